//! Registers that follow the inputs: synchronisers, and all that is delayed behind them.
//!
//! When the inputs have stood still for as many edges as there are registers in a row, they stand still
//! too.

use std::collections::{BTreeMap, BTreeSet};

use super::plan::{Leaf, Plan};

/// Registers that follow the same inputs.
pub(super) struct Following {
    /// Indices in the netlist's inputs.
    pub(super) inputs: BTreeSet<usize>,
    /// Indices in the netlist's registers.
    pub(super) registers: Vec<usize>,
    /// Edges until the last of them shows what the inputs are.
    pub(super) edges: usize,
}

/// What a register follows, and after how many edges.
type Follows = (BTreeSet<usize>, usize);

/// All of a design, among the registers outside blocks.
pub(super) fn following(plan: &Plan) -> Vec<Following> {
    let mut known: BTreeMap<usize, Follows> = BTreeMap::new();
    loop {
        let others = plan.blocks.outside.iter().filter(|register| !known.contains_key(register));
        let found =
            others.filter_map(|register| Some((*register, follows(plan, &known, *register)?)));
        let found: Vec<(usize, Follows)> = found.collect();
        if found.is_empty() {
            break;
        }
        known.extend(found);
    }
    let mut groups: BTreeMap<BTreeSet<usize>, (Vec<usize>, usize)> = BTreeMap::new();
    for (register, (inputs, edges)) in known {
        let (registers, most) = groups.entry(inputs).or_default();
        registers.push(register);
        *most = edges.max(*most);
    }
    let groups = groups.into_iter();
    groups.map(|(inputs, (registers, edges))| Following { inputs, registers, edges }).collect()
}

/// What a register follows, when all that its next value is computed from is known to follow.
fn follows(plan: &Plan, known: &BTreeMap<usize, Follows>, register: usize) -> Option<Follows> {
    let (mut inputs, mut edges) = (BTreeSet::new(), 0);
    for leaf in plan.leaves_of(plan.next[register]) {
        match leaf {
            Leaf::Input(input) => inputs.extend([input]),
            Leaf::Register(other) if plan.blocks.may_change(other) => {
                let (before, after) = known.get(&other)?;
                inputs.extend(before);
                edges = edges.max(*after);
            }
            Leaf::Register(_) => {}
        }
    }
    Some((inputs, edges + 1))
}
