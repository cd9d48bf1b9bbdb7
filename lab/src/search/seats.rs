//! Shapes tried in the place of several groups of effects at once.
//!
//! The columns of a shape are the same in whoever's place it stands, and to work them out takes longer
//! than to try them: so each shape goes round all groups before the next is asked.

use std::collections::BTreeSet;

use helixlock_plant::Entry;

use crate::formulas::{Placed, Shape};
use crate::model::{Columns, Stage};
use crate::numerics::in_parallel;

/// The place of some effects in a model, for a shape to stand in.
pub(super) struct Seat<'a> {
    /// The effects, by their places in the model; none of them beside all.
    pub(super) group: Vec<usize>,
    /// Columns of the others.
    pub(super) base: Columns,
    /// Where a shape may enter, in order.
    pub(super) entries: Vec<Entry>,
    /// What the others leave under the noise of the model, and under white noise, in which slow noise hides
    /// nothing.
    pub(super) stages: [Stage<'a>; 2],
}

/// Shapes at their best on each stage of a seat.
pub(super) type Tried<'a> = [Vec<Placed<'a>>; 2];

impl Seat<'_> {
    /// True when a shape may stand here: of many places it is looked for beside the effects only.
    fn hears(&self, entry: Entry, shape: &Shape, most_places: f64) -> bool {
        self.entries.contains(&entry) && (self.group.is_empty() || shape.places() < most_places)
    }
}

/// All shapes at their best in every seat that hears them.
pub(super) fn tried<'a>(
    seats: &[Seat<'_>],
    shapes: &'a [Shape],
    most_places: f64,
) -> Vec<Tried<'a>> {
    let entries: BTreeSet<Entry> = seats.iter().flat_map(|seat| &seat.entries).copied().collect();
    let each: Vec<(Entry, &Shape)> =
        entries.iter().flat_map(|&entry| shapes.iter().map(move |shape| (entry, shape))).collect();
    let of = |&(entry, shape): &(Entry, &'a Shape)| {
        let hears = |place: &usize| seats[*place].hears(entry, shape, most_places);
        let asked: Vec<usize> = (0..seats.len()).filter(hears).collect();
        let stages: Vec<&Stage<'_>> =
            asked.iter().flat_map(|&place| &seats[place].stages).collect();
        (asked, shape.best(&stages, entry))
    };
    let found: Vec<(Vec<usize>, Vec<Option<Placed<'a>>>)> = in_parallel(&each, of);
    let mut tried: Vec<Tried<'a>> = seats.iter().map(|_| [Vec::new(), Vec::new()]).collect();
    for (asked, best) in found {
        for (nth, placed) in best.into_iter().enumerate() {
            tried[asked[nth / 2]][nth % 2].extend(placed);
        }
    }
    tried
}
