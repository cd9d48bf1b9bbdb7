//! Target and reference positions of an ISO 230-2 test: assignments, or tables of a report.
//!
//! The test of the `ecmc` motion controller writes both (its `examples/test/fat_sat`): `TGT_DATA[1]=15` and
//! `REF_DATA_FWD[1,2]=15.09` in one file, tables headed `tgt_pos(i) [mm]|ref_pos(i,1) [mm]|…` in the other.
//! The deviation is reference minus target (ISO 230-2:2014, 3.1); the error is positive when the table is behind.

use std::collections::BTreeMap;

use helixlock_traces::Column;

use crate::build::Built;
use crate::data;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::number::number;
use crate::place::Place;

#[derive(Default)]
struct Test {
    /// Its line, and what it is.
    unit: Option<(usize, String)>,
    /// Positions aimed at, by their number.
    targets: BTreeMap<usize, f64>,
    /// Positions found and their lines, by cycle, direction (0 there, 1 back) and number.
    found: BTreeMap<(usize, usize, usize), (usize, f64)>,
}

/// Reads assignments or tables.
pub(crate) fn read(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let file = decisions.file();
    let mut test = Test::default();
    let mut direction = None;
    let mut cycles: Vec<usize> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let bare = line.trim();
        let lower = bare.to_lowercase();
        if lower.contains("forward direction") {
            (direction, cycles) = (Some(0), Vec::new());
        } else if lower.contains("backward direction") {
            (direction, cycles) = (Some(1), Vec::new());
        } else if bare.contains("ref_pos(i,") {
            cycles = test.header(index, bare);
        } else if bare.is_empty() || bare.starts_with("## ") {
            cycles.clear();
        } else if let (Some(direction), false) = (direction, cycles.is_empty()) {
            test.row(file, (index, line), direction, &cycles)?;
        } else if !bare.starts_with('#') && bare.contains('=') {
            test.assignment(file, index, line)?;
        }
    }
    test.build(decisions)
}

impl Test {
    /// Cycles of the columns of a table.
    fn header(&mut self, index: usize, text: &str) -> Vec<usize> {
        if let Some((_, unit)) = text.split_once('[') {
            let unit = unit.split(']').next().unwrap_or_default().to_owned();
            self.unit.get_or_insert((index + 1, unit));
        }
        let cycle = |cell: &str| cell.split_once("ref_pos(i,")?.1.split(')').next()?.parse().ok();
        text.split('|').filter_map(cycle).collect()
    }

    fn row(
        &mut self,
        file: &str,
        (index, line): (usize, &str),
        direction: usize,
        cycles: &[usize],
    ) -> Result<(), ImportError> {
        let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
        if cells.iter().all(|cell| cell.chars().all(|c| c == '-' || c == ':')) {
            return Ok(());
        }
        if cells.len() != cycles.len() + 2 {
            let found = format!("{} cells", cells.len());
            return Err(ImportError::found(
                Place::line(file, index + 1),
                found,
                format!("{}", cycles.len() + 2),
            ));
        }
        let value = |cell: &str| number(cell, '.').ok_or_else(|| refused(file, index, line, cell));
        let at = cells[0].parse().map_err(|_| refused(file, index, line, cells[0]))?;
        self.targets.insert(at, value(cells[1])?);
        for (cycle, cell) in cycles.iter().zip(&cells[2..]) {
            self.found.insert((*cycle, direction, at), (index + 1, value(cell)?));
        }
        Ok(())
    }

    fn assignment(&mut self, file: &str, index: usize, line: &str) -> Result<(), ImportError> {
        let Some((name, cell)) = line.trim().split_once('=') else { return Ok(()) };
        if name == "UNIT" {
            self.unit = Some((index + 1, cell.trim().to_owned()));
        }
        let Some((name, indices)) = name.strip_suffix(']').and_then(|name| name.split_once('['))
        else {
            return Ok(());
        };
        let wanted = match name {
            "TGT_DATA" => 1,
            "REF_DATA_FWD" | "REF_DATA_BWD" => 2,
            _ => return Ok(()),
        };
        let numbers: Vec<usize> =
            indices.split(',').filter_map(|word| word.trim().parse().ok()).collect();
        let value =
            number(cell.trim(), '.').ok_or_else(|| refused(file, index, line, cell.trim()))?;
        match (wanted, numbers.as_slice()) {
            (1, [at]) => {
                self.targets.insert(*at, value);
            }
            (2, [at, cycle]) => {
                let back = usize::from(name == "REF_DATA_BWD");
                self.found.insert((*cycle, back, *at), (index + 1, value));
            }
            _ => {
                return Err(ImportError::found(
                    Place::word(file, index + 1, line, indices),
                    quoted(indices),
                    "numbers of position and cycle",
                ));
            }
        }
        Ok(())
    }

    fn build(self, decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
        let file = decisions.file();
        let refuse =
            |place, found: String, expected: &str| Err(ImportError::found(place, found, expected));
        if self.found.is_empty() {
            return refuse(
                Place::file(file),
                "no reference positions".into(),
                "`REF_DATA_FWD[…]` or tables of `ref_pos`",
            );
        }
        let named = self.unit.as_ref().map(|(_, unit)| unit.clone());
        let unit = decisions.text("calibration", "unit", || match named {
            Some(unit) => (unit, "as the file says".into()),
            None => ("mm".into(), "what its manual says holds without `UNIT`".into()),
        });
        let Some(scale) = data::unit(&unit, "length").or_else(|| data::unit(&unit, "angle")) else {
            let line = self.unit.iter().find(|(_, named)| *named == unit);
            let place =
                line.map_or_else(|| Place::file(file), |(line, _)| Place::line(file, *line));
            let found = format!("the unit {}", quoted(&unit));
            return refuse(place, found, "a unit of length or angle");
        };
        let angular = scale.kind == "angle";
        let ours =
            if angular { ["angle_rev", "error_arcsec"] } else { ["position_mm", "error_um"] };
        let per_turn = if angular { 1_296_000.0 } else { 1000.0 };
        let mut columns: Vec<Column> = ours
            .into_iter()
            .chain(["pass", "direction"])
            .map(|name| Column { name: name.into(), values: Vec::new() })
            .collect();
        let mut order: Vec<_> = self.found.iter().collect();
        // There in the order of the targets, back against it.
        order.sort_by_key(|((cycle, back, at), _)| {
            (*cycle, *back, if *back == 1 { usize::MAX - at } else { *at })
        });
        for ((cycle, back, at), (line, found)) in order {
            let Some(target) = self.targets.get(at) else {
                return refuse(
                    Place::line(file, *line),
                    format!("a reference for position {at}"),
                    "a target for it (`TGT_DATA`)",
                );
            };
            #[expect(clippy::cast_precision_loss, reason = "cycles are few")]
            let row = [
                target * scale.scale / per_turn,
                digits((target - found) * scale.scale),
                *cycle as f64,
                if *back == 1 { -1.0 } else { 1.0 },
            ];
            columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
        }
        Ok(Built { columns, origin_s: None })
    }
}

/// A difference of two numbers of a dozen digits, to a picometre.
fn digits(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn refused(file: &str, index: usize, line: &str, cell: &str) -> ImportError {
    ImportError::found(Place::word(file, index + 1, line, cell), quoted(cell), "a number")
}
