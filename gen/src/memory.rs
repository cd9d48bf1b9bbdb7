//! A memory beside a block in the top of a design: words that an FPGA has as block RAM.

use helixlock_netlist::{
    Design, Expression, Memory, Module, ModuleSignal, Port, PortKind, Role, SignalId, Statement,
};

use crate::GenError;
use crate::exchange::{Source, insert};

/// Name of the module and of its instance.
const NAME: &str = "sample_memory";

/// Ports but the clock, in order, with what each is for; the block's have `memory_` before them.
const PORTS: [(&str, &str); 4] = [
    ("write", "sample is put at address"),
    ("address", "place of a word"),
    ("sample", "the word"),
    ("data", "the word that stood at address one clock ago, unless that was written"),
];

/// Puts as many words as its `memory_address` reaches beside the block of that name in the top: its
/// outputs `memory_write` and `memory_sample` write one there, its input `memory_data` reads it.
///
/// # Errors
///
/// [`GenError::NoSignal`] when the block is not there or has no such ports.
pub fn attach_memory(design: &mut Design, block: &str) -> Result<(), GenError> {
    let names = PORTS.map(|(port, _)| format!("{block}_memory_{port}"));
    let mut ids = vec![];
    for name in &names {
        let missing = || GenError::NoSignal { signal: name.clone() };
        let mut signals = (0..).map(SignalId).zip(&design.top().signals);
        let found = signals.find(|(_, signal)| signal.name == *name);
        let (id, signal) = found.ok_or_else(missing)?;
        ids.push((id, signal.width));
    }
    let index = design.modules.len() - 1;
    design.modules.insert(index, memory(ids[1].1, ids[2].1));
    let sources = names.each_ref().map(|name| [name.as_str()]);
    let inputs = [0, 1, 2].map(|port| (PORTS[port].0, Source::Signals(&sources[port])));
    let wires = insert(design, NAME, index, &inputs)?;
    let (into, width) = ids[3];
    if let (Some(top), Some(word)) = (design.modules.last_mut(), wires.get(PORTS[3].0)) {
        let into = top.body.iter_mut().filter_map(|statement| match statement {
            Statement::Assign { target, value } if *target == into => Some(value),
            _ => None,
        });
        into.for_each(|value| *value = Expression::signal(width, *word));
    }
    Ok(())
}

/// The module, of words as wide as that and as many as the address reaches.
fn memory(address_width: u32, width: u32) -> Module {
    let [write, address, sample, data, word] = [0, 1, 2, 3, 4].map(SignalId);
    let signal = |name: &str, width, role| ModuleSignal { name: name.to_owned(), width, role };
    let kinds = [
        PortKind::Input(write),
        PortKind::Input(address),
        PortKind::Input(sample),
        PortKind::Output(data),
    ];
    let clock = Port { name: "clock".to_owned(), kind: PortKind::Clock };
    let ports = PORTS.iter().zip(kinds);
    let ports = ports.map(|((name, _), kind)| Port { name: (*name).to_owned(), kind });
    let notes = PORTS.iter().map(|(_, note)| (*note).to_owned());
    Module {
        name: NAME.to_owned(),
        comment: "Words that an FPGA has as block RAM".to_owned(),
        ports: std::iter::once(clock).chain(ports).collect(),
        port_notes: std::iter::once("FPGA clock, rising edge".to_owned()).chain(notes).collect(),
        signals: vec![
            signal("write", 1, Role::Input),
            signal("address", address_width, Role::Input),
            signal("sample", width, Role::Input),
            signal("data", width, Role::Output),
            signal("word_q", width, Role::RegisterOutput),
        ],
        body: vec![Statement::Assign { target: data, value: Expression::signal(width, word) }],
        memory: Some(Memory { words: 1 << address_width, address, write, sample, word }),
        ..Module::default()
    }
}
