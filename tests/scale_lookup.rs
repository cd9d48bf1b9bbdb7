//! The look-up takes the corrector where the table of document 3 says.

use helixlock_metrology::scale::{
    CorrectionTable, Direction, ErrorSample, LookUp, Scheme, apply, to_image,
};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// The block with an EEPROM of this image behind its address pins.
struct Corrector {
    bench: Bench,
    image: Vec<u8>,
    stands: i64,
}

impl Corrector {
    fn new(table: &CorrectionTable, scale: u64) -> Self {
        let mut bench = Bench::new("scale_lookup");
        bench.pulse(&["clear"]);
        bench.set(&[("places", table.forward.len() as u64), ("scale", scale), ("machining", 1)]);
        bench.set(&[("two_ways", u64::from(!table.backward.is_empty()))]);
        Self { bench, image: to_image(table).expect("fits").to_vec(), stands: 0 }
    }

    /// Clocks with the EEPROM answering; the step clock ticks every other clock.
    fn run(&mut self, clocks: u32) {
        for clock in 0..clocks {
            let address = usize::try_from(self.bench.get("address")).expect("12 bits");
            let data = self.image.get(address).copied().unwrap_or(0xff);
            self.bench.set(&[("data", data.into()), ("tick", (clock % 2).into())]);
            if self.bench.high("step") {
                self.stands += if self.bench.high("step_forward") { 1 } else { -1 };
            }
            self.bench.clock();
        }
    }

    /// Goes a number of places and waits until the corrector stands.
    fn go(&mut self, places: i64, clocks: u32) {
        self.bench.set(&[("forward", u64::from(places >= 0))]);
        for _ in 0..places.abs() {
            self.bench.pulse(&["place_pulse"]);
        }
        self.run(clocks);
    }
}

fn table(forward: Vec<i8>, backward: Vec<i8>) -> CorrectionTable {
    CorrectionTable { start_mm: 0.0, step_mm: 1.0, lsb_um: 0.1, forward, backward }
}

/// Steps the software of scheme 1 takes at a place.
fn software(table: &CorrectionTable, place: i64, direction: Direction, step_um: f64) -> i64 {
    let position_mm = f64::from(i32::try_from(place).expect("small"));
    let sample = ErrorSample { position_mm, error_um: 0.0, direction };
    apply(table, &[sample], Scheme::Step { step_um }, LookUp::Nearest)[0].steps
}

/// All 256 bytes of a table, for three step sizes: 0.0125 µm, 0.1 µm, 0.3 µm.
#[test]
fn every_byte_of_the_table() {
    let table = table((-128..=127).collect(), vec![]);
    for (step_um, scale) in [(0.0125, 8 * 4096), (0.1, 4096), (0.3, 1365)] {
        let mut corrector = Corrector::new(&table, scale);
        corrector.run(4200);
        for place in 0..256 {
            assert_eq!(corrector.stands, software(&table, place, Direction::Forward, step_um));
            corrector.go(1, 100);
        }
        corrector.run(4200);
        assert_eq!(corrector.stands, 0, "outside the table");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..kept_beside_source() })]

    /// Any way through a table with both directions, before its beginning and behind its end.
    #[test]
    fn any_way_through_the_table(
        bytes in vec(any::<(i8, i8)>(), 2..12),
        moves in vec(-6..=6_i64, 1..20),
    ) {
        let (ahead, back) = bytes.into_iter().unzip();
        let table = table(ahead, back);
        let mut corrector = Corrector::new(&table, 4096);
        let mut place = 0;
        for moved in moves {
            corrector.go(moved, 600);
            place += moved;
            let direction = if moved < 0 { Direction::Backward } else { Direction::Forward };
            prop_assert_eq!(corrector.stands, software(&table, place, direction, 0.1));
        }
    }
}

/// Idling, the corrector stands still; machining, it goes on to its target.
#[test]
fn stands_still_while_idling() {
    let mut corrector = Corrector::new(&table(vec![9, 9], vec![]), 4096);
    corrector.bench.set(&[("machining", 0)]);
    corrector.go(0, 100);
    assert_eq!(corrector.stands, 0);
    corrector.bench.set(&[("machining", 1)]);
    corrector.run(100);
    assert_eq!(corrector.stands, 9);
}

/// The origin pulse makes this place 0, whatever was counted.
#[test]
fn origin_is_place_zero() {
    let mut corrector = Corrector::new(&table(vec![7, 1, 2], vec![]), 4096);
    corrector.go(2, 100);
    assert_eq!(corrector.stands, 2);
    corrector.bench.pulse(&["origin", "place_pulse"]);
    corrector.run(100);
    assert_eq!(corrector.stands, 7);
}
