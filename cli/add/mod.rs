//! `helixlock add`: one more effect in a machine file, fitted to data if there are any.

mod formula;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::Args;
use helixlock_lab::{Added, Measurement, Problem, add, written};
use helixlock_plant::{At, MachineFile, Term};

use crate::shared::angular::in_unit;
use crate::shared::answer::{Answer, Answering};
use crate::shared::captured::Signals;
use crate::shared::diagnosis_json::{EffectJson, effects};
use crate::shared::effect_file::{effect_text, own_effects};
use crate::shared::input::{Input, machine_files};
use crate::shared::keys::keys;
use crate::shared::next::Next;
use crate::shared::{diagnosis_text, measured, output};

/// Put an effect into a machine file, its parameters fitted to data
#[derive(Debug, Args)]
pub(crate) struct Add {
    /// Machine file
    machine: PathBuf,
    /// Name of an effect of the catalogue, or a TOML file with one `[[effect]]`, such as a custom one
    #[arg(required_unless_present = "formula", conflicts_with = "formula")]
    effect: Option<String>,
    /// A formula as a `custom` effect, such as `k*ramp(position_mm - at_mm)`: words that are no columns are its parameters
    #[arg(long, value_name = "FORMULA")]
    formula: Option<String>,
    /// Where the formula enters
    #[arg(long, requires = "formula", default_value = "motion")]
    entry: String,
    /// What the formula is called
    #[arg(long, requires = "formula", default_value = "formula")]
    name: String,
    /// Measured data to fit its parameters to
    #[arg(long, value_name = "DATA")]
    fit: Option<PathBuf>,
    /// Fit the effects that the machine file has already along with it
    #[arg(long, requires = "fit")]
    refit: bool,
    /// With `--refit`, leave the first N effects of the machine file as they are
    #[arg(long, value_name = "N", default_value_t = 0, requires = "refit")]
    keep: usize,
    /// A parameter, such as `amplitude="1.5 um"`; with `--fit` only where a formula's search begins
    #[arg(long = "set", value_name = "KEY=VALUE")]
    values: Vec<String>,
    #[command(flatten)]
    signals: Signals,
    /// New machine file
    #[arg(short, long, required = true)]
    output: Option<PathBuf>,
    /// Let the new machine file replace the old one
    #[arg(long)]
    force: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Add {
    /// Writes the new machine file; exit status 1 when the effect has no influence on the data.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let output = self.output.as_deref().context("no file, expected `-o FILE`")?;
        let file = MachineFile::read(&self.machine)?;
        let Some(data) = &self.fit else {
            let new = self.with_given_values(&file)?;
            self.write(output, &new, &file)?;
            writeln!(out, "{}: {} added", output.display(), self.what())?;
            return Ok(ExitCode::SUCCESS);
        };
        let Fitted { base, problem, added, name } = self.fitted(file, data)?;
        let Some(added) = added else {
            writeln!(out, "{name} has no influence on these data")?;
            return Ok(ExitCode::from(1));
        };
        self.write(output, &written(&base, &added.effects)?, &base)?;
        let unit = problem.measurement.unit_word();
        if self.json {
            output::print_json(out, &in_unit(&AddedJson::new(&added, unit), unit)?)?;
        } else {
            print(out, &added, problem.measurement.unit())?;

            let next = Next::command("compare").words([output, data]);
            next.words(self.signals.words()).print(out)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Fits the effect to the data.
    fn fitted(&self, file: MachineFile, data: &Path) -> anyhow::Result<Fitted> {
        if self.formula.is_none() && !self.values.is_empty() {
            bail!(
                "--set {}: found with --fit, which finds the values",
                self.values.join(" --set ")
            );
        }
        let (base, beside) =
            if self.refit { stripped(&file, self.keep)? } else { (file, Vec::new()) };
        let problem = measured::problem(&base.model, data, Input::read(data)?, &self.signals)?;
        let term = self.term(&base, &problem.measurement)?;
        let added = add(&problem, &beside, &term)
            .with_context(|| format!("{} cannot be fitted", term.name))
            .context(At::file(data))?;
        Ok(Fitted { base, problem, added, name: term.name })
    }

    /// The effect in words.
    fn what(&self) -> &str {
        self.effect.as_deref().unwrap_or(&self.name)
    }

    /// The effect as it stands before the fit.
    fn term(&self, file: &MachineFile, measurement: &Measurement) -> anyhow::Result<Term> {
        if let Some(formula) = self.given() {
            let logged = |word: &str| measurement.covariates.contains_key(word);
            return formula.to_be_fitted(&logged);
        }
        if let Some(card) = Term::card(self.what()).filter(|card| !card.parameters.is_empty()) {
            return Ok(Term::candidate(card, file.model.rotary));
        }
        own_effects(file, Path::new(self.what())).map(|mut terms| terms.remove(0))
    }

    fn given(&self) -> Option<formula::Given<'_>> {
        let formula = self.formula.as_deref()?;
        Some(formula::Given { formula, name: &self.name, entry: &self.entry, values: &self.values })
    }

    /// The file with the effect's table as the user gave it.
    fn with_given_values(&self, file: &MachineFile) -> anyhow::Result<MachineFile> {
        if let Some(formula) = self.given() {
            return Ok(file.with_effect(&formula.as_given()?)?);
        }
        let effect = Path::new(self.what());
        let (text, path) = if Term::card(self.what()).is_some() {
            let mut text = format!("[[effect]]\nkind = \"{}\"\n", self.what());
            for pair in &self.values {
                let Some((key, value)) = pair.split_once('=') else {
                    bail!("--set {pair}: found no `=`, expected KEY=VALUE");
                };
                let plain = value.parse::<f64>().is_ok()
                    || value.starts_with(['"', '\'', '[', '{'])
                    || matches!(value, "true" | "false");
                let value = if plain { value.to_owned() } else { format!("\"{value}\"") };
                text.extend([key.trim(), " = ", &value, "\n"]);
            }
            (text, Path::new("--set"))
        } else {
            (effect_text(effect)?, effect)
        };
        Ok(file.with_text(&text, path)?)
    }

    /// Writes the new file; what was read is spared unless the user says otherwise of the machine.
    fn write(&self, output: &Path, new: &MachineFile, old: &MachineFile) -> anyhow::Result<()> {
        let mut inputs = machine_files(&self.machine, &old.model);
        if self.force {
            inputs.remove(0);
        }
        inputs.extend(self.fit.clone());
        inputs.extend(self.effect.as_ref().map(PathBuf::from));
        output::write_content(output, inputs, new.text())
    }
}

/// A fit and what it began with.
struct Fitted {
    /// The machine file without the effects that are fitted.
    base: MachineFile,
    problem: Problem,
    /// `None` where the effect has no influence on the data.
    added: Option<Added>,
    /// Name of the effect.
    name: String,
}

impl Answering for Add {
    /// With the text `machine`; nothing else where nothing is fitted.
    fn answer(&self) -> anyhow::Result<Answer> {
        let file = MachineFile::read(&self.machine)?;
        let Some(data) = &self.fit else {
            let new = self.with_given_values(&file)?;
            return Ok(Answer::new(&serde_json::Map::new())?.with_text("machine", new.text()));
        };
        let Fitted { base, problem, added, name } = self.fitted(file, data)?;
        let added = added.with_context(|| format!("{name} has no influence on these data"))?;
        let unit = problem.measurement.unit_word();
        let answer = Answer::in_unit(&AddedJson::new(&added, unit), unit)?;
        Ok(answer.with_text("machine", written(&base, &added.effects)?.text()))
    }
}

/// The machine file without its effects behind the first `keep`, and those effects.
fn stripped(file: &MachineFile, keep: usize) -> anyhow::Result<(MachineFile, Vec<Term>)> {
    let terms: Vec<Term> = file.model.effects.iter().skip(keep).cloned().collect();
    let mut bare = file.clone();
    for _ in &terms {
        bare = bare.without_effect(keep)?;
    }
    Ok((bare, terms))
}

keys! {
    AddedJson<'a>(added: &'a Added, unit: &'static str) {
        effects: Vec<EffectJson<'a>> = effects(&added.effects),
        unit: &'static str = unit,
        rms_before_um: f64 = added.rms_um[0],
        rms_um: f64 = added.rms_um[1],
        holdout_rms_before_um: f64 = added.holdout_rms_um[0],
        holdout_rms_um: f64 = added.holdout_rms_um[1],
        evidence: f64 = added.gain,
    }
}

fn print(out: &mut impl Write, added: &Added, unit: &str) -> anyhow::Result<()> {
    writeln!(out, "error:     {:.4} → {:.4} {unit} rms", added.rms_um[0], added.rms_um[1])?;
    writeln!(
        out,
        "held out:  {:.4} → {:.4} {unit} rms",
        added.holdout_rms_um[0], added.holdout_rms_um[1]
    )?;
    if added.evidence < 0.0 {
        writeln!(out, "note:      noise would give as much (evidence {:.1})", added.evidence)?;
    }
    for effect in &added.effects {
        diagnosis_text::print_effect(out, effect)?;
    }
    Ok(())
}
