//! A waveform on its way into a file, whatever the format.

use std::io;

/// A variable to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Scopes and name joined by dots: `device.meter.t1`.
    pub path: String,
    /// Number of bits, 1 to 64; `None` for a real number such as micrometres.
    pub width: Option<u32>,
}

impl Variable {
    /// A bundle of `width` wires, 1 to 64.
    pub fn bits(path: impl Into<String>, width: u32) -> Self {
        Self { path: path.into(), width: Some(width) }
    }

    /// A real number; say the unit in the name.
    pub fn real(path: impl Into<String>) -> Self {
        Self { path: path.into(), width: None }
    }
}

/// Takes a waveform change by change, in the order of time; variables are named by their index.
pub trait Dump {
    /// Puts the first values at this time instead of 0; has no effect once they are out.
    ///
    /// # Errors
    ///
    /// Those of the output.
    fn begin_at(&mut self, ticks: u64) -> io::Result<()>;

    /// Goes on to a later time, in ticks; what is set before the first call are first values.
    ///
    /// # Errors
    ///
    /// A time before the present one, or those of the output.
    fn at(&mut self, ticks: u64) -> io::Result<()>;

    /// Sets a bundle of bits; bits above its width are cut off.
    ///
    /// # Errors
    ///
    /// Those of the output.
    fn bits(&mut self, variable: usize, value: u64) -> io::Result<()>;

    /// Sets a real number.
    ///
    /// # Errors
    ///
    /// Those of the output.
    fn real(&mut self, variable: usize, value: f64) -> io::Result<()>;

    /// Marks the end of the record, in ticks, and flushes; nothing comes after it.
    ///
    /// # Errors
    ///
    /// A time before the present one, or those of the output.
    fn finish(&mut self, ticks: u64) -> io::Result<()>;
}

/// Takes declarations, scope by scope.
pub(crate) trait Declarations {
    fn scope(&mut self, name: &str) -> io::Result<()>;
    fn upscope(&mut self) -> io::Result<()>;
    fn variable(&mut self, index: usize, name: &str) -> io::Result<()>;
}

/// Declares scopes and variables, each in the order it first came; variables of one scope need not
/// stand together.
pub(crate) fn declare(to: &mut impl Declarations, variables: &[Variable]) -> io::Result<()> {
    // A variable stands in a scope, by the formats.
    let scoped = |path: &str| if path.contains('.') { path.into() } else { format!("top.{path}") };
    let paths: Vec<String> = variables.iter().map(|variable| scoped(&variable.path)).collect();
    let named: Vec<_> = paths.iter().map(String::as_str).zip(0..).collect();
    declare_scope(to, &named)
}

/// Paths are those below the scope being declared.
fn declare_scope(to: &mut impl Declarations, inside: &[(&str, usize)]) -> io::Result<()> {
    let mut scopes: Vec<(&str, Vec<(&str, usize)>)> = Vec::new();
    for &(path, index) in inside {
        let Some((scope, below)) = path.split_once('.') else {
            to.variable(index, path)?;
            continue;
        };
        match scopes.iter_mut().find(|(known, _)| *known == scope) {
            Some((_, inside)) => inside.push((below, index)),
            None => scopes.push((scope, vec![(below, index)])),
        }
    }
    for (scope, inside) in scopes {
        to.scope(scope)?;
        declare_scope(to, &inside)?;
        to.upscope()?;
    }
    Ok(())
}
