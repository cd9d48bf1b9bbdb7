//! Expressions built anew, and simplified by it, keep their value: 20 000 random trees of every
//! operator, evaluated before and after.

mod trees;

use std::convert::Infallible;

use helixlock_netlist::Expression;
use trees::{Dice, WIDTHS, constant, tree};

#[test]
fn building_anew_keeps_the_value() {
    let mut dice = Dice(0x1977);
    let mut simplified = 0;
    for _ in 0..20_000 {
        let width = dice.between(1, 64);
        let depth = dice.between(1, 5);
        let plain = tree(&mut dice, width, depth);
        let built = plain.substitute(&mut |id| {
            let width = WIDTHS[id.0 as usize];
            Ok::<_, Infallible>(Expression::signal(width, id))
        });
        let Ok(built) = built;
        assert_eq!(built.width, plain.width);
        simplified += u32::from(built != plain);
        for _ in 0..20 {
            let values = WIDTHS.map(|width| constant(&mut dice, width));
            assert_eq!(
                built.evaluate(&values),
                plain.evaluate(&values),
                "{plain:?}\nbuilt {built:?}\nat {values:?}"
            );
        }
    }
    assert!(5_000 < simplified, "the trees give the builders something to do: {simplified}");
}
