//! Times with one colon: hours and minutes of a day, or minutes and seconds of a stopwatch.

/// Minutes before the colon, and seconds behind it with their fraction.
fn parts(cell: &str) -> Option<(u32, f64)> {
    let (minutes, seconds) = cell.trim().split_once(':')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let (whole, fraction) = seconds.split_once(['.', ',']).unwrap_or((seconds, "0"));
    let fits = digits(minutes) && whole.len() == 2 && digits(whole) && digits(fraction);
    let seconds: f64 = format!("{whole}.{fraction}").parse().ok().filter(|_| fits)?;
    Some((minutes.parse().ok()?, seconds)).filter(|_| seconds < 60.0)
}

/// Seconds of `m:ss`; `None` for anything else.
pub(crate) fn seconds(cell: &str) -> Option<f64> {
    parts(cell).map(|(minutes, seconds)| f64::from(minutes) * 60.0 + seconds)
}

/// Why a time can be no hours and minutes; `None` when it can be.
pub(crate) fn no_time_of_day(cell: &str) -> Option<&'static str> {
    let (minutes, _) = parts(cell)?;
    if 23 < minutes {
        Some("a number before the colon is above 23")
    } else if cell.contains(['.', ',']) {
        Some("a fraction stands behind the seconds")
    } else {
        None
    }
}

/// True where 23:59 or so comes before 0:00 or so: a stopwatch goes on to 24:00.
pub(crate) fn pass_midnight(cells: &[&String]) -> bool {
    let minutes = |cell: &String| parts(cell).map(|(minutes, _)| minutes);
    cells.windows(2).any(|pair| minutes(pair[0]) == Some(23) && minutes(pair[1]) == Some(0))
}
