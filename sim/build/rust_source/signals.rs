//! Every signal at once, for those who look at all of them.

use std::fmt::Write as _;

use helixlock_netlist::{Netlist, SignalId};

use super::dense::{indented, place_sources};
use super::words::{Operand, Words};

/// `impl AllSignals for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl AllSignals for {name} {{
    fn signals(&self, inputs: &[u64], registers: &[u64], values: &mut [u64]) {{
{lines}    }}
}}

",
        lines = indented(&lines(netlist)),
    );
    source
}

fn lines(netlist: &Netlist) -> Vec<String> {
    let signals = || (0..).map(SignalId).take(netlist.signals.len());
    let mut words = Words::new(netlist);
    place_sources(&mut words, netlist, signals());
    let values: Vec<Operand> = signals().map(|signal| words.signal(signal)).collect();
    let mut lines = words.lines();
    let stores = values.iter().enumerate();
    lines.extend(stores.map(|(index, word)| format!("values[{index}] = {word};")));
    lines
}
