//! Why a calculation was refused.

/// What a library of numbers can find wrong with its input; rows count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Two columns that belong together differ in length.
    #[error("a column has {found} rows, expected {expected}")]
    ColumnLengths {
        /// Rows of the first column.
        expected: usize,
        /// Rows of the other.
        found: usize,
    },
    /// A number is infinite, or NaN where a value must stand.
    #[error("sample {row}: {column} is not finite, expected a number")]
    NotFinite {
        /// Which sample.
        row: usize,
        /// Which column.
        column: &'static str,
    },
    /// Travel changes its direction inside one curve.
    #[error(
        "sample {row}: travel turns round from {previous_mm} mm to {found_mm} mm, expected one direction"
    )]
    TravelTurns {
        /// Which sample.
        row: usize,
        /// Its travel, mm.
        found_mm: f64,
        /// The travel before it, mm.
        previous_mm: f64,
    },
    /// Instants of a pulse train do not increase.
    #[error("{column} {row}: at {found_s} s after {previous_s} s, expected increasing time")]
    TimeTurns {
        /// Which pulse.
        row: usize,
        /// Of which train.
        column: &'static str,
        /// Its instant, s.
        found_s: f64,
        /// The instant before it, s.
        previous_s: f64,
    },
    /// A train that lost a pulse or has one twice.
    #[error(
        "{column} {row}: at {at_s} s a pulse was {what}, expected periods like those beside it\nhint: cut the capture there, both trains alike"
    )]
    PulseMissing {
        /// Which pulse.
        row: usize,
        /// Of which train.
        column: &'static str,
        /// Its instant, s.
        at_s: f64,
        /// What befell it.
        what: &'static str,
    },
    /// Pulse trains whose rates cannot come from the transmission described.
    #[error(
        "{found:.4} input pulses for each output pulse, expected about {expected:.4} from the lines and the ratio"
    )]
    WrongRatio {
        /// Input pulses for each output pulse over the whole run.
        found: f64,
        /// What lines and ratio say.
        expected: f64,
    },
    /// Too little is left to evaluate.
    #[error("{found} usable samples, expected {expected} or more at different places")]
    TooFewSamples {
        /// Samples there are.
        found: usize,
        /// Samples there should be.
        expected: usize,
    },
    /// A lead that is no length.
    #[error("lead is {found_mm} mm, expected more than 0 mm")]
    LeadNotPositive {
        /// The lead, mm.
        found_mm: f64,
    },
    /// A number outside the range that makes sense.
    #[error("{name} is {found}, expected {expected}")]
    OutOfRange {
        /// What it is.
        name: &'static str,
        /// Its value.
        found: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// A tolerance table that cannot be read.
    #[error("tolerance table: {reason}")]
    ToleranceTable {
        /// What is wrong, and where.
        reason: String,
    },
    /// A standard nobody has a table for.
    #[error("standard `{found}` is unknown, expected `iso3408-3` or `jbt2886`")]
    UnknownStandard {
        /// Its name.
        found: String,
    },
    /// A grade the table does not have.
    #[error("grade `{found}` is unknown, expected one of {expected}")]
    UnknownGrade {
        /// The grade asked for.
        found: String,
        /// The grades there are.
        expected: String,
    },
    /// Probe spacings that lose harmonics.
    #[error(
        "spacings {first} and {second} samples lose harmonics {lost:?} of {samples} samples, expected spacings without a common divisor with the samples\nhint: choose spacings with `--plan`, or accept the loss with `--accept-lost-harmonics`"
    )]
    LostHarmonics {
        /// First spacing, samples.
        first: usize,
        /// Second spacing, samples.
        second: usize,
        /// Samples of the stroke.
        samples: usize,
        /// The harmonics nobody can recover.
        lost: Vec<usize>,
    },
    /// A spacing that is no whole number of samples.
    #[error(
        "spacing {found_mm} mm is no whole number of sampling steps of {step_mm} mm, expected a multiple"
    )]
    SpacingOffGrid {
        /// The spacing, mm.
        found_mm: f64,
        /// The sampling step, mm.
        step_mm: f64,
    },
    /// Probes so far apart that no two of them touch the same places.
    #[error("the probes span {found_mm} mm, expected less than the stroke of {stroke_mm} mm")]
    ProbesBeyondStroke {
        /// From the first probe to the third, mm.
        found_mm: f64,
        /// From the first sample to the last, mm.
        stroke_mm: f64,
    },
    /// A correction table or image that is damaged or foreign.
    #[error("table image: {reason}")]
    Image {
        /// What is wrong with it.
        reason: String,
    },
    /// A table too big for the memory it has to fit in.
    #[error(
        "table needs {needed} bytes, expected {available} or fewer\nhint: a longer sampling step or one direction needs less"
    )]
    ImageTooBig {
        /// Bytes needed.
        needed: usize,
        /// Bytes there are.
        available: usize,
    },
    /// Two directions measured over different stretches.
    #[error(
        "one direction begins at {begins_mm} mm and another ends at {ends_mm} mm, expected a stretch that both cover"
    )]
    DirectionsApart {
        /// Where the later one begins, mm.
        begins_mm: f64,
        /// Where the earlier one ends, mm.
        ends_mm: f64,
    },
    /// A stretch between two places of a table.
    #[error(
        "no multiple of the table step {step_mm} mm lies from {from_mm} mm to {to_mm} mm, expected one or more\nhint: choose a shorter `--step`"
    )]
    NoPlace {
        /// The step, mm.
        step_mm: f64,
        /// Where the samples begin, mm.
        from_mm: f64,
        /// Where they end, mm.
        to_mm: f64,
    },
    /// An error the table's byte cannot hold.
    #[error(
        "the correction at {at_mm} mm is {found_um:.3} µm, expected at most ±{limit_um:.3} µm for 8 bits at this LSB\nhint: choose a bigger `--lsb`"
    )]
    BeyondConverter {
        /// Where, mm.
        at_mm: f64,
        /// How much, µm.
        found_um: f64,
        /// The most a byte holds, µm.
        limit_um: f64,
    },
    /// A method that cannot work with this pair of pulse trains.
    #[error("method `{method}` {reason}")]
    MethodCannot {
        /// Which method.
        method: &'static str,
        /// Why.
        reason: String,
    },
    /// Nothing was measured twice, so nothing can be said about repeatability.
    #[error(
        "{found} repeats at the target {at_mm} mm, expected {expected} or more in each direction"
    )]
    TooFewRepeats {
        /// The target, mm.
        at_mm: f64,
        /// Repeats there are.
        found: usize,
        /// Repeats there should be.
        expected: usize,
    },
}
