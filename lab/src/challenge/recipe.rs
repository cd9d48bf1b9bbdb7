//! Which effects are hidden, and in which experiment they can be told from all others.

use helixlock_plant::{Machine, Record, Role, Search, Term};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::numerics::spread;

/// An effect with the experiment that shows it.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is one thing an experiment has or lacks")]
pub(super) struct Recipe {
    pub(super) kind: &'static str,
    pub(super) passes: usize,
    /// Speeds of the passes in turn, as shares of the spindle's.
    pub(super) speeds: [f64; 2],
    /// True when each pass turns back half way.
    pub(super) reversal: bool,
    /// True when the grating is turned on its hub before each pass.
    pub(super) reindexed: bool,
    pub(super) logs: &'static [&'static str],
    pub(super) recorder: bool,
    pub(super) thread: bool,
    /// True when the compensation adds pulses.
    pub(super) adding: bool,
    /// True when physics or counting fixes the size.
    pub(super) fixed_size: bool,
}

const PLAIN: Recipe = Recipe {
    kind: "gear-error",
    passes: 2,
    speeds: [1.0, 1.0],
    reversal: false,
    reindexed: false,
    logs: &[],
    recorder: true,
    thread: false,
    adding: false,
    fixed_size: false,
};

const AIR: &[&str] = &["air_temperature_c", "air_pressure_hpa", "humidity_pct"];

/// The recipe whose effect is hidden as a second one.
pub(super) const COMPANION: usize = 0;

pub(super) const RECIPES: [Recipe; 14] = [
    PLAIN,
    Recipe { kind: "screw-periodic", ..PLAIN },
    Recipe { kind: "screw-wear", passes: 3, ..PLAIN },
    Recipe { kind: "abbe", logs: &["bed_pitch_arcsec"], ..PLAIN },
    Recipe { kind: "backlash", reversal: true, ..PLAIN },
    Recipe { kind: "air-temperature", passes: 6, logs: AIR, fixed_size: true, ..PLAIN },
    Recipe { kind: "air-pressure", passes: 6, logs: AIR, fixed_size: true, ..PLAIN },
    Recipe { kind: "dead-path", passes: 6, logs: AIR, ..PLAIN },
    Recipe { kind: "clamping-runout", thread: true, ..PLAIN },
    Recipe { kind: "grating-eccentricity", passes: 4, reindexed: true, ..PLAIN },
    Recipe { kind: "headstock-growth", passes: 6, ..PLAIN },
    Recipe { kind: "vibration", passes: 4, speeds: [1.0, 1.5], ..PLAIN },
    Recipe {
        kind: "workpiece-expansion",
        passes: 3,
        logs: &["workpiece_temperature_c", "air_temperature_c"],
        thread: true,
        fixed_size: true,
        ..PLAIN
    },
    Recipe { kind: "lost-added-pulses", adding: true, fixed_size: true, ..PLAIN },
];

/// Recipes without what tells their effects: one speed, one place of the grating, two passes.
pub(super) fn poor() -> Vec<Recipe> {
    let told = RECIPES.iter().filter(|one| one.reindexed || one.speeds[0] < one.speeds[1]);
    told.map(|one| Recipe { passes: 2, speeds: [1.0, 1.0], reindexed: false, ..*one }).collect()
}

/// The effect of a recipe with values drawn by chance; its size is set afterwards.
pub(super) fn term(
    machine: &Machine,
    record: &Record,
    recipe: &Recipe,
    chance: &mut ChaCha8Rng,
) -> Term {
    let Some(card) = Term::card(recipe.kind) else {
        return Term::candidate(helixlock_plant::CATALOGUE[0], machine.rotary);
    };
    let mut term = Term::candidate(card, machine.rotary);
    for index in 0..term.parameters.len() {
        let what = &term.parameters[index];
        let share: f64 = chance.random_range(0.0..1.0);
        term.values[index] = match (what.role, what.search) {
            (Role::Known { .. }, _) | (_, Search::Switch | Search::Fixed)
                if what.default.is_some() && what.role != Role::Phase =>
            {
                what.default.unwrap_or(1.0)
            }
            (Role::Phase, _) => 360.0 * share - 180.0,
            (Role::Nonlinear, Search::GearOrder) => {
                machine.gears[chance.random_range(0..machine.gears.len())].order
            }
            (Role::Nonlinear, Search::Whole) => 1.0,
            (Role::Nonlinear, Search::Position) => {
                (0.25 + 0.5 * share) * spread(&record.position_mm)
            }
            (Role::Nonlinear, Search::Time) => (0.25 + 0.5 * share) * spread(&record.time_s),
            (Role::Nonlinear, _) => match what.unit.suffix().as_str() {
                "hz" => 0.03 + 0.1 * share,
                "s" => (0.15 + 0.3 * share) * spread(&record.time_s),
                "mm" => (0.03 + 0.05 * share) * spread(&record.position_mm),
                _ => what.default.unwrap_or(1.0),
            },
            _ => 0.5 + share,
        };
    }
    term
}
