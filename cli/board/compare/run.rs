//! The model on the pins of a log.

use anyhow::Context;
use helixlock_netlist::SignalId;
use helixlock_sim::{Circuit, Comparison, Engine, InterpretedPieces, Leap, Recorder};

use super::pins::PinLog;

/// What became of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    /// Comparisons of the model that ended before the first difference.
    pub(super) comparisons: u64,
    /// The first difference.
    pub(super) difference: Option<Difference>,
}

/// The first clock at which log and model differ.
#[derive(Clone, Debug)]
pub(super) struct Difference {
    /// The edge after which they do.
    pub(super) clock: u64,
    /// Index of the pin.
    pub(super) pin: usize,
    /// Its level in the log.
    pub(super) found: bool,
    /// Number of the comparison, if one had begun.
    pub(super) number: Option<u64>,
    /// That comparison in the log and in the model, if it ended and the log has `t1`.
    pub(super) readings: Option<[Comparison; 2]>,
    /// Net steps at its end, in the log and in the model, if the log has them.
    pub(super) steps: Option<[i64; 2]>,
}

/// Runs the model on the log's inputs to the first difference, and to the end of that comparison.
///
/// `progress` is told the clock it has come to.
pub(super) fn compare(
    circuit: &Circuit,
    log: &PinLog,
    progress: impl FnMut(u64),
) -> anyhow::Result<Outcome> {
    let mut pair = Pair::new(circuit, log)?;
    pair.run(progress);
    Ok(pair.outcome)
}

/// What is counted of one of the two.
#[derive(Default)]
struct Side {
    recorder: Recorder,
    stepping: bool,
    steps: i64,
}

impl Side {
    fn see(&mut self, clock: u64, [t1, step, direction]: [bool; 3]) {
        self.recorder.meter(clock, t1);
        if step && !self.stepping {
            self.steps += if direction { 1 } else { -1 };
        }
        self.stepping = step;
    }
}

/// The model beside the log.
struct Pair<'a> {
    log: &'a PinLog,
    engine: Leap<'a, InterpretedPieces<'a>>,
    opening: SignalId,
    begun: SignalId,
    number: SignalId,
    /// Outputs that a [`Side`] looks at, and their places in the log.
    seen: [(SignalId, Option<usize>); 3],
    /// Levels of the log's pins.
    levels: Vec<bool>,
    /// Log and model.
    sides: [Side; 2],
    outcome: Outcome,
}

impl<'a> Pair<'a> {
    fn new(circuit: &'a Circuit, log: &'a PinLog) -> anyhow::Result<Self> {
        let netlist = circuit.netlist();
        let find = |path: &str| netlist.find(path).with_context(|| format!("no signal `{path}`"));
        let seen = |path: &str| {
            let place = log.pins.iter().position(|pin| pin.logged && pin.name == path);
            anyhow::Ok((find(path)?, place))
        };
        Ok(Self {
            log,
            engine: Leap::new(circuit, InterpretedPieces::new(circuit)),
            opening: find("telemetry.opening")?,
            begun: find("telemetry.begun_q")?,
            number: find("telemetry.number_q")?,
            seen: [seen("t1")?, seen("step")?, seen("direction")?],
            levels: log.pins.iter().map(|pin| pin.first).collect(),
            sides: [Side::default(), Side::default()],
            outcome: Outcome::default(),
        })
    }

    fn run(&mut self, mut progress: impl FnMut(u64)) {
        let mut watched = self.engine.netlist().outputs.clone();
        watched.push(self.opening);
        self.engine.watch(&watched);
        (0..self.log.pins.len()).for_each(|pin| self.drive(pin));
        let log = self.log;
        let mut changes = log.changes.iter().peekable();
        loop {
            let now = self.engine.clock();
            let mut driven = vec![];
            while let Some(change) = changes.next_if(|change| change.clock <= now) {
                self.levels[change.pin] = change.high;
                driven.push(change.pin);
            }
            if self.observe(now) || now >= log.clocks {
                return;
            }
            // What changes after this edge is seen by the next.
            for pin in driven {
                self.drive(pin);
            }
            let next = changes.peek().map_or(log.clocks, |change| change.clock);
            self.engine.run_until(next.min(log.clocks));
            progress(self.engine.clock());
        }
    }

    /// Puts an input of the model on the level of the log.
    fn drive(&mut self, pin: usize) {
        let pin = &self.log.pins[pin];
        if pin.input {
            let bits = self.log.pins.iter().zip(&self.levels);
            let bits = bits.filter(|(other, _)| other.port == pin.port);
            let value = bits.map(|(pin, level)| u64::from(*level) << pin.bit).sum();
            self.engine.set_input(pin.port, value);
        }
    }

    /// Holds the outputs to each other; true when nothing more is to be learnt.
    fn observe(&mut self, now: u64) -> bool {
        let model = self.seen.map(|(signal, _)| self.engine.value(signal) == 1);
        let log = self.seen.map(|(_, place)| place.is_some_and(|place| self.levels[place]));
        for (side, levels) in self.sides.iter_mut().zip([log, model]) {
            side.see(now, levels);
        }
        if self.outcome.difference.is_none() {
            self.outcome.difference = self.difference(now);
        }
        let steps = self.sides.each_ref().map(|side| side.steps);
        let has_steps = self.seen[1..].iter().all(|(_, place)| place.is_some());
        if let Some(difference) = &mut self.outcome.difference {
            difference.steps = has_steps.then_some(steps);
        }
        self.engine.value(self.opening) == 1 && self.end_comparison(now)
    }

    /// The first output that is not on the level of the log.
    fn difference(&mut self, now: u64) -> Option<Difference> {
        let outputs = self.log.pins.iter().zip(&self.levels).enumerate();
        let mut outputs = outputs.filter(|(_, (pin, _))| !pin.input);
        let (pin, found) = outputs.find_map(|(place, (pin, level))| {
            let differs = (self.engine.value(pin.port) == 1) != *level;
            differs.then_some((place, *level))
        })?;
        let begun = self.engine.value(self.begun) == 1;
        let number = self.engine.value(self.number);
        let number = begun.then_some(number);
        Some(Difference { clock: now, pin, found, number, readings: None, steps: None })
    }

    /// The model begins the next comparison; true when the one that ends is that of the difference.
    fn end_comparison(&mut self, now: u64) -> bool {
        let [log, model] = self.sides.each_mut().map(|side| side.recorder.compare(now));
        let Some(readings) = log.zip(model).map(|(log, model)| [log, model]) else { return false };
        let has_meter = self.seen[0].1.is_some();
        match &mut self.outcome.difference {
            // One at the opening itself lies in the comparison that begins there.
            Some(difference) if difference.clock < now => {
                difference.readings =
                    (has_meter && difference.number.is_some()).then_some(readings);
                true
            }
            Some(_) => false,
            None => {
                self.outcome.comparisons += 1;
                false
            }
        }
    }
}
