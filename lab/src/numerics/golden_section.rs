//! Golden section: the top of a function with one peak, without derivatives.

/// Place and value of the maximum of a function with one peak between two ends.
pub(crate) fn golden_maximum(
    value_at: &mut impl FnMut(f64) -> f64,
    ends: (f64, f64),
    steps: usize,
) -> (f64, f64) {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = ends;
    let mut left = high - SHARE * (high - low);
    let mut right = low + SHARE * (high - low);
    let (mut at_left, mut at_right) = (value_at(left), value_at(right));
    for _ in 0..steps {
        if at_left < at_right {
            low = left;
            (left, at_left) = (right, at_right);
            right = low + SHARE * (high - low);
            at_right = value_at(right);
        } else {
            high = right;
            (right, at_right) = (left, at_left);
            left = high - SHARE * (high - low);
            at_left = value_at(left);
        }
    }
    if at_left < at_right { (right, at_right) } else { (left, at_left) }
}
