//! `helixlock scale build`: the table of a measured scale.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Args;
use helixlock_metrology::scale::{
    CorrectionTable, Detector, Direction, Joint, JointRule, TableRule, build_table, to_hex,
    to_image,
};

use super::export::print_export;
use super::image::write_image;
use super::json::BuiltJson;
use super::samples::read_samples;
use super::text;
use crate::shared::answer::{Answer, Answering};
use crate::shared::next::Next;
use crate::shared::output::print_json;
use crate::shared::quantity::{length_mm, length_um, position_mm};
use crate::shared::refused::in_file;

/// Make the EEPROM image from measured errors
#[derive(Debug, Args)]
pub(crate) struct Build {
    /// Measured errors
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Image to write: Intel HEX for `.hex`, binary otherwise
    #[arg(short, long, value_name = "IMAGE", required = true)]
    output: Option<PathBuf>,
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
        let output = self.output.as_deref().context("no image, expected `-o IMAGE`")?;
        let Built { table, joints, samples } = self.built()?;
        write_image(output, [self.data.clone()], &table)
            .map_err(|error| error.context(self.data.display().to_string()))?;
        if self.json {
            print_json(out, &BuiltJson::new(&table, &joints, samples))?;
        } else {
            text::print_built(out, output, &table, &joints)?;
            print_export(out, output)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn built(&self) -> anyhow::Result<Built> {
        let detector = Detector { pitch_mm: 2.0, lsb_um: self.lsb };
        let samples = read_samples(&self.data, self.origin, &detector)?;
        let zone_mm = self.joint_zone.unwrap_or(0.0);
        let joints = JointRule { every_mm: self.joint, first_mm: self.joint, zone_mm };
        let rule = TableRule { step_mm: self.step, lsb_um: self.lsb, joints: Some(joints) };
        let table = build_table(&samples, &rule).map_err(in_file(&self.data))?;
        let mut forward: Vec<(f64, f64)> = samples
            .iter()
            .filter(|sample| sample.direction == Direction::Forward)
            .map(|sample| (sample.position_mm, sample.error_um))
            .collect();
        forward.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(Built { table, joints: joints.joints(&forward), samples: samples.len() })
    }
}

/// Says how measured errors become an image.
pub(super) fn print_build(out: &mut impl Write, data: &Path) -> anyhow::Result<()> {
    Next::command("scale").words(["build"]).words([data]).output("table.hex").print(out)
}

/// A table, and what it was made of.
struct Built {
    table: CorrectionTable,
    joints: Vec<Joint>,
    samples: usize,
}

impl Answering for Build {
    /// With the text `image`, Intel HEX.
    fn answer(&self) -> anyhow::Result<Answer> {
        let Built { table, joints, samples } = self.built()?;
        let image = to_hex(&to_image(&table).map_err(in_file(&self.data))?)?;
        Ok(Answer::new(&BuiltJson::new(&table, &joints, samples))?.with_text("image", image))
    }
}
