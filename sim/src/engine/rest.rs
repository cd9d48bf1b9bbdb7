//! Registers that stand still though conditions under which they change are met.
//!
//! While a reset is held, every register is given at each clock what it holds already. Two clocks
//! that begin with the same bits are enough to see it: what the second has not changed, no further
//! one will.

/// Whether the blocks of a kernel, as they are now, stay so under certain bits.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rest {
    /// What was known and found when blocks were last active.
    bits: [u64; 3],
    /// That clock changed no register of theirs.
    settled: bool,
}

impl Rest {
    /// True when blocks have been seen to stand still when they were last active.
    #[inline]
    pub(super) fn is_settled(&self) -> bool {
        self.settled
    }

    /// What `blocks` make of `next` under the bits known and found, the first of which `next` comes of;
    /// they are passed over when the same bits have just left the registers as they were.
    #[inline]
    pub(crate) fn passing_over<Registers: Clone + PartialEq>(
        &mut self,
        bits: [u64; 3],
        registers: &mut Registers,
        next: u64,
        blocks: impl FnOnce(&mut Registers) -> u64,
    ) -> u64 {
        if next != bits[0] {
            // A pulse, as a rule: the next clock begins with other bits.
            self.settled = false;
            return blocks(registers);
        }
        // Word by word: as one list, just written, each would wait for the last.
        let [one, two, three] = [0, 1, 2].map(|word| self.bits[word] ^ bits[word]);
        if one | two | three != 0 {
            *self = Self { bits, settled: false };
            return blocks(registers);
        }
        if self.settled {
            return next;
        }
        self.comparing(registers, blocks)
    }

    /// The same bits once more: do they change anything?
    #[cold]
    #[inline(never)]
    fn comparing<Registers: Clone + PartialEq>(
        &mut self,
        registers: &mut Registers,
        blocks: impl FnOnce(&mut Registers) -> u64,
    ) -> u64 {
        let before = registers.clone();
        let next = blocks(registers);
        self.settled = before == *registers;
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts up to three, and how often it is asked to.
    fn count(rest: &mut Rest, registers: &mut [u64; 1], calls: &mut u64) {
        rest.passing_over([0, 2, 3], registers, 0, |registers| {
            *calls += 1;
            registers[0] = 3.min(registers[0] + 1);
            0
        });
    }

    #[test]
    fn blocks_are_passed_over_once_the_same_bits_have_changed_nothing() {
        let (mut rest, mut registers, mut calls) = (Rest::default(), [0], 0);
        for _ in 0..10 {
            count(&mut rest, &mut registers, &mut calls);
        }
        assert_eq!((registers, calls), ([3], 4));
    }

    #[test]
    fn other_bits_wake_blocks() {
        let (mut rest, mut registers, mut calls) = (Rest::default(), [3], 0);
        for _ in 0..10 {
            count(&mut rest, &mut registers, &mut calls);
        }
        assert_eq!(calls, 2);
        rest.passing_over([0, 3, 3], &mut registers, 0, |registers| {
            registers[0] = 0;
            0
        });
        count(&mut rest, &mut registers, &mut calls);
        assert_eq!((registers, calls), ([1], 3));
    }
}
