//! Where each gate is computed when many copies run together, and which are kept from clock to clock.
//!
//! A gate is computed in the innermost block around all that need it. One outside all blocks that
//! reads nothing but inputs and registers in blocks is *kept* instead, and computed anew when one of those
//! blocks was active; so is what it is computed from, where that depends on fewer blocks.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use helixlock_netlist::{Netlist, SignalId};

use super::blocks::Site;
use super::following::Following;
use super::gates::{Bit, Gate, Gates};
use super::plan::Plan;

/// Keeping a gate that takes fewer than this spares nothing.
const FEWEST_KEPT: usize = 2;

/// The same for a gate that only others kept are computed from; 4 and 40 are slower on the device.
const FEWEST_STEPS: usize = 12;

/// Where each gate is computed, and which are kept.
pub(super) struct LaneCircuit<'a> {
    pub(super) plan: &'a Plan<'a>,
    /// By number: a gate stands behind those it reads.
    pub(super) gates: Vec<Gate>,
    /// Of every bit of every register, by place.
    pub(super) next: Vec<Bit>,
    /// Places of the bits of each register.
    pub(super) registers: Vec<Range<usize>>,
    /// Index of the input that each bit of the inputs belongs to.
    pub(super) inputs: Vec<usize>,
    /// Of every block that has a condition.
    pub(super) active: Vec<Bit>,
    /// Behind them, those that follow inputs.
    pub(super) following: Vec<Following>,
    /// Of every gate that is computed.
    pub(super) sites: BTreeMap<usize, Site>,
    /// Blocks that each gate depends on; none for one that also depends on registers outside.
    steady: Vec<Option<BTreeSet<usize>>>,
    /// Where each gate that is kept is kept.
    pub(super) kept: BTreeMap<usize, usize>,
}

impl<'a> LaneCircuit<'a> {
    /// `following` are the last of the plan's blocks.
    pub(super) fn new(netlist: &Netlist, plan: &'a Plan, following: Vec<Following>) -> Self {
        let outputs = netlist.registers.iter().map(|register| register.output);
        let widths: Vec<u32> = outputs.clone().map(|id| netlist.signal(id).width).collect();
        let (low, state) = places(netlist, outputs);
        let (input_low, _) = places(netlist, netlist.inputs.iter().copied());
        let mut gates = Gates::new(plan, input_low, low.clone());
        let next = plan.next.iter().zip(widths);
        let next = next.flat_map(|(next, width)| gates.operand(*next, width)).collect();
        let conditional = plan.blocks.blocks.len() - following.len();
        let blocks = plan.blocks.blocks.iter().take(conditional);
        let active = blocks.map(|block| gates.operand(block.active, 1)[0]).collect();
        let ends = low.iter().copied().skip(1).chain([state]);
        let inputs = netlist.inputs.iter().enumerate();
        let inputs = inputs.flat_map(|(index, input)| {
            std::iter::repeat_n(index, netlist.signal(*input).width as usize)
        });
        let mut circuit = Self {
            plan,
            gates: gates.all().to_vec(),
            next,
            registers: low.iter().zip(ends).map(|(low, end)| *low..end).collect(),
            inputs: inputs.collect(),
            active,
            following,
            sites: BTreeMap::new(),
            steady: vec![],
            kept: BTreeMap::new(),
        };
        circuit.steady = circuit.steady();
        circuit.sites = circuit.placed();
        circuit.kept = circuit.worth_keeping();
        circuit.sites = circuit.placed();
        circuit
    }

    /// The innermost block around all that need it, for every gate that is computed.
    fn placed(&self) -> BTreeMap<usize, Site> {
        let mut sites = BTreeMap::new();
        let need = |sites: &mut BTreeMap<usize, Site>, gate, site| {
            let place = sites.entry(gate).or_insert(site);
            *place = self.plan.blocks.common(*place, site);
        };
        for (bit, site) in self.needs() {
            if let Bit::Gate(gate) = bit {
                need(&mut sites, gate, site);
            }
        }
        for gate in (0..self.gates.len()).rev() {
            let Some(site) = sites.get(&gate).copied() else { continue };
            if !self.kept.contains_key(&gate) {
                for operand in self.gates[gate].operands() {
                    need(&mut sites, operand, site);
                }
            }
        }
        sites
    }

    /// What registers and blocks need, and where.
    pub(super) fn needs(&self) -> Vec<(Bit, Site)> {
        let blocks = &self.plan.blocks;
        let bits = |register: &usize| self.next[self.registers[*register].clone()].to_vec();
        let outside = blocks.outside.iter().flat_map(bits);
        let mut needs: Vec<(Bit, Site)> = outside.map(|bit| (bit, None)).collect();
        for (index, block) in blocks.blocks.iter().enumerate() {
            needs.extend(self.active.get(index).map(|active| (*active, block.parent)));
            let inside = block.registers.iter().flat_map(bits);
            needs.extend(inside.map(|bit| (bit, Some(index))));
        }
        needs
    }

    /// The blocks that each gate depends on, unless it depends on a register outside as well.
    fn steady(&self) -> Vec<Option<BTreeSet<usize>>> {
        let blocks = &self.plan.blocks;
        let mut steady: Vec<Option<BTreeSet<usize>>> = vec![];
        for gate in &self.gates {
            let own = match gate {
                Gate::State(place) => {
                    let register = self.registers.partition_point(|bits| bits.end <= *place);
                    let block = blocks.of_register(register);
                    (!blocks.outside.contains(&register)).then(|| block.into_iter().collect())
                }
                _ => Some(BTreeSet::new()),
            };
            let operands = gate.operands();
            let operands = operands.iter().map(|operand| steady[*operand].as_ref());
            let all = operands.fold(own, |all, of| Some(&all? | of?));
            steady.push(all);
        }
        steady
    }

    /// Steady gates outside all blocks that others read, and what these are computed from and changes
    /// less often.
    fn worth_keeping(&self) -> BTreeMap<usize, usize> {
        let outside = self.sites.iter().filter(|(_, site)| site.is_none()).map(|(gate, _)| *gate);
        let steady: BTreeSet<usize> = outside.filter(|gate| self.steady[*gate].is_some()).collect();
        let mut seen: BTreeSet<usize> =
            self.needs().into_iter().filter_map(|(bit, _)| number(bit)).collect();
        for gate in self.sites.keys().filter(|gate| !steady.contains(gate)) {
            seen.extend(self.gates[*gate].operands());
        }
        let seen: BTreeSet<usize> = seen.intersection(&steady).copied().collect();
        let mut steps = BTreeSet::new();
        for gate in self.cone(seen.iter().copied(), |_| false) {
            let operands = self.gates[gate].operands();
            steps.extend(operands.into_iter().filter(|of| self.steady[*of] != self.steady[gate]));
        }
        let mut kept: BTreeMap<usize, usize> = BTreeMap::new();
        for gate in seen.union(&steps) {
            let fewest = if seen.contains(gate) { FEWEST_KEPT } else { FEWEST_STEPS };
            let is_there = |gate: usize| self.gates[gate].is_read() || kept.contains_key(&gate);
            if fewest <= self.cone([*gate], is_there).len() {
                kept.insert(*gate, kept.len());
            }
        }
        kept
    }

    /// What is computed for some gates when others are there.
    pub(super) fn cone(
        &self,
        gates: impl IntoIterator<Item = usize>,
        is_there: impl Fn(usize) -> bool,
    ) -> BTreeSet<usize> {
        let mut cone = BTreeSet::new();
        let mut open: Vec<usize> = gates.into_iter().collect();
        while let Some(gate) = open.pop() {
            if !is_there(gate) && cone.insert(gate) {
                open.extend(self.gates[gate].operands());
            }
        }
        cone
    }

    /// Gates kept, by the blocks that they depend on, each behind those it is computed from.
    pub(super) fn groups(&self) -> BTreeMap<(usize, Vec<usize>), Vec<usize>> {
        let mut groups: BTreeMap<(usize, Vec<usize>), Vec<usize>> = BTreeMap::new();
        for gate in self.kept.keys() {
            let blocks: Vec<usize> = self.steady[*gate].iter().flatten().copied().collect();
            groups.entry((blocks.len(), blocks)).or_default().push(*gate);
        }
        groups
    }
}

/// Number of the gate, unless it is a constant.
pub(super) fn number(bit: Bit) -> Option<usize> {
    match bit {
        Bit::Constant(_) => None,
        Bit::Gate(gate) => Some(gate),
    }
}

/// Places of the lowest bit of each of some signals, and where the next would be.
fn places(netlist: &Netlist, signals: impl Iterator<Item = SignalId>) -> (Vec<usize>, usize) {
    let mut next = 0;
    let mut low = vec![];
    for signal in signals {
        low.push(next);
        next += netlist.signal(signal).width as usize;
    }
    (low, next)
}
