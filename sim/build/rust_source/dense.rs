//! The kernel that takes every clock: registers are updated in place, block by block.
//!
//! ```text
//! tables are asked
//! packed registers
//! if any block is active { if block { its words; blocks inside; its registers; what is kept } … }
//! registers that are neither packed nor in a block
//! ```

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::blocks::Site;
use super::outside;
use super::packing::Packing;
use super::plan::{Kept, Plan};
use super::words::{Operand, Words};
use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::{Netlist, SignalId};

/// `impl DenseKernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let mut plan = Plan::new(netlist);
    let packing = Packing::new(&plan);
    plan.kept.retain(|kept| !packing.bits.contains_key(&kept.word));
    let (plan, packing) = (&plan, &packing);
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
    const TOGGLES: &'static [u64] = &{toggles:?};
    const TABLES: usize = {tables};

    #[inline(always)]
    fn step(inputs: &Self::Inputs, registers: &mut Self::Registers, kept: &mut Self::Kept, known: u64, rest: &mut Rest) -> u64 {{
{step}    }}

    #[inline(always)]
    fn keep(inputs: &Self::Inputs, registers: &Self::Registers, kept: &mut Self::Kept, mut next: u64) -> u64 {{
{keep}    }}

    #[inline(always)]
    fn pack(registers: &Self::Registers, known: u64) -> u64 {{
{pack}    }}

    #[inline(always)]
    fn unpack(known: u64, registers: &mut Self::Registers) {{
{unpack}    }}

    #[inline(always)]
    fn outputs(inputs: &Self::Inputs, registers: &Self::Registers, values: &mut [u64]) {{
{outputs}    }}
}}

{blocks}",
        kept = plan.kept.len(),
        initial = netlist.registers.iter().map(|register| register.initial).collect::<Vec<_>>(),
        kept_from = (0..inputs).map(|input| is_kept_from(plan, packing, input)).collect::<Vec<_>>(),
        toggles = (0..inputs).map(|input| toggles(plan, packing, input)).collect::<Vec<_>>(),
        step = indented(&step(plan, packing)),
        tables = packing.tables.len(),
        blocks = blocks_function(plan, packing, name),
        keep = indented(&keep_all(plan, packing)),
        pack = indented(&pack(packing)),
        unpack = indented(&unpack(packing)),
        outputs = indented(&stores(netlist, &netlist.outputs)),
    );
    source
}

/// True when words kept depend on an input, other than a bit that is the input itself.
fn is_kept_from(plan: &Plan, packing: &Packing, input: usize) -> bool {
    let apart = packing.steady.iter().filter(|kept| plan.input_of(kept.word).is_none());
    plan.kept.iter().chain(apart).any(|kept| kept.inputs.contains(&input))
}

/// The packed bit that is an input.
fn toggles(plan: &Plan, packing: &Packing, input: usize) -> u64 {
    let is_it = |kept: &&Kept| plan.input_of(kept.word) == Some(input);
    packing.steady.iter().find(is_it).map_or(0, |kept| 1 << packing.bits[&kept.word])
}

/// Statements that take the packed registers from where they stand one a word.
fn pack(packing: &Packing) -> Vec<String> {
    let bits = packing.registers.iter();
    let mask: u64 = packing.registers.values().map(|bit| 1 << bit).sum();
    let parts = bits.map(|(register, bit)| format!(" | registers[{register}] << {bit}"));
    vec![format!("known & {:#x}{}", !mask, parts.collect::<String>())]
}

/// The other way about.
fn unpack(packing: &Packing) -> Vec<String> {
    let bits = packing.registers.iter();
    bits.map(|(register, bit)| format!("registers[{register}] = known >> {bit} & 1;")).collect()
}

/// The registers left outside are written last: blocks read their old values.
fn step(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut lines = outside::lines(plan, packing);
    lines.extend(active_blocks(plan, packing));
    lines.extend(packing.left_outside(plan).into_iter().map(|register| plan.update(register)));
    lines.push("next".to_owned());
    lines
}

/// The statement that looks after blocks, passed over when all are known to stand still.
fn active_blocks(plan: &Plan, packing: &Packing) -> Option<String> {
    let outer = || plan.blocks.blocks.iter().filter(|block| block.parent.is_none());
    outer().next()?;
    let call = "Self::blocks(inputs, registers, kept, known, found, next)";
    let statement = if packing.gives_all_to_blocks(plan) {
        format!("next = rest.passing_over([known, found], registers, next, |registers| {call});")
    } else {
        format!("next = {call};")
    };
    let active: Option<Vec<u64>> = outer().map(|block| packing.active(block)).collect();
    Some(match active {
        Some(active) => {
            format!("if found & {:#x} != 0 {{ {statement} }}", active.iter().sum::<u64>())
        }
        None => statement,
    })
}

/// What [`active_blocks`] calls. In a function of its own it leaves the processor's registers to the
/// clocks at which no block is active.
fn blocks_function(plan: &Plan, packing: &Packing, name: &str) -> String {
    if plan.blocks.blocks.is_empty() {
        return String::new();
    }
    format!(
        "impl {name} {{
    #[inline(never)]
    fn blocks(
        inputs: &<Self as DenseKernel>::Inputs,
        registers: &mut <Self as DenseKernel>::Registers,
        kept: &mut <Self as DenseKernel>::Kept,
        known: u64,
        found: u64,
        mut next: u64,
    ) -> u64 {{
{blocks}    }}
}}

",
        blocks = indented(&blocks(plan, packing)),
    )
}

fn blocks(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut lines = outside::needed_by_blocks(plan, packing);
    lines.extend(blocks_in(plan, packing, None));
    for roots in shared(plan, packing) {
        let actives = roots.iter().map(|root| plan.blocks.blocks[*root].active.to_string());
        lines.push(format!("if {} != 0 {{", actives.collect::<Vec<_>>().join(" | ")));
        lines.extend(keep(plan, packing, |kept| kept.roots == roots, |kept| kept.roots.len() < 2));
        lines.push("}".to_owned());
    }
    lines.push("next".to_owned());
    lines
}

/// Groups of blocks on all of which some word that is kept depends.
fn shared(plan: &Plan, packing: &Packing) -> BTreeSet<BTreeSet<usize>> {
    let roots = plan.kept.iter().chain(&packing.steady).map(|kept| kept.roots.clone());
    roots.filter(|roots| 1 < roots.len()).collect()
}

/// The blocks directly inside a site.
fn blocks_in(plan: &Plan, packing: &Packing, site: Site) -> Vec<String> {
    let mut lines = vec![];
    let blocks = plan.blocks.blocks.iter().enumerate();
    for (index, block) in blocks.filter(|(_, block)| block.parent == site) {
        lines.push(format!("if {} != 0 {{", block.active));
        lines.extend(plan.computed_in(Some(index)).map(|word| plan.words.line(word)));
        lines.extend(blocks_in(plan, packing, Some(index)));
        lines.extend(block.registers.iter().map(|register| plan.update(*register)));
        let own = |kept: &Kept| kept.roots == BTreeSet::from([index]);
        lines.extend(keep(plan, packing, own, |kept| kept.roots.is_empty()));
        lines.push("}".to_owned());
    }
    lines
}

/// Statements that compute all that is kept.
fn keep_all(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut lines = keep(plan, packing, |_| true, |_| false);
    lines.push("next".to_owned());
    lines
}

/// Statements that compute words kept anew, in a scope of their own, from bits of `next` where those
/// are `fresh`.
fn keep(
    plan: &Plan,
    packing: &Packing,
    which: impl Fn(&Kept) -> bool,
    fresh: impl Fn(&Kept) -> bool,
) -> Vec<String> {
    let kept: Vec<(usize, &Kept)> =
        plan.kept.iter().enumerate().filter(|(_, kept)| which(kept)).collect();
    let (steady, others): (Vec<&Kept>, Vec<&Kept>) =
        packing.steady.iter().partition(|kept| which(kept));
    let fresh: BTreeSet<usize> =
        others.into_iter().filter(|kept| fresh(kept)).map(|kept| kept.word).collect();
    let all = kept.iter().map(|(_, kept)| *kept).chain(steady.iter().copied());
    let words = plan.cone_up_to(all.map(|kept| kept.word), &fresh);
    if words.is_empty() {
        return vec![];
    }
    let mut lines = vec!["{".to_owned()];
    lines.extend(words.into_iter().map(|word| match packing.bits.get(&word) {
        Some(bit) if fresh.contains(&word) => format!("let w{word} = next >> {bit} & 1;"),
        _ => plan.words.line(word),
    }));
    lines.extend(
        kept.iter().map(|(place, kept)| format!("kept[{place}] = {};", Operand::Word(kept.word))),
    );
    if !steady.is_empty() {
        let bits = steady.iter().map(|kept| (kept.word, packing.bits[&kept.word]));
        let mask: u64 = bits.clone().map(|(_, bit)| 1 << bit).sum();
        let parts = bits.map(|(word, bit)| format!(" | w{word} << {bit}"));
        lines.push(format!("next = next & {:#x}{};", !mask, parts.collect::<String>()));
    }
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
