//! `helixlock scale build`: the table of a measured scale.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::anyhow;
use clap::Args;
use helixlock_metrology::scale::{Detector, Direction, JointRule, TableRule, build_table};

use super::image::write_image;
use super::json::BuiltJson;
use super::samples::read_samples;
use super::text;
use crate::shared::output::print_json;
use crate::shared::quantity::{length_mm, length_um, position_mm};

/// Make the EEPROM image from measured errors
#[derive(Debug, Args)]
pub(crate) struct Build {
    /// Measured errors
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Image to write: Intel HEX for `.hex`, binary otherwise
    #[arg(short, long, value_name = "IMAGE")]
    output: PathBuf,
    /// Position of the origin pulse, mm: the table counts from there
    #[arg(long, value_name = "MM", value_parser = position_mm, allow_hyphen_values = true, default_value = "0")]
    origin: f64,
    /// Distance of the table's places, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "1 mm")]
    step: f64,
    /// Weight of the least of the eight bits, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    lsb: f64,
    /// Length of one scale, mm: joints are looked for at its multiples
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "250 mm")]
    joint: f64,
    /// Length about each joint that is bridged from both sides, mm; samples there are not used
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    joint_zone: Option<f64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl Build {
    /// Does it.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let detector = Detector { pitch_mm: 2.0, lsb_um: self.lsb };
        let samples = read_samples(&self.data, self.origin, &detector)?;
        let zone_mm = self.joint_zone.unwrap_or(0.0);
        let joints = JointRule { every_mm: self.joint, first_mm: self.joint, zone_mm };
        let rule = TableRule { step_mm: self.step, lsb_um: self.lsb, joints: Some(joints) };
        let refused = |error| anyhow!("{}: {error}", self.data.display());
        let table = build_table(&samples, &rule).map_err(refused)?;
        write_image(&self.output, [self.data.clone()], &table)
            .map_err(|error| error.context(self.data.display().to_string()))?;
        let mut forward: Vec<(f64, f64)> = samples
            .iter()
            .filter(|sample| sample.direction == Direction::Forward)
            .map(|sample| (sample.position_mm, sample.error_um))
            .collect();
        forward.sort_by(|a, b| a.0.total_cmp(&b.0));
        let found = joints.joints(&forward);
        if self.json {
            print_json(out, &BuiltJson::new(&table, &found, samples.len()))?;
        } else {
            text::print_built(out, &self.output, &table, &found)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
