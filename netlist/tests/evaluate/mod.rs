//! A netlist run clock by clock, assignment by assignment.

use helixlock_netlist::Netlist;

pub(crate) struct Machine {
    netlist: Netlist,
    values: Vec<u64>,
}

impl Machine {
    pub(crate) fn new(netlist: Netlist) -> Self {
        let mut values = vec![0; netlist.signals.len()];
        for register in &netlist.registers {
            values[register.output.0 as usize] = register.initial;
        }
        Self { netlist, values }
    }

    pub(crate) fn set(&mut self, path: &str, value: u64) {
        let id = self.netlist.find(path).expect("the path is in the netlist");
        self.values[id.0 as usize] = value;
    }

    /// Settles the logic and takes a rising edge.
    pub(crate) fn clock(&mut self) {
        self.settle();
        let taken: Vec<u64> =
            self.netlist.registers.iter().map(|r| self.values[r.input.0 as usize]).collect();
        for (register, value) in self.netlist.registers.iter().zip(taken) {
            self.values[register.output.0 as usize] = value;
        }
    }

    pub(crate) fn get(&mut self, path: &str) -> u64 {
        self.settle();
        self.values[self.netlist.find(path).expect("the path is in the netlist").0 as usize]
    }

    fn settle(&mut self) {
        for assignment in &self.netlist.assignments {
            let value = assignment.value.evaluate(&self.values);
            self.values[assignment.target.0 as usize] = value;
        }
    }
}
