//! What is beyond chance, and how a chance is found.

/// A chance smaller than this is structure.
///
/// Chosen: one record of noise in ten thousand is called unexplained by a probe. Doubled: one in
/// five thousand, and a wave needs a gain of 17.0 instead of 18.4.
pub(crate) const SIGNIFICANCE: f64 = 1e-4;

/// A chance smaller than this, of as many as there are effects, says that passes do not agree on one.
///
/// Chosen: it is one question of each effect that was found, and no list of shapes; one in a thousand is left open
/// that is right. Doubled: one in five hundred.
pub(crate) const DISAGREES: f64 = 1e-3;

/// An effect must have a smaller chance than this to be named, all effects and places that were
/// tried counted.
///
/// Chosen: three records of noise in a thousand are given a name, as many as may be. The chance is
/// calibrated: of 770 records of a world made apart from the program that hide nothing it was below
/// 0.01 in 6 and below 0.05 in 29. On 880 others (seeds 10280 to 11159) five effects more than at a
/// third of it are named rightly, and one falsely. Doubled: one in 170.
pub(crate) const NAMED: f64 = 3e-3;

/// The same of a chance that allows for noise which is louder in places, smoother, or of longer tails
/// than the model of the noise can be.
///
/// Measured: of 300 records of white noise with a stretch four times as loud four are given a name.
/// Trebled: six.
pub(crate) const NAMED_IN_OTHER_NOISE: f64 = 1e-3;

/// Chance below which no all-clear is given, though what was found may not be named.
///
/// Chosen: a hundredth of [`SIGNIFICANCE`], for the chance is that of one effect, at its best place,
/// where noise has no name to lose. Doubled: a curve needs a gain of 27.6 instead of 29.0.
pub(crate) const NO_ALL_CLEAR: f64 = 1e-6;

/// Chance in noise from which on an effect is no doubt of an all-clear, though without it the noise is slow
/// and with it is not.
///
/// Measured: none of 380 records with nothing hidden, by a generator made apart from the program, loses
/// its all-clear, with random walks and 1/f noise among them. Doubled: one in ten is asked of a cause.
pub(crate) const NO_CHANCE: f64 = 0.05;

/// The same beside effects that explain the rest: slow noise is there oftener than one cause more.
///
/// Measured: at a twentieth, two of 220 records of a world made apart from the program with slow noise in
/// most of them lose a right answer. Doubled: one of them does.
pub(crate) const NO_CHANCE_BESIDE: f64 = 0.01;

/// The same where the noise is swift for all with it: slow noise has room for any curve, and no curve has
/// room for slow noise.
///
/// Chosen: it is likelier there than not. Doubled: any curve is asked.
pub(crate) const NO_CHANCE_SWIFT: f64 = 0.5;

/// Chance below which a line is listed for a reader. No verdict rests on a list, so it may be ten
/// times as open as [`SIGNIFICANCE`].
///
/// Chosen. Doubled: two lists of noise in a thousand hold a line, instead of one.
pub(crate) const LISTED_LINE: f64 = 1e-3;

/// Chance below which a fast line forbids means of neighbours. Samples are then picked, at a cost
/// to every slow effect, so this is a hundred times as strict as [`SIGNIFICANCE`].
///
/// Chosen. Doubled: two long records of noise in a million are picked instead of averaged.
pub(crate) const FAST_LINE: f64 = 1e-6;

/// Probes for structure beside those of logged columns: every chance is multiplied by their
/// number (Bonferroni).
///
/// Derived: eighteen on one pass, twenty-four on several of one sensor; this stands for both. Doubled:
/// structure at the limit needs 1.4 more evidence.
pub(crate) const PROBES: f64 = 20.0;

/// Columns from which on χ² is too optimistic and a chance is found by trying noise.
///
/// Chosen: from the shortest smooth curve on, for correlated noise passed for a wave by χ² alone.
/// Doubled: that curve, and a shape of eight columns that repeats each turn, would again.
pub(crate) const MANY_COLUMNS: usize = 6;

/// Samples that a record is worth where noise may have swallowed two effects.
///
/// Measured on twelve pairs that were found so: 2 to 13. Doubled: no other pair, and a fifth more time for a
/// diagnosis.
pub(crate) const SWALLOWED: f64 = 30.0;

/// Samples that a record must be worth for χ² to be believed of an effect of few columns.
///
/// Derived: two columns reach a chance of 1e-4 by χ² oftener than so by Fisher's law with a hundred
/// degrees of freedom, which knows that the noise was estimated, 2.2 times. Doubled: 1.5 times, at
/// the cost of drawn noise in more records.
pub(crate) const FEW_SAMPLES: f64 = 100.0;

/// Draws of noise at a time whose mean and variance say which scaled χ² a gain follows.
///
/// Chosen: enough where a gain is far from any limit. Doubled: the same answers, later.
pub(crate) const DRAWS: u64 = 16;

/// The most of them, where their scatter leaves open on which side of a limit a gain lies.
///
/// Derived: the mean of so many gains of one column is good to 9 %, and a chance of 1e-5 to a factor
/// of three. With sixteen it is good to a factor of thirty: effects of 6 standard errors were lost.
/// Doubled: to a factor of two.
pub(crate) const MOST_DRAWS: u64 = 256;

/// Draws of which the largest is one of the tail.
///
/// Chosen: a dozen of 256 lie in it. Doubled: six, and a chance is good to a factor of two instead of 1.6.
pub(crate) const TAIL: usize = 20;

/// Columns up to which gains fall as the exponential of their half.
///
/// Derived: χ² with two degrees is that law, with more it takes longer to. Doubled: shapes of four columns are
/// told with too small a chance.
pub(crate) const NARROW: usize = 2;

/// Gain a column above which no noise is to blame and none is drawn.
///
/// Derived: χ² with one degree exceeds 40 once in 4·10⁹. Doubled: more draws, the same answers.
pub(crate) const BEYOND_DOUBT: f64 = 40.0;

/// Standard deviations of noise, sixteen times drawn, between which changes that stand out are held
/// against more of it.
///
/// Derived: what is beyond [`SIGNIFICANCE`] is beyond six, and sixteen draws tell three from it on one
/// side. On the other they do not know how skewed a figure is: at twelve of their deviations noise was as far
/// as that once in hundreds of records, and by an exponential law thirty are 1e-9 if half of them are true.
/// Doubled: half of it is missed on the one side, nothing on the other.
pub(crate) const WORTH_DRAWING: std::ops::RangeInclusive<f64> = 3.0..=30.0;

/// Changes from one stretch of a pass to the next from which on their median says what is usual.
///
/// Chosen: it is good to a third. Doubled: stretches are half as long at most.
pub(crate) const FEWEST_CHANGES: usize = 16;

/// A whitened sample beyond this many deviations is a jump.
///
/// Derived: Gaussian noise does so once in 1.7 million samples. Heavier tails are read from the
/// samples themselves: with it, none of 200 records of AR(1) noise with t₃ innovations shows
/// jumps, where 77 did by Gauss's law. Doubled: only jumps of ten deviations are seen.
pub(crate) const JUMP_DEVIATIONS: f64 = 5.0;

/// Samples of a pass from which on the deviation of its noise is told by most of them, and not by all,
/// of which jumps are a part.
///
/// Derived: the median of so many normal sizes is known to 15 %. Doubled: passes of a hundred samples are
/// held against a noise that their jumps have made.
pub(crate) const SAMPLES_THAT_TELL: usize = 60;

/// Neighbours on each side that a level is told from.
///
/// Chosen. Doubled: teeth of ten samples are none.
pub(crate) const JUMP_SIDE: usize = 3;

/// Share of a jump that the level must keep behind it.
///
/// Measured: of 383 records of noise by a generator made apart from the program, bursts and louder
/// halves among them, none shows jumps. Doubled: no jump with noise in it counts.
pub(crate) const JUMP_KEPT: f64 = 0.6;

/// Fewest jumps that are structure: a slip or a knock explains one.
///
/// Derived. Doubled: two and three jumps stay in the noise.
pub(crate) const FEWEST_JUMPS: usize = 2;

/// Standard errors within which a coefficient may be zero, or beyond its plausible range.
///
/// Source: 95.4 % of a normal law. Of the true values of challenges 557 of 583 lie within.
/// Doubled: effects of less than four standard errors are dropped as superfluous.
pub(crate) const STANDARD_ERRORS: f64 = 2.0;

/// Shares of noises, before a residual is seen, that a standard error is told by: white, or whatever was fitted,
/// without a slow part; with one so slow that it is a random walk over a pass, of a size in [`WALKS`]; the
/// rest with one of any length and size.
///
/// Measured on 16 200 drawn records of 60 to 180 rows, one pass and four, with a drift, bow, step, growth or wave:
/// within two standard errors under the likeliest noise alone white 96.0 %, AR(1) 92.1 %, white with a walk of 0.4,
/// 0.8 and 1.5 of its deviation a pass 91.2, 85.0 and 80.1 %; with these shares 97.3, 96.2, 94.7, 90.9 and 88.4 %;
/// with none for walks 96.5, 96.0, 92.3, 86.6 and 84.3 %. Walks doubled: 97.7, 96.2, 95.8, 93.6 and 90.5 %.
pub(crate) const NO_SLOW_PART: f64 = 0.4;
/// See [`NO_SLOW_PART`].
pub(crate) const LIKE_A_WALK: f64 = 0.3;

/// Variances that such a walk gains over the longest pass, against the white variance.
///
/// Chosen: the smallest moves a drift over a hundred rows by half of its error, the largest leaves ten rows
/// little that is white. Doubled: the same five of the ten sizes that are tried lie within.
pub(crate) const WALKS: std::ops::RangeInclusive<f64> = 0.027..=33.0;

/// Share of noises that have a slow part beside the shorter one of the fitted noise.
///
/// Derived: as much as three of the seventy parts of any length and size have, which is how near a residual
/// tells one. Doubled: a fitted part counts as better known.
pub(crate) const BESIDE_A_FITTED_PART: f64 = 0.03;

/// Standard errors within which a slope equals a ratio of settings, a count is whole.
///
/// Derived: a normal law leaves them once in 16 000, so that hardly a true one is lost. Doubled:
/// a slope of less than eight is no setting, and slopes twice as far off pass for one.
pub(crate) const EXACT_STANDARD_ERRORS: f64 = 4.0;

/// Standard errors of an order within which it is that of a shaft, or of a harmonic.
///
/// Source: 99.7 % of a normal law. Doubled: lines get a name that belongs to their neighbour.
pub(crate) const NAME_STANDARD_ERRORS: f64 = 3.0;

/// Part of a frequency cell that is added to them: the noise's own colour moves a line.
///
/// Chosen. Doubled: two fifths of a cell, in which two shafts may lie.
pub(crate) const NAME_CELL: f64 = 0.2;

/// How far from whole the ratio of two lines may be, whatever their standard errors, for the one to
/// be called a multiple of the other.
///
/// Chosen: two lines of no kinship are so near by chance two times in five. Doubled: four in five.
pub(crate) const NEARLY_WHOLE: f64 = 0.2;

/// Share of a standard error from its range's end at which a value is warned of.
///
/// Derived: whatever stopped at the end lies within rounding of it. Doubled: nothing moves.
pub(crate) const AT_AN_END: f64 = 0.01;

/// Whitened square a row of a fit that leaves more than noise: its standard errors are no measure.
///
/// Derived: 1 is noise, and 16 samples and more hardly double it. Doubled: slips beside something
/// larger that is still to be found are refused as no whole number.
pub(crate) const MORE_THAN_NOISE: f64 = 2.0;

/// Standard deviations of its own scatter by which the variance along an effect's curve must exceed
/// that of the fitted noise to count.
///
/// Chosen: white noise passes once in some hundred effects, which then lose a third of their gain.
/// Doubled: a stretch that is twice as loud goes unseen.
pub(crate) const UNEVEN_DEVIATIONS: f64 = 3.0;

/// By how much noise of an instrument is louder, at its loudest frequency, than white and slow parts fitted to it.
///
/// Derived: the mean of the last 4 to 20 readings by 2.2 at most (Whittle's likelihood of its spectrum), of which an
/// estimate from some hundred rows is a third more at times. What is louder still is another cause, and takes no
/// name away. Doubled: a gear whose second line stands beside it is refused, at 28 standard errors.
pub(crate) const LOUDEST_LOBE: f64 = 3.0;

/// Rows of an effect's curve for each row that the scatter along it may reach.
///
/// Chosen: the residual has lost what the effect took, and over more than an eighth of the curve
/// that shows. Doubled: a filter over a tenth of the curve goes unseen.
pub(crate) const ROWS_A_LAG: f64 = 8.0;

/// Twice the log likelihood by which rows must prefer a noise of their own to have one.
///
/// Derived: χ² with three degrees, the size of either part and a memory, exceeds it once in twenty;
/// such effects in even noise then lose a part of their gain. Doubled: a gust twice as loud as the
/// rest over fifty rows is not told from it.
pub(crate) const ANOTHER_NOISE: f64 = 7.8;

/// Rows on either side of a short curve whose noise is asked for.
///
/// Chosen: size and memory of a noise need some eighty rows. Doubled: gusts of less than that go
/// unseen.
pub(crate) const NEIGHBOURHOOD: usize = 40;

/// Rows of a sensor against those of a neighbourhood, at least.
///
/// Measured: at two, a workpiece that is warm in one pass of two is slow noise of that pass; at
/// four, a knock in one pass of three is a slip. Doubled: gusts are looked at in records of six
/// passes and more only, or near the place.
pub(crate) const A_PART: usize = 3;

/// Share of a curve's square with which it stands in a neighbourhood.
///
/// Chosen: what stands in other passes too is judged by all of them. Not to be doubled; at a half,
/// a curve of two passes is judged by one.
pub(crate) const NEARLY_ALL: f64 = 0.9;

/// Fewest outliers that may have something in common.
///
/// Chosen: five at one angle have a chance of 7e-3 there. Doubled: three bumps of three samples are not told.
pub(crate) const FEWEST_OUTLIERS: usize = 5;
