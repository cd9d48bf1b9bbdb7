//! A mistake as a hypothesis: what would be predicted, and how usual the readings would be.

use std::cmp::Ordering;

use helixlock_plant::{Model, Term};

use crate::measurement::Measurement;
use crate::model::Problem;
use crate::policy::mistakes::MACHINE_OF_EFFECTS;

use super::doubt::Doubt;
use super::law::usualness;
use super::worst_pass::silent;

/// What kind of mistake, the mistake in a sentence, and the line that puts it right.
pub(super) type Words = (&'static str, String, String);

/// A mistake before the court.
#[derive(Debug)]
pub(super) struct Hypothesis {
    /// Kind of mistake.
    pub(super) what: &'static str,
    /// The mistake in a sentence.
    pub(super) says: String,
    /// The line that puts it right.
    pub(super) mend: String,
    /// The problem with the mistake put right.
    pub(super) mended: Problem,
    /// Evidence that comes of observations being written in another unit there; 0 where they stay as
    /// they were read.
    pub(super) rescaled: f64,
    /// The pass that the mistake is in, by its index, where it is in one alone.
    pub(super) pass: Option<usize>,
    /// True when it needs effects of known size that the file does not have.
    pub(super) physics: bool,
    /// True for a factor on what a sensor shows.
    pub(super) scales: bool,
    /// True for readings that stand beside their rows.
    pub(super) slips: bool,
    /// How much more usual the readings are when it is put right, as evidence.
    pub(super) usual: f64,
    /// Free numbers, and places they were looked for at.
    pub(super) numbers: f64,
    pub(super) looks: f64,
    /// Evidence against the next best explanation, once it has been judged.
    pub(super) evidence: f64,
}

impl Hypothesis {
    /// A mistake without a free number.
    pub(super) fn new((what, says, mend): Words, mended: Problem) -> Self {
        Self {
            what,
            says,
            mend,
            mended,
            rescaled: 0.0,
            pass: None,
            physics: false,
            scales: false,
            slips: false,
            usual: 0.0,
            numbers: 0.0,
            looks: 1.0,
            evidence: 0.0,
        }
    }

    /// True when it lets the prediction grow, shrink or vanish: then nothing is told from what is
    /// not there at all.
    pub(super) fn lets_go(&self) -> bool {
        self.scales || self.last_resort()
    }

    /// What is said of it.
    pub(super) fn doubt(&self) -> Doubt {
        let (says, mend) = (self.says.clone(), self.mend.clone());
        Doubt { what: self.what, evidence: self.evidence, says, mend }
    }

    /// True for a zero of the position, which an effect that delays imitates at one speed.
    pub(super) fn shifts(&self) -> bool {
        self.what == "shift"
    }

    /// True for a unit of what is no sensor's, of a place, for its scale, and for a lead: harmonics of the file's waves
    /// imitate them.
    pub(super) fn stretches(&self) -> bool {
        matches!(self.what, "lead" | "gear" | "scale") || self.what == "unit" && !self.scales
    }

    /// True when it is said only if no mistake of this machine's data is likely.
    pub(super) fn last_resort(&self) -> bool {
        self.what == "another-machine"
    }

    /// How late it is said: a factor of no unit after every mistake with a name, however much better a free
    /// number fits, and another machine last.
    pub(super) fn lateness(&self) -> u8 {
        match (self.last_resort(), self.scales && 0.0 < self.numbers) {
            (true, _) => 2,
            (_, free) => u8::from(free),
        }
    }

    /// Which of two is said before the other.
    pub(super) fn said_before(&self, other: &Self) -> Ordering {
        self.lateness().cmp(&other.lateness()).then(other.evidence.total_cmp(&self.evidence))
    }

    /// A mistake in the machine file; `None` when the data cannot be laid out alike by the mended one.
    pub(super) fn of_model(problem: &Problem, model: &Model, words: Words) -> Option<Self> {
        Self::of_both(problem, model, &problem.measurement, words)
    }

    /// A mistake in the machine file that the measurement was completed by.
    pub(super) fn of_both(
        problem: &Problem,
        model: &Model,
        measurement: &Measurement,
        words: Words,
    ) -> Option<Self> {
        let mended = Problem::new(model, measurement).ok()?;
        let alike = mended.has_rows_of(problem);
        let mended = Problem { layout: problem.layout.clone(), ..mended };
        alike.then(|| Self::new(words, mended))
    }

    /// A mistake in a measurement; `None` when the mended one cannot be laid out alike.
    pub(super) fn of_measurement(
        problem: &Problem,
        mended: &Measurement,
        words: Words,
    ) -> Option<Self> {
        Self::with(problem, mended, &[], words)
    }

    /// The same with further effects that the machine must then have.
    pub(super) fn with(
        problem: &Problem,
        mended: &Measurement,
        more: &[Term],
        words: Words,
    ) -> Option<Self> {
        let model = with_effects(&problem.model, more);
        let usual = usualness(mended, &model) - usualness(&problem.measurement, &model);
        let mended = Problem::new(&model, mended).ok()?;
        let alike = mended.has_samples_of(problem);
        let mended = Problem { layout: problem.layout.clone(), ..mended };
        alike.then_some(Self { physics: !more.is_empty(), usual, ..Self::new(words, mended) })
    }
}

/// A model that has further effects.
pub(super) fn with_effects(model: &Model, more: &[Term]) -> Model {
    let mut model = model.clone();
    model.effects.extend(more.iter().cloned());
    model
}

/// True of a file that says so much of its machine that nothing of it in the data is a doubt.
///
/// What is predicted from a log that holds its readings is not what the machine did between them.
fn tells_a_machine(problem: &Problem) -> bool {
    let held = |term: &&Term| term.needs().iter().any(|name| problem.measurement.holds(name));
    let told = problem.model.effects.iter().filter(|term| !held(term)).count();
    MACHINE_OF_EFFECTS <= told
}

/// The measurement shows nothing of what the file says that its machine has.
pub(super) fn another_machine(problem: &Problem) -> Option<Hypothesis> {
    let effects = problem.model.effects.len();
    if !tells_a_machine(problem) {
        return None;
    }
    let bare = Model { effects: Vec::new(), ..problem.model.clone() };
    let says = format!("none of the file's {effects} effects is in the data: is it this machine?");
    let mend = "take the machine file that belongs to the data".to_owned();
    Hypothesis::of_model(problem, &bare, ("another-machine", says, mend))
}

/// The same of one pass: it is of another machine, or its rows are not in order.
pub(super) fn another_machine_in(problem: &Problem, pass: usize) -> Option<Hypothesis> {
    if !tells_a_machine(problem) {
        return None;
    }
    let name = problem.measurement.pass_names[pass];
    let says = format!(
        "nothing of the file's effects is in pass {name}: is it of this machine, and are its rows in order?"
    );
    let mend = format!("leave pass {name} out, or put its rows in order");
    let one = Hypothesis::new(("another-machine", says, mend), silent(problem, pass));
    Some(Hypothesis { pass: Some(pass), ..one })
}
