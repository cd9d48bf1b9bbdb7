//! Who wins: margins of evidence, and what likeness is.
//!
//! Odds are `exp(evidence / 2)`: 8 are 55 to 1, 10 are 150 to 1, 12 are 400 to 1.

/// Evidence by which an effect must beat every other to be named, and a shape without a name the
/// effects in whose place it stands.
///
/// Chosen: odds of 55 to 1. Doubled: 3000 to 1, and more answers are `ambiguous`.
pub(crate) const MARGIN: f64 = 8.0;

/// Evidence that overrules a high inflation.
///
/// Chosen: odds of 270 000 to 1, which no model of the noise is good enough for. Doubled: effects
/// that are alike in shape are `ambiguous` however well one of them fits.
pub(crate) const CLEAR_MARGIN: f64 = 25.0;

/// The same for an effect that turns with a reversal or follows a logged column, which no slow bend does.
///
/// Measured: of records of two generators that were `ambiguous` by inflation alone, 12 to 25 behind, the first name was
/// right in all 12 that are such, and in 4 of 6 others. Doubled: these 12 are `ambiguous`.
pub(crate) const CLEAR_OF_BENDS: f64 = 12.0;

/// Variance inflation above which two effects count as one.
///
/// Source: Marquardt 1970, *Generalized inverses, ridge regression, biased linear estimation, and
/// nonlinear estimation*, Technometrics 12:591. Doubled: the standard error of a named effect may
/// be 4.5 times what it were alone, instead of 3.2 times.
pub(crate) const INFLATION: f64 = 10.0;

/// A rival that had to be tuned to so many times as many places is a coincidence, no likeness.
///
/// Chosen: odds of 8 to 1, paid for by the looks. Doubled: more bumps and slips are rivals.
pub(crate) const COINCIDENCE: f64 = 8.0;

/// Evidence that tells a frequency in time from an order of the spindle.
///
/// Chosen: odds of 400 to 1. Doubled: a vibration needs a larger change of speed to be one.
pub(crate) const TIME_LOCK: f64 = 12.0;

/// Root mean square, in waves, by which rows may lie off an even motion for their angles to be taken for it.
///
/// Chosen: beyond a sixth of a wave two thirds of it are lost, and what the axis did is no even motion. Doubled: steps
/// of a third of a wave are stamped unevenly.
pub(crate) const OFF_AN_EVEN_MOTION: f64 = 0.17;

/// Usual intervals of readings within which angles that are held change.
///
/// Chosen: clocks of loggers, and rows that were picked for a coarse look, vary by less than an interval. Doubled: an
/// axis that moves from place to place within three readings is taken for one that goes evenly.
pub(crate) const HELD_FOR: f64 = 2.0;

/// Evidence by which a set of effects of known size must beat the best single one.
///
/// Chosen: odds of 150 to 1. Doubled: a warm day's weather must be the larger for all of it to be
/// seen at once, and is else found one by one.
pub(crate) const SET_MARGIN: f64 = 10.0;

/// What an effect of the machine file at another value must bring beyond one that is new.
///
/// Chosen: it is twice as likely, -2·ln 2; of two that are one column the file's own is said. Doubled: four times.
pub(crate) const OF_THE_FILE_PRICE: f64 = -1.4;

/// What a high harmonic without the lower ones must bring beyond a named shaft.
///
/// Chosen: odds of one to a hundred, 2·ln 100. Doubled: one to ten thousand.
pub(crate) const HIGH_HARMONIC_PRICE: f64 = 9.2;

/// What a shape of a turn that is no sine must bring beyond the sines of the catalogue.
///
/// Chosen: odds of one to a hundred, 2·ln 100, for a part that turns out of its centre makes a
/// sine. Without it, a sine of 20 standard errors was called a triangle. Doubled: one to ten
/// thousand, and faint square waves are two sines.
pub(crate) const NO_SINE_PRICE: f64 = 9.2;

/// Square of what an effect shows beside its mean at one target and that at all others, against their
/// difference's, below which it shows at one alone.
///
/// Derived: a bell half as wide as targets lie apart shows a tenth at both neighbours. Doubled: one
/// of 0.54 of that is no shape either.
pub(crate) const OTHER_TARGETS: f64 = 0.02;

/// Share of a pattern's square that a straight line must leave for it to have a shape.
///
/// Chosen: a thirtieth of its size. Doubled: a curve of a twenty-second part of its slope is no
/// more than a slope, and named alone no more.
pub(crate) const SHAPE: f64 = 1e-3;

/// Share of a wave's square that a parabola must leave for it to be seen as a wave.
///
/// Chosen: a tenth of its size. Doubled: a wave needs to show more of itself, a seventh.
pub(crate) const WAVE: f64 = 0.01;

/// Share of a curve's square that another leaves where both are one.
///
/// Chosen: a thousandth of its size, as rounded places leave. Doubled: a seven-hundredth.
pub(crate) const SAME_CURVE: f64 = 1e-6;

/// Waves that a frequency in time must show in what one clock has logged.
///
/// Chosen: what turns less is a drift. Doubled: shaking of less than six waves is not named.
pub(crate) const WAVES_IN_TIME: f64 = 3.0;

/// Samples a place, on average, from which on a record is a table of targets.
///
/// Chosen: ISO 230-2 asks for ten. Doubled: three runs there and back are none.
pub(crate) const VISITS: usize = 4;

/// The same of few places.
///
/// Chosen: of three visits the middle one tells which is wrong. Doubled: five runs one way are none.
pub(crate) const VISITS_OF_FEW: usize = 3;

/// Places that are few.
///
/// Chosen: a rotary table every five degrees has 72. Doubled: three passes that were read at even places of a
/// moving axis are a table.
pub(crate) const FEW_TARGETS: usize = 100;

/// Logarithm by which the speed by the clock may be off that which is told where an axis stops nowhere.
///
/// Chosen: a spindle's slip. Doubled: one that stands for a tenth of its time is said to pass.
pub(crate) const PASSING: f64 = 0.05;

/// Most effects of one name: lines come in numbers, and so do slips.
///
/// Chosen. Doubled: a shape of no catalogue may be made up of six slips.
pub(crate) const MOST_OF_A_NAME: usize = 3;

/// The same of whole waves of a turn, and of listed gears.
///
/// Measured: a resolver's record carries eight, the smallest 0.12 of 20 µm, on 110 records of a world made
/// apart from the program none is named more for it. Doubled: nothing that was met moves.
pub(crate) const MOST_WHOLE_WAVES: usize = 8;

/// Share of a column that the rows left must vary by for whole passes to be held out.
///
/// Chosen: its coefficient is then good to three times its own error. Doubled: more files are held
/// out by fifths of a pass.
pub(crate) const TOLD: f64 = 0.1;

/// Parts a pass is cut into when whole passes cannot be held out.
///
/// Source: fivefold cross-validation (Hastie, Tibshirani and Friedman, *The Elements of
/// Statistical Learning*, 2nd ed., 7.10). Doubled: the parts are shorter, and slow noise bridges
/// them.
pub(crate) const PARTS: usize = 5;

/// Slopes that physics leaves lie within this either way, µm/m; it sets what an exact match is
/// worth.
///
/// Chosen. Doubled: an exact match gains 1.4, and slopes up to the double are searched under slow
/// noise.
pub(crate) const PHYSICAL_UM_PER_M: f64 = 400.0;

/// Relative error of a slope that the air and the wavelength leave in any case.
///
/// Chosen: of a slope of a tenth it is 10 µm/m, which ten kelvin of air leave. Doubled: settings
/// that differ by a five-thousandth of their slope look alike.
pub(crate) const EXACT_SLOPE: f64 = 1e-4;

/// What a ratio that fits must pay of its prior range, in standard errors.
///
/// Derived: the area of a normal law is √2π of its deviation times its height. Doubled: costs 1.4.
pub(crate) const NORMAL_WIDTH: f64 = 2.5;

/// Largest step that a count is looked for, µm; it sets what a whole number must pay.
///
/// Chosen: sixteen fringes. Doubled: a slip costs 1.4 more.
pub(crate) const LARGEST_STEP_UM: f64 = 5.0;

/// How far from whole a count may be fitted whatever its standard error.
///
/// Chosen: the formula's own error. Doubled: nothing that is not within 0.04 of whole.
pub(crate) const WHOLE: f64 = 0.02;

/// Relative error of a constant of physics from which on it is that of a material, which another
/// alloy changes by far more.
///
/// Source: the expansion of steels is tabled to 5 %, the refraction of air known to 2 % over a
/// day's weather. Doubled: no constant is free.
pub(crate) const LOOSELY_KNOWN: f64 = 0.05;

/// Factors on such a constant that another material may have.
///
/// Source: against steel's 11.5 ppm/K, Invar has a tenth and polymers up to ten times as much.
/// Doubled: nothing moves that is a workpiece.
pub(crate) const ANOTHER_MATERIAL: std::ops::RangeInclusive<f64> = 0.05..=10.0;

/// How many times its price an effect must be worth to means of neighbours for all rows not to be asked
/// whether they need it.
///
/// Chosen: some eighty of twice the log likelihood a number. Doubled: `diagnose` of large tables
/// takes longer, and nothing else moves.
pub(crate) const SURE_ON_MEANS: f64 = 10.0;

/// Share of an effect's square outside of something's shape from which on it has a shape of its own.
///
/// Chosen: half. Doubled: nothing has.
pub(crate) const OWN_SHAPE: f64 = 0.5;

/// How many times the frequency of the first a wave in time may have, to be its harmonic.
///
/// Chosen: of a square wave the seventh is a seventh of the first. Doubled: a pump beside a slow swing is asked
/// whether it is one switch, and is none.
pub(crate) const MULTIPLES: f64 = 7.0;

/// How many times its plausible size an effect may have and be a rival.
///
/// Chosen: sizes of causes scatter by decades. Doubled: a slope of 20 µm in a few seconds is a drift of the table.
pub(crate) const LARGEST_RIVAL: f64 = 10.0;

/// Waves over the record by which an order may be off that draws a wave of a listed one.
///
/// Derived: sines that differ by a whole wave over the record have nothing in common. Doubled: a line of its own, which
/// nobody has explained yet, stands in the place of the wave beside it.
pub(crate) const OFF_AN_ORDER: f64 = 1.0;

/// Waves of one name from which on they are the harmonics of one shape.
///
/// Chosen: of two, one is a multiple of the other oftener than not. Doubled: pulses a fifth of their distance wide
/// are three or four divisions.
pub(crate) const FEWEST_TEETH: usize = 3;

/// Multiples below the last that may be missing among them.
///
/// Chosen: one may be too small, as the second of a shape that is as long up as down. Doubled: three of five, as two
/// in five of any three numbers are.
pub(crate) const MISSING_TEETH: usize = 1;

/// Gain in twice the log likelihood below which no effect is named beside what nobody explains.
///
/// Measured: of the names of less than six standard errors beside `unexplained`, in 1027 records of three generators
/// made apart from the program, two in three were false; of those of six to nine a third. Doubled: of nine.
pub(crate) const BESIDE_THE_REST: f64 = 40.0;

/// Least that a number costs which few rows tell of, as what a pass began with.
///
/// Derived: noise gives a free number a gain of 1 on average; with twice that it is no gain (Akaike 1974).
/// Doubled: a log that begins in motion is a lag less often, where its rows are as far apart as the lag is long.
pub(crate) const LEAST_PRICE: f64 = 2.0;
