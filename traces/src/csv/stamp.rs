//! Instants of a clock, as loggers write them.

use chrono::{DateTime, NaiveDateTime};

/// Seconds since 1970 of an ISO 8601 date with its time of day; without a zone, in that of the
/// logger, which is good enough for differences.
pub(super) fn seconds(cell: &[u8]) -> Option<f64> {
    const LOCAL: [&str; 4] =
        ["%Y-%m-%dT%H:%M:%S%.f", "%Y-%m-%d %H:%M:%S%.f", "%Y-%m-%dT%H:%M", "%Y-%m-%d %H:%M"];
    let text = std::str::from_utf8(cell).ok()?.trim_ascii();
    let zoned = DateTime::parse_from_rfc3339(text).map(|instant| instant.naive_utc());
    let local = || {
        let read = |form: &&str| NaiveDateTime::parse_from_str(text, form).ok();
        LOCAL.iter().find_map(read)
    };
    let instant = zoned.ok().or_else(local)?.and_utc();
    #[expect(clippy::cast_precision_loss, reason = "seconds of a calendar are far below 2⁵³")]
    let whole_s = instant.timestamp() as f64;
    Some(whole_s + f64::from(instant.timestamp_subsec_nanos()) * 1e-9)
}

/// Name of a column of stamps, whose unit follows from its cells.
pub(super) fn column_name(name: &str) -> String {
    const TIME: [&str; 7] =
        ["time", "timestamp", "datetime", "date_time", "date time", "date", "utc"];
    let lower = name.to_lowercase();
    if TIME.contains(&lower.as_str()) { "time_s".to_owned() } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 000 000 000 s are 2033-05-18T03:33:20Z (POSIX).
    #[test]
    fn stamps_are_seconds_since_1970() {
        for (text, expected) in [
            ("2033-05-18T03:33:20Z", 2e9),
            ("2033-05-18T05:33:20.5+02:00", 2e9 + 0.5),
            ("2033-05-18 03:33:20", 2e9),
            ("2033-05-18T03:33", 2e9 - 20.0),
        ] {
            assert_eq!(seconds(text.as_bytes()), Some(expected), "{text}");
        }
        for text in ["2033-05-18", "03:33:20", "18.05.2033 03:33", "2033-13-01T00:00:00"] {
            assert_eq!(seconds(text.as_bytes()), None, "{text}");
        }
    }
}
