//! Instants as loggers write them: a date, a time of day, a zone.

use chrono::NaiveDate;

use crate::stopwatch;

/// What a date begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    Day,
    Month,
    Year,
}

impl Order {
    pub(crate) fn named(name: &str) -> Self {
        match name {
            "day" => Self::Day,
            "month" => Self::Month,
            _ => Self::Year,
        }
    }
}

/// A date, a time of day, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Instant {
    /// Days since 1970.
    pub(crate) day: Option<i64>,
    /// Seconds of the day.
    pub(crate) second: f64,
    /// Minutes ahead of UTC.
    pub(crate) zone_min: Option<i64>,
    /// True when day and month could be exchanged.
    pub(crate) ambiguous: bool,
}

impl Instant {
    /// Seconds since midnight UTC of `day`, in the zone given where none is written.
    pub(crate) fn since(&self, day: i64, zone_min: i64) -> f64 {
        let days = self.day.unwrap_or(day) - day;
        let minutes = self.zone_min.unwrap_or(zone_min);
        #[expect(clippy::cast_precision_loss, reason = "days and minutes of a calendar are few")]
        let whole = (days * 86_400 - minutes * 60) as f64;
        whole + self.second
    }
}

/// Reads an instant; `None` when it is none, or no such day exists.
pub(crate) fn parse(text: &str, order: Order) -> Option<Instant> {
    let text = text.trim().trim_matches('"');
    if text.is_empty() || !text.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let Some(colon) = text.find(':') else { return date(text, order) };
    let bytes = text.as_bytes();
    let hour =
        bytes[..colon].iter().rposition(|byte| !byte.is_ascii_digit()).map_or(0, |at| at + 1);
    let (head, clock) = text.split_at(hour);
    let (second, rest) = time_of_day(clock)?;
    let (meridiem, zone_min) = zone(rest)?;
    let second = match meridiem {
        Some(Half::Morning) => second % 43_200.0,
        Some(Half::Afternoon) => second % 43_200.0 + 43_200.0,
        None => second,
    };
    let head = head.trim_end_matches(['T', 't', ' ', ',', '_', '-', ':']);
    let head = head.trim_end_matches(char::is_alphabetic).trim_end();
    let date = if head.is_empty() { Instant::default() } else { date(head, order)? };
    Some(Instant { second, zone_min, ..date })
}

/// True when the text is an instant in some order of day and month, or of a stopwatch.
pub(crate) fn is_instant(text: &str) -> bool {
    [Order::Year, Order::Day, Order::Month].iter().any(|order| parse(text, *order).is_some())
        || stopwatch::seconds(text).is_some()
}

/// True when the text can only be a date with the day first, or only with the month first.
pub(crate) fn order_of(text: &str) -> Option<Order> {
    let year_first = text.trim().bytes().take_while(u8::is_ascii_digit).count() == 4;
    if year_first {
        return Some(Order::Year);
    }
    if text.contains('.') && text.split(['.', ' ']).count() > 2 && !text.contains('/') {
        return Some(Order::Day);
    }
    match (parse(text, Order::Day), parse(text, Order::Month)) {
        (Some(_), None) => Some(Order::Day),
        (None, Some(_)) => Some(Order::Month),
        _ => None,
    }
}

fn date(text: &str, order: Order) -> Option<Instant> {
    let separators = ['-', '/', '.', '年', '月', '日'];
    let parts: Vec<&str> = text.split(separators).filter(|part| !part.is_empty()).collect();
    let &[first, second, third] = parts.as_slice() else { return None };
    let count = |part: &str| part.trim().parse::<u32>().ok().filter(|_| part.len() < 5);
    let (a, b, c) = (count(first)?, month(second).or_else(|| count(second))?, count(third)?);
    let (year, month, day) = match order {
        _ if first.len() == 4 => (a, b, c),
        Order::Day => (c, b, a),
        Order::Month => (c, a, b),
        Order::Year => return None,
    };
    let year = if year < 100 { year + 2000 } else { year };
    let date = NaiveDate::from_ymd_opt(i32::try_from(year).ok()?, month, day)?;
    let days = date.signed_duration_since(NaiveDate::default()).num_days();
    let ambiguous = first.len() < 3 && a < 13 && b < 13 && a != b;
    Some(Instant { day: Some(days), ambiguous, ..Instant::default() })
}

/// `Feb`, as in `18-Feb-2017`.
fn month(text: &str) -> Option<u32> {
    const NAMES: [&str; 12] =
        ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];
    let start = text.get(..3)?.to_lowercase();
    let at = NAMES.iter().position(|name| **name == start)?;
    u32::try_from(at + 1).ok()
}

/// Seconds of `20:31`, `20:31:15` or `20:31:15,250`, and what follows.
fn time_of_day(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit() && !":.,".contains(c)).unwrap_or(text.len());
    let (clock, rest) = text.split_at(end);
    let clock = clock.trim_end_matches([',', '.']);
    let mut parts = clock.split(':');
    let hour: u32 = parts.next()?.parse().ok().filter(|hour| *hour < 24)?;
    let minute: u32 = parts.next()?.parse().ok().filter(|minute| *minute < 60)?;
    let seconds = parts.next().unwrap_or("0").replace(',', ".");
    let mut second: f64 = seconds.parse().ok().filter(|second| (0.0..61.0).contains(second))?;
    if let Some(thousandths) = parts.next() {
        second += thousandths.parse::<u16>().ok().map(f64::from)? / 1000.0;
    }
    if parts.next().is_some() {
        return None;
    }
    Some((f64::from(hour * 3600 + minute * 60) + second, rest))
}

/// Half of the day.
enum Half {
    Morning,
    Afternoon,
}

/// Half of the day by `AM` or `PM`, and minutes ahead of UTC; `None` for other words.
fn zone(text: &str) -> Option<(Option<Half>, Option<i64>)> {
    let lower = text.trim().to_lowercase();
    let (half, rest) = match (lower.strip_prefix("pm"), lower.strip_prefix("am")) {
        (Some(rest), _) => (Some(Half::Afternoon), rest.trim()),
        (_, Some(rest)) => (Some(Half::Morning), rest.trim()),
        _ => (None, lower.as_str()),
    };
    if rest.is_empty() { Some((half, None)) } else { Some((half, Some(offset(rest)?))) }
}

/// Minutes ahead of UTC of `+02:00`, `-0530`, `UTC+2` or `CET`.
pub(crate) fn offset(text: &str) -> Option<i64> {
    let lower = text.trim().to_lowercase();
    let named = include_str!("../data/zones.csv").lines().find_map(|line| {
        let (name, minutes) = line.split_once(',')?;
        (name == lower).then(|| minutes.parse().ok())?
    });
    if named.is_some() {
        return named;
    }
    let signed = lower.trim_start_matches("utc").trim_start_matches("gmt");
    let sign = match signed.chars().next()? {
        '+' => 1,
        '-' | '\u{2212}' => -1,
        _ => return None,
    };
    let digits: String = signed.chars().filter(char::is_ascii_digit).collect();
    let minutes: i64 = match digits.len() {
        1 | 2 => 60 * digits.parse::<i64>().ok()?,
        4 => 60 * digits[..2].parse::<i64>().ok()? + digits[2..].parse::<i64>().ok()?,
        _ => return None,
    };
    (minutes <= 14 * 60).then_some(sign * minutes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2017-02-18 is day 17 215 since 1970 (POSIX).
    #[test]
    fn one_instant_in_many_spellings() {
        for (text, order) in [
            ("2017-02-18 20:31:15", Order::Year),
            ("2017-02-18T20:31:15Z", Order::Year),
            ("2017-02-18T21:31:15+01:00", Order::Year),
            ("18.02.2017 20:31:15", Order::Day),
            ("18/02/2017 20:31:15,0", Order::Day),
            ("02/18/2017 8:31:15 PM", Order::Month),
            ("18-Feb-2017 20:31:15", Order::Day),
            ("2017年2月18日 20:31:15", Order::Year),
            ("2017/2/18 21:31:15 CET", Order::Year),
        ] {
            let instant = parse(text, order).expect(text);
            assert!((instant.since(17_215, 0) - 73_875.0).abs() < 1e-9, "{text}: {instant:?}");
        }
    }

    #[test]
    fn what_is_no_instant_is_none() {
        for text in
            ["", "12.5", "2017-02-30 10:00", "25:00:00", "10:61", "1:2:3:4:5", "a:b", "18.02"]
        {
            assert!(!is_instant(text), "{text}");
        }
        assert!(parse("03/04/2024", Order::Day).is_some_and(|instant| instant.ambiguous));
        assert_eq!(order_of("13/04/2024 10:00"), Some(Order::Day));
        assert_eq!(order_of("03/04/2024 10:00"), None);
    }
}
