//! How far is looked: rounds, rows, places, orders. What is not looked at is not found.

/// Most effects that are looked for one after the other.
///
/// Chosen: a resolver's record carries eight whole waves of a turn. Doubled: twice the time in a record
/// where imitators go on being accepted.
pub(crate) const MOST_ROUNDS: usize = 8;

/// Numbers from which on an effect may bend to what two others draw together.
///
/// Derived: two effects have two sizes. Doubled: none is asked.
pub(crate) const MANY_NUMBERS: usize = 3;

/// Difference of their gains below which two effects draw one curve.
///
/// Chosen: a sixteenth of the margin. Doubled: the same slopes count as one.
pub(crate) const SAME_CURVE: f64 = 0.5;

/// Most formulas that are looked for one after the other.
///
/// Chosen: beyond two, a sum of shapes imitates anything. Doubled: four, at twice the time.
pub(crate) const MOST_FORMULAS: usize = 2;

/// Effects whose noise is fitted anew before one is chosen, in each way that they are looked for.
///
/// Chosen. Doubled: twice the time of a round.
pub(crate) const SHORTLIST: usize = 4;

/// Share of the best gain from which on a candidate is on that list however many there are.
///
/// Chosen. Doubled: no other candidate would be.
pub(crate) const NEAR_THE_BEST: f64 = 0.7;

/// Effects beside each of which a second is looked for.
///
/// Chosen, by time: each is a round. Of twelve pairs ten began with the first or second, one with the fourth.
/// Doubled: no other pair.
pub(crate) const FIRST_OF_PAIRS: usize = 4;

/// Most effects of known size that are tried in sets.
///
/// Chosen, by time: 26 sets. Doubled: 1013.
pub(crate) const KNOWN_IN_SETS: usize = 5;

/// Rows beyond which a search works on means of neighbouring samples.
///
/// Chosen, by time: a search is linear in it. Doubled: twice the time, and swifter effects are
/// averaged in files of 3000 to 6000 rows no more. Reported figures are fitted to all rows.
pub(crate) const SEARCHED_ROWS: usize = 3000;

/// Sizes that are in use or not against the model that was found, in those that say how sure its values are.
///
/// Derived: a slope, a bow and an S are three. Doubled: of a formula with six sizes 64 models are weighed for 42.
pub(crate) const MOST_CHANGED: usize = 3;

/// Orders that are measured against a frequency in time, those first that are the strongest by a scan.
///
/// Chosen: half of those that 300 rows resolve; where targets are visited by turns the right one was the 18th to the 44th
/// of a thousand. Doubled: twice the time of that question.
pub(crate) const MEASURED_ORDERS: usize = 512;

/// The same against a wave of a listed order, which was no choice among many: those of the few highest peaks.
///
/// Chosen: three points a peak, of four. Doubled: chance is given as many places again to be nearly as good.
pub(crate) const MEASURED_FOR_A_LISTED_ONE: usize = 12;

/// How many times fewer they are where a search has left structure and is made once more, and the fewest.
///
/// Chosen: a ripple of a hundred waves a turn is noise to a row in 375, and a wave of few turns still has all
/// of its shape; ten rows to each of six numbers. Doubled: a wave of twenty turns is passed over.
pub(crate) const COARSER: usize = 8;
pub(crate) const FEWEST_COARSE: usize = 60;

/// Rows beyond which a comparison looks for structure in means of neighbouring samples.
///
/// Chosen, by time: 8 s for 5.5 million rows. Doubled: twice that.
pub(crate) const COMPARED_ROWS: usize = 30_000;

/// Rows beyond which the likelihood of a moment is summed up over means of neighbouring samples.
///
/// Chosen, by time: some 400 fits a moment, and steps that are told to fewer rows than a mean has are told to one mean.
/// Doubled: twice the time, and half of that.
pub(crate) const STEPPED_ROWS: usize = 10_000;

/// Rows of a sensor, from the start of each of its passes, in which fast lines are looked for.
///
/// Derived: a line of a fiftieth of the noise gains n/50² = 80 there, which is clear. Doubled: so
/// is one of a seventieth.
pub(crate) const FAST_LINE_ROWS: usize = 200_000;

/// Rows kept, against those wanted, when samples must be picked instead of averaged.
///
/// Chosen: a picked sample has the noise of one. Doubled: twice the time.
pub(crate) const PICKED: usize = 2;

/// Samples a period of the fastest line that means must leave.
///
/// Derived: the mean over a sixth of a period takes 4.5 % off its amplitude. Doubled: 1.1 %, and
/// more files are picked.
pub(crate) const SAMPLES_A_PERIOD: f64 = 6.0;

/// Samples over which whatever is slower than a fast line is forgotten.
///
/// Chosen: about [`SAMPLES_A_PERIOD`]. Doubled: slower lines count as fast.
pub(crate) const FAST_SAMPLES: f64 = 5.0;

/// Most fast lines that are looked for beside those of the gears.
///
/// Chosen: the fastest decides alone. Doubled: a fourth, weaker and faster one may forbid means.
pub(crate) const FAST_LINES: usize = 3;

/// Samples, with those in between, up to which a search on means works out its columns for all; and those of a
/// record where nothing of the machine file remembers.
///
/// Chosen, by time and memory. Doubled: files up to 130 000 samples filter their columns at every
/// comparison.
pub(crate) const MOST_BETWEEN: usize = 1 << 16;

/// Samples, with those in between, of a record where something of the machine file remembers.
///
/// Chosen, by time and memory: twenty rows a wave of a hundred thousand rows. Doubled: 50 MB more.
pub(crate) const MOST_REMEMBERED: usize = 1 << 18;

/// Most passes of which it is open what a recorder that lags began with.
///
/// Chosen, by time: each is a column at every place that a lag is tried at. Doubled: four times as long.
pub(crate) const MOST_STARTS: usize = 24;

/// Samples a turn of the spindle, with those in between, of a recorder without comparisons.
///
/// Derived: straight lines between them delay what a short lag shows of a wave of two turns by
/// 180°/256, which takes 1.2 % off it: at fifty times the noise, a square of 0.4. Doubled: 0.1, at
/// twice the time.
pub(crate) const BETWEEN_A_TURN: f64 = 128.0;

/// Most comparisons between two samples that are worked out for themselves.
///
/// Chosen, by time: what lies further back is forgotten, or too slow to ask for more. Doubled: steps of the error
/// are where they are to a thirty-second of the interval.
pub(crate) const MOST_COMPARISONS: f64 = 16.0;

/// Samples a wave of the machine file, with those in between, for what a lag makes of it.
///
/// Derived: straight lines between n samples take (2π/n)²/12 off it, 0.3 %: at fifty times the
/// noise, a square of 0.03 a row. Doubled: 0.002, at twice the time.
pub(crate) const BETWEEN_A_WAVE: f64 = 32.0;

/// Share of a turn that a record must have for what comes with every turn to be named.
///
/// Chosen: that the circle closes is taken on trust for a tenth of it. Doubled: a table that was measured over
/// one turn has no eccentricity.
pub(crate) const MOST_OF_A_TURN: f64 = 0.9;

/// Waves over the record of the slowest line that is one.
///
/// Derived: one wave and a half has two turning points inside, a parabola one. Doubled: lines of
/// less than three waves are left to the smooth curves.
pub(crate) const SLOWEST_WAVES: f64 = 1.5;

/// Waves along the travel that rows must draw of a gear that is quicker than they come.
///
/// Chosen: a drawn wave of no cause of its own is as near to any curve of one or two bends. Doubled: a mesh whose alias
/// has five waves along the travel has no name.
pub(crate) const FEWEST_DRAWN: f64 = 3.0;

/// Waves over the record of the longest that a formula has, of one length or of a changing one.
///
/// Chosen: of a part of a wave a cube is as good a formula. Doubled: the one wave of a gear's turn is a wave of
/// neither.
pub(crate) const LONGEST_WAVE: f64 = 1.0;

/// Highest frequency looked at, against the usual rate of sampling.
///
/// Chosen. Doubled: twice the looks, for which every line pays 1.4.
pub(crate) const HIGHEST_AGAINST_RATE: f64 = 4.0;

/// Spectral window beyond which two frequencies look alike.
///
/// Chosen: half the power. Doubled: there would be no such limit.
pub(crate) const ALIKE_WINDOW: f64 = 0.7;

/// Spectral window beyond which no size of a wave tells it from another.
///
/// Derived: the other keeps nine tenths of its evidence then, so that ten standard errors are ten ahead.
/// Not to be doubled; of even places it is 1.
pub(crate) const SAME_WINDOW: f64 = 0.95;

/// Rows a turn of the way, on average, below which places are visited in no order.
///
/// Derived: in random order two of three rows are turns, and half where an axis goes three ahead and one back. Doubled:
/// strokes of eight rows are in no order either, which their places are the denser for.
pub(crate) const ROWS_A_TURN: usize = 4;

/// Part of the mean distance of places within which two of them are the same one, met again.
///
/// Chosen: an encoder trembles by less. Doubled: one in ten gaps of random places is none; they are the smallest.
pub(crate) const SAME_PLACE: f64 = 0.05;

/// Part of the usual rate from which on the window is looked at; below it is its own peak.
///
/// Chosen, above half the rate, which even samples resolve. Doubled: the first return of samples
/// taken evenly is missed.
pub(crate) const WINDOW_FROM: f64 = 0.6;

/// Frequencies in time that an effect is tried at.
///
/// Chosen. Doubled: the seventeenth strongest line may be the one.
pub(crate) const FREQUENCIES: usize = 16;

/// Sudden changes that an effect of one moment is tried at.
///
/// Chosen. Doubled: smaller slips in slow noise are found, at twice the time.
pub(crate) const SUDDEN_CHANGES: usize = 16;

/// Part of the travel that is the narrowest bump looked for.
///
/// Derived: five samples of a file of a thousand. Doubled: a hundredth.
pub(crate) const NARROWEST: f64 = 200.0;

/// Part of the interval of samples, those in between counted, that is the shortest time constant
/// looked for.
///
/// Derived: a lag delays a wave of ten samples by a hundredth of it there. Doubled: a twentieth.
pub(crate) const SHORTEST: f64 = 10.0;

/// Longest time constant or width looked for, against the record: beyond it anything is a slope.
///
/// Chosen. Doubled: slopes are fitted by more effects.
pub(crate) const LONGEST: f64 = 2.0;

/// Highest overtone of a gear that is looked for: a worm shows five.
///
/// Chosen. Doubled: lines at up to ten times an order found are the gear's.
pub(crate) const OVERTONES: u16 = 5;

/// Turns of a slower wheel by which a line lies off a listed one and is that one's, uneven within such a turn.
///
/// Chosen: ten waves in a turn are an uneven one still. Doubled: half of all orders are beside one of fifty.
pub(crate) const SIDEBANDS: u16 = 10;

/// Harmonics of gears and of the lead screw that lines are named by.
///
/// Chosen. Doubled: eight, and more lines bear two shafts' names.
pub(crate) const NAMED_HARMONICS: u8 = 4;

/// Harmonics of the spindle that lines are named by.
///
/// Source: the document on the device, whose wanted band ends at the third. Doubled: six.
pub(crate) const NAMED_SPINDLE_HARMONICS: u8 = 3;

/// Highest multiple of a stronger line that a line is called.
///
/// Chosen. Doubled: every line far up is a multiple of a slow one.
pub(crate) const HIGHEST_MULTIPLE: f64 = 12.0;

/// Most lines listed a sensor.
///
/// Chosen, for a reader. Doubled: twenty.
pub(crate) const LISTED_LINES: usize = 10;

/// Polynomials of the smooth curve, the local bump, and the wave of changing length that are looked
/// for.
///
/// Chosen: each has some three times as many as the last, so that nothing between falls through.
/// Doubled: narrower bumps are seen, and the last follows slow noise.
pub(crate) const CURVE_ORDER: usize = 6;
/// See [`CURVE_ORDER`].
pub(crate) const BUMP_ORDER: usize = 24;
/// See [`CURVE_ORDER`].
pub(crate) const WAVE_ORDER: usize = 64;

/// Order of a curve over what a logged column shows.
///
/// Chosen: three waves over its range, as a sensor's own nonlinearity has them. Doubled: six waves are
/// seen, and a bend needs more evidence.
pub(crate) const CURVE_OF_A_LOG: usize = 12;

/// Rows that each column of such a curve needs.
///
/// Chosen. Doubled: short files are not looked at for bumps.
pub(crate) const ROWS_A_COLUMN: usize = 6;

/// Most targets of all sensors that may each have an error of their own.
///
/// Chosen, by time, which grows as their cube: 200 places that six passes read take three seconds. Doubled: a minute.
pub(crate) const MOST_TARGETS: usize = 200;

/// Fewest targets of a table that tell what is at one of them alone from a curve.
///
/// Source: ISO 230-2 asks for five a metre. Doubled: a dent at one target of nine is wear.
pub(crate) const FEWEST_TARGETS: usize = 5;

/// Orders of the curves that one pass may have and no other.
///
/// Chosen: a slope, a bow and an S, as what warms up bends; and two waves, as a run that was disturbed
/// swings. Doubled: a run with one wave is noise of them all.
pub(crate) const BENDS_OF_A_PASS: [usize; 2] = [3, 7];

/// Rows of a pass beyond that and its level, which tell its noise.
///
/// Measured on drawn noise, white to a random walk: with eleven, of up to twenty passes no more fall
/// below a chance than three times what it says; with six, fifteen times. Doubled: runs of eleven
/// targets there and back are not compared.
pub(crate) const ROWS_BESIDE_A_BEND: usize = 11;

/// Parts of a record, of as many rows each, that a wave in time is to have one size and phase in.
///
/// Chosen: six numbers more than the wave has, and a burst or a lost beat fills one part. Doubled: fourteen, and a
/// wave of five standard errors a part is asked in parts that hardly show it.
pub(crate) const PARTS_OF_A_RECORD: usize = 4;

/// Columns of all passes together that their own smooth curves may have.
///
/// Chosen. Doubled: eight passes may have curves of eight columns each.
pub(crate) const COLUMNS_OF_PASSES: usize = 48;

/// Most polynomials of a pass's own curve, and fewest.
///
/// Chosen: fewer than three are offset, slope and sag, which every pass may have. Doubled: a curve
/// in each pass is a bump.
pub(crate) const CURVE_OF_A_PASS: std::ops::RangeInclusive<usize> = 3..=8;

/// Most times a turn that a formula of what is no sine is looked for.
///
/// Chosen: a cam or a chuck has few faces. Doubled: a search takes longer by a third, and sines have to do for the poles
/// of a motor as before.
pub(crate) const MOST_A_TURN: u8 = 6;

/// Turns of a shaft from which on a shape repeats with it.
///
/// Derived: what is there once repeats nothing. Doubled: four turns.
pub(crate) const TURNS: f64 = 2.0;

/// Most shafts that a shape may repeat with, the spindle and the machine's screw first, then the slowest.
///
/// Chosen: a worm and what drives it. Doubled: twice the time, and every shape pays for more places.
pub(crate) const MOST_SHAFTS: usize = 4;

/// Harmonics of a shape that repeats each turn.
///
/// Chosen. Doubled: sharper shapes are seen, and sixteen columns follow slow noise.
pub(crate) const HARMONICS: u8 = 4;

/// Rows of the cells whose means are compared from pass to pass.
///
/// Measured: of 195 records of a generator made apart from the program seven repeat beyond chance by
/// them, five by single rows. Doubled: shapes of a few rows are averaged away in the second.
pub(crate) const CELLS_OF_WAYS: [usize; 3] = [1, 4, 16];

/// Parts of a way whose means make the curve that is held against those of other ways.
///
/// Chosen: eight waves a way are seen. Doubled: shapes of a sixteenth, and noise of half as many rows in
/// each.
pub(crate) const CELLS_OF_A_CURVE: usize = 16;

/// Rows of each part, at least.
///
/// Chosen. Doubled: ways of less than a hundred rows are not held against one another.
pub(crate) const ROWS_A_PART: usize = 3;

/// Ways that a curve is common to, at least.
///
/// Derived: two slow curves are alike by chance too often. Doubled: five passes are not asked.
pub(crate) const FEWEST_WAYS: usize = 3;

/// Share of the longest way that another must cover to be held against it.
///
/// Chosen: its parts then lie within a tenth of a way of the other's. Not to be doubled.
pub(crate) const WHOLE_WAY: f64 = 0.9;

/// Fewest common samples of two passes that are compared.
///
/// Chosen: a correlation of 0.97 is then beyond chance, of two runs over ten targets. Doubled: runs over
/// less than twenty are not compared.
pub(crate) const COMMON_SAMPLES: usize = 10;

/// Comparisons at the beginning of a run in which the loop pulls in.
///
/// Chosen: at 160 steps a second and 6.3 comparisons a second they make 3 µm good. Doubled: the
/// check begins later.
pub(crate) const PULLING_IN: usize = 10;

/// Share of a pass that must lie on either side of a sudden change.
///
/// Measured: the first thousandth to half a hundredth of positioned motors' logs show them pulling in.
/// Doubled: a slip in the first or last fiftieth of a pass has no name.
pub(crate) const RUN_IN: f64 = 0.01;

/// Cells of a window in which a shape of any kind is looked for.
///
/// Chosen: a bell with both flanks shows in six. Doubled: shapes of two lobes show better, short
/// ones worse.
pub(crate) const CELLS: usize = 6;

/// Rows of the narrowest cell.
///
/// Chosen: the noise inside a window is then known from 18 rows. Doubled: knocks of less than fifty
/// rows are not seen.
pub(crate) const ROWS_A_CELL: usize = 4;

/// Windows that the longest pass must hold, for what they usually show to be known.
///
/// Chosen. Doubled: shapes of more than a twelfth of a pass are left to the smooth curves.
pub(crate) const WINDOWS: usize = 6;

/// Rows of the shortest stretches whose means are compared for changes that stand out.
///
/// Measured: with half of it, skewed noise stands out in one record of twelve. Doubled: teeth of
/// thirty samples do not.
pub(crate) const SHORTEST_STRETCH: usize = 4;

/// Rows of the longest stretches whose means are compared for changes that stand out.
///
/// Chosen: longer shapes are smooth curves of a pass. Doubled: one look more.
pub(crate) const LONGEST_STRETCH: usize = 64;

/// Rows on either side that say how loud a place is.
///
/// Measured on 155 records of noise made apart from the program: with 24, gusts of white noise that
/// come and go within 24 rows stand out by 7 deviations, with 16 nothing by more than 4.5; with 8
/// the shapes themselves are taken for loudness.
pub(crate) const LOUDNESS_ROWS: usize = 16;

/// Rows of the stretches whose means are differenced for jumps that go one way only.
///
/// Chosen: the longest averages a quarter of the noise away, and slower jumps are smooth curves.
/// One more: every chance is a fifth larger, and a creep over 64 rows and more shows better.
pub(crate) const REVERSED_STRETCHES: [usize; 5] = [1, 2, 4, 8, 16];

/// Last values that a sample is predicted by.
///
/// Measured on 131 all-clears of two generators by others, 15 to 250 standard errors: at the limit 26 are
/// told with eight, 23 with six or twelve. Doubled: passes of fewer than thirty rows say nothing.
pub(crate) const PREDICTED_BY: usize = 8;

/// Of these, the last, of which the mean predicts as well.
///
/// Chosen: half of them. Doubled: the mean of all eight, once more.
pub(crate) const JUST_BEFORE: usize = 4;

/// Rows whose means are cut in two, to tell levels from noise.
///
/// Chosen: single rows of rounding are no levels, and what lasts nine is no smooth curve. Doubled: levels of
/// three to eight rows are blurred.
pub(crate) const ROWS_OF_A_LEVEL: [usize; 4] = [2, 3, 5, 9];

/// Fewest means of a pass that are cut.
///
/// Chosen: of fewer the halves differ by most of the square in any noise. Doubled: passes of fewer than fifty
/// rows say nothing.
pub(crate) const FEWEST_CUT_IN_TWO: usize = 12;

/// Rows after which half a swing is over.
///
/// Chosen: differences of rounded values are of the other sign one row later, and what is longer is a line.
/// Doubled: periods of four rows are not seen.
pub(crate) const HALF_A_SWING: [usize; 8] = [2, 3, 4, 6, 8, 11, 16, 22];

/// Bends of a coordinate at which waves of changing frequency are looked for, and the steepest: of what the frequency
/// is in the middle, it is less by so much at one end and more at the other.
///
/// Derived: half a bend aside, a hundred waves lose a third of their square. Doubled: the same two hundred.
pub(crate) const BENDS: usize = 64;
pub(crate) const STEEPEST_BEND: f64 = 0.95;

/// Waves of a record that are looked for so.
///
/// Chosen: fewer are a smooth curve. Doubled at the end: twice the time, and twice the price.
pub(crate) const WAVES_OF_A_BEND: std::ops::RangeInclusive<f64> = 4.0..=100.0;

/// Waves times bend from which on they are half a turn from any line of one frequency.
///
/// Derived: the bend is largest in the middle, where it is a quarter. Doubled: a turn.
pub(crate) const NO_LINE: f64 = 2.0;

/// Bends that are fitted: a scan takes what hardly changes between samples for strong.
///
/// Chosen. Doubled: twice the time.
pub(crate) const SETTLED_BENDS: usize = 3;

/// Parts of the travel, or of a pass, that waves may be in alone, and the fewest rows of one.
///
/// Chosen: a wave in half of a record is a line of it; three columns a run leave five rows for its noise. Doubled:
/// eighths and sixteenths; a wave in a quarter of the rows is seen in half of them.
pub(crate) const PARTS_WITH_A_BURST: [u8; 2] = [4, 8];
pub(crate) const FEWEST_ROWS_OF_A_BURST: usize = 8;

/// Stretches of a pass that may be slow or not, each number of them a look, and their fewest rows.
///
/// Chosen: passes, halves and quarters; a stretch of fewer rows has less than eight frequencies. Doubled: passes of
/// twenty rows over targets say nothing.
pub(crate) const STRETCHES_OF_A_PASS: [usize; 3] = [1, 2, 4];
pub(crate) const FEWEST_ROWS_OF_A_STRETCH: usize = 16;

/// The most last values that noise of any spectrum is predicted by.
///
/// Chosen: instruments' running means of up to 24 rows show their lobes. Doubled: means of 40 rows do, for twice the time.
pub(crate) const PREDICTED_BY_MOST: usize = 24;

/// Rows that each of [`PREDICTED_BY`] and [`PREDICTED_BY_MOST`] needs.
///
/// Chosen. Doubled: a record of 150 rows says nothing.
pub(crate) const ROWS_A_LAG: usize = 10;

/// Rows within which one outlier follows another.
///
/// Chosen: as many as neighbours on each side that a sample is judged by. Doubled: two outliers a pass are
/// in company oftener by chance, and a burst tells less.
pub(crate) const IN_COMPANY: usize = 3;

/// Fewest passes over the same places whose zeros are said to lie apart.
///
/// Chosen: of two, either may be off. Doubled: five runs of ISO 230-2 say nothing.
pub(crate) const FEWEST_ZEROS: usize = 3;

/// Turns of a spindle in a pass from which on a frequency in time is said to be a whole multiple of its rate.
///
/// Derived: to half a wave, one frequency in so many is that by chance, and a cause of its own is told beside it.
/// Doubled: one in twenty.
pub(crate) const MANY_TURNS: f64 = 10.0;

/// Part of a stroke within which play is taken up whose passes begin as the one before ended, or behind a turn.
///
/// Measured on the 42nd records: play took up to 0.28 of a stroke; the loops of a piezo, creep and a vibration of one
/// wave a stroke, which such play follows as well, 0.36 to 0.48. Doubled: those four are named for it.
pub(crate) const TAKEN_UP_OF_A_STROKE: f64 = 1.0 / 3.0;

/// Strokes between two reversals of which one may end before a way is gone that the others go.
///
/// Chosen: play that is not taken up is carried over, which the formula of play does not know. Where one stroke in
/// eight ends before, the width that it finds is right to 2 %, of one in two a third low. Doubled: that one in eight
/// forbids the name.
pub(crate) const STROKES_A_SHORT_ONE: usize = 4;
