//! Shafts of the machine file whose turns the samples resolve.

use super::problem::Problem;
use crate::numerics::spread;
use crate::policy::extent::MOST_SHAFTS;

/// A shaft.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shaft {
    pub(crate) name: String,
    /// Its turns a turn of the spindle.
    pub(crate) order: f64,
    /// True for one of the gears: what repeats with it is its error, whatever the shape.
    pub(crate) of_a_gear: bool,
}

impl Problem {
    /// Turns of the spindle from one end of the record to the other.
    pub(crate) fn turned(&self) -> f64 {
        spread(&self.record.turns().collect::<Vec<_>>())
    }

    /// The spindle, the machine's screw and the slowest shafts of its gears, of those that make more than so many
    /// turns.
    #[must_use]
    pub(crate) fn shafts(&self, least_turns: f64) -> Vec<Shaft> {
        let screw = self.model.lead_screw.as_ref().filter(|_| !self.model.rotary);
        let screw = screw.map(|lead| self.model.workpiece.lead.mm() / lead.mm());
        let own = [("spindle angle", Some(1.0)), ("machine screw angle", screw)];
        let own = own.into_iter().filter_map(|(name, order)| {
            Some(Shaft { name: name.to_owned(), order: order?, of_a_gear: false })
        });
        let gears = self.model.gears.iter().map(|gear| Shaft {
            name: format!("angle of `{}`", gear.name),
            order: gear.order,
            of_a_gear: true,
        });
        let mut gears: Vec<Shaft> = gears.collect();
        gears.sort_by(|a, b| a.order.total_cmp(&b.order));
        let turns = self.turned();
        let mut shafts: Vec<Shaft> = Vec::new();
        for shaft in own.chain(gears) {
            let order = shaft.order;
            let is_met = order < self.highest_order() && least_turns < order * turns;
            let is_new = |other: &Shaft| 1e-9 * order < (other.order - order).abs();
            if is_met && shafts.iter().all(is_new) && shafts.len() < MOST_SHAFTS {
                shafts.push(shaft);
            }
        }
        shafts
    }
}
