//! The decade counter does what its truth table says, from every state.

use crate::support::bench::Bench;

#[test]
fn every_state_and_input() {
    for digit in 0..16 {
        for (clear, count) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let mut bench = Bench::new("decade_counter");
            bench.force(&[("state_q", digit)]);
            bench.set(&[("clear", clear), ("count", count)]);
            let overflows = clear == 0 && count == 1 && digit >= 9;
            assert_eq!(bench.high("carry"), overflows, "digit {digit}, {clear}, {count}");
            bench.clock();
            let next = match (clear, count) {
                (1, _) => count,
                (_, 1) if digit >= 9 => 0,
                _ => digit + count,
            };
            assert_eq!(bench.get("digit"), next, "digit {digit}, {clear}, {count}");
        }
    }
}
