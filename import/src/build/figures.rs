//! Numbers with the digits that they have.

#[expect(clippy::cast_precision_loss, reason = "runs and days are few")]
pub(super) fn whole(number: i64) -> f64 {
    number as f64
}

/// To a microsecond: what is left of a difference of two instants.
pub(super) fn micro(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// To fifteen digits, so that 0.1 mm is 100 µm and not 100.00000000000001.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A difference with no more decimals than its terms have.
pub(super) fn difference(value: f64, subtract: f64) -> f64 {
    const MOST: usize = 12;
    let decimals =
        |number: f64| format!("{number}").split_once('.').map_or(0, |(_, rest)| rest.len());
    let most = decimals(value).max(decimals(subtract)).min(MOST);
    format!("{:.most$}", value - subtract).parse().unwrap_or(value - subtract)
}
