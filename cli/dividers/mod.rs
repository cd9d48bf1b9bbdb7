//! `helixlock dividers`: thumb wheels for a lead, line counts for a set of leads.

mod json;

use std::io::Write;
use std::process::ExitCode;

use anyhow::ensure;
use comfy_table::{Table, presets};
use helixlock_plant::dividers::{
    COMPENSATOR_REACH_PPM, LineCount, METRIC_TRACK, MODULE_TRACK, Setting, Task, USUAL_RANGE_UM,
    centre_phase, find_line_counts, phase_deg, solve,
};
use helixlock_plant::units::{UM, read_quantity};
use helixlock_plant::{Lead, LeadUnit, Range};

use self::json::{SettingsJson, TracksJson};
use crate::shared::next::Next;
use crate::shared::output::print_json;

/// Thumb-wheel settings for a lead: A, B, F, initial phase, and the error they leave
#[derive(Debug, clap::Args)]
pub(crate) struct Dividers {
    /// Lead to grind, such as "6 mm", "1/6 in", "10 tpi" or "0.5 pi mm"; may be repeated
    #[arg(long, value_name = "LEAD", allow_hyphen_values = true,
        required_unless_present_any = ["table", "find_lines"])]
    lead: Vec<Lead>,

    /// Lines of the grating [default: 13906, for module leads 11060]
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    lines: Option<u32>,

    /// Wavelength of the laser in the air of the machine
    #[arg(long, value_name = "LENGTH", default_value = "0.63281983 um", value_parser = wavelength)]
    wavelength: f64,

    /// Measuring range to come near to at ×1 [default: 47.5 um]
    #[arg(long, value_name = "LENGTH", value_parser = measuring_range)]
    measuring_range: Option<f64>,

    /// Search line counts that make all leads rational with one compensation
    #[arg(long, conflicts_with = "table")]
    find_lines: bool,

    /// Fewest lines to search
    #[arg(long, value_name = "M", default_value_t = 5_000, requires = "find_lines",
        value_parser = clap::value_parser!(u32).range(100..=1_000_000))]
    min_lines: u32,

    /// Most lines to search
    #[arg(long, value_name = "M", default_value_t = 20_000, requires = "find_lines",
        value_parser = clap::value_parser!(u32).range(100..=1_000_000))]
    max_lines: u32,

    /// Largest residual of a line count, in ppm
    #[arg(long, value_name = "PPM", default_value_t = 1.0, requires = "find_lines",
        value_parser = tolerance)]
    tolerance: f64,

    /// Settings for the usual metric, inch and module leads
    #[arg(long, conflicts_with = "lead")]
    table: bool,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Leads of ordinary screws and worms: metric, inch, module.
const USUAL: &str = "1 mm, 1.5 mm, 2 mm, 2.5 mm, 3 mm, 4 mm, 5 mm, 6 mm, 8 mm, 10 mm, 12 mm, 16 mm, \
    20 mm, 1/2 in, 1/3 in, 1/4 in, 1/5 in, 1/6 in, 1/8 in, 1/10 in, 1/12 in, 0.5 pi mm, 1 pi mm, \
    1.5 pi mm, 2 pi mm, 2.5 pi mm, 3 pi mm, 4 pi mm";

impl Dividers {
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let usual = || USUAL.split(", ").filter_map(|lead| lead.parse().ok()).collect();
        let leads: Vec<Lead> = if self.lead.is_empty() { usual() } else { self.lead.clone() };
        if self.find_lines {
            return self.line_counts(out, &leads);
        }
        let solved = |task: Task| (solve(&task), task);
        let found: Vec<_> = leads.iter().map(|lead| solved(self.task(*lead))).collect();
        if self.json {
            print_json(out, &SettingsJson::new(&found))?;
        } else if let [(Some(setting), task)] = found.as_slice() {
            describe(out, task, setting)?;

            Next::command("init").print(out)?;
        } else if found.iter().any(|(setting, _)| setting.is_some()) {
            writeln!(out, "{}", as_table(&found))?;
        }
        self.refusals(out, &found)
    }

    fn task(&self, lead: Lead) -> Task {
        let track = if lead.unit == LeadUnit::PiMm { MODULE_TRACK } else { METRIC_TRACK };
        Task {
            lead,
            lines: self.lines.unwrap_or(track),
            wavelength_um: self.wavelength,
            range_um: self.measuring_range.unwrap_or(USUAL_RANGE_UM),
        }
    }

    /// Names leads that no wheels reach; then the answer is no.
    fn refusals(
        &self,
        out: &mut impl Write,
        found: &[(Option<Setting>, Task)],
    ) -> anyhow::Result<ExitCode> {
        let mut code = ExitCode::SUCCESS;
        for (_, task) in found.iter().filter(|(setting, _)| setting.is_none()) {
            code = ExitCode::FAILURE;
            if !self.json {
                let Task { lead, lines, .. } = task;
                writeln!(
                    out,
                    "lead {lead} with {lines} lines: no A and B from 1 to 999 come within \
                     {COMPENSATOR_REACH_PPM} ppm, which is what the compensator can take out"
                )?;
            }
        }
        Ok(code)
    }

    fn line_counts(&self, out: &mut impl Write, leads: &[Lead]) -> anyhow::Result<ExitCode> {
        ensure!(
            self.min_lines <= self.max_lines,
            "`--min-lines` is {}, expected at most `--max-lines`, {}",
            self.min_lines,
            self.max_lines
        );
        let module = |lead: &&Lead| lead.unit == LeadUnit::PiMm;
        let kinds = [false, true].map(|kind| -> Vec<Lead> {
            leads.iter().filter(|lead| module(lead) == kind).copied().collect()
        });
        let tracks: Vec<(&'static str, Vec<LineCount>)> = ["metric and inch", "module"]
            .into_iter()
            .zip(&kinds)
            .filter(|(_, leads)| !leads.is_empty())
            .map(|(name, leads)| {
                let lines = self.min_lines..=self.max_lines;
                (name, find_line_counts(leads, self.wavelength, lines, self.tolerance))
            })
            .collect();
        if self.json {
            print_json(out, &TracksJson::new(&tracks))?;
        } else {
            for (name, found) in &tracks {
                track_table(out, name, found)?;
            }
        }
        let complete = tracks.iter().all(|(_, found)| !found.is_empty());
        Ok(if complete { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }
}

/// One lead, in full.
fn describe(out: &mut impl Write, task: &Task, setting: &Setting) -> anyhow::Result<()> {
    let Task { lead, lines, wavelength_um, .. } = task;
    writeln!(out, "lead {lead}, {lines} lines, λ {wavelength_um} µm")?;
    writeln!(out, "  A               {}", setting.a)?;
    writeln!(out, "  B               {}", setting.b)?;
    for range in [Range::X1, Range::X2] {
        let phase = centre_phase(setting.b, range);
        writeln!(
            out,
            "  ×{}  range {:.2} µm, initial phase {phase} pulses ({:.2}°)",
            range.factor(),
            setting.full_scale_um(task, range),
            phase_deg(phase, setting.b, range),
        )?;
    }
    writeln!(out, "  left            {:+.4} ppm (µm/m)", setting.residual_ppm)?;
    match setting.compensation() {
        Some((rate, cycle)) => writeln!(
            out,
            "  compensate      {rate:+.4} µm/m: F {cycle}, {}; then {:+.4} ppm",
            if rate < 0.0 { "insert" } else { "block" },
            setting.residual_ppm + rate,
        )?,
        None => writeln!(out, "  compensate      nothing: less than F can be set to")?,
    }
    Ok(())
}

fn as_table(found: &[(Option<Setting>, Task)]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_FULL_CONDENSED)
        .set_header(["lead", "lines", "A", "B", "×1 µm", "m ×1", "×2 µm", "m ×2", "left ppm", "F"]);
    for (setting, task) in found {
        let Some(setting) = setting else { continue };
        let range = |range| format!("{:.2}", setting.full_scale_um(task, range));
        let phase = |range| centre_phase(setting.b, range).to_string();
        table.add_row([
            task.lead.to_string(),
            task.lines.to_string(),
            setting.a.to_string(),
            setting.b.to_string(),
            range(Range::X1),
            phase(Range::X1),
            range(Range::X2),
            phase(Range::X2),
            format!("{:+.4}", setting.residual_ppm),
            setting.compensation().map_or("–".into(), |(_, cycle)| cycle.to_string()),
        ]);
    }
    table
}

fn track_table(out: &mut impl Write, name: &str, found: &[LineCount]) -> anyhow::Result<()> {
    writeln!(out, "{name} leads: {} line counts serve them all", found.len())?;
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header([
        "lines",
        "B/A per mm",
        "left ppm",
        "largest preset",
    ]);
    for count in found {
        table.add_row([
            count.lines.to_string(),
            count.ratio.to_string(),
            format!("{:+.4}", count.residual_ppm),
            count.largest_preset.to_string(),
        ]);
    }
    if !found.is_empty() {
        writeln!(out, "{table}")?;
    }
    Ok(())
}

fn wavelength(text: &str) -> Result<f64, String> {
    length_um(text, 0.2, 20.0)
}

fn measuring_range(text: &str) -> Result<f64, String> {
    length_um(text, 0.1, 10_000.0)
}

fn length_um(text: &str, low: f64, high: f64) -> Result<f64, String> {
    let length = read_quantity(text, &UM)
        .map_err(|error| format!("found {error}, expected a length such as \"{low} um\""))?;
    if (low..=high).contains(&length) {
        Ok(length)
    } else {
        Err(format!("{length} um is not between {low} um and {high} um"))
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let ppm: f64 = text.parse().map_err(|_| "expected a number of ppm".to_owned())?;
    if 0.0 < ppm && ppm <= COMPENSATOR_REACH_PPM {
        Ok(ppm)
    } else {
        Err(format!("{ppm} is not between 0 and {COMPENSATOR_REACH_PPM}"))
    }
}
