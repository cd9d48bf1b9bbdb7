//! Bits of a word brought together into the index of a table.
//!
//! Each run of neighbouring bits takes a shift and a mask. From three runs on one multiplication
//! does it for all: by a factor of a few ones, each of which shifts some of the bits into the
//! uppermost places, while no two bits meet anywhere below, so that nothing is carried.

use std::collections::{BTreeMap, BTreeSet};

/// Up to so many runs are shifted one by one: a factor would save no operation.
const MOST_SHIFTED: usize = 2;

/// A search that has not ended by then is given up; for the device ten times as many find no more.
const MOST_TRIALS: u32 = 100_000;

/// Rust that brings bits of `known` together, and the bits in the order in which they then stand,
/// lowest first.
pub(super) fn gathered(bits: &[u32]) -> (String, Vec<u32>) {
    let runs = bits.chunk_by(|bit, next| bit + 1 == *next).count();
    if runs <= MOST_SHIFTED {
        return (shifted(bits), bits.to_vec());
    }
    match Factor::find(bits) {
        Some(factor) => factor.applied(),
        None => (shifted(bits), bits.to_vec()),
    }
}

/// Run by run.
fn shifted(bits: &[u32]) -> String {
    let mut parts = vec![];
    let mut low = 0;
    for run in bits.chunk_by(|bit, next| bit + 1 == *next) {
        let mask = ((1_u64 << run.len()) - 1) << low;
        parts.push(if low <= run[0] {
            format!("known >> {} & {mask:#x}", run[0] - low)
        } else {
            format!("known << {} & {mask:#x}", low - run[0])
        });
        low += u32::try_from(run.len()).expect("a word has few bits");
    }
    parts.join(" | ")
}

/// A factor in the making.
struct Factor<'a> {
    bits: &'a [u32],
    /// The lowest place of the index.
    lowest: u32,
    /// Which bit each place of the index has.
    places: BTreeMap<u32, u32>,
    /// The ones of the factor.
    shifts: BTreeSet<u32>,
    trials: u32,
}

impl<'a> Factor<'a> {
    fn find(bits: &'a [u32]) -> Option<Self> {
        let lowest = u64::BITS - u32::try_from(bits.len()).expect("a word has few bits");
        let (places, shifts) = (BTreeMap::new(), BTreeSet::new());
        let mut factor = Self { bits, lowest, places, shifts, trials: 0 };
        factor.place(bits).then_some(factor)
    }

    /// Finds places for the given bits, the uppermost first: it has the fewest.
    fn place(&mut self, open: &[u32]) -> bool {
        let Some((bit, open)) = open.split_last() else { return true };
        let mut places: Vec<u32> = (self.lowest.max(*bit)..u64::BITS).collect();
        // A shift that is there already costs nothing.
        places.sort_by_key(|place| !self.shifts.contains(&(place - bit)));
        for place in places {
            if self.places.contains_key(&place) || self.trials == MOST_TRIALS {
                continue;
            }
            self.trials += 1;
            self.places.insert(place, *bit);
            let is_new = self.shifts.insert(place - bit);
            if self.keeps_apart() && self.place(open) {
                return true;
            }
            self.places.remove(&place);
            if is_new {
                self.shifts.remove(&(place - bit));
            }
        }
        false
    }

    /// True when no two bits meet, and none comes to a place that is not its own.
    fn keeps_apart(&self) -> bool {
        let mut taken = 0_u64;
        let products = self.bits.iter().flat_map(|bit| self.shifts.iter().map(move |by| (bit, by)));
        products.filter(|(bit, by)| *bit + *by < u64::BITS).all(|(bit, by)| {
            let place = bit + by;
            let own = place < self.lowest || self.places.get(&place).is_none_or(|own| own == bit);
            let free = taken >> place & 1 == 0;
            taken |= 1 << place;
            own && free
        })
    }

    fn applied(&self) -> (String, Vec<u32>) {
        let ones = |places: &mut dyn Iterator<Item = u32>| places.map(|place| 1_u64 << place).sum();
        let mask: u64 = ones(&mut self.bits.iter().copied());
        let factor: u64 = ones(&mut self.shifts.iter().copied());
        let text = format!("u64::wrapping_mul(known & {mask:#x}, {factor:#x}) >> {}", self.lowest);
        (text, self.places.values().copied().collect())
    }
}
