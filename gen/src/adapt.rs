//! A design as others want it: its modules under other names, its top with fewer pins.

use helixlock_netlist::{Design, PortKind, Role};

use crate::GenError;
use crate::bypass::{forget, is_read};

/// Puts a prefix before the name of every module, so that a core meets no other of its name.
pub fn prefix(design: &mut Design, prefix: &str) {
    for module in &mut design.modules {
        module.name.insert_str(0, prefix);
    }
}

/// Takes a pin from the top: inside, an input then has the level for ever, an output no reader. An
/// input that nothing reads goes altogether.
///
/// # Errors
///
/// [`GenError::NoPort`] when the top has no such pin.
pub fn leave_out(design: &mut Design, pin: &str, level: u64) -> Result<(), GenError> {
    let missing = || GenError::NoPort { pin: pin.to_owned() };
    let top = design.modules.last_mut().ok_or_else(missing)?;
    let place = top.ports.iter().position(|port| port.name == pin).ok_or_else(missing)?;
    let port = top.ports.remove(place);
    if place < top.port_notes.len() {
        top.port_notes.remove(place);
    }
    match port.kind {
        PortKind::Clock => return Err(missing()),
        PortKind::Input(id) if !is_read(top, id) => forget(top, &[id]),
        PortKind::Input(id) => top.signals[id.0 as usize].role = Role::Constant(level),
        PortKind::Output(id) => top.signals[id.0 as usize].role = Role::Local,
    }
    Ok(())
}
