//! Two circuits answer alike from power-up on, for ever: abc proves it, or finds where they part.
//!
//! Of both a sequential miter is made: one output, high when any of theirs differ. Registers that
//! nothing sets start at zero. Nothing is paired by name: abc merges what is equal in every state
//! that can be reached (signal correspondence), and goes on with interpolation and reachability
//! where that is not enough.

use std::process::Command;

use crate::tools::{run, yosys};

/// What became of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Likeness {
    /// For every input, for ever.
    Alike,
    /// There are inputs with which they differ so many clocks after power-up.
    Differ {
        /// The clock, from 0.
        clock: u32,
    },
    /// Neither could be shown, or a tool refused one of them.
    Open,
}

/// Compares two circuits with ports of the same names, each the flat module `top` that a script of
/// yosys leaves; and what the tools said.
///
/// # Errors
///
/// When a tool cannot be started, or there is no place for scratch files.
pub fn alike(top: &str, right: &str, other: &str) -> anyhow::Result<(Likeness, String)> {
    let folder = tempfile::tempdir()?;
    let miter = folder.path().join("both.aig");
    let script = format!(
        "{right} design -stash right; {other} design -stash other; \
         design -copy-from right -as right {top}; design -copy-from other -as other {top}; \
         miter -equiv -flatten right other both; hierarchy -top both; setundef -zero -init; \
         techmap; aigmap; write_aiger -zinit {}",
        miter.display()
    );
    let (content, mut log) = yosys(&script)?;
    if !content {
        return Ok((Likeness::Open, log));
    }
    // Rewriting first leaves signal correspondence a quarter of its work.
    let steps = format!("read {}; dc2; scorr; dprove; print_status", miter.display());
    // It leaves files of its own where it runs.
    let mut abc = Command::new("yosys-abc");
    let (_, said) = run(abc.args(["-c", &steps]).current_dir(folder.path()), "yosys")?;
    log.push_str(&said);
    Ok((likeness(&said), log))
}

/// From `Status = 0  Frames = -1   CEX: Po =   0  Frame =   2  FF = 6`, with 1 for a proof.
fn likeness(said: &str) -> Likeness {
    let number = |name: &str| -> Option<i64> {
        let (_, rest) = said.rsplit_once(name)?;
        rest.split_whitespace().next()?.parse().ok()
    };
    let clock = number(" Frame =").and_then(|clock| u32::try_from(clock).ok());
    match (number("Status ="), clock) {
        (Some(1), _) => Likeness::Alike,
        (Some(0), Some(clock)) => Likeness::Differ { clock },
        _ => Likeness::Open,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_abc_says_is_understood() {
        let differ = "Status = 0  Frames = -1   CEX: Po =   0  Frame =   2  FF = 6  PI = 4";
        assert_eq!(likeness(differ), Likeness::Differ { clock: 2 });
        assert_eq!(likeness("Status = 1  Frames = -1   Cex is not defined."), Likeness::Alike);
        assert_eq!(likeness("Status = -1  Frames = 40   Cex is not defined."), Likeness::Open);
        assert_eq!(likeness("Error: Empty network."), Likeness::Open);
    }
}
