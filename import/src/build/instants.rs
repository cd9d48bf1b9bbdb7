//! How instants of a column are read: what a date begins with, and in which zone.

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::header::{self, Header};
use crate::instant::{Instant, Order, parse};
use crate::recipe::Value;
use crate::samples::date_order;
use crate::{steps, stopwatch};

const DAY_S: f64 = 86_400.0;

/// Seconds of each cell, and the day since 1970 from which they count; or the index of a cell that is no instant.
type Read = Result<(Vec<f64>, i64), usize>;

pub(super) fn decide_order(cells: &[String], decisions: &mut Decisions<'_>) -> Order {
    if let Some(Value::Text(order)) = decisions.given("table", "date_order") {
        return Order::named(order);
    }
    let cells: Vec<&str> = cells.iter().map(String::as_str).collect();
    let order = date_order(&cells).unwrap_or_else(|| {
        let text = format!("{} may begin with the day or the month", quoted(cells[0]));
        decisions.ask(
            "table",
            "date_order",
            &text,
            &[("day", "the day comes first"), ("month", "the month comes first")],
        );
        Order::Day
    });
    let name = match order {
        Order::Day => "day",
        Order::Month => "month",
        Order::Year => "year",
    };
    decisions
        .text("table", "date_order", || (name.to_owned(), format!("as in {}", quoted(cells[0]))));
    order
}

pub(super) fn decide_zone(
    cells: &[String],
    decisions: &mut Decisions<'_>,
) -> Result<i64, ImportError> {
    let named = cells.first().is_some_and(|cell| {
        parse(cell, Order::Day).is_some_and(|instant| instant.zone_min.is_some())
    });
    let zone = decisions.text("table", "zone", || {
        let reason = if named {
            "the times name their own"
        } else {
            "no time names one; only differences count"
        };
        ("UTC".to_owned(), reason.to_owned())
    });
    crate::instant::offset(&zone).ok_or_else(|| {
        let place = crate::place::Place::file(decisions.file());
        ImportError::found(place, format!("`zone = {}`", quoted(&zone)), "a zone such as `+02:00`")
    })
}

/// Asks whether times with one colon are minutes and seconds, where neither they nor the header tell.
pub(super) fn decide_clock(
    cells: &[String],
    header: &Header,
    decisions: &mut Decisions<'_>,
) -> bool {
    let told: Vec<&String> = cells.iter().filter(|cell| !cell.is_empty()).collect();
    let Some((first, begin)) =
        told.first().and_then(|cell| Some((cell, stopwatch::seconds(cell)?)))
    else {
        return false;
    };
    let name = header.name.to_lowercase();
    let clock = header::meaning(&header.bare).is_some_and(|word| word.meaning == "clock");
    let minutes = told.iter().find_map(|cell| stopwatch::no_time_of_day(cell));
    let found = minutes
        .map(|why| ("minutes", why))
        .or_else(|| stopwatch::pass_midnight(&told).then_some(("hours", "they pass midnight")))
        .or((clock || name.contains("h:m")).then_some(("hours", "the header says so")))
        .or(name.contains("m:s").then_some(("minutes", "the header says so")));
    // A stopwatch begins at nought.
    let likely = usize::from(60.0 <= begin);
    if found.is_none() && decisions.given("table", "clock").is_none() {
        let text = format!("{} may be hours and minutes, or minutes and seconds", quoted(first));
        let mut ways =
            [("minutes", "minutes and seconds"), ("hours", "hours and minutes of the day")];
        ways.rotate_left(likely);
        decisions.ask("table", "clock", &text, &ways);
    }
    let (word, why) = found.unwrap_or((["minutes", "hours"][likely], "not sure"));
    decisions.text("table", "clock", || (word.to_owned(), why.to_owned())) == "minutes"
}

/// Minutes and seconds of a stopwatch, which knows no day.
pub(super) fn of_stopwatch(cells: &[String], _: (Order, i64), missing: &[String]) -> Read {
    let read = |(index, cell): (usize, &String)| {
        if is_missing(cell, missing) { Ok(f64::NAN) } else { stopwatch::seconds(cell).ok_or(index) }
    };
    Ok((cells.iter().enumerate().map(read).collect::<Result<_, _>>()?, 0))
}

fn is_missing(cell: &str, missing: &[String]) -> bool {
    cell.trim().is_empty() || missing.iter().any(|word| word == cell)
}

/// Instants of a column as seconds since midnight of the first day; goes on over midnight where no date is
/// written, back where the newest row is the first. Gives the index of a cell that is no instant instead.
pub(super) fn of_calendar(
    cells: &[String],
    (order, zone_min): (Order, i64),
    missing: &[String],
) -> Read {
    let (mut first_day, mut undated) = (None, false);
    let mut seconds = Vec::with_capacity(cells.len());
    for (index, cell) in cells.iter().enumerate() {
        if is_missing(cell, missing) {
            seconds.push(f64::NAN);
            continue;
        }
        let instant: Instant = parse(cell, order).ok_or(index)?;
        let day = *first_day.get_or_insert(instant.day.unwrap_or(0));
        undated |= instant.day.is_none();
        seconds.push(instant.since(day, zone_min));
    }
    if undated {
        let midnights = steps::back(&seconds).into_iter().filter(|(_, back)| DAY_S / 2.0 < *back);
        let midnights: Vec<usize> = midnights.map(|(at, _)| at).collect();
        steps::unroll(&mut seconds, &midnights, DAY_S);
    }
    Ok((seconds, first_day.unwrap_or(0)))
}
