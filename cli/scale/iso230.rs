//! `helixlock scale iso230`: positioning accuracy by ISO 230-2.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::anyhow;
use clap::Args;
use helixlock_metrology::scale::Detector;

use super::axis_test::AxisTest;
use super::json::AxisTestJson;
use super::samples::{axis_result, read_samples};
use super::text;
use crate::shared::output::print_json;
use crate::shared::quantity::length_um;

/// Evaluate positioning accuracy by ISO 230-2
#[derive(Debug, Args)]
pub(crate) struct Iso230 {
    /// Measured errors: two approaches or more of every target and direction
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Accuracy A that must not be exceeded, µm; exit status 1 beyond
    #[arg(long, value_name = "UM", value_parser = length_um)]
    limit: Option<f64>,
    /// Expanded uncertainty of A (k = 2), µm: the limit is then decided by ISO 14253-1
    #[arg(long, value_name = "UM", value_parser = length_um, requires = "limit")]
    expanded_uncertainty: Option<f64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl Iso230 {
    /// Does it.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        // Eight-bit codes are of no use here: approaches come as errors.
        let detector = Detector { pitch_mm: 2.0, lsb_um: 1.0 };
        let samples = read_samples(&self.data, 0.0, &detector)?;
        let errors = samples.iter().map(|sample| (*sample, sample.error_um));
        let found =
            axis_result(errors).map_err(|error| anyhow!("{}: {error}", self.data.display()))?;
        let test = AxisTest { limit_um: self.limit, expanded_um: self.expanded_uncertainty, found };
        if self.json {
            print_json(out, &AxisTestJson::new(&test))?;
        } else {
            text::print_axis(out, &test)?;
        }
        Ok(if test.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}
