//! The kernel that takes every clock: registers are updated in place, block by block.
//!
//! ```text
//! tables are asked
//! packed registers
//! if any block is active { if block { its words; blocks inside; its registers; what is kept } … }
//! registers that are neither packed nor in a block
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use super::blocks::Site;
use super::leaping;
use super::outside;
use super::packing::Packing;
use super::plan::{Kept, Plan};
use super::split::Split;
use super::words::{Operand, Words};
use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::{Netlist, SignalId};

/// `impl DenseKernel for name`, and what it calls and asks.
pub(super) fn source(original: &Netlist, name: &str) -> String {
    let Split { netlist, origins } = &Split::new(original);
    let mut plan = Plan::new(netlist);
    let packing = Packing::new(&plan);
    plan.kept.retain(|kept| !packing.bits.contains_key(&kept.word));
    let (plan, packing) = (&plan, &packing);
    let (look, entries) = outside::look(plan, packing, name);
    let (shown_at, shown) = leaping::shown(plan, packing);
    let mut source = blocks_function(plan, packing, name);
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "static {tables}_TABLES: [u64; {count}] = {entries:?};

impl DenseKernel for {name} {{
{constants}    type Joined = [u64; {joined}];
    const SHOWN: &'static [Option<u32>] = &{shown_at:?};

    #[inline(always)]
    fn look<G: Gather>(inputs: &Self::Inputs, registers: &Self::Registers, kept: &Self::Kept, Known {{ early: known, late }}: Known) -> Edge {{
{look}    }}

    #[inline(always)]
    fn take(inputs: &Self::Inputs, registers: &mut Self::Registers, kept: &mut Self::Kept, edge: Edge, rest: &mut Rest) -> Known {{
        let Edge {{ known: Known {{ early: known, late }}, next: Known {{ early: mut next, late: later }}, found }} = edge;
{take}    }}

    fn keep(inputs: &mut Self::Inputs, registers: &Self::Registers, kept: &mut Self::Kept, mut next: u64) -> u64 {{
{keep}    }}

    fn split(values: &[u64], registers: &mut Self::Registers, known: u64) -> Known {{
{split}    }}

    fn join(Known {{ early: known, late }}: Known, registers: &Self::Registers) -> Self::Joined {{
{join}    }}

    fn shown(Known {{ early: known, late }}: Known) -> u64 {{
{shown}    }}

    fn outputs(inputs: &[u64], registers: &[u64], values: &mut [u64]) {{
{outputs}    }}
}}

",
        tables = name.to_uppercase(),
        count = entries.len(),
        constants = constants(netlist, plan, packing),
        joined = original.registers.len(),
        look = indented(&look),
        take = indented(&take(plan, packing)),
        keep = indented(&keep_all(plan, packing)),
        split = indented(&split(packing, origins)),
        join = indented(&join(packing, origins, original)),
        shown = indented(&shown),
        outputs = indented(&stores(original, &netlist.outputs)),
    );
    source
}

/// Types and constants of a kernel.
fn constants(netlist: &Netlist, plan: &Plan, packing: &Packing) -> String {
    let inputs = netlist.inputs.len();
    format!(
        "    type Inputs = [u64; {held}];
    type Registers = [u64; {registers}];
    type Kept = [u64; {kept}];
    const INPUTS: Self::Inputs = [0; {held}];
    const REGISTERS: Self::Registers = [0; {registers}];
    const KEPT: Self::Kept = [0; {kept}];
    const TELLS: &'static [bool] = &{tells:?};
    const TOGGLES: &'static [u64] = &{toggles:?};
    const TABLES: usize = {tables};
    const BUSY: Option<u64> = {busy:?};
    const COASTING: &'static [Coast] = &[{coasting}];
",
        held = inputs + plan.set.len(),
        registers = netlist.registers.len(),
        kept = plan.kept.len(),
        tells = (0..inputs).map(|input| tells(plan, packing, input)).collect::<Vec<_>>(),
        toggles = (0..inputs).map(|input| toggles(plan, packing, input)).collect::<Vec<_>>(),
        tables = packing.tables.len(),
        busy = leaping::busy(plan, packing),
        coasting = leaping::coasting(netlist, plan, packing).join(", "),
    )
}

/// True when an input is not, or is more than, a packed bit: others are computed from it.
fn tells(plan: &Plan, packing: &Packing, input: usize) -> bool {
    let packed = packing.steady.iter().filter(|kept| plan.input_of(kept.word).is_none());
    let others = plan.kept.iter().chain(packed).chain(&packing.fresh);
    let mut inputs = others.map(|kept| kept.inputs.clone()).chain(set_from(plan));
    toggles(plan, packing, input) == 0 || inputs.any(|inputs| inputs.contains(&input))
}

/// The inputs that words are set by.
fn set_from(plan: &Plan) -> impl Iterator<Item = BTreeSet<usize>> {
    plan.set.iter().map(|word| plan.kept(*word).inputs)
}

/// The packed bit that is an input.
fn toggles(plan: &Plan, packing: &Packing, input: usize) -> u64 {
    let is_it = |kept: &&Kept| plan.input_of(kept.word) == Some(input);
    packing.steady.iter().find(is_it).map_or(0, |kept| 1 << packing.bits[&kept.word])
}

/// Statements that take registers from where they stand whole.
fn split(packing: &Packing, origins: &[(usize, u32)]) -> Vec<String> {
    let all = || origins.iter().enumerate();
    let words = all().filter(|(register, _)| !packing.has(*register));
    let words =
        words.map(|(register, (index, _))| format!("registers[{register}] = values[{index}];"));
    let bits = |of: &BTreeMap<usize, u32>| {
        let parts = all().filter_map(|(register, (index, low))| {
            Some(format!(" | (values[{index}] >> {low} & 1) << {}", of.get(&register)?))
        });
        parts.collect::<String>()
    };
    let mask: u64 = packing.registers.values().map(|bit| 1 << bit).sum();
    let (early, late) = (bits(&packing.registers), bits(&packing.late));
    let known = format!("Known {{ early: known & {:#x}{early}, late: 0{late} }}", !mask);
    words.chain([known]).collect()
}

/// The other way about.
fn join(packing: &Packing, origins: &[(usize, u32)], original: &Netlist) -> Vec<String> {
    let part = |register: usize| {
        let places = [("known", &packing.registers), ("late", &packing.late)];
        let mut bits = places.into_iter().filter_map(|(word, of)| Some((word, of.get(&register)?)));
        match bits.next() {
            Some((word, bit)) => format!("({word} >> {bit} & 1)"),
            None => format!("registers[{register}]"),
        }
    };
    let value = |index: usize| {
        let parts = origins.iter().enumerate().filter(|(_, (origin, _))| *origin == index);
        let parts = parts.map(|(register, (_, low))| format!("{} << {low}", part(register)));
        parts.collect::<Vec<_>>().join(" | ")
    };
    let values: Vec<String> = (0..original.registers.len()).map(value).collect();
    vec![format!("[{}]", values.join(", "))]
}

/// The registers left outside are written last: blocks read their old values.
fn take(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut lines = outside::left(plan, packing);
    lines.extend(active_blocks(plan, packing));
    lines.extend(packing.left_outside(plan).into_iter().map(|register| plan.update(register)));
    let fresh: Vec<&Kept> = packing.fresh.iter().collect();
    lines.extend(keep(plan, packing, [vec![], fresh], &BTreeSet::new()));
    lines.push("Known { early: next, late: later }".to_owned());
    lines
}

/// The statement that looks after blocks, passed over when all are known to stand still.
fn active_blocks(plan: &Plan, packing: &Packing) -> Option<String> {
    let outer = || plan.blocks.blocks.iter().filter(|block| block.parent.is_none());
    outer().next()?;
    let call = "Self::blocks(inputs, registers, kept, known, late, found, next)";
    let statement = if packing.gives_all_to_blocks(plan) {
        format!(
            "let kept = &mut *kept; \
             next = rest.passing_over([known, late, found], registers, next, move |registers| {call});"
        )
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
        late: u64,
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
        lines.extend(keep_where(
            plan,
            packing,
            |kept| kept.roots == roots,
            |kept| kept.roots.len() < 2,
        ));
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
        lines.extend(plan.computed_in(Some(index)).map(|word| plan.line(word)));
        lines.extend(blocks_in(plan, packing, Some(index)));
        lines.extend(block.registers.iter().map(|register| plan.update(*register)));
        let own = |kept: &Kept| kept.roots == BTreeSet::from([index]);
        lines.extend(keep_where(plan, packing, own, |kept| kept.roots.is_empty()));
        lines.push("}".to_owned());
    }
    lines
}

/// Statements that compute all that is kept.
fn keep_all(plan: &Plan, packing: &Packing) -> Vec<String> {
    let packed = packing.steady.iter().chain(&packing.fresh);
    let all = [plan.kept.iter().collect(), packed.collect()];
    let set = plan.cone_up_to(plan.set.iter().copied(), &BTreeSet::new());
    let mut lines: Vec<String> = set.into_iter().map(|word| plan.words.line(word)).collect();
    let words = plan.set.iter().filter_map(|word| Some((word, plan.set_at(*word)?)));
    lines.extend(words.map(|(word, place)| format!("inputs[{place}] = w{word};")));
    lines.extend(keep(plan, packing, all, &BTreeSet::new()));
    lines.push("next".to_owned());
    lines
}

/// Statements that compute words kept anew, from bits of `next` where those are `up_to_date`.
fn keep_where(
    plan: &Plan,
    packing: &Packing,
    which: impl Fn(&Kept) -> bool,
    up_to_date: impl Fn(&Kept) -> bool,
) -> Vec<String> {
    let kept = plan.kept.iter().filter(|kept| which(kept)).collect();
    let (steady, others): (Vec<&Kept>, Vec<&Kept>) =
        packing.steady.iter().partition(|kept| which(kept));
    let known = others.into_iter().filter(|kept| up_to_date(kept)).map(|kept| kept.word).collect();
    keep(plan, packing, [kept, steady], &known)
}

/// Statements that compute words of their own and packed ones, in a scope, from bits of `next` where
/// those are `known`.
fn keep(
    plan: &Plan,
    packing: &Packing,
    [kept, packed]: [Vec<&Kept>; 2],
    known: &BTreeSet<usize>,
) -> Vec<String> {
    let there = known.iter().chain(&plan.set).copied().collect();
    let words = plan.cone_up_to(kept.iter().chain(&packed).map(|kept| kept.word), &there);
    if words.is_empty() {
        return vec![];
    }
    let mut lines = vec!["{".to_owned()];
    lines.extend(words.into_iter().map(|word| match packing.bits.get(&word) {
        Some(bit) if known.contains(&word) => format!("let w{word} = next >> {bit} & 1;"),
        _ if plan.set.contains(&word) => plan.line(word),
        _ => plan.words.line(word),
    }));
    for kept in kept {
        let place = plan.kept.iter().position(|other| other.word == kept.word);
        let place = place.expect("what is kept has a place");
        lines.push(format!("kept[{place}] = {};", Operand::Word(kept.word)));
    }
    if !packed.is_empty() {
        let bits = packed.iter().map(|kept| (kept.word, packing.bits[&kept.word]));
        let mask: u64 = bits.clone().map(|(_, bit)| 1 << bit).sum();
        let parts: Vec<String> = bits.map(|(word, bit)| format!("w{word} << {bit}")).collect();
        // In brackets, so that what is known last is joined last.
        lines.push(format!("next = next & {:#x} | ({});", !mask, parts.join(" | ")));
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
