//! The hazards one by one.

use crate::circuit::Circuit;
use crate::delays::{Corner, Delays};
use crate::error::Error;
use crate::figures::compensator::{self, Correction};
use crate::figures::discriminator::{self, ClockInputs};
use crate::figures::{Clear, divider, phase_selector, reset_counter};
use crate::library::{FLIP_FLOP_PULSES, SN7400, SN7476, rc_limits};
use crate::pulses::{Change, Train};
use crate::simulator::{Check, Simulator};

use super::{Hazard, Waves, begins, typical};

/// Time for everything to rest, ps.
const REST_PS: u64 = 20_000_000;

pub(super) fn run<'a>(
    circuit: &'a Circuit,
    delays: &Delays,
    changes: &[Change],
) -> Result<Simulator<'a>, Error> {
    let mut simulator = Simulator::new(circuit, delays)?;
    for (time_ps, pin, level) in changes {
        simulator.drive(*time_ps, *pin, *level)?;
    }
    simulator.run_until(changes.last().map_or(0, |last| last.0) + REST_PS);
    Ok(simulator)
}

/// The waves at the number where it begins; none when it does not.
fn shown(
    begins_ps: Option<u64>,
    waves: impl FnOnce(u64) -> Result<Waves, Error>,
) -> Result<Waves, Error> {
    begins_ps.map_or_else(|| Ok(Waves::default()), waves)
}

fn rises(simulator: &mut Simulator, circuit: &Circuit, pin: &str) -> Result<usize, Error> {
    let net = circuit.pin(pin)?;
    let edges = simulator.take_edges();
    Ok(edges.iter().filter(|edge| edge.net == net && edge.level).count())
}

/// A slow NAND3 lets a clock pulse through NAND1 where a comparison begins: the laser leads in
/// every one, Q is low, and rises nevertheless.
pub(super) fn slow_nand3(inputs: ClockInputs) -> Result<Hazard, Error> {
    let circuit = discriminator::with(inputs);
    let [start, middle, laser] = ["start", "middle", "laser"].map(|pin| circuit.pin(pin));
    let (start, middle, laser) = (start?, middle?, laser?);
    let mut train = Train::new();
    for number in 1..=3 {
        train.pulse(number * 100_000_000, start, 500_000);
        train.pulse(number * 100_000_000 + 40_000_000, laser, 500_000);
        train.pulse(number * 100_000_000 + 50_000_000, middle, 500_000);
    }
    let changes = train.changes();
    let slow = |nand3_ps| typical(&circuit).with(&circuit, "nand3", [nand3_ps, nand3_ps]);
    let begins_ps = begins(1_000, 100_000, &mut |nand3_ps| {
        Ok(0 < rises(&mut run(&circuit, &slow(nand3_ps)?, &changes)?, &circuit, "q")?)
    })?;
    let wires = ["start", "meter", "standard", "nand3", "nand1", "q"];
    let waves = shown(begins_ps, |nand3_ps| {
        let window_ps = [199_980_000, 200_280_000];
        Waves::of(&circuit, &slow(nand3_ps)?, &changes, &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "15, 16",
        what: match inputs {
            ClockInputs::Coupled => "a direction is lost where a comparison begins",
            ClockInputs::OfClockLength => "the same with clock inputs of 14 ns, as of a 7472",
            ClockInputs::Missing => "the same, the clock inputs taken out",
        },
        turned: "delay of NAND3, all else typical",
        begins_ps,
        given_ps: SN7400.limits.fall.longest_ps,
        above: true,
        kept_away_by: "clocks coupled in by an RC network",
        waves,
    })
}

/// Without the delay, the first flip-flop that obeys ends the clear of the others.
pub(super) fn short_clear() -> Result<Hazard, Error> {
    let circuit = divider::circuit(4, Clear::AtOnce);
    let pulse = circuit.pin("pulse")?;
    let mut train = Train::new();
    for number in 1..=8 {
        train.pulse(number * REST_PS, pulse, REST_PS / 2);
    }
    let changes = train.changes();
    let quick = |flip_flop_ps| {
        let delays = Delays::corner(&circuit, Corner::Shortest);
        delays.with(&circuit, "units_c", [flip_flop_ps, flip_flop_ps])
    };
    let begins_ps = begins(40_000, 1, &mut |flip_flop_ps| {
        let findings = run(&circuit, &quick(flip_flop_ps)?, &changes)?.findings();
        Ok(findings.iter().any(|finding| finding.check == Check::PresetClear))
    })?;
    let wires = ["pulse", "units_c", "coincidence", "clear_bar"];
    let waves = shown(begins_ps, |flip_flop_ps| {
        let fall_ps = 4 * REST_PS + REST_PS / 2;
        let window_ps = [fall_ps - 20_000, fall_ps + 120_000];
        Waves::of(&circuit, &quick(flip_flop_ps)?, &changes, &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "7",
        what: "the clear is shorter than the 25 ns a flip-flop may ask for, the delay taken out",
        turned: "delay of the first flip-flop to clear, all else shortest",
        begins_ps,
        given_ps: SN7476.limits.fall.shortest_ps,
        above: false,
        kept_away_by: "the delay before the clear",
        waves,
    })
}

/// The gate opens while a grating line is high: what is left of it may be no clock pulse.
pub(super) fn cut_line() -> Result<Hazard, Error> {
    let circuit = phase_selector::circuit(1);
    let [laser, grating, reset] = ["laser", "grating", "reset"].map(|pin| circuit.pin(pin));
    let (laser, grating, reset) = (laser?, grating?, reset?);
    let falls_ps = 2 * REST_PS;
    let delays = typical(&circuit);
    let line = circuit.pin("line")?;
    let lines = |behind_ps| {
        let mut train = Train::new();
        train.level(1_000_000, reset, false);
        train.pulse(falls_ps - REST_PS / 2, laser, REST_PS / 2);
        train.pulse(falls_ps - REST_PS / 4, grating, REST_PS / 4 + behind_ps);
        train.changes()
    };
    let begins_ps = begins(2_000_000, 0, &mut |behind_ps| {
        let edges = run(&circuit, &delays, &lines(behind_ps))?.take_edges();
        let edges: Vec<_> = edges.iter().filter(|edge| edge.net == line).collect();
        let shortest_ps = FLIP_FLOP_PULSES.clock_high_ps;
        Ok(edges.windows(2).all(|pair| pair[1].time_ps - pair[0].time_ps < shortest_ps))
    })?;
    let waves = shown(begins_ps, |behind_ps| {
        let window_ps = [falls_ps - 20_000, falls_ps + 180_000];
        let wires = ["laser", "open", "grating", "line"];
        Waves::of(&circuit, &delays, &lines(behind_ps), &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "8",
        what: "the first line through the gate is cut, and no clock pulse for the divider",
        turned: "time from the fall of the m-th laser pulse to the fall of the line, all typical",
        begins_ps,
        given_ps: 0,
        above: false,
        kept_away_by: "nothing: once in a pass, within this window, a line more or less",
        waves,
    })
}

/// Direction and step at the same time: J and K have not come to rest when the clock rises.
pub(super) fn late_direction() -> Result<Hazard, Error> {
    let circuit = reset_counter::circuit();
    let [request, forward] = ["request", "forward"].map(|pin| circuit.pin(pin));
    let (request, forward) = (request?, forward?);
    let delays = Delays::corner(&circuit, Corner::Longest);
    let last_ps = 2049 * REST_PS;
    let turned = |before_ps| {
        let mut train = Train::new();
        // To 2048 and one back: the whole chain has to follow.
        for number in 1..=2048 {
            train.pulse(number * REST_PS, request, REST_PS / 2);
        }
        train.level(last_ps - before_ps, forward, false);
        train.pulse(last_ps, request, REST_PS / 2);
        train.changes()
    };
    let begins_ps = begins(2_000_000, 0, &mut |before_ps| {
        let findings = run(&circuit, &delays, &turned(before_ps))?.findings();
        Ok(findings.iter().any(|finding| finding.check == Check::Data))
    })?;
    let waves = shown(begins_ps, |before_ps| {
        let window_ps = [last_ps - before_ps - 20_000, last_ps + 120_000];
        let wires = ["forward", "up", "down", "toggle6", "toggle11", "taken"];
        Waves::of(&circuit, &delays, &turned(before_ps), &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "17",
        what: "the counter miscounts a step whose direction is new",
        turned: "time from direction to step, all parts slowest",
        begins_ps,
        given_ps: 0,
        above: false,
        kept_away_by: "nothing in the text: the discriminator does not wait for the step oscillator",
        waves,
    })
}

/// A pulse that ends while the clear is low is lost.
pub(super) fn lost_pulse() -> Result<Hazard, Error> {
    let circuit = divider::circuit(4, Clear::Delayed);
    let pulse = circuit.pin("pulse")?;
    let delays = Delays::corner(&circuit, Corner::Longest);
    let pulses = |period_ps| {
        let mut train = Train::new();
        for number in 1..=40 {
            train.pulse(number * period_ps, pulse, period_ps / 2);
        }
        train.changes()
    };
    let begins_ps = begins(10_000_000, 200_000, &mut |period_ps| {
        Ok(rises(&mut run(&circuit, &delays, &pulses(period_ps))?, &circuit, "divided")? != 10)
    })?;
    let waves = shown(begins_ps, |period_ps| {
        let window_ps = [4 * period_ps, 6 * period_ps + 200_000];
        let wires = ["pulse", "coincidence", "clear_bar", "units_a"];
        Waves::of(&circuit, &delays, &pulses(period_ps), &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "7",
        what: "a pulse that comes while the decades are cleared is lost",
        turned: "time from pulse to pulse, all parts slowest",
        begins_ps,
        given_ps: 200_000_000,
        above: false,
        kept_away_by: "5000 fringes a second at 1.5 mm/s",
        waves,
    })
}

/// An added pulse comes right behind a real one; the pause is the clock-low time of divider B.
pub(super) fn added_pulse_too_close() -> Result<Hazard, Error> {
    let circuit = compensator::circuit(1, Correction::Insert);
    let laser = circuit.pin("laser")?;
    let mut train = Train::new();
    for number in 1..=1000 {
        train.pulse(number * REST_PS, laser, REST_PS / 2);
    }
    let shortest = Delays::corner(&circuit, Corner::Shortest);
    let mut simulator = Simulator::new(&circuit, &shortest)?;
    let pulse = circuit.pin("pulse")?;
    simulator.watch(&[pulse]);
    let changes = train.changes();
    for (time_ps, pin, level) in &changes {
        simulator.drive(*time_ps, *pin, *level)?;
    }
    simulator.run_until(1002 * REST_PS);
    let edges = simulator.take_edges();
    let fall_ps = 1000 * REST_PS + REST_PS / 2;
    let window_ps = [fall_ps - 100_000, fall_ps + 1_200_000];
    let wires = ["laser", "due", "clear_bar", "pulse"];
    let waves = Waves::of(&circuit, &shortest, &changes, &wires, window_ps)?;
    let pause_ps = edges.windows(2).map(|pair| pair[1].time_ps - pair[0].time_ps).min();
    Ok(Hazard {
        figure: "9",
        what: "an added pulse runs into the one before it",
        turned: "pause between them, all parts shortest",
        begins_ps: Some(FLIP_FLOP_PULSES.clock_low_ps),
        given_ps: pause_ps.unwrap_or(0),
        above: false,
        kept_away_by: "the carry through the decades, which the added pulse waits for",
        waves,
    })
}

/// An added pulse falls while divider B clears itself behind the pulse before it.
pub(super) fn added_pulse_lost() -> Result<Hazard, Error> {
    let mut circuit = Circuit::new("compensator_and_divider");
    let (laser, reset) = (circuit.input("laser", false), circuit.input("reset", false));
    let pulses =
        circuit.block("compensator", |c| compensator::add(c, laser, reset, 1, Correction::Insert));
    let divided = circuit.block("b", |c| divider::add(c, pulses, reset, 500, Clear::Delayed));
    circuit.output("divided", divided);
    let mut train = Train::new();
    // The 1000th is the F-th and ends a division; with the added one 1499 are three times 500.
    for number in 1..=1499 {
        train.pulse(number * REST_PS, laser, REST_PS / 2);
    }
    let changes = train.changes();
    let late = |delay_ps| typical(&circuit).with(&circuit, "b_late", [delay_ps, delay_ps]);
    let begins_ps = begins(100_000, divider::DELAY_PS, &mut |delay_ps| {
        Ok(rises(&mut run(&circuit, &late(delay_ps)?, &changes)?, &circuit, "divided")? != 3)
    })?;
    let waves = shown(begins_ps, |delay_ps| {
        let fall_ps = 1000 * REST_PS + REST_PS / 2;
        let window_ps = [fall_ps - 100_000, fall_ps + 1_400_000];
        let wires = ["laser", "compensator_added", "divided", "b_clear_bar", "b_units_a"];
        Waves::of(&circuit, &late(delay_ps)?, &changes, &wires, window_ps)
    })?;
    Ok(Hazard {
        figure: "9 and 7",
        what: "an added pulse behind the B-th is lost while divider B is cleared",
        turned: "delay of the divider's clear, all else typical",
        begins_ps,
        given_ps: rc_limits(divider::DELAY_PS).rise.longest_ps,
        above: true,
        kept_away_by: "an added pulse that waits for the clear; the text has no word of it",
        waves,
    })
}
