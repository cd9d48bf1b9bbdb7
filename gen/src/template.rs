//! How to put a module into a design of one's own: a text to copy.

use helixlock_netlist::{Module, PortKind};

/// An instance with every port named, its direction and width beside it.
pub(crate) fn template(module: &Module) -> String {
    let name = &module.name;
    let mut lines =
        vec![format!("// Copy this into your design and connect the ports.\n{name} {name}_0 (")];
    let longest = module.ports.iter().map(|port| port.name.len()).max().unwrap_or(0);
    for (index, port) in module.ports.iter().enumerate() {
        let (direction, width) = match port.kind {
            PortKind::Clock => ("in", 1),
            PortKind::Input(id) => ("in", module.signal(id).width),
            PortKind::Output(id) => ("out", module.signal(id).width),
        };
        let comma = if index + 1 < module.ports.len() { "," } else { "" };
        let connection = format!(".{}(){comma}", port.name);
        let bits = if width == 1 { "1 bit".to_owned() } else { format!("{width} bits") };
        lines.push(format!("    {connection:0$} // {direction}, {bits}", longest + 4));
    }
    lines.push(");\n".to_owned());
    lines.join("\n")
}
