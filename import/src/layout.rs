//! Where runs are: side by side, one below the other, or there and back in one table.

use crate::outline::Block;
use crate::runs;

/// Run and direction of every row; empty where nothing tells them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Runs {
    pub(crate) pass: Vec<f64>,
    pub(crate) direction: Vec<f64>,
}

/// Rows that run one way: first and one past the last, and +1 or −1.
pub(crate) type Sweep = (usize, usize, f64);

/// Parts a path there and back into its ways; a single way when it is none.
///
/// A way ends where the path turns by more than a twentieth of its range, or jumps by more than
/// half of it. Ways shorter than half the range mean that the path only wanders.
pub(crate) fn sweeps(path: &[f64]) -> Vec<Sweep> {
    let finite: Vec<(usize, f64)> =
        path.iter().copied().enumerate().filter(|(_, value)| value.is_finite()).collect();
    let (low, high) =
        finite.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, v)| {
            (low.min(*v), high.max(*v))
        });
    let range = high - low;
    let whole = |direction| vec![(0, path.len(), direction)];
    let (Some(first), Some(last)) = (finite.first(), finite.last()) else { return whole(1.0) };
    let overall = if last.1 < first.1 { -1.0 } else { 1.0 };
    if range <= 0.0 || !range.is_finite() {
        return whole(overall);
    }
    let turns = turns(&finite, range);
    let mut found: Vec<Sweep> = Vec::new();
    for pair in turns.windows(2) {
        let (start, end) = (finite[pair[0]], finite[pair[1] - 1]);
        let next = finite.get(pair[1]).map_or(path.len(), |(row, _)| *row);
        if (end.1 - start.1).abs() < range / 2.0 {
            return whole(overall);
        }
        found.push((start.0, next, if end.1 < start.1 { -1.0 } else { 1.0 }));
    }
    if let Some(first) = found.first_mut() {
        first.0 = 0;
    }
    found
}

/// Places in `finite` where a new way begins, from 0 to its length.
fn turns(finite: &[(usize, f64)], range: f64) -> Vec<usize> {
    let (hysteresis, jump) = (range / 20.0, range / 2.0);
    let mut starts = vec![0];
    let (mut extreme, mut rising) = (0, None::<bool>);
    for index in 1..finite.len() {
        let (value, best) = (finite[index].1, finite[extreme].1);
        let step = value - finite[index - 1].1;
        if jump < step.abs()
            && 2 < finite.len() - starts.last().copied().unwrap_or(0)
            && rising.is_some_and(|rising| rising != (0.0 < step))
        {
            starts.push(index);
            (extreme, rising) = (index, None);
            continue;
        }
        match rising {
            None if hysteresis < (value - best).abs() => {
                rising = Some(best < value);
                extreme = index;
            }
            Some(up) if (best <= value) == up && (best < value || value < best) => extreme = index,
            Some(up) if hysteresis < (if up { best - value } else { value - best }) => {
                starts.push(extreme + 1);
                (extreme, rising) = (index, Some(!up));
            }
            _ => {}
        }
    }
    starts.push(finite.len());
    starts
}

/// Runs of ways: a way back belongs to the way there before it.
pub(crate) fn of_sweeps(sweeps: &[Sweep], rows: usize) -> Runs {
    let mut runs = Runs { pass: vec![f64::NAN; rows], direction: vec![f64::NAN; rows] };
    let mut pass = 0.0;
    let mut last: Option<f64> = None;
    let first = sweeps.first().map_or(1.0, |sweep| sweep.2);
    for (start, end, direction) in sweeps {
        let back =
            last.is_some_and(|last| (last - first).abs() < 0.5 && 1.0 < (direction - first).abs());
        if !back {
            pass += 1.0;
        }
        runs.pass[*start..*end].fill(pass);
        runs.direction[*start..*end].fill(*direction);
        last = Some(*direction);
    }
    runs
}

/// Runs of blocks: as their headings number them, or in order.
pub(crate) fn of_blocks(blocks: &[Block], path: Option<&[f64]>) -> Runs {
    let rows: usize = blocks.iter().map(|block| block.rows.len()).sum();
    let mut runs = Runs { pass: Vec::with_capacity(rows), direction: Vec::with_capacity(rows) };
    let mut ways = Vec::new();
    let mut start = 0;
    for block in blocks {
        let named = runs::run_of(&block.heading).unwrap_or_default();
        let values = path.map(|path| &path[start..start + block.rows.len()]);
        let found = values.map(sweeps).filter(|sweeps| sweeps.len() == 1).map(|sweeps| sweeps[0].2);
        #[expect(clippy::cast_precision_loss, reason = "1 or -1")]
        let direction = named.direction.map(|direction| direction as f64).or(found);
        ways.push((named.number, direction));
        start += block.rows.len();
    }
    let both =
        ways.iter().any(|way| way.1 == Some(1.0)) && ways.iter().any(|way| way.1 == Some(-1.0));
    let numbered = ways.iter().all(|way| way.0.is_some());
    for (index, (block, (number, direction))) in blocks.iter().zip(&ways).enumerate() {
        let alike = ways[..index].iter().filter(|way| !both || way.1 == *direction).count();
        let counted = i64::try_from(alike + 1).unwrap_or(1);
        let pass = number.filter(|_| numbered && !renumbered(&ways, both)).unwrap_or(counted);
        #[expect(clippy::cast_precision_loss, reason = "runs are few")]
        runs.pass.extend(std::iter::repeat_n(pass as f64, block.rows.len()));
        let direction = direction.filter(|_| both).unwrap_or(f64::NAN);
        runs.direction.extend(std::iter::repeat_n(direction, block.rows.len()));
    }
    runs
}

/// True when there and back have numbers of their own: 1 there, 2 back, 3 there.
fn renumbered(ways: &[(Option<i64>, Option<f64>)], both: bool) -> bool {
    let differ = ways.windows(2).all(|pair| pair[0].0 != pair[1].0);
    let alternate = ways.windows(2).all(|pair| pair[0].1 != pair[1].1);
    both && differ && alternate
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_cycle_there_and_back_is_one_run() {
        let path = [0.0, 10.0, 20.0, 30.0, 30.0, 20.0, 10.0, 0.0, 0.0, 10.0, 20.0, 30.0];
        let found = sweeps(&path);
        assert_eq!(found, [(0, 4, 1.0), (4, 8, -1.0), (8, 12, 1.0)]);
        let runs = of_sweeps(&found, path.len());
        assert_eq!(runs.pass, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
        assert_eq!(runs.direction[3..5], [1.0, -1.0]);
    }

    #[test]
    fn jumps_back_begin_a_run_and_wandering_does_not() {
        let saw: Vec<f64> = (0..30).map(|n| f64::from(n % 10)).collect();
        assert_eq!(sweeps(&saw).len(), 3);
        assert!(sweeps(&saw).iter().all(|sweep| sweep.2 > 0.0));
        assert_eq!(of_sweeps(&sweeps(&saw), 30).pass[29].to_bits(), 3.0_f64.to_bits());
        let wander: Vec<f64> = (0..100).map(|n| f64::from(n) + 12.0 * f64::from(n % 2)).collect();
        assert_eq!(sweeps(&wander).len(), 1);
    }
}
