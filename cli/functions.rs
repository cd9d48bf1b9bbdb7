//! The commands that answer in memory, by the names of their functions in other languages.
//!
//! A function takes the words of its command: their names, units, bounds, defaults and messages
//! are stated once. What only says where files go or how to print is left out.

use std::ffi::OsString;

use clap::{Args, Command};

use crate::shared::answer::{Answer, Answering};
use crate::shared::refused::Refused;
use crate::{
    add, compare, diagnose, discover, learn, scale, screw, sim, straightness, sweep, transmission,
};

/// Words of a command that have no meaning without files and text.
const OF_FILES: &[&str] = &["force", "json", "open", "output", "page", "shard", "undo"];

/// A command that answers in memory.
#[derive(Clone, Copy, Debug)]
pub struct Function {
    /// Name of the function.
    pub name: &'static str,
    /// Words of the command, such as `scale iso230`.
    pub words: &'static str,
    command: fn(&'static str) -> Command,
    answer: fn(Command, Vec<OsString>) -> Result<Answer, Refused>,
}

impl Function {
    const fn new<C: Answering>(name: &'static str, words: &'static str) -> Self {
        Self { name, words, command: command::<C>, answer: answer::<C> }
    }

    /// Its words, those of files and text left out.
    #[must_use]
    pub fn command(&self) -> Command {
        (self.command)(self.name)
    }

    /// Works out what the command does with these words.
    ///
    /// # Errors
    ///
    /// [`Refused`] where the command would print an error and have exit status 2.
    pub fn answer(&self, words: Vec<OsString>) -> Result<Answer, Refused> {
        (self.answer)(self.command(), words)
    }
}

/// All of them.
#[must_use]
pub const fn functions() -> &'static [Function] {
    const {
        &[
            Function::new::<sim::Sim>("simulate", "sim"),
            Function::new::<compare::Compare>("compare", "compare"),
            Function::new::<diagnose::Diagnose>("diagnose", "diagnose"),
            Function::new::<discover::Discover>("discover", "discover"),
            Function::new::<add::Add>("add", "add"),
            Function::new::<learn::Learn>("learn", "learn"),
            Function::new::<sweep::Sweep>("sweep", "sweep"),
            Function::new::<screw::Screw>("screw", "screw"),
            Function::new::<straightness::StraightnessCommand>("straightness", "straightness"),
            Function::new::<transmission::TransmissionCommand>("transmission", "transmission"),
            Function::new::<scale::Build>("scale_build", "scale build"),
            Function::new::<scale::Apply>("scale_apply", "scale apply"),
            Function::new::<scale::Iso230>("scale_iso230", "scale iso230"),
            Function::new::<scale::Model>("scale_model", "scale model"),
        ]
    }
}

fn command<C: Args>(name: &'static str) -> Command {
    let whole = C::augment_args(Command::new(name).no_binary_name(true));
    whole.disable_help_flag(true).mut_args(|word| {
        let of_files = OF_FILES.contains(&word.get_id().as_str());
        if of_files { word.required(false).hide(true) } else { word }
    })
}

fn answer<C: Answering>(command: Command, words: Vec<OsString>) -> Result<Answer, Refused> {
    let matches = command.try_get_matches_from(words)?;
    Ok(C::from_arg_matches(&matches)?.answer()?)
}
