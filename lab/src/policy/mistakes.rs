//! When the input is doubted: laws of what workshops are like, and the margin of a doubt.
//!
//! A law says how likely a reading is before the model is asked; what is meant to be wide is
//! wide, for a sound oddity must never be doubted by a law alone.

/// Evidence by which a mistake must beat every other explanation.
///
/// Chosen: odds of 270 000 to 1, so that sound data are doubted less than once in five hundred.
/// Doubled: swapped columns and shifts that move a prediction by few times its noise are not seen.
pub(crate) const DOUBT: f64 = 25.0;

/// Evidence under the noise of the file as it is from which on a mistake is worth its own fit.
///
/// Chosen: a fifth of [`DOUBT`], for the noise that takes a mistake's traces is too large. Doubled:
/// mistakes in slow noise may be passed over.
pub(crate) const WORTH_A_FIT: f64 = 5.0;

/// Share of the best of these gains from which on a mistake is fitted as well.
///
/// Chosen: a factor of a thousand and one of a million differ by less. Doubled: nothing else is
/// fitted than the best.
pub(crate) const NEAR_THE_BEST_DOUBT: f64 = 0.5;

/// Share of the square that a mend may leave of what is left without it.
///
/// Chosen: a mistake that moves the prediction by half the noise is not seen. Doubled: no mistake
/// would have to make the error smaller.
pub(crate) const SMALLER: f64 = 0.9;

/// Usual reading of a column with its deviation.
///
/// Chosen: three deviations hold cellars and foundries, and a pressure at an altitude of 2 km.
/// Doubled: °F alone are no longer doubted.
pub(crate) const USUAL: &[(&str, f64, f64)] = &[
    ("air_temperature_c", 20.0, 8.0),
    ("workpiece_temperature_c", 24.0, 12.0),
    ("bed_temperature_c", 24.0, 12.0),
    ("air_pressure_hpa", 1000.0, 80.0),
    ("humidity_pct", 50.0, 25.0),
];

/// How far weather and a low hill take an air pressure from the reference of the machine file.
///
/// Chosen: 500 m of height, or the deepest low. Doubled: mmHg are told from hPa up to 1000 m.
pub(crate) const WEATHER_HPA: f64 = 60.0;

/// Share of workshops so high up, above 1900 m, that their pressure in hPa is as much in mmHg lower down.
///
/// Chosen. Doubled: such a pressure gains 1.4 more; alone it is not enough for a doubt.
pub(crate) const HIGH_UP: f64 = 1e-3;

/// Usual size of an error, and its deviation: decimal logarithms of µm (arcsec).
///
/// Chosen: a sound machine errs by 0.1 to 100. Doubled: no size is doubted by itself.
pub(crate) const USUAL_SIZE: (f64, f64) = (0.5, 1.0);

/// Relative deviation of two speeds that are said to be equal.
///
/// Chosen: a spindle's slip and a clock's digits. Doubled: an exact match gains 1.4 less.
pub(crate) const SAME_SPEED: f64 = 5e-3;

/// Logarithmic deviation of the travel of a record from the length of the workpiece.
///
/// Chosen: by a factor of 1.6 either way. Doubled: an expected travel gains 1.4 less.
pub(crate) const SAME_TRAVEL: f64 = 0.5;

/// Share of records in which speeds, or travel and length, differ for a sound reason.
///
/// Chosen. Doubled: such a match gains 1.4 less.
pub(crate) const OTHERWISE: f64 = 0.1;

/// Logarithmic deviation of those.
///
/// Chosen: by a factor of 4.5 either way, so that a thousand is 4.6 deviations off. Doubled: a
/// unit is doubted only where two quantities speak against it.
pub(crate) const OTHERWISE_DEVIATION: f64 = 1.5;

/// How often an error has another sensor's name, against how often it has the wrong sign: of what the table
/// alone does, the thread's error is the recorder's with the other sign.
///
/// Chosen. Doubled: where nothing tells them apart, the sign still leads by 3.
pub(crate) const RARER_THAN_A_SIGN: f64 = 0.1;

/// Fewest effects in a file, but for those of logs that hold their readings, whose absence says that the measurement is another machine's.
///
/// Derived: one effect can have been repaired. Doubled: files of two and three are not doubted.
pub(crate) const MACHINE_OF_EFFECTS: usize = 2;

/// How many times the file's, or its part, another lead of its screw may be.
///
/// Chosen: one farther off is seen by whoever types it. Doubled: half as many leads again, and their time.
pub(crate) const FARTHEST_LEAD: f64 = 4.0;

/// Cells of the spectrum within which a line is no other.
///
/// Derived: a line is as wide. Doubled: orders a tenth apart are not told in ten turns.
pub(crate) const SAME_LINE: f64 = 0.5;

/// How far a ratio may be off a whole number.
///
/// Chosen: orders are written with five digits. Doubled: the same gears.
pub(crate) const WHOLE: f64 = 1e-4;

/// How far a ratio of leads may be off a step of a unit and be that.
///
/// Chosen: what a spectrum of a dozen turns tells of a ratio. Doubled: a lead 2 % off twice the file's is not told.
pub(crate) const NEAR_A_STEP: f64 = 0.01;

/// Share of a wave of the file by which one that comes more or less often in the data departs from it in size and phase,
/// and is the same.
///
/// Chosen: what a machine file says of a wave is good to a fifth. Doubled: any wave beside one that was mended, and of
/// nearly its size, is the file's.
pub(crate) const SAME_WAVE: f64 = 0.2;

/// Farthest shift of the position's zero that is looked for, in turns of the spindle.
///
/// Chosen. Doubled: twice the time.
pub(crate) const SHIFT_TURNS: u16 = 6;

/// How much longer or shorter all places may be, as a power of a half: 3 %.
///
/// Chosen: what is farther off is seen by whoever types it. Doubled: 0.1 %, and a stretched belt is not told.
pub(crate) const FARTHEST_STRETCH: i32 = 5;

/// Share of a record by which a log may be late or early, and places either way at which that is looked for.
///
/// Chosen: a logger's clock, or readings sent once in a while. Doubled: twice the time; what is later still has
/// hardly anything in common with the record.
pub(crate) const LATEST: f64 = 0.25;
pub(crate) const LATE_PLACES: i32 = 25;

/// Share of its whole change by which one place of a grid of zeros changes a prediction.
///
/// Derived: a wave's twelfth, of which a parabola through three places tells the height to a thousandth.
/// Doubled: an eighth of a wave; the best wave of hundreds alike may be passed over.
pub(crate) const A_PLACE: f64 = 0.13;

/// Square that a pass leaves, over that of any other one, from which on a mistake in it alone is looked for.
///
/// Chosen: noise of forty samples that depend on nothing differs by less. Doubled: a shift by which
/// an effect leaves less than its noise is not seen.
pub(crate) const WORSE_PASS: f64 = 2.0;

/// Share of the travel that no error runs along with.
///
/// Chosen: a hundred times what the compensator takes out, and ten times a wrong tooth in a hundred.
/// Doubled: a position in units that differ by a fifth is taken for an error.
pub(crate) const RUNS_ALONG: f64 = 0.1;

/// Share of an error's square that this must explain.
///
/// Chosen: what is left is a third of the error. Nearer to 1: a position with large errors is no doubt.
pub(crate) const RUNS_ALONG_SHARE: f64 = 0.9;

/// Least slope of an error along all of the travel, as a share of it, that is no machine's.
///
/// Derived: beyond what `screw-progressive` (500 µm/m) and `cosine` (450 µm/m) may be. Doubled: a wrong tooth in a
/// thousand is told, and not one in two thousand.
pub(crate) const ANOTHER_SCALE: f64 = 5e-4;

/// The same of a rotary axis that goes less than a turn, or one way.
///
/// Derived: what turns a millimetre off the centre of a disc of 200 mm is as steep. Doubled: of a wheel one wrong tooth
/// in fifty is told, and not one in a hundred.
pub(crate) const OFF_CENTRE: f64 = 1e-2;

/// Least against greatest slope of an error that is straight.
///
/// Chosen: a sine over a seventh of a turn about its middle has 0.9, an arc that begins level 0. Nearer to 1: a bow of a
/// twentieth beside the slope hides it.
pub(crate) const STRAIGHT: f64 = 0.8;

/// Part of the square of the places that no time, or way, explains, from which on a slope is no drift.
///
/// Derived: speeds whose spread is a tenth leave as much. Doubled: those of a seventh are as one.
pub(crate) const TOLD_FROM_TIME: f64 = 0.01;

/// The same where an axis goes round whole turns both ways, after which its error is what it was.
///
/// Derived: one line in the 36 000 of a fine disc. Doubled: one line in 18 000.
pub(crate) const ONE_LINE_OF_A_TURN: f64 = 1.0 / 36_000.0;

/// How much an error may grow and drift with the time, where all passes go one way, and what a µm of that may be as an
/// angle, arcsec.
///
/// Derived: `headstock-growth` and `phase-drift` may be as large, on a rotary axis by 36 times: a telescope's polar axis
/// that is two degrees off drifts by 1900 arcsec an hour. Doubled: wrong scales of short axes are told later.
pub(crate) const GROWS_UM: f64 = 200.0;
pub(crate) const DRIFTS_UM_PER_H: f64 = 1000.0;
pub(crate) const GROWS_AS_AN_ANGLE: f64 = 36.0;

/// Share of the way that was gone against `direction`, from which on one of the two is turned.
///
/// Chosen: rows at reversals and a jitter while the axis stands are less than the rest. Nearer to 1:
/// records that reverse every few rows are not doubted.
pub(crate) const DENIED: f64 = 0.9;

/// Rows that must say so where one pass alone does.
///
/// Chosen: evidence of 28. Doubled: a pass of 21 targets is not doubted.
pub(crate) const DENIED_ROWS: usize = 20;

/// Logarithm by which the usual speed may be off that which is told, times the factor of a unit.
///
/// Chosen: a spindle's slip and the digits of a clock. Doubled: of speeds that are nominal only one in
/// fifty has such a factor by accident, and not one in a hundred.
pub(crate) const AT_A_UNIT: f64 = 0.01;

/// Share of rows from which on a column goes by the clock as the travel does, and below which the position does not.
///
/// Chosen: an axis that turns back or dwells now and then goes by it in nine rows of ten, and an error, which knows
/// nothing of the speed, in one of ten. Doubled: none does, and a travel that does would be held for an error.
pub(crate) const GOES_BY_THE_CLOCK: f64 = 0.85;
pub(crate) const STANDS_BY_THE_CLOCK: f64 = 0.5;

/// Logarithm by which a row may be off the speed that it was told.
///
/// Chosen: a tenth; places are rounded and clocks read late. Doubled: errors go by the clock in twice as many rows,
/// one of five.
pub(crate) const NEAR_A_SPEED: f64 = 0.1;

/// That by which half of the rows may be off.
///
/// Chosen: times and places are rounded. Doubled: where an axis dwells for a tenth of its time it may be
/// doubted.
pub(crate) const A_ROW_AT_A_UNIT: f64 = 0.05;

/// Fewest rows that are another pass's to the last digit, or copies of their neighbours, and fewest different ones
/// among them.
///
/// Chosen: of five values, ten rows are those of another pass by accident once in ten million. Doubled: short
/// tables may be copied.
pub(crate) const COPIED_ROWS: usize = 10;
pub(crate) const DIFFERENT: usize = 5;

/// Share of the rows that are there as often as any, from which on all of them were copied.
///
/// Chosen: a few are lost where passes were cut. Nearer to 1: these are not told.
pub(crate) const MOST_ROWS_COPIED: f64 = 0.9;

/// Rows that stand at a limit, elsewhere than where passes begin, and in how many runs, of a column with so many values.
///
/// Chosen: a table that every run begins and ends at zero has none, what warms up on a coarse display comes to rest in one
/// run, and noise on a lattice of few values is often at any of them. Doubled: what is cut off at few peaks is not told.
pub(crate) const CUT_OFF_ROWS: usize = 9;
pub(crate) const CUT_OFF_RUNS: usize = 3;
pub(crate) const CUT_OFF_VALUES: usize = 20;

/// How many times as often as the oftenest of so many next values.
///
/// Derived: noise on a lattice is there less often, a sine up to 1/(√2 − 1) = 2.4 times. Doubled: waves that are cut
/// off near their peaks are not told.
pub(crate) const OFTENER_THAN_BEFORE: usize = 3;
pub(crate) const NEXT_VALUES: usize = 3;

/// Rows that readings stand beside their place at most.
///
/// Chosen: a heading, a blank line, an edge that was cut in one column alone. Doubled: twice the looks, 1.4 of
/// evidence for every mistake.
pub(crate) const MOST_ROWS_SLIPPED: isize = 5;

/// Share of rows that repeat the one before in a column of which a run of one reading is no rest: less.
///
/// Chosen: what a display shows in coarse steps, and what follows a stepping axis, repeats oftener. Doubled: air that
/// hardly changes is stuck at its extremes.
pub(crate) const STUCK_REPEATS_ELSEWHERE: f64 = 0.1;

/// Least leap at an end of such a run, in usual steps: of a sensor, and of a log.
///
/// Measured: of 2100 records of four generators and 60 real logs no sound one has a run of [`DOUBT`] that ends in a
/// quarter of a step or more; two have a log that ends one of 8 rows in 35 and 48. Doubled: one in ten of those that
/// are stuck is not told.
pub(crate) const LEAP_OF_A_SENSOR: f64 = 0.25;
pub(crate) const LEAP_OF_A_LOG: f64 = 5.0;

/// Evidence that a log is stuck: what it reads may rest.
///
/// Chosen: four times [`DOUBT`]. Doubled: a log of 300 rows must rest for 35 of them.
pub(crate) const STUCK_LOG: f64 = 100.0;

/// Way from one row to the next, in mean ways, from which on an axis moves and does not tremble.
///
/// Chosen: an encoder at rest trembles by a thousandth. Doubled: the slow half of a ramp rests.
pub(crate) const MOVES: f64 = 0.25;
