//! How values go on from row to row, and where they begin anew.

/// A counter or an angle is unrolled where the step over its end is as long as the others, to this part.
const AS_LONG: f64 = 0.5;

/// +1 where values mostly rise, −1 where they mostly fall: a log may have its newest row first.
pub(crate) fn way(values: &[f64]) -> f64 {
    let steps = steps(values);
    let rises = steps.iter().filter(|(_, step)| 0.0 < *step).count();
    let falls = steps.iter().filter(|(_, step)| *step < 0.0).count();
    // One step back alone is over midnight more often than the newest row first.
    if rises.max(1) < falls { -1.0 } else { 1.0 }
}

/// The middle one of the steps that go the way that most go; `None` without any.
pub(crate) fn usual(values: &[f64]) -> Option<f64> {
    let way = way(values);
    let mut steps: Vec<f64> = steps(values).into_iter().map(|(_, step)| way * step).collect();
    steps.retain(|step| 0.0 < *step);
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied()
}

/// Places that go against the way of the others, each with how far.
pub(crate) fn back(values: &[f64]) -> Vec<(usize, f64)> {
    let way = way(values);
    let against = steps(values).into_iter().map(|(at, step)| (at, -way * step));
    against.filter(|(_, back)| 0.0 < *back).collect()
}

/// True where a step back is one of the usual length over the end of a `whole`.
pub(crate) fn is_over_the_end(back: f64, usual: f64, whole: f64) -> bool {
    (whole - back - usual).abs() <= AS_LONG * usual
}

/// Adds a whole at each of the places, which rise, and in all rows behind it.
pub(crate) fn unroll(values: &mut [f64], places: &[usize], whole: f64) {
    let whole = way(values) * whole;
    let (mut added, mut next) = (0.0, places.iter().peekable());
    for (at, value) in values.iter_mut().enumerate() {
        if next.next_if(|place| **place == at).is_some() {
            added += whole;
        }
        *value += added;
    }
}

/// Steps between values that are there, each with the place it leads to.
fn steps(values: &[f64]) -> Vec<(usize, f64)> {
    let finite = || values.iter().copied().enumerate().filter(|(_, value)| value.is_finite());
    finite().zip(finite().skip(1)).map(|((_, one), (at, next))| (at, next - one)).collect()
}
