//! A day in a workshop, at the pins of the board shell.
//!
//! Levels drawn without a plan would stop the board once and then look at a board that stands still.
//! So the panel follows scenes, in which passes begin and end; switches bounce, pulses come at drawn
//! times, and buttons are pressed at any of them.

use std::collections::BTreeMap;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::computer::Computer;

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
    // Time for a computer to turn the wheels.
    scene(2500, &["enable"]),
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
    computer: Computer,
    drawn: BTreeMap<String, (u64, usize)>,
    encoders: BTreeMap<&'static str, Turn>,
}

/// Where an encoder is.
#[derive(Default)]
struct Turn {
    /// Quarters of a line.
    quarters: u64,
    /// Clock of the next one.
    until: usize,
    /// Quarters that it still goes back.
    back: u64,
}

impl Workshop {
    /// The level of a pin in a clock; clocks follow each other.
    pub(super) fn level(&mut self, pin: &str, clock: usize, random: &mut ChaCha8Rng) -> u64 {
        let (scene, since) = scene_at(clock);
        let glitch = u64::from(random.random_range(0..40) == 0);
        match pin {
            _ if pin == scene.silent => 0,
            // Four lines take about as long as three fringes.
            "grating" => self.encoder("grating", clock, 1..3, random) ^ glitch,
            "laser" => self.encoder("laser", clock, 2..3, random) ^ glitch,
            "grating_b" => self.second("grating"),
            "laser_b" => self.second("laser"),
            "grating_index" | "laser_index" => self.drawn(pin, clock, 5..60, random),
            "calibrate" => {
                2 * self.drawn("high", clock, 300..1500, random)
                    + self.drawn("low", clock, 300..1500, random)
            }
            "range_x2" | "manual_forward" => self.drawn(pin, clock, 300..2500, random),
            "rx" => self.computer.line(clock, random),
            "manual_step" => self.drawn(pin, clock, 8..300, random),
            _ if since < BOUNCES && pin != "emergency_stop" => random.random_range(0..2),
            _ => scene.on.contains(&pin).into(),
        }
    }

    /// First signal of an encoder, which mostly goes forward, a quarter of a line in so many clocks.
    fn encoder(
        &mut self,
        pin: &'static str,
        clock: usize,
        rests: std::ops::Range<usize>,
        random: &mut ChaCha8Rng,
    ) -> u64 {
        let turn = self.encoders.entry(pin).or_default();
        if turn.until <= clock {
            turn.until = clock + random.random_range(rests);
            if turn.back == 0 && random.random_range(0..200) == 0 {
                turn.back = random.random_range(1..20);
            }
            turn.quarters = if turn.back > 0 && turn.quarters > 0 {
                turn.quarters - 1
            } else {
                turn.quarters + 1
            };
            turn.back = turn.back.saturating_sub(1);
        }
        u64::from(matches!(turn.quarters % 4, 1 | 2))
    }

    /// Its second signal, a quarter behind.
    fn second(&self, pin: &str) -> u64 {
        let quarters = self.encoders.get(pin).map_or(0, |turn| turn.quarters);
        u64::from(matches!(quarters % 4, 2 | 3))
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
