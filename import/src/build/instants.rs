//! How instants of a column are read: what a date begins with, and in which zone.

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::instant::Order;
use crate::recipe::Value;
use crate::samples::date_order;

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
        crate::instant::parse(cell, Order::Day).is_some_and(|instant| instant.zone_min.is_some())
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
