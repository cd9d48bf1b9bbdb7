//! From characteristics to a grade, with its probability.

use statrs::distribution::{ContinuousCDF, Normal};

use super::{Characteristic, Estimate, Status, ToleranceTable};

/// How one characteristic stands to one limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// Symbol of the characteristic.
    pub symbol: &'static str,
    /// Its value, µm.
    pub value_um: f64,
    /// The limit, µm; `e` and pitch errors may have either sign.
    pub limit_um: f64,
    /// True when the size of the value does not exceed the limit.
    pub holds: bool,
    /// Probability that the true value does not exceed it; absent without an uncertainty.
    pub probability: Option<f64>,
    /// How far the limit can be trusted.
    pub status: Status,
    /// Where the limit is from.
    pub source: String,
}

/// How a screw stands to one grade.
#[derive(Clone, Debug, PartialEq)]
pub struct GradeVerdict {
    /// The grade.
    pub grade: String,
    /// Each characteristic with a value and a limit.
    pub judgements: Vec<Judgement>,
    /// Symbols whose limit ends before this useful travel: the grade cannot be given.
    pub without_limit: Vec<&'static str>,
    /// Symbols this grade limits and the samples do not show: the grade cannot be given.
    pub unmeasured: Vec<&'static str>,
    /// True when every limit is known and holds.
    pub holds: bool,
    /// Probability of this grade or a better one; absent without an uncertainty.
    pub probability: Option<f64>,
    /// The least trusted limit of this grade.
    pub status: Status,
}

/// How a screw stands to every grade of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Grading {
    /// The best grade that holds; absent when none does.
    pub grade: Option<String>,
    /// The least trusted limit of the grade given; of all when none holds.
    pub status: Status,
    /// The least trusted limit by which a better grade is refused; absent when none is.
    pub refused_by: Option<Status>,
    /// Every grade, the best first.
    pub verdicts: Vec<GradeVerdict>,
    /// Symbols that have a limit in the table but no value: they were not judged.
    pub not_judged: Vec<&'static str>,
}

/// Grades a screw.
///
/// `estimates` are what is known of each characteristic, in their order; their errors are taken as
/// normal and independent, so a grade's probability is the product over its limits. Without them
/// there is no probability. Whether a limit holds is said of the value as it was measured.
/// Both the grade and its probability are monotone: with every characteristic made larger in
/// size, neither gets better. A worse grade is never less probable than a better one.
#[must_use]
pub fn grade(
    table: &ToleranceTable,
    characteristics: &[Characteristic],
    useful_travel_mm: f64,
    estimates: &[Option<Estimate>],
) -> Grading {
    let verdict =
        |grade: &String| judge(table, grade, characteristics, useful_travel_mm, estimates);
    let mut verdicts: Vec<GradeVerdict> = table.grades.iter().map(verdict).collect();
    make_cumulative(&mut verdicts);
    let best = verdicts.iter().position(|verdict| verdict.holds);
    let given = best.map(|index| verdicts[index].status);
    let worst = || verdicts.iter().map(|verdict| verdict.status).max();
    let status = given.or_else(worst);
    let refused = verdicts[..best.unwrap_or(0)].iter().flat_map(|verdict| &verdict.judgements);
    let refused_by = refused.filter(|one| !one.holds).map(|one| one.status).max();
    let limited = |one: &&Characteristic| table.limits.iter().any(|l| l.quantity == one.limit);
    let missing = characteristics.iter().filter(|one| one.reached.is_err()).filter(limited);
    Grading {
        grade: best.map(|index| verdicts[index].grade.clone()),
        status: status.unwrap_or(Status::Unverified),
        refused_by,
        not_judged: missing.map(|one| one.symbol).collect(),
        verdicts,
    }
}

/// Grades that rest on other characteristics than their neighbour (pitch after helix) may come
/// out less probable than a better one; "this grade or better" then has the better one's.
fn make_cumulative(verdicts: &mut [GradeVerdict]) {
    let mut least: Option<f64> = None;
    for verdict in verdicts {
        least = verdict.probability.map(|found| found.max(least.unwrap_or(0.0))).or(least);
        verdict.probability = least;
    }
}

fn judge(
    table: &ToleranceTable,
    grade: &str,
    characteristics: &[Characteristic],
    useful_travel_mm: f64,
    estimates: &[Option<Estimate>],
) -> GradeVerdict {
    let (mut judgements, mut without_limit) = (Vec::new(), Vec::new());
    for (index, one) in characteristics.iter().enumerate() {
        let (Ok(reached), Some(limit)) = (&one.reached, table.limit(grade, one.limit)) else {
            continue;
        };
        let Some(limit_um) = table.allowed_um(limit, useful_travel_mm) else {
            without_limit.push(one.symbol);
            continue;
        };
        judgements.push(Judgement {
            symbol: one.symbol,
            value_um: reached.value_um,
            limit_um,
            holds: reached.value_um.abs() <= limit_um,
            probability: estimates.get(index).copied().flatten().and_then(|e| within(e, limit_um)),
            status: limit.status,
            source: limit.source.clone(),
        });
    }
    let unmeasured: Vec<_> = characteristics
        .iter()
        .filter(|one| table.limit(grade, one.limit).is_some())
        .filter(|one| one.reached.as_ref().is_err_and(|why| why.is_unmeasured()))
        .map(|one| one.symbol)
        .collect();
    let known = without_limit.is_empty() && unmeasured.is_empty() && !judgements.is_empty();
    let probabilities: Option<Vec<f64>> = judgements.iter().map(|j| j.probability).collect();
    GradeVerdict {
        grade: grade.into(),
        holds: known && judgements.iter().all(|judgement| judgement.holds),
        probability: probabilities.filter(|_| known).map(|each| each.iter().product()),
        status: judgements.iter().map(|j| j.status).max().unwrap_or(Status::Unverified),
        judgements,
        without_limit,
        unmeasured,
    }
}

/// Probability that the true value, normal about the estimate, lies within `±limit_um`.
///
/// For a band width the lower side hardly counts, as no true band is negative.
fn within(estimate: Estimate, limit_um: f64) -> Option<f64> {
    let true_value = Normal::new(estimate.size_um, estimate.uncertainty_um).ok()?;
    Some(true_value.cdf(limit_um) - true_value.cdf(-limit_um))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::number;
    use crate::screw::{Curve, Weighting, built_in_table, evaluate_travel};
    use crate::screw::{helical_characteristics, pitch_characteristics};

    fn curve(heights: &[f64], factor: f64) -> Curve {
        let x: Vec<f64> = (0..heights.len()).map(|k| number(k) * 1.25).collect();
        let y: Vec<f64> = heights.iter().map(|height| height * factor).collect();
        Curve::new(&x, &y).unwrap()
    }

    /// A characteristic known to 1 µm.
    fn known(value_um: f64) -> Estimate {
        Estimate { size_um: value_um.abs(), uncertainty_um: 1.0 }
    }

    fn rank(standard: &str, curve: &Curve) -> (usize, Vec<Option<f64>>) {
        let table = built_in_table(standard).unwrap();
        let characteristics = if standard == "jbt2886" {
            let mut all = helical_characteristics(curve, 5.0).to_vec();
            all.extend(pitch_characteristics(curve, 5.0));
            all
        } else {
            evaluate_travel(curve, 5.0, 0.0, Weighting::Samples).unwrap().characteristics.to_vec()
        };
        let estimate = |one: &Characteristic| one.reached.ok().map(|found| known(found.value_um));
        let estimates: Vec<_> = characteristics.iter().map(estimate).collect();
        let grading = grade(&table, &characteristics, curve.length_mm(), &estimates);
        let best = grading.verdicts.iter().position(|verdict| verdict.holds);
        let probabilities = grading.verdicts.iter().map(|verdict| verdict.probability).collect();
        (best.unwrap_or(usize::MAX), probabilities)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn a_worse_curve_never_gets_a_better_grade(
            heights in prop::collection::vec(-12.0..12.0f64, 300..500),
            factor in 1.0..4.0f64,
        ) {
            for standard in ["iso3408-3", "jbt2886"] {
                let (better, likely) = rank(standard, &curve(&heights, 1.0));
                let (worse, less_likely) = rank(standard, &curve(&heights, factor));
                prop_assert!(better <= worse, "{standard}");
                for (likely, less_likely) in likely.iter().zip(&less_likely) {
                    prop_assert!(*less_likely <= likely.map(|p| p + 1e-12), "{standard}");
                }
                prop_assert!(likely.is_sorted());
            }
        }
    }

    #[test]
    fn a_value_on_its_limit_is_within_it_half_the_time() {
        let half = within(known(21.0), 21.0).unwrap();
        assert!((half - 0.5).abs() < 1e-12);
        // Φ(1.96) = 0.975
        assert!((within(known(10.0), 11.96).unwrap() - 0.975).abs() < 1e-4);
    }

    /// What a short screw does not have is not asked of it; what was not measured is.
    #[test]
    fn samples_that_show_nothing_earn_no_grade() {
        let table = built_in_table("iso3408-3").unwrap();
        let given = |travel_mm: &[f64]| {
            let curve = Curve::new(travel_mm, &vec![0.0; travel_mm.len()]).unwrap();
            let found = evaluate_travel(&curve, 5.0, 0.0, Weighting::Samples).unwrap();
            grade(&table, &found.characteristics, curve.length_mm(), &[])
        };
        assert_eq!(given(&[0.0, 2.5, 5.0]).grade, None);
        let once_a_turn: Vec<f64> = (0..40).map(|k| f64::from(k) * 5.0).collect();
        assert_eq!(given(&once_a_turn).verdicts[0].unmeasured, ["V2π"]);
        let short: Vec<f64> = (0..100).map(|k| f64::from(k) * 0.5).collect();
        assert_eq!(given(&short).grade.as_deref(), Some("0"), "50 mm have no V300");
    }

    #[test]
    fn a_recalled_table_makes_an_unverified_verdict() {
        let table = built_in_table("jbt2886").unwrap();
        let curve = curve(&vec![0.0; 400], 1.0);
        let found = grade(&table, &helical_characteristics(&curve, 5.0), 500.0, &[]);
        assert_eq!((found.grade.as_deref(), found.status), (Some("3"), Status::Unverified));
    }
}
