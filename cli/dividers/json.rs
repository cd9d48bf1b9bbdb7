//! The keys of `dividers --json`; they do not change.

use helixlock_plant::Range;
use helixlock_plant::dividers::{LineCount, Setting, Task, centre_phase, phase_deg};

use crate::shared::keys::keys;

keys! {
    SettingsJson(found: &[(Option<Setting>, Task)]) {
        settings: Vec<LeadJson> =
            found.iter().map(|(setting, task)| LeadJson::new(task, *setting)).collect(),
    }

    LeadJson(task: &Task, setting: Option<Setting>) {
        lead: String = task.lead.to_string(),
        lead_mm: f64 = task.lead.mm(),
        lines: u32 = task.lines,
        #[serde(skip_serializing_if = "Option::is_none")]
        wavelength_um: Option<f64> = setting.map(|_| task.wavelength_um),
        reachable: bool = setting.is_some(),
        #[serde(flatten)]
        setting: Option<SettingJson> = setting.map(|setting| SettingJson::new(task, setting)),
    }

    SettingJson(task: &Task, one: Setting) {
        a: u16 = one.a,
        b: u16 = one.b,
        ranges: [RangeJson; 2] =
            [Range::X1, Range::X2].map(|range| RangeJson::new(task, &one, range)),
        residual_ppm: f64 = one.residual_ppm,
        residual_um_per_m: f64 = one.residual_ppm,
        compensation_f: Option<u32> = one.compensation().map(|(_, cycle)| cycle),
        compensation_um_per_m: Option<f64> = one.compensation().map(|(rate, _)| rate),
        compensated_ppm: Option<f64> = one.compensation().map(|(rate, _)| one.residual_ppm + rate),
    }

    RangeJson(task: &Task, setting: &Setting, range: Range) {
        range: u16 = range.factor(),
        full_scale_um: f64 = setting.full_scale_um(task, range),
        initial_phase: u16 = centre_phase(setting.b, range),
        initial_phase_deg: f64 = phase_deg(centre_phase(setting.b, range), setting.b, range),
    }

    TracksJson(tracks: &[(&'static str, Vec<LineCount>)]) {
        tracks: Vec<TrackJson> =
            tracks.iter().map(|(leads, found)| TrackJson::new(leads, found)).collect(),
    }

    TrackJson(leads: &'static str, found: &[LineCount]) {
        leads: &'static str = leads,
        line_counts: Vec<CountJson> = found.iter().map(CountJson::new).collect(),
    }

    CountJson(count: &LineCount) {
        lines: u32 = count.lines,
        fringes_per_line: String = count.ratio.to_string(),
        residual_ppm: f64 = count.residual_ppm,
        largest_preset: i64 = count.largest_preset,
    }
}
