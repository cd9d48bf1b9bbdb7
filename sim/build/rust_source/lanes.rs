//! The kernel of many copies: one bit a lane, so that a gate serves 512 copies at once.
//!
//! ```text
//! if block is active in any lane { blocks inside; its registers } …
//! if registers that follow inputs have not settled { these registers } …
//! registers outside all blocks
//! if blocks were active { gates kept that depend on them } …
//! ```
//!
//! Registers are updated in place. The code is generic in the vector it computes with, so that it is
//! compiled for every kind the processor may have.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use helixlock_netlist::Netlist;

use super::blocks::Site;
use super::dense::indented;
use super::digits::Digits;
use super::following::following;
use super::gates::{Bit, Gate};
use super::lane_circuit::{LaneCircuit, number};
use super::plan::Plan;

/// `impl LaneKernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let Digits { netlist, next } = &Digits::new(netlist);
    let mut plan = Plan::undecided(netlist);
    for (digit, next) in next {
        plan.next[*digit] = plan.words.value(next);
    }
    let following = following(&plan);
    for group in &following {
        plan.blocks.set_apart(group.registers.clone());
    }
    let circuit = LaneCircuit::new(netlist, &plan, following);
    let step = indented(&step(&circuit));
    let keep = indented(&keep(&circuit));
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl LaneKernel for {name} {{
{constants}
    #[inline(always)]
    fn step<V: Vector>(inputs: &Self::Inputs, state: &mut Self::State, kept: &mut Self::Kept, settling: &mut Self::Settling) {{
{step}    }}

    #[inline(always)]
    fn keep<V: Vector>(inputs: &Self::Inputs, state: &Self::State, kept: &mut Self::Kept) {{
{keep}    }}
}}

",
        constants = constants(&circuit),
    );
    source
}

/// Types and constants of a kernel.
fn constants(circuit: &LaneCircuit) -> String {
    let followed_by = circuit.inputs.iter().map(|input| {
        let groups = circuit.following.iter().enumerate();
        let groups = groups.filter(|(_, group)| group.inputs.contains(input));
        format!("&{:?}", groups.map(|(place, _)| place).collect::<Vec<_>>())
    });
    let read = circuit.cone(circuit.kept.keys().copied(), |_| false);
    let tells = (0..circuit.inputs.len())
        .map(|place| read.iter().any(|gate| circuit.gates[*gate] == Gate::Input(place)));
    let settling = circuit.following.iter().map(|group| group.edges);
    format!(
        "    type Inputs = [Lane; {inputs}];
    type State = [Lane; {state}];
    type Kept = [Lane; {kept}];
    type Settling = [usize; {following}];
    const INPUTS: Self::Inputs = [[0; LANE_WORDS]; {inputs}];
    const STATE: Self::State = [[0; LANE_WORDS]; {state}];
    const KEPT: Self::Kept = [[0; LANE_WORDS]; {kept}];
    const SETTLING: Self::Settling = {settling:?};
    const TELLS: &'static [bool] = &{tells:?};
    const FOLLOWED_BY: &'static [&'static [usize]] = &[{followed_by}];
",
        inputs = circuit.inputs.len(),
        state = circuit.next.len(),
        kept = circuit.kept.len(),
        following = circuit.following.len(),
        settling = settling.collect::<Vec<_>>(),
        tells = tells.collect::<Vec<_>>(),
        followed_by = followed_by.collect::<Vec<_>>().join(", "),
    )
}

/// Statements that take an edge.
fn step(circuit: &LaneCircuit) -> Vec<String> {
    let [defined, written, saved] = [const { BTreeSet::new() }; 3];
    let mut code = Code { circuit, defined, written, saved, lines: vec![] };
    code.site(None);
    let words = circuit.plan.blocks.blocks.len().div_ceil(64);
    let mut lines = vec![format!("let mut moved = [0_u64; {words}];")];
    let save = |place: &usize| format!("let s{place} = V::load(&state[{place}]);");
    lines.extend(code.saved.iter().map(save));
    lines.extend(code.lines);
    for ((_, blocks), kept) in circuit.groups().into_iter().filter(|((count, _), _)| 0 < *count) {
        lines.push(format!("if {} {{", any_moved(&blocks)));
        lines.extend(keep_group(circuit, &kept));
        lines.push("}".to_owned());
    }
    lines
}

/// Statements that compute all that is kept.
fn keep(circuit: &LaneCircuit) -> Vec<String> {
    let mut lines = vec![];
    for kept in circuit.groups().into_values() {
        lines.push("{".to_owned());
        lines.extend(keep_group(circuit, &kept));
        lines.push("}".to_owned());
    }
    lines
}

/// Statements that compute some of the gates kept.
fn keep_group(circuit: &LaneCircuit, group: &[usize]) -> Vec<String> {
    let is_kept = |gate: usize| circuit.kept.contains_key(&gate) && !group.contains(&gate);
    let is_there = |gate: usize| circuit.gates[gate].is_read() || is_kept(gate);
    let cone = circuit.cone(group.iter().copied(), is_there);
    let name = |gate: usize| match circuit.kept.get(&gate) {
        Some(place) if is_kept(gate) => format!("V::load(&kept[{place}])"),
        _ => read(circuit, gate).unwrap_or_else(|| format!("g{gate}")),
    };
    let line = |gate: usize| {
        let names = circuit.gates[gate].operands().into_iter().map(name);
        definition(gate, circuit.gates[gate], &names.collect::<Vec<_>>())
    };
    let mut lines: Vec<String> = cone.into_iter().map(line).collect();
    let place = |gate: &usize| format!("g{gate}.store(&mut kept[{}]);", circuit.kept[gate]);
    lines.extend(group.iter().map(place));
    lines
}

/// Where a bit that no gate computes is read from.
fn read(circuit: &LaneCircuit, gate: usize) -> Option<String> {
    match circuit.gates[gate] {
        Gate::Input(place) => Some(format!("V::load(&inputs[{place}])")),
        Gate::State(place) => Some(format!("V::load(&state[{place}])")),
        _ => None,
    }
}

/// True when one of some blocks was active.
fn any_moved(blocks: &[usize]) -> String {
    let mut masks: BTreeMap<usize, u64> = BTreeMap::new();
    for block in blocks {
        *masks.entry(block / 64).or_default() |= 1 << (block % 64);
    }
    let words = masks.iter().map(|(word, mask)| format!("(moved[{word}] & {mask:#x})"));
    format!("{} != 0", words.collect::<Vec<_>>().join(" | "))
}

/// The statement that computes a gate from what others are called.
fn definition(index: usize, gate: Gate, names: &[String]) -> String {
    let (operator, others) = match gate {
        Gate::Input(_) | Gate::State(_) => unreachable!("what is read is not computed"),
        Gate::Not(_) => ("not", String::new()),
        Gate::And(..) => ("and", names[1].clone()),
        Gate::Or(..) => ("or", names[1].clone()),
        Gate::Xor(..) => ("xor", names[1].clone()),
        Gate::Choose(..) => ("choose", names[1..].join(", ")),
    };
    format!("let g{index} = {}.{operator}({others});", names[0])
}

/// The body of a step in the making. Registers are written in place.
struct Code<'a> {
    circuit: &'a LaneCircuit<'a>,
    /// Gates computed so far.
    defined: BTreeSet<usize>,
    /// Places of registers that may have been written.
    written: BTreeSet<usize>,
    /// Places of those that are read after that: their old values are to be saved before.
    saved: BTreeSet<usize>,
    lines: Vec<String>,
}

impl Code<'_> {
    /// What is computed in a site: blocks inside, which read its registers, before these are written.
    fn site(&mut self, site: Site) {
        let circuit = self.circuit;
        let blocks = &circuit.plan.blocks;
        for inside in (0..blocks.blocks.len()).filter(|block| blocks.blocks[*block].parent == site)
        {
            self.block(inside, site);
        }
        let registers = match site {
            None => &blocks.outside,
            Some(block) => &blocks.blocks[block].registers,
        };
        let places = || registers.iter().flat_map(|register| circuit.registers[*register].clone());
        for place in places() {
            self.define(circuit.next[place], site);
            let next = self.name(circuit.next[place]);
            self.lines.push(format!("let n{place} = {next};"));
        }
        self.lines.extend(places().map(|place| format!("n{place}.store(&mut state[{place}]);")));
        self.written.extend(places());
    }

    /// A block inside a site. Each gate stands right before the first that reads it, so that few wait
    /// in the processor's registers.
    fn block(&mut self, block: usize, site: Site) {
        let active = self.circuit.active.get(block).copied();
        if let Some(active) = active {
            self.define(active, site);
        }
        for gate in self.fed(block, site) {
            self.define(Bit::Gate(gate), site);
        }
        let condition = match active {
            Some(active) => format!("{}.any()", self.name(active)),
            None => format!("settling[{}] != 0", block - self.circuit.active.len()),
        };
        self.lines.push(format!("if {condition} {{"));
        self.lines.push(format!("moved[{}] |= {:#x};", block / 64, 1_u64 << (block % 64)));
        if active.is_none() {
            self.lines.push(format!("settling[{}] -= 1;", block - self.circuit.active.len()));
        }
        self.site(Some(block));
        self.lines.push("}".to_owned());
    }

    /// Gates of a site that a block and those inside it read.
    fn fed(&self, block: usize, site: Site) -> BTreeSet<usize> {
        let circuit = self.circuit;
        let blocks = &circuit.plan.blocks;
        let within = |site: Site| blocks.common(site, Some(block)) == Some(block);
        let inside = circuit.sites.iter().filter(|(_, site)| within(**site));
        let computed = inside.filter(|(gate, _)| !circuit.kept.contains_key(gate));
        let read = computed.flat_map(|(gate, _)| circuit.gates[*gate].operands());
        let needs = circuit.needs().into_iter().filter(|(_, site)| within(*site));
        let needs = needs.filter_map(|(bit, _)| number(bit));
        read.chain(needs).filter(|gate| circuit.sites[gate] == site).collect()
    }

    /// Computes a gate of a site with all it reads, unless that is done.
    fn define(&mut self, bit: Bit, site: Site) {
        let circuit = self.circuit;
        let Some(gate) = number(bit) else { return };
        let is_read = circuit.gates[gate].is_read() || circuit.kept.contains_key(&gate);
        if is_read || circuit.sites[&gate] != site || !self.defined.insert(gate) {
            return;
        }
        for operand in circuit.gates[gate].operands() {
            self.define(Bit::Gate(operand), site);
        }
        let operands = circuit.gates[gate].operands();
        let names = operands.into_iter().map(|operand| self.name(Bit::Gate(operand)));
        let line = definition(gate, circuit.gates[gate], &names.collect::<Vec<_>>());
        self.lines.push(line);
    }

    /// What a bit is called.
    fn name(&mut self, bit: Bit) -> String {
        let gate = match bit {
            Bit::Constant(value) => return format!("V::of({value})"),
            Bit::Gate(gate) => gate,
        };
        if let Some(place) = self.circuit.kept.get(&gate) {
            return format!("V::load(&kept[{place}])");
        }
        match self.circuit.gates[gate] {
            Gate::State(place) if self.written.contains(&place) => {
                self.saved.insert(place);
                format!("s{place}")
            }
            _ => read(self.circuit, gate).unwrap_or_else(|| format!("g{gate}")),
        }
    }
}
