//! Where the runs of a table are: side by side, one below the other, or there and back.

use helixlock_traces::Column;

use super::Understood;
use super::figures::whole;
use crate::decide::Decisions;
use crate::error::ImportError;
use crate::layout::{self, Runs};
use crate::outline::Block;
use crate::rules::COORDINATES;
use crate::runs::run_of;
use crate::samples::rows;

impl Understood<'_> {
    /// The columns with their runs.
    pub(super) fn with_runs(
        &self,
        columns: Vec<Column>,
        decisions: &mut Decisions<'_>,
    ) -> Result<Vec<Column>, ImportError> {
        let count = rows(self.outline).len();
        let own = |name: &str| columns.iter().any(|column| column.name == name);
        let path = COORDINATES.iter().filter(|name| **name != "time_s").find_map(|name| {
            columns
                .iter()
                .find(|column| column.name == *name)
                .map(|column| column.values.as_slice())
        });
        let clock = columns
            .iter()
            .find(|column| column.name == "time_s")
            .map(|column| column.values.as_slice());
        let held = self.rules.iter().filter(|rule| rule.pass.is_some()).count();
        let found = decisions.text("table", "runs", || {
            let ways = path.map(layout::sweeps).unwrap_or_default();
            let text = |word: &str, reason: String| (word.to_owned(), reason);
            if 0 < held {
                text("columns", format!("{held} columns hold a run each"))
            } else if own("pass") && !own("direction") && self.headings_tell_ways() {
                text("blocks", "a column tells the runs, headings tell the way".into())
            } else if own("pass") {
                text("one", "a column tells the runs".into())
            } else if self.restart(path.or(clock)) {
                text("blocks", format!("{} blocks, one below the other", self.outline.blocks.len()))
            } else if 1 < ways.len() {
                text(
                    "sweeps",
                    format!("the position goes {} ways, each over most of its range", ways.len()),
                )
            } else {
                text("one", "nothing starts anew".into())
            }
        });
        let runs = match found.as_str() {
            "columns" => return self.unpivot(&columns, decisions),
            "blocks" => layout::of_blocks(&self.outline.blocks, path),
            "sweeps" => layout::of_sweeps(&path.map(layout::sweeps).unwrap_or_default(), count),
            _ => Runs::default(),
        };
        let mut columns = columns;
        for (name, values) in [("pass", runs.pass), ("direction", runs.direction)] {
            let told = values.iter().any(|value| value.is_finite());
            if told && values.len() == count && !columns.iter().any(|column| column.name == name) {
                columns.push(Column { name: name.to_owned(), values });
            }
        }
        Ok(columns)
    }

    /// True when the headings of all blocks tell which way they go, and some go back.
    fn headings_tell_ways(&self) -> bool {
        let way = |block: &Block| run_of(&block.heading).and_then(|run| run.direction);
        let ways: Option<Vec<i64>> = self.outline.blocks.iter().map(way).collect();
        ways.is_some_and(|ways| ways.contains(&1) && ways.contains(&-1))
    }

    /// True when blocks begin anew, and a stray blank line is not all there is.
    fn restart(&self, path: Option<&[f64]>) -> bool {
        let blocks = &self.outline.blocks;
        if blocks.len() < 2 {
            return false;
        }
        let headed = blocks.iter().skip(1).all(|block| run_of(&block.heading).is_some());
        let Some(path) = path else { return headed };
        let starts = blocks.iter().scan(0, |start, block| {
            *start += block.rows.len();
            Some(*start)
        });
        let inner: Vec<usize> = starts.filter(|start| *start < path.len()).collect();
        let back = |start: &usize| {
            let before = (2..=*start).find_map(|back| {
                (0.0 < (path[*start - 1] - path[*start - back]).abs())
                    .then(|| path[*start - 1] - path[*start - back])
            });
            let step = path[*start] - path[*start - 1];
            before.is_none_or(|before| before * step <= 0.0)
        };
        headed || inner.iter().all(back)
    }

    /// One row a target and run, run after run.
    fn unpivot(
        &self,
        shared: &[Column],
        decisions: &mut Decisions<'_>,
    ) -> Result<Vec<Column>, ImportError> {
        let mut keys: Vec<(i64, i64)> = self
            .rules
            .iter()
            .filter_map(|rule| Some((rule.pass?, rule.direction.unwrap_or(0))))
            .collect();
        keys.sort_by_key(|(pass, direction)| (*pass, -direction));
        keys.dedup();
        let both = keys.iter().any(|(_, direction)| *direction != 0);
        let count = rows(self.outline).len();
        let mut columns: Vec<Column> = shared
            .iter()
            .map(|column| Column { name: column.name.clone(), values: Vec::new() })
            .collect();
        let mut held: Vec<Column> = Vec::new();
        let (mut passes, mut directions) = (Vec::new(), Vec::new());
        for (pass, direction) in &keys {
            let order: Vec<usize> =
                if *direction < 0 { (0..count).rev().collect() } else { (0..count).collect() };
            for (column, from) in columns.iter_mut().zip(shared) {
                column.values.extend(order.iter().map(|row| from.values[*row]));
            }
            for (index, rule) in self.rules.iter().enumerate() {
                if rule.pass != Some(*pass) || rule.direction.unwrap_or(0) != *direction {
                    continue;
                }
                let (name, values) =
                    (rule.to.clone().unwrap_or_default(), self.values(index, rule, decisions)?);
                let column =
                    if let Some(at) = held.iter_mut().position(|column| column.name == name) {
                        &mut held[at]
                    } else {
                        held.push(Column { name, values: Vec::new() });
                        held.last_mut().expect("it was just pushed")
                    };
                column.values.resize(passes.len(), f64::NAN);
                column.values.extend(order.iter().map(|row| values[*row]));
            }
            passes.extend(std::iter::repeat_n(whole(*pass), count));
            directions.extend(std::iter::repeat_n(whole(*direction), count));
        }
        for column in &mut held {
            column.values.resize(passes.len(), f64::NAN);
        }
        columns.extend(held);
        columns.push(Column { name: "pass".into(), values: passes });
        if both {
            columns.push(Column { name: "direction".into(), values: directions });
        }
        Ok(columns)
    }
}
