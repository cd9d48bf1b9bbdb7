//! What is large enough to change a figure.

/// Share of the noise below which structure, or an effect, is left alone: a flaw of the noise model
/// or of a smooth formula makes as much.
///
/// Measured with `benches/world`: at a quarter, waves of 8 to 15 standard errors were refused,
/// down to chances of 1e-68, and some records called clear of them; at a twentieth none is, and no
/// record with nothing hidden is named. Doubled: a wave of a tenth of the noise, 6 standard errors
/// in 7000 rows, is not spoken of.
pub(crate) const SHARE_OF_NOISE: f64 = 0.05;

/// Stretches a pass is cut into to tell what is swift from what is slow.
///
/// Measured: in one piece, a gear under a large drift was not taken. Doubled: only what turns
/// twenty times a pass is swift.
pub(crate) const STRETCHES: usize = 10;

/// Share of the error before any effect below which nothing is looked for: no formula of the
/// catalogue is better than that.
///
/// Measured: a capture without noise was called unexplained for 0.9 nm of 1.06 µm. Doubled: 2 nm of
/// every µm are left alone.
pub(crate) const SHARE_OF_ERROR: f64 = 1e-3;

/// Share of an effect's size that must be its own beside the others of a model.
///
/// Chosen: a slope, a bow or the sag of a bed are true to a few per cent of themselves. Doubled: two that
/// share 99.6 % of their squares are one.
pub(crate) const TRUE_TO: f64 = 0.03;

/// Share of an effect that something left must have, to be what made all of it.
///
/// Chosen: what leaves a hundredth of the squares is what was there, if not to the last. Doubled: an effect that
/// leaves a fifth of itself keeps its name beside a shape that has no need of it.
pub(crate) const SHARE_OF_AN_EFFECT: f64 = 0.1;

/// Samples that a pass must be worth for its noise to be told from a smooth curve.
///
/// Derived: noise alone whose correlation is as long as the pass is worth 1 + ½. Doubled: noise of
/// a quarter of the pass is no noise any more.
pub(crate) const WORTH_A_PASS: f64 = 1.5;

/// Samples that a pass must be worth for its noise to be nothing else.
///
/// Measured: of 490 records with nothing hidden, by three generators made apart from the program, with
/// random walks and 1/f noise among them, none is worth less; of 59 that got an all-clear though they hide
/// a cause of twelve standard errors and more, 24 are worth less than three. Doubled: sixteen of those 490
/// get no all-clear.
pub(crate) const WORTH_AN_ALL_CLEAR: f64 = 3.25;

/// Share of the square of what was to be explained, up to which noise as slow as that is believed beside
/// effects.
///
/// Measured: of seven models under such noise, by two generators made apart from the program, whose
/// effects are there the one that explains least leaves 0.69; of three whose effects are not 0.68, 0.90 and
/// all is left. Not to be doubled; at a half, two of the seven are `unexplained`.
pub(crate) const BESIDE_EFFECTS: f64 = 0.75;

/// How many times as many samples a pass must be worth beside an effect for its noise to be slow only
/// without it.
///
/// Chosen: noise that is slow of itself stays so beside any one curve. Doubled: where a pass is worth ten
/// samples, a cause that makes them hundred is noise.
pub(crate) const SWIFT_WITH_IT: f64 = 8.0;

/// How many times as many, for its noise to be slow without that effect and nothing else.
///
/// Measured: of six plays there and back that hid a drift or a growth of twelve standard errors, by a generator
/// made apart from the program, five had 65 to 240 times as many with it. Doubled: two of the five stay
/// `explained` by the play alone.
pub(crate) const SWIFT_FOR_ALL: f64 = 64.0;

/// Samples that a pass must be worth for nobody to ask whether its noise is smooth.
///
/// Chosen: what two places draw leaves ten. Doubled: instruments that filter are asked as well.
pub(crate) const SLOW_ENOUGH: f64 = 20.0;

/// By how much twice the log likelihood of a smooth part must be ahead of noise that forgets.
///
/// Measured: of 300 records of slow noise, random walks and 1/f noise among them, and of 299 with nothing hidden by
/// two generators made apart from the program, none that had an all-clear is more than 4 ahead (one of 80 drawn
/// since is 5.3); of 49 that had one over places of opposite signs in one pass, 37 are. Doubled: ten are.
pub(crate) const SMOOTHER: f64 = 5.0;

/// Rows that a smooth part must be long.
///
/// Measured: means of up to 16 rows are smooth over no more than 5, filters of three poles of four rows over 9;
/// what two places draw is over 16 and more. Doubled: two of 37 of these are not told.
pub(crate) const ROWS_OF_A_MEAN: f64 = 12.0;

/// Share of what is left from which on a smooth curve under such noise is reported.
///
/// Measured on records of the second generator: over slow columns and thermostats it is 0.65 to
/// 0.85 in seven of seven, and in two of 222 records with nothing hidden. Doubled: none is more
/// than all.
pub(crate) const SMOOTH_SHARE: f64 = 0.65;

/// Variance by which a shape of many columns must exceed what it leaves, for such columns also
/// follow slow noise.
///
/// Chosen: one and a half times in size. Doubled: a shape must be twice the noise.
pub(crate) const FAR_ABOVE: f64 = 2.25;

/// Swings of a loop that a jump must exceed to be none of them, with the noise of two samples.
///
/// Derived: a swing there and back is two, and a third for the noise. Doubled: jumps up to six
/// swings pass for hunting.
pub(crate) const LOOP_JUMP: f64 = 3.0;

/// Largest swing that neighbouring samples may hide, against their median difference.
///
/// Derived: a filter at a third of the comparisons leaves a third of a swing, and half of all
/// samples differ by less than half of that. Doubled: where neighbours differ little, effects up
/// to twice as large are left to the hunting.
pub(crate) const SWINGS: f64 = 6.0;

/// Share of what structure shows that is set against a loop's swing: it may be any of its lines.
///
/// Derived: a swing of ±u is a sawtooth, u/√3 in all and u/√12 of it slow. Doubled: a line that
/// is hunting is reported.
pub(crate) const SLOW_SHARE_OF_HUNTING: f64 = 0.5;

/// Finest that a sensor is taken to be, µm: a meter's clock is no finer, and a simulated record
/// without noise would weigh so much that nothing else could be calculated.
///
/// Derived: 1.5 mm/s at 12 MHz are 0.125 nm a clock. Doubled: figures of simulated records without
/// noise move, no measured one.
pub(crate) const FINEST_SENSOR_UM: f64 = 1e-4;

/// Separation below which an experiment is not proposed, µm (arcsec).
///
/// Chosen: a fifth of the noise of a good record. Doubled: experiments worth 10 to 20 nm are not
/// proposed.
pub(crate) const WORTHWHILE_UM: f64 = 0.01;

/// Relative difference of speeds that is another speed already.
///
/// Chosen, far below any step of a gearbox. Doubled: nothing moves.
pub(crate) const ANOTHER_SPEED: f64 = 1e-3;

/// Share of the usual speed by which samples of a record must be off it, for the speed to be that of every
/// sample and not of the pass.
///
/// Chosen: steps of travel and time that are rounded to a tenth are 0.1 off, a stroke of a sine 0.35.
/// Doubled: of such strokes only the speed of the pass is looked at.
pub(crate) const ONE_SPEED: f64 = 0.2;

/// Share of the samples that must be.
///
/// Chosen: an axis that goes and stands by turns, 12 % of its samples off its speed, tells a reading
/// that is late. Doubled: that one is not asked.
pub(crate) const SAMPLES_OFF: f64 = 0.1;

/// Share of a record that a pause must have to count as a dwell.
///
/// Chosen: a drift with the record's own time constant goes on by four tenths of its rest in it.
/// Doubled: a pause must be as long as the record.
pub(crate) const DWELL: f64 = 0.5;

/// Longest pass over the shortest from which on passes of other lengths were measured.
///
/// Chosen. Doubled: half of the travel is advised though two thirds were measured.
pub(crate) const ANOTHER_LENGTH: f64 = 1.5;

/// Spread of the distances of samples, against their mean, below which they are even.
///
/// Chosen: what is uneven resolves aliases. Doubled: unevenness of a twenty-fifth is none.
pub(crate) const EVEN: f64 = 0.02;

/// Evidence that an experiment must bring, against measuring the same once more.
///
/// Chosen: what is less is not worth another set-up. Doubled: half the travel is never advised.
pub(crate) const MORE_THAN_A_REPEAT: f64 = 1.1;

/// Share of what a formula takes by least squares that it must take with the sizes it is told with.
///
/// Derived: sizes of 0.3 to 1.7 of those that leave least take half. Doubled: none but those are told.
pub(crate) const LEAST_TAKEN: f64 = 0.5;
