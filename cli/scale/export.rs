//! `helixlock scale export`: a table for a machine control.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use helixlock_metrology::scale::{LinuxCnc, linuxcnc_file, nominal_actual_csv, siemens_file};

use super::image::read_image;
use crate::shared::next::Next;
use crate::shared::output::write_content;

/// Write a table in the format of a machine control
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// EEPROM image, Intel HEX or binary
    #[arg(value_name = "IMAGE")]
    image: PathBuf,
    /// Format
    #[arg(long, value_enum)]
    format: Format,
    /// Axis, for Siemens
    #[arg(long, value_name = "AXIS", default_value = "AX1")]
    axis: String,
    /// File to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Formats on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Compensation file, `COMP_FILE_TYPE = 0`
    Linuxcnc,
    /// Nominal and actual positions, in the style of Heidenhain and Siemens
    Csv,
    /// `$AA_ENC_COMP` program
    Siemens,
}

impl Export {
    /// Does it.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let table = read_image(&self.image)?;
        let inputs = [self.image.clone()];
        match self.format {
            Format::Linuxcnc => {
                let LinuxCnc { text, every, lost_um } = linuxcnc_file(&table);
                write_content(&self.output, inputs, text)?;
                if 1 < every {
                    writeln!(
                        out,
                        "note: one place in {every}, as this control takes no more rows; at those \
                         between them the correction is up to {lost_um:.3} um off"
                    )?;
                }
            }
            Format::Csv => write_content(&self.output, inputs, nominal_actual_csv(&table))?,
            Format::Siemens => {
                write_content(&self.output, inputs, siemens_file(&table, &self.axis))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Says how an image becomes a file of a control.
pub(super) fn print_export(out: &mut impl Write, image: &Path) -> anyhow::Result<()> {
    let next = Next::command("scale").words(["export"]).words([image]);
    next.words(["--format", "linuxcnc"]).output("axis.comp").print(out)
}
