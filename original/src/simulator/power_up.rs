//! Power-up: gates come to rest, presets and clears act, nothing is timed.

use crate::circuit::Function;
use crate::error::Error;

use super::{Cell, Simulator};

impl Simulator<'_> {
    /// Finds the levels that all parts agree with.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        for _ in 0..=self.flip_flops.len() {
            self.settle_gates()?;
            if !self.wake_flip_flops() {
                return Ok(());
            }
        }
        Ok(())
    }

    fn settle_gates(&mut self) -> Result<(), Error> {
        let mut restless = None;
        for _ in 0..=self.cells.len() {
            restless = None;
            for number in 0..self.cells.len() {
                if self.settle_cell(self.cells[number]) {
                    restless = Some(number);
                }
            }
            if restless.is_none() {
                break;
            }
        }
        restless.map_or(Ok(()), |number| {
            Err(Error::NeverRests { gate: self.circuit.elements[number].name.clone() })
        })
    }

    /// True when an output had to change.
    fn settle_cell(&mut self, cell: Cell) -> bool {
        let level = self.value(cell);
        let outputs = if matches!(cell.function, Function::FlipFlop { .. }) { 2 } else { 1 };
        let mut changed = false;
        for (place, level) in [level, !level].into_iter().enumerate().take(outputs) {
            let output = &mut self.outputs[cell.output as usize + place];
            output.aim = level;
            let net = &mut self.levels[output.net as usize];
            changed |= std::mem::replace(net, level) != level;
        }
        changed
    }

    /// Preset and clear act at power-up, too, and clocks are where they are; true when one changed.
    fn wake_flip_flops(&mut self) -> bool {
        let mut changed = false;
        for number in 0..self.cells.len() {
            let cell = self.cells[number];
            if let Function::FlipFlop { j } = cell.function {
                let pins = self.pins(cell, j);
                let flip_flop = &mut self.flip_flops[cell.flip_flop as usize];
                let before = flip_flop.level();
                flip_flop.wake(pins);
                changed |= flip_flop.level() != before;
            }
        }
        changed
    }
}
