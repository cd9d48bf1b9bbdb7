//! A day in a workshop, at the pins of the board shell.
//!
//! Levels drawn without a plan would stop the board once and then look at a board that stands still.
//! So the panel follows scenes, in which passes begin and end; switches bounce, pulses come at drawn
//! times, and buttons are pressed at any of them.

use std::collections::BTreeMap;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Some clocks in which the panel rests.
struct Scene {
    clocks: usize,
    /// Switches that are on.
    on: &'static [&'static str],
    /// The pulses that do not come.
    silent: &'static str,
}

const fn scene(clocks: usize, on: &'static [&'static str]) -> Scene {
    Scene { clocks, on, silent: "" }
}

const fn without(silent: &'static str, clocks: usize, on: &'static [&'static str]) -> Scene {
    Scene { clocks, on, silent }
}

/// After each pass the panel is off, and what was wrong is forgotten.
const DAY: &[Scene] = &[
    scene(300, &["enable"]),
    // A pass, and back.
    scene(3000, &["enable", "start", "correct"]),
    scene(800, &["enable", "playback"]),
    scene(150, &["enable"]),
    // Lines fail, then fringes; the loop has to stop, the playback not.
    scene(700, &["enable", "start", "correct"]),
    without("grating", 700, &["enable", "start", "correct"]),
    scene(400, &["enable", "start", "correct", "playback"]),
    scene(150, &["enable"]),
    scene(700, &["enable", "start", "correct"]),
    without("laser", 700, &["enable", "start", "correct"]),
    scene(150, &["enable"]),
    // Without correction a meter may wrap: only the watchdogs see what is missing.
    scene(700, &["enable", "start"]),
    without("laser", 700, &["enable", "start"]),
    scene(150, &["enable"]),
    // A stop is remembered as long as any of the three switches is on.
    scene(900, &["enable", "start", "correct"]),
    scene(60, &["enable", "start", "correct", "emergency_stop"]),
    scene(300, &["enable", "start"]),
    scene(300, &["enable", "correct"]),
    scene(300, &["enable", "playback"]),
    scene(300, &["enable"]),
    // Nothing moves without the switch that allows it.
    scene(900, &["start", "correct"]),
    scene(500, &["playback"]),
    scene(300, &[]),
    scene(900, &["enable", "start"]),
    scene(150, &["enable"]),
    // A pass so long that compensations are due.
    scene(9500, &["enable", "start"]),
    scene(800, &["enable", "playback", "start"]),
];

/// Clocks a switch bounces after it was thrown.
const BOUNCES: usize = 12;

/// Levels at the pins, and when drawn ones change next.
#[derive(Default)]
pub(super) struct Workshop {
    drawn: BTreeMap<String, (u64, usize)>,
}

impl Workshop {
    /// The level of a pin in a clock; clocks follow each other.
    pub(super) fn level(&mut self, pin: &str, clock: usize, random: &mut ChaCha8Rng) -> u64 {
        let (scene, since) = scene_at(clock);
        let glitch = u64::from(random.random_range(0..40) == 0);
        match pin {
            _ if pin == scene.silent => 0,
            // Four lines take about as long as three fringes.
            "grating" => self.drawn(pin, clock, 2..5, random) ^ glitch,
            "laser" => self.drawn(pin, clock, 3..6, random) ^ glitch,
            "calibrate" => {
                2 * self.drawn("high", clock, 300..1500, random)
                    + self.drawn("low", clock, 300..1500, random)
            }
            "range_x2" | "manual_forward" => self.drawn(pin, clock, 300..2500, random),
            "manual_step" => self.drawn(pin, clock, 8..300, random),
            _ if since < BOUNCES && pin != "emergency_stop" => random.random_range(0..2),
            _ => scene.on.contains(&pin).into(),
        }
    }

    /// A level that changes after a drawn number of clocks.
    fn drawn(
        &mut self,
        pin: &str,
        clock: usize,
        rests: std::ops::Range<usize>,
        random: &mut ChaCha8Rng,
    ) -> u64 {
        let (level, until) = self.drawn.entry(pin.to_owned()).or_default();
        if *until <= clock {
            (*level, *until) = (1 - *level, clock + random.random_range(rests));
        }
        *level
    }
}

/// The scene of a clock, and how long it has lasted; days follow each other.
fn scene_at(clock: usize) -> (&'static Scene, usize) {
    let day: usize = DAY.iter().map(|scene| scene.clocks).sum();
    let mut since = clock % day;
    for scene in DAY {
        if since < scene.clocks {
            return (scene, since);
        }
        since -= scene.clocks;
    }
    unreachable!("a day is as long as its scenes")
}
