//! The kernel that takes every clock: registers are updated in place, block by block.
//!
//! ```text
//! registers outside all blocks, and the words that blocks need of the old ones
//! if block { its words; blocks inside; its registers; words kept that depend on it }
//! …
//! words kept that depend on several blocks
//! ```

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::blocks::Site;
use super::outside;
use super::plan::{Kept, Plan};
use super::words::{Operand, Words};
use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::{Netlist, SignalId};

/// `impl DenseKernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let plan = Plan::new(netlist);
    let (inputs, registers) = (netlist.inputs.len(), netlist.registers.len());
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl DenseKernel for {name} {{
    type Inputs = [u64; {inputs}];
    type Registers = [u64; {registers}];
    type Kept = [u64; {kept}];
    const INPUTS: Self::Inputs = [0; {inputs}];
    const REGISTERS: Self::Registers = {initial:?};
    const KEPT: Self::Kept = [0; {kept}];
    const KEPT_FROM: &'static [bool] = &{kept_from:?};

    // In a loop of its caller it would carry the registers from clock to clock, on the stack.
    #[inline(never)]
    fn step(inputs: &Self::Inputs, registers: &mut Self::Registers, kept: &mut Self::Kept) {{
{step}    }}

    #[inline(always)]
    fn keep(inputs: &Self::Inputs, registers: &Self::Registers, kept: &mut Self::Kept) {{
{keep}    }}

    #[inline(always)]
    fn outputs(inputs: &Self::Inputs, registers: &Self::Registers, values: &mut [u64]) {{
{outputs}    }}
}}

",
        kept = plan.kept.len(),
        initial = netlist.registers.iter().map(|register| register.initial).collect::<Vec<_>>(),
        kept_from = kept_from(&plan, inputs),
        step = indented(&step(&plan)),
        keep = indented(&keep(&plan, |_| true)),
        outputs = indented(&stores(netlist, &netlist.outputs)),
    );
    source
}

/// One an input: words kept depend on it.
fn kept_from(plan: &Plan, inputs: usize) -> Vec<bool> {
    (0..inputs).map(|input| plan.kept.iter().any(|kept| kept.inputs.contains(&input))).collect()
}

fn step(plan: &Plan) -> Vec<String> {
    let mut lines = outside::lines(plan);
    lines.extend(blocks_in(plan, None));
    for roots in shared(plan) {
        let actives = roots.iter().map(|root| plan.blocks.blocks[*root].active.to_string());
        lines.push(format!("if {} != 0 {{", actives.collect::<Vec<_>>().join(" | ")));
        lines.extend(keep(plan, |kept| kept.roots == roots));
        lines.push("}".to_owned());
    }
    lines
}

/// Groups of blocks on all of which some word that is kept depends.
fn shared(plan: &Plan) -> BTreeSet<BTreeSet<usize>> {
    let roots = plan.kept.iter().map(|kept| kept.roots.clone());
    roots.filter(|roots| 1 < roots.len()).collect()
}

/// The blocks directly inside a site.
fn blocks_in(plan: &Plan, site: Site) -> Vec<String> {
    let mut lines = vec![];
    let blocks = plan.blocks.blocks.iter().enumerate();
    for (index, block) in blocks.filter(|(_, block)| block.parent == site) {
        lines.push(format!("if {} != 0 {{", block.active));
        lines.extend(plan.computed_in(Some(index)).map(|word| plan.words.line(word)));
        lines.extend(blocks_in(plan, Some(index)));
        lines.extend(block.registers.iter().map(|register| plan.update(*register)));
        lines.extend(keep(plan, |kept| kept.roots == BTreeSet::from([index])));
        lines.push("}".to_owned());
    }
    lines
}

/// Statements that compute words kept anew, in a scope of their own.
fn keep(plan: &Plan, which: impl Fn(&Kept) -> bool) -> Vec<String> {
    let kept: Vec<(usize, &Kept)> =
        plan.kept.iter().enumerate().filter(|(_, kept)| which(kept)).collect();
    if kept.is_empty() {
        return vec![];
    }
    let words: BTreeSet<usize> = kept.iter().flat_map(|(_, kept)| plan.cone(kept.word)).collect();
    let mut lines = vec!["{".to_owned()];
    lines.extend(words.into_iter().map(|word| plan.words.line(word)));
    lines.extend(
        kept.iter().map(|(place, kept)| format!("kept[{place}] = {};", Operand::Word(kept.word))),
    );
    lines.push("}".to_owned());
    lines
}

/// Statements that write signals into `values`, in order.
pub(super) fn stores(netlist: &Netlist, signals: &[SignalId]) -> Vec<String> {
    let mut words = Words::new(netlist);
    place_sources(&mut words, netlist, signals.iter().copied());
    let values: Vec<Operand> = signals.iter().map(|signal| words.signal(*signal)).collect();
    let mut lines = words.lines();
    let stores = values.iter().enumerate();
    lines.extend(stores.map(|(index, word)| format!("values[{index}] = {word};")));
    lines
}

/// Places the inputs and registers that `roots` depend on, and no others.
fn place_sources(words: &mut Words, netlist: &Netlist, roots: impl Iterator<Item = SignalId>) {
    let drivers = Drivers::new(netlist);
    for end in drivers.ends(roots, |_| false) {
        match drivers.of(end) {
            Driver::Input(index) => words.place(end, &format!("inputs[{index}]")),
            Driver::Register(index) => words.place(end, &format!("registers[{index}]")),
            Driver::Assignment(_) | Driver::Nothing => {}
        }
    }
}

/// Lines of a function body.
pub(super) fn indented(lines: &[String]) -> String {
    lines.iter().flat_map(|line| ["        ", line, "\n"]).collect()
}
