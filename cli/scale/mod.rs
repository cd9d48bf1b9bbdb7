//! `helixlock scale`: errors of a machine scale stored, applied, exported, modelled.

mod apply;
mod axis_page;
mod axis_test;
mod build;
mod comparison;
mod export;
mod image;
mod iso230;
mod json;
mod model;
mod page;
mod samples;
mod text;

use std::process::ExitCode;

use clap::{Args, Subcommand};

pub(crate) use self::apply::Apply;
pub(crate) use self::build::Build;
use self::export::Export;
pub(crate) use self::iso230::Iso230;
pub(crate) use self::model::Model;
use crate::shared::language::Reporter;

/// Build, apply and export a table of positioning errors
///
/// Errors of a machine scale against a calibrated one are read from `position_mm`, `error_um`
/// (what the machine's scale shows less what is true) and, where known, `direction` (+1, −1). The
/// table is the image of a 2 KiB EEPROM, as Intel HEX (`.hex`) or binary.
#[derive(Debug, Args)]
pub(crate) struct ScaleCommand {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    Build(Build),
    Apply(Apply),
    Export(Export),
    Iso230(Iso230),
    Model(Model),
}

impl ScaleCommand {
    /// Does what the word after `scale` says.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        match self.action {
            Action::Build(build) => build.run(out),
            Action::Apply(apply) => apply.run(out),
            Action::Export(export) => export.run(out),
            Action::Iso230(iso230) => iso230.run(out),
            Action::Model(model) => model.run(out),
        }
    }
}
