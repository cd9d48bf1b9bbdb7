//! The keys of `screw --json`; they do not change.

use helixlock_metrology::screw::{
    Characteristic, Estimate, Gap, GradeVerdict, Judgement, MeanLine, Reached, Status,
};
use serde::{Serialize, Serializer};

use super::evaluation::Evaluation;
use super::sheet::key;
use crate::shared::keys::keys;
use crate::shared::sheet::SheetJson;

keys! {
    /// A whole evaluation; `asked` is the grade asked for, and whether it is met.
    ScrewJson<'a>(found: &'a Evaluation, asked: Option<(&'a str, bool)>) {
        standard: &'a str = &found.standard,
        lead_mm: f64 = found.lead_mm,
        useful_travel_mm: f64 = found.curve.length_mm(),
        from_mm: f64 = found.curve.first_mm(),
        to_mm: f64 = found.curve.last_mm(),
        samples: usize = found.curve.travel_mm().len(),
        samples_per_turn: f64 = found.samples_per_turn,
        intervals_in_300_mm: Option<usize> = found.intervals_in_300_mm,
        mean_line: MeanLineJson = MeanLineJson::new(&found.mean_line),
        #[serde(flatten, serialize_with = "values")]
        values: &'a [Characteristic] = &found.characteristics,
        grade: Option<GradeJson<'a>> = found.grading.grade.as_deref().map(GradeJson::from),
        status: &'static str = found.grading.status.name(),
        refused_by: Option<&'static str> = found.grading.refused_by.map(Status::name),
        uncertainty_um: Option<f64> = found.uncertainty_um,
        #[serde(skip_serializing_if = "Option::is_none")]
        reading_noise_um: Option<f64> = found.reading_noise_um,
        not_judged: &'a [&'static str] = &found.grading.not_judged,
        #[serde(skip_serializing_if = "Option::is_none")]
        asked: Option<AskedJson<'a>> = asked.map(|(grade, holds)| AskedJson::new(grade, holds)),
        characteristics: Vec<CharacteristicJson> =
            found.without_noise().map(|(one, size)| CharacteristicJson::new(one, size)).collect(),
        grades: Vec<VerdictJson<'a>> = found.grading.verdicts.iter().map(VerdictJson::new).collect(),
        gaps: Vec<GapJson> = found.gaps.iter().map(GapJson::new).collect(),
        #[serde(skip_serializing_if = "Option::is_none")]
        sheet: Option<SheetJson<'a>> = found.sheet.as_ref().map(SheetJson::new),
        notes: Vec<String> = found.notes(),
    }

    MeanLineJson(line: &MeanLine) {
        start_um: f64 = line.start_um,
        slope_um_per_m: f64 = line.slope_um_per_mm * 1000.0,
    }

    AskedJson<'a>(grade: &'a str, holds: bool) {
        grade: GradeJson<'a> = grade.into(),
        holds: bool = holds,
    }

    CharacteristicJson(one: &Characteristic, without_noise: Option<Estimate>) {
        symbol: &'static str = one.symbol,
        meaning: &'static str = one.meaning,
        value_um: Option<f64> = one.reached.as_ref().ok().map(|reached| reached.value_um),
        #[serde(skip_serializing_if = "Option::is_none")]
        without_noise: Option<EstimateJson> = without_noise.map(|size| EstimateJson::new(&size)),
        #[serde(flatten)]
        place: Option<PlaceJson> = one.reached.as_ref().ok().map(PlaceJson::new),
        #[serde(skip_serializing_if = "Option::is_none")]
        missing: Option<String> = one.reached.as_ref().err().map(ToString::to_string),
    }

    EstimateJson(size: &Estimate) {
        size_um: f64 = size.size_um,
        uncertainty_um: f64 = size.uncertainty_um,
    }

    PlaceJson(reached: &Reached) {
        at_mm: [f64; 2] = reached.stretch_mm(),
        highest_at_mm: f64 = reached.highest_mm,
        lowest_at_mm: f64 = reached.lowest_mm,
    }

    VerdictJson<'a>(verdict: &'a GradeVerdict) {
        grade: GradeJson<'a> = verdict.grade.as_str().into(),
        holds: bool = verdict.holds,
        probability: Option<f64> = verdict.probability,
        status: &'static str = verdict.status.name(),
        without_limit: &'a [&'static str] = &verdict.without_limit,
        limits: Vec<LimitJson<'a>> = verdict.judgements.iter().map(LimitJson::new).collect(),
    }

    LimitJson<'a>(one: &'a Judgement) {
        symbol: &'static str = one.symbol,
        value_um: f64 = one.value_um,
        limit_um: f64 = one.limit_um,
        holds: bool = one.holds,
        probability: Option<f64> = one.probability,
        status: &'static str = one.status.name(),
        source: &'a str = &one.source,
    }

    GapJson(gap: &Gap) {
        from_mm: f64 = gap.from_mm,
        to_mm: f64 = gap.to_mm,
    }
}

/// A grade as a number, or as text where a table names it otherwise.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum GradeJson<'a> {
    Number(i64),
    Name(&'a str),
}

impl<'a> From<&'a str> for GradeJson<'a> {
    fn from(grade: &'a str) -> Self {
        grade.parse().map_or(Self::Name(grade), Self::Number)
    }
}

/// Each characteristic under its symbol in plain letters.
fn values<S: Serializer>(all: &[Characteristic], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    #[serde(untagged)]
    enum Value {
        Size(Option<f64>),
        Place(Option<[f64; 2]>),
    }
    let mut entries = Vec::new();
    for one in all {
        let key = key(one.symbol);
        let reached = one.reached.as_ref().ok();
        let value_um = || Value::Size(reached.map(|reached| reached.value_um));
        let place = Value::Place(reached.map(Reached::stretch_mm));
        entries.extend([(format!("{key}_um"), value_um()), (format!("{key}_at_mm"), place)]);
        if one.symbol == "e" {
            entries.push(("mean_travel_deviation_um".into(), value_um()));
        }
    }
    serializer.collect_map(entries)
}
