//! Narrow registers as registers of one bit each, which can be packed and looked up.

use super::packing::Packing;
use super::plan::Plan;
use helixlock_netlist::{Assignment, Expression, Netlist, Node, Register, Signal, SignalId};

/// What a register of more bits is split for at most: as one word it takes some operations a clock.
const WIDEST: u32 = 4;

/// A design with narrow registers split, and what its registers are of the original's.
pub(super) struct Split {
    pub(super) netlist: Netlist,
    /// Of every register, the index of the original one and the lowest bit of it.
    pub(super) origins: Vec<(usize, u32)>,
}

impl Split {
    /// Splits what would be computed at every clock otherwise, and can be packed whole.
    pub(super) fn new(netlist: &Netlist) -> Self {
        let whole = Self::of(netlist, &[]);
        let narrow = {
            let plan = Plan::new(netlist);
            let left = Packing::new(&plan).left_outside(&plan);
            let width =
                |register: &usize| netlist.signal(netlist.registers[*register].output).width;
            let narrow =
                left.into_iter().filter(|register| (2..=WIDEST).contains(&width(register)));
            narrow.collect::<Vec<_>>()
        };
        let packed = Self::of(netlist, &narrow).packed(&narrow);
        let split = Self::of(netlist, &packed);
        if split.packed(&packed) == packed { split } else { whole }
    }

    /// Those of the split registers of which all bits are packed.
    fn packed(&self, split: &[usize]) -> Vec<usize> {
        let plan = Plan::new(&self.netlist);
        let packing = Packing::new(&plan);
        let bits = self.origins.iter().enumerate();
        let unpacked = bits.filter(|(register, _)| !packing.has(*register));
        let unpacked: Vec<usize> = unpacked.map(|(_, (origin, _))| *origin).collect();
        split.iter().copied().filter(|register| !unpacked.contains(register)).collect()
    }

    fn of(netlist: &Netlist, split: &[usize]) -> Self {
        let mut this = Self { netlist: netlist.clone(), origins: vec![] };
        this.netlist.registers.clear();
        for (index, register) in netlist.registers.iter().enumerate() {
            if split.contains(&index) {
                this.split(index, *register);
            } else {
                this.origins.push((index, 0));
                this.netlist.registers.push(*register);
            }
        }
        this
    }

    fn split(&mut self, index: usize, Register { output, input, initial }: Register) {
        let width = self.netlist.signal(output).width;
        let mut whole = Expression::constant(width, 0);
        for bit in 0..width {
            let (own, next) = (self.bit(), self.bit());
            let of = Box::new(Expression::signal(width, input));
            let value = Expression { width: 1, node: Node::Slice { of, low: bit } };
            self.netlist.assignments.push(Assignment { target: next, value });
            let initial = initial >> bit & 1;
            self.netlist.registers.push(Register { output: own, input: next, initial });
            self.origins.push((index, bit));
            let own = Box::new(Expression::signal(1, own));
            let own = Box::new(Expression { width, node: Node::Extend(own) });
            let places = Box::new(Expression::constant(width, u64::from(bit)));
            let own = Expression { width, node: Node::ShiftUp(own, places) };
            whole = Expression { width, node: Node::Or(Box::new(whole), Box::new(own)) };
        }
        // Who reads it comes later.
        self.netlist.assignments.insert(0, Assignment { target: output, value: whole });
    }

    fn bit(&mut self) -> SignalId {
        let index = self.netlist.signals.len();
        self.netlist.signals.push(Signal { path: format!("bit{index}"), width: 1 });
        SignalId(u32::try_from(index).expect("a design has few signals"))
    }
}
