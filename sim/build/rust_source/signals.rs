//! Every signal at once, for those who look at all of them.

use std::fmt::Write as _;

use helixlock_netlist::{Netlist, SignalId};

use super::dense::{indented, stores};

/// `impl AllSignals for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let signals: Vec<SignalId> = (0..).map(SignalId).take(netlist.signals.len()).collect();
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl AllSignals for {name} {{
    fn signals(&self, inputs: &[u64], registers: &[u64], values: &mut [u64]) {{
{lines}    }}
}}

",
        lines = indented(&stores(netlist, &signals)),
    );
    source
}
