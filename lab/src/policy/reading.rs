//! How a file is read: what is too little, what is an outlier, where a pass begins.

/// Fewest samples that say anything about noise.
///
/// Chosen: white noise is then known to 18 %. Doubled: files of 16 to 31 samples are refused.
pub(crate) const FEWEST_SAMPLES: usize = 16;

/// Fewest pulses of a train that say anything.
///
/// Chosen. Doubled: captures of four to seven pulses are refused here, and not as too few samples.
pub(crate) const FEWEST_PULSES: usize = 4;

/// Places that count as one, against the travel.
///
/// Chosen: a file's digits round to less. Doubled: nothing moves.
pub(crate) const ONE_PLACE: f64 = 1e-6;

/// Fringes a line, over what the dividers say, beyond which the trains are not those of this
/// machine: a wrong line count is a few per cent, exchanged signals and most wrong leads are more.
///
/// Chosen: 5 mm for 6 mm are 1.2 and pass. Doubled: so does a lead of twice or half.
pub(crate) const MOST_OFF: f64 = 1.25;

/// Robust deviations from its neighbours' median beyond which a sample is an outlier.
///
/// Source: Hampel's identifier (Davies and Gather 1993, *The identification of multiple outliers*,
/// JASA 88:782), three deviations. Doubled: knocks of less than six weigh fully.
pub(crate) const OUTLIER_DEVIATIONS: f64 = 3.0;

/// One sample in so many may be a bad reading, which says nothing of how far noise takes one.
///
/// Chosen: a fifth of a log may be bad readings. Doubled: a tenth.
pub(crate) const BEYOND_ARE_OUTLIERS: usize = 5;

/// Deviations beyond which one sample in [`BEYOND_ARE_OUTLIERS`] lies by a normal law.
///
/// Derived: its upper tenth begins there. Doubled: the half alone tells, for any noise.
pub(crate) const BEYOND_DEVIATIONS: f64 = 1.2816;

/// How many times the deviation that half of the samples tell four fifths must tell to be believed.
///
/// Derived: by Cauchy's law, heavier than any noise that was met, it is 1.6 times. Doubled: a wave that
/// four in ten samples turn slowly on is told as bad readings.
pub(crate) const NO_LAW: f64 = 2.0;

/// How many times as loud as others a pass is that a reader is told of.
///
/// Chosen: its rows weigh a quarter. Doubled: those of a sixteenth are told.
pub(crate) const LOUD_ENOUGH_TO_SAY: f64 = 2.0;

/// How many times as loud as others a pass is that is no noise.
///
/// Measured: of some 200 records with nothing hidden but a louder pass, by generators made apart from the program, the
/// loudest is 7.7 times as loud; passes of another machine, or with rows out of order, 8 to 23 times. Doubled: a third
/// of these is told.
pub(crate) const FAR_LOUDER: f64 = 10.0;

/// Share of the rows of a pass that lie far from the rest, beyond which they are no wild readings.
///
/// Measured: a pass half of which is told backwards has 37 % of such rows; of passes of 62 readings, a tenth of which are
/// three times as loud, the worst has 23 %. Doubled: such a pass is wild readings.
pub(crate) const MOST_FAR: f64 = 0.3;

/// How much longer or shorter than the usual one a standard deviation told by the file may be.
///
/// Chosen: a row that weighs 4096 times another already decides alone. Doubled: 16 384 times.
pub(crate) const MOST_TOLD: f64 = 64.0;

/// Error of the logarithm of the deviation that the median size of bends between neighbours tells, times the root of
/// the rows.
///
/// Measured: drawn normal rows, 24 to 600, have 1.40 to 1.43. Doubled: a pass of a hundred rows must be three times as
/// loud.
pub(crate) const ERROR_OF_NEIGHBOURS: f64 = 1.42;

/// The same of rows that share no neighbours.
///
/// Derived: the median of sizes has 37 % of the efficiency of a mean square (Rousseeuw and Croux 1993). Doubled: as above.
pub(crate) const ERROR_OF_LOUDNESS: f64 = 1.17;

/// Rows of a pass from which on it may be louder than others.
///
/// Chosen: of fewer half a dozen bends are the median. Doubled: a pass of sixteen rows five times as loud has a step or
/// a slip of the laser.
pub(crate) const FEWEST_OF_A_LOUD_PASS: usize = 12;

/// Twice the log likelihood by which no pass that is taken to be louder, or quieter, may prefer a noise of its own.
///
/// Derived: χ² with three degrees, the size of either part and a memory, exceeds it once in forty thousand. Doubled: in a
/// sound example with passes of other colours a slow one is taken to be quiet, and what is slow in it to be a cause.
pub(crate) const SURELY_ANOTHER_COLOUR: f64 = 24.0;

/// Such errors from which on a pass is asked whether it is louder than others, or quieter.
///
/// Chosen: chance asks one pass in eighty, and the likelihood decides. Doubled: a pass of sixteen rows must be eight
/// times as loud.
pub(crate) const PERHAPS_LOUDER: f64 = 2.5;

/// Twice the log likelihood that each pass that is louder than others, or quieter, must gain.
///
/// Derived: four standard errors of one figure, squared: chance has it in one of sixteen thousand passes. Doubled: a pass
/// of forty rows must be twice as loud.
pub(crate) const PRICE_OF_LOUDNESS: f64 = 16.0;

/// Least loudness of a place against that of its pass.
///
/// Chosen: a sensor that holds its reading has none, and any change beside it would stand out.
/// Doubled: stretches half as loud as the rest hide what stands out of them.
pub(crate) const LEAST_LOUD: f64 = 0.25;

/// Change that a quarter of the rows of a pass do not reach, against the one that a tenth exceeds, below
/// which they are no readings of their own.
///
/// Derived: a normal law has 0.19, one of three degrees of freedom 0.12. Doubled: no noise is any.
pub(crate) const HARDLY_CHANGES: f64 = 0.1;

/// The same against the deviation of rounding, beyond which rows are readings all the same.
///
/// Derived: rows on a line that are rounded, with as much noise again, change their change by 1.4. Doubled:
/// levels that switch under noise of less than two and a half digits are told by their steps alone.
pub(crate) const MOST_OF_ROUNDING: f64 = 2.0;

/// Neighbours on each side that a sample is judged by.
///
/// Chosen: seven samples hold a step on one side. Doubled: a wave of thirteen samples is all
/// outliers.
pub(crate) const OUTLIER_NEIGHBOURS: usize = 3;

/// Share of the travel that a jump back to the start of a pass must exceed.
///
/// Chosen: a fifth of the travel is no gap in a record. Doubled: passes over less than two fifths
/// of the travel run together.
pub(crate) const JUMP_OF_TRAVEL: f64 = 0.2;

/// How many times as far the way through the rows of a pass is as their clock has them, where it began anew among
/// them, than as they stand in the file.
///
/// Chosen: rows that tremble or stand in another order have the shorter way as the clock has them. Doubled: a clock
/// that began anew shortly before the end is not told.
pub(crate) const WAY_OF_A_RESTART: f64 = 2.0;

/// Share of the most that an effect of one place shows, from which on a row is within its reach.
///
/// Derived: four standard deviations of a bell. Doubled: three and a half.
pub(crate) const WITHIN_REACH: f64 = 3e-4;

/// Usual moves from row to row that such a jump must exceed as well.
///
/// Chosen. Doubled: in a table of less than 500 rows no pass is told.
pub(crate) const JUMP_OF_MOVES: f64 = 50.0;

/// Rows a jump, at least, in a table that is in order; one with more is shuffled.
///
/// Chosen: no pass is so short. Doubled: passes of less than forty rows run together.
pub(crate) const ROWS_A_PASS: usize = 20;

/// Rows a reversal, at least, in a table that is in order.
///
/// Chosen. Doubled: a record that reverses every twelve rows is sorted by its travel.
pub(crate) const ROWS_A_REVERSAL: usize = 8;

/// Most passes of a single sample for each that has more: a zero of its own takes all that such a
/// pass says.
///
/// Chosen: with more, `pass` is a counter of rows. Doubled: a file is read of whose passes two in
/// three say nothing.
pub(crate) const LONE_PASSES: usize = 1;

/// Samples on each side over whose way the direction is told, so that a jitter is no reversal.
///
/// Chosen. Doubled: reversals are told later, and moved back to the farthest sample all the same.
pub(crate) const DIRECTION_REACH: usize = 2;

/// Part of the steps that make most of the way up to which an axis rests, at half of the rows or more.
///
/// Chosen: encoders tremble by less than that of a step between targets. Doubled: an axis that goes slowly for most of
/// the time stands there.
pub(crate) const AT_REST: f64 = 0.05;

/// Part of the time that a move from place to place usually takes in which an axis may have gone beyond a turn and come
/// back.
///
/// Chosen: to go beyond the last target and back is a short move. Doubled: only what takes as long as two moves is one,
/// and readings from both sides of the last target are told to have come from one.
pub(crate) const AS_LONG_AS_A_MOVE: f64 = 0.5;

/// Part of the sum of its steps that an axis has gone at most where it stands and trembles.
///
/// Derived: over five rows that tremble alone a quarter is to be expected, and all where an axis creeps. Doubled: it
/// stands wherever it creeps.
pub(crate) const TREMBLES: f64 = 0.5;

/// Deviations by which a standing axis trembles up to which a row belongs to the stand.
///
/// Derived: of normal trembling one row in 16 000 is farther. Doubled: the first row of a slow start is one of the stand.
pub(crate) const BEYOND_TREMBLING: f64 = 4.0;

/// What a position may jitter by from row to row: so much of a turn of the spindle, and of the travel of a pass.
///
/// Chosen: 25 µm of a screw of 5 mm, and a row of a thousand. Doubled: a step of a pilgrim's walk over 500 targets is
/// a jitter.
pub(crate) const JITTER_REV: f64 = 0.005;
pub(crate) const JITTER_OF_TRAVEL: f64 = 0.001;

/// Strokes of no more than [`DIRECTION_REACH`] rows from which on an axis makes such strokes.
///
/// Chosen: a reading far off its place is one or two. Doubled: an axis that turns round in six of its targets has gone
/// one way.
pub(crate) const SHORT_STROKES: usize = 3;

/// Rows a reading, on average, from which on a clock is coarse.
///
/// Chosen: of two rows at one instant one may be the other sensor's. Doubled: noise that goes on over three rows is
/// none within a tick and leaps at its end.
pub(crate) const ROWS_A_TICK: usize = 3;

/// Ticks from a reading of a coarse clock to the next from which on the log has paused between them.
///
/// Derived: half way from one tick to two. Doubled: rows before a second that nobody logged lie evenly through it.
pub(crate) const TICK_MISSED: f64 = 1.5;

/// Samples on each side in which a reversal, or a slip at one, lies.
///
/// Derived: one more than [`DIRECTION_REACH`]. Doubled: slips six samples from a reversal rival
/// backlash.
pub(crate) const REVERSAL_REACH: usize = 3;

/// Rows at a turn that are as near to each other as a standing axis trembles, where it stood.
///
/// Derived: a turn half way between two rows leaves these two at one place, and the third a sixth of the way of a row
/// off or more. Doubled: an axis that rests for two rows turns before it rests.
pub(crate) const ROWS_OF_A_STAND: usize = 3;

/// Part of the slowest speed around that an interval is passed by in which an axis turns.
///
/// Chosen: rounded places and times move a speed by a thousandth. Nearer to 1: an axis of even speed that turns at its
/// rows turns beside them. Half of it: one that turns within a quarter of a step of a row turns there.
pub(crate) const SLOWED_BY: f64 = 0.98;

/// Turns of which one at a row makes all to be at rows.
///
/// Derived: where an axis of uneven speed turns at its rows, half of them are next to no slowest interval; where it
/// turns anywhere, hardly any. Doubled: one odd stroke in six moves all turns.
pub(crate) const TURNS_AT_ROWS: usize = 3;

/// Samples on each side of a reversal that stay single where others are averaged: there play and
/// wind-up change quickly.
///
/// Chosen. Doubled: twice as many rows at every reversal.
pub(crate) const AROUND_REVERSALS: usize = 8;

/// Distance from the usual interval, as a share of it, within which one is taken for it: times are
/// written with so many digits, and no noise knows the difference.
///
/// Derived: a time of three digits an interval. Doubled: nothing moves but the time it takes.
pub(crate) const WRITTEN_INTERVAL: f64 = 1e-3;

/// Part of its length after zero from which on it is said that a record begins late.
///
/// Chosen: less is not seen in a picture. Doubled: a moment is told by a fiftieth of the record
/// earlier than the file has it, and nothing is said.
pub(crate) const LATE: f64 = 0.01;

/// Part of the travel that a clock tells from which on a length of no known name is where the axis was.
///
/// Chosen: gaps, levels and wear are smaller. Doubled: an axis that rested for most of the record goes by the clock.
pub(crate) const AS_FAR: f64 = 0.1;

/// Seconds from which on a first time is a clock's, and the record begins at zero.
///
/// Derived: a day. Doubled: clocks of the second day count from midnight before.
pub(crate) const CLOCK_S: f64 = 86_400.0;

/// Fewest values on a lattice that were rounded to it: fewer may be settings.
///
/// Chosen. Doubled: logs with less than ten steps keep their treads.
pub(crate) const FEWEST_VALUES: usize = 5;

/// Part of a lattice's step that a value may be off.
///
/// Chosen: a decimal written with one digit more. Doubled: a twenty-fifth.
pub(crate) const OFF_THE_LATTICE: f64 = 0.02;

/// Changes of a rounded log, at least, a leap over a value of the lattice.
///
/// Chosen: what leaps more often was not sampled as it went. Doubled: a log with more than one leap
/// in four changes keeps its treads.
pub(crate) const CHANGES_A_LEAP: usize = 2;

/// Share of an error that rounding leaves of it where it is worked out of the position that was measured.
///
/// Derived: steps of a tenth of its size leave a thirty-fifth. Doubled: so do steps of a fifth.
pub(crate) const SHARE_OF_ROUNDING: f64 = 0.03;

/// Share of the travel that two gauges of one axis may differ by.
///
/// Chosen: an axis that is off by more of its way is not measured but repaired. Doubled: a column in millimetres
/// that grows with the position by a fiftieth more or less is the position.
pub(crate) const SHARE_OF_TRAVEL: f64 = 0.01;

/// Chance, of a log that changes at any time, to change at the ticks of some clock as often as one
/// that is taken to follow it.
///
/// Chosen: one log in 2000. Doubled: of logs with four or five changes a few more lose their holds.
pub(crate) const BY_ACCIDENT: f64 = 5e-4;

/// Rows a reading, at least, for its hold to matter.
///
/// Chosen. Doubled: holds of three to five rows stay.
pub(crate) const ROWS_A_READING: usize = 3;

/// Share of those changes that lie at the ticks of the clock that a log follows.
///
/// Chosen: jitter of the instrument's clock moves some. Doubled: none is more than all.
pub(crate) const AT_A_TICK: f64 = 0.8;

/// Throughout in this range, a temperature of a shop is in kelvin; one in °C never is.
///
/// Source: −73 to 127 °C.
pub(crate) const KELVIN: std::ops::RangeInclusive<f64> = 200.0..=400.0;

/// Deviations from its neighbours beyond which a sample predicts no others and, alone, is wild.
///
/// Measured on 684 records with nothing hidden: at three skewed noise and chatter are predicted by
/// what was cut off (1e-5 and 1e-6), at six none is. Doubled: one bad reading in a hundred decides.
pub(crate) const FAR_OUT: f64 = 6.0;

/// Share of samples so far out in noise of the longest tails.
///
/// Derived: of Student's law with two degrees of freedom, whose variance is infinite, one in 54. Doubled: bad
/// readings of six in a hundred are believed.
pub(crate) const FAR_IN_TAILS: f64 = 1.0 / 54.0;

/// Shares of readings that lost their sign which are tried.
///
/// Chosen: between the likelihoods of neighbours lies less than one. Doubled: one lost sign in 200 readings is
/// less likely by two.
pub(crate) const SIGNS_LOST: [f64; 4] = [0.01, 0.03, 0.1, 0.25];

/// Deviations between a reading that is as others are and one that lost its sign.
///
/// Chosen: of 200 readings one is farther out by chance; without any that is off by more and with its sign turned by
/// less nothing is asked. Doubled: a few signs of readings of six deviations stay lost.
pub(crate) const BEYOND_NOISE: f64 = 3.0;

/// Deviations of its pass beyond which a sample predicts no more.
///
/// Chosen: of 1000 normal ones none lies there. Doubled: a cube follows the largest few alone.
pub(crate) const MOST_DEVIATIONS: f64 = 4.0;

/// Loudness of a place against that of its pass up to which it is noise that is louder there.
///
/// Measured on 88 records with nothing hidden that have outliers, stretches of chatter and loud passes among
/// them: none is told at 2, 3 or 5; of five bursts of 12 to 50 deviations three are told at 2, two at 3, one
/// at 5. Doubled: so it is of a burst of fifteen.
pub(crate) const MOST_LOUD: f64 = 2.0;

/// Loudness of a place against that of its pass from which on its rows weigh less.
///
/// Measured on 300 records each: weighed by any loudness, that of even noise varies by chance, and 18 of
/// skewed noise fall below 0.01; by none, 167 with a stretch four times as loud do. Doubled: so do many of
/// these.
pub(crate) const CLEARLY_LOUDER: f64 = 1.5;

/// Share of an error that a column may leave of it by a straight line, where it is that error in another unit.
///
/// Chosen: sensors that tell a cause apart to a ten-thousandth of it are rare, digits that are carried over are
/// not. Doubled: two thermometers of five digits beside a fault of exactly one of them are that fault.
pub(crate) const SAME_READING: f64 = 1e-4;

/// The same where it is no more than the rounding of both.
///
/// Derived: digits of a fiftieth of its size leave twice a 173rd. Doubled: a sensor that shows a cause in steps of
/// a twenty-fifth, and nothing else, is the cause's reading.
pub(crate) const FINE_ROUNDING: f64 = 0.012;
