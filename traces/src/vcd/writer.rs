//! Writes dumps: scopes from dotted names, first values, then every change.

use std::io::{self, Write};

use ::vcd::{IdCode, ReferenceIndex, SimulationCommand, VarType, Writer};

use crate::number::write_number;
use crate::vcd::Tick;

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

/// Writes a dump change by change; what does not change is not written.
///
/// # Examples
///
/// ```
/// use helixlock_traces::{Tick, Variable, VcdWriter};
///
/// let variables = [Variable::bits("device.step", 1), Variable::real("plant.error_um")];
/// let mut text = Vec::new();
/// let mut dump = VcdWriter::new(&mut text, Tick::NANOSECOND, &variables)?;
/// dump.bits(0, 0)?;
/// dump.real(1, -0.25)?;
/// dump.at(1_000)?;
/// dump.bits(0, 1)?;
/// dump.finish(2_000)?;
/// assert!(String::from_utf8_lossy(&text).contains("#1000\n1!\n#2000\n"));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct VcdWriter<W: Write> {
    out: Dump<W>,
    variables: Vec<Written>,
    time: u64,
    /// Time of the last `#` line; `None` until the first values are out.
    stamped: Option<u64>,
}

/// The library's writer, which does not print itself.
struct Dump<W: Write>(Writer<W>);

impl<W: Write> std::fmt::Debug for Dump<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Dump")
    }
}

#[derive(Clone, Copy, Debug)]
struct Written {
    code: IdCode,
    width: Option<u32>,
    /// Bits of the value, or of the real number.
    now: Option<u64>,
}

impl<W: Write> VcdWriter<W> {
    /// Writes the header; variables are then named by their index.
    ///
    /// Variables of one scope need not stand together.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn new(out: W, tick: Tick, variables: &[Variable]) -> io::Result<Self> {
        let mut out = Writer::new(out);
        out.version("helixlock")?;
        out.timescale(tick.count, tick.unit)?;
        let written = declare(&mut out, variables)?;
        out.enddefinitions()?;
        Ok(Self { out: Dump(out), variables: written, time: 0, stamped: None })
    }

    /// Puts the first values at this time instead of 0; has no effect once they are out.
    pub fn begin_at(&mut self, ticks: u64) {
        if self.stamped.is_none() {
            self.time = ticks;
        }
    }

    /// Goes on to a later time, in ticks; what is set before the first call are first values.
    ///
    /// # Errors
    ///
    /// A time before the present one, or those of the output.
    pub fn at(&mut self, ticks: u64) -> io::Result<()> {
        if ticks < self.time {
            let message = format!("time goes back from {} to {ticks} ticks", self.time);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        if self.stamped.is_none() {
            self.first_values()?;
        }
        self.time = ticks;
        Ok(())
    }

    /// Sets a bundle of bits; bits above its width are cut off.
    ///
    /// # Errors
    ///
    /// Those of the output.
    pub fn bits(&mut self, variable: usize, value: u64) -> io::Result<()> {
        let width = self.variables[variable].width.unwrap_or(64);
        self.set(variable, value & (u64::MAX >> (64 - width)))
    }

    /// Sets a real number.
    ///
    /// # Errors
    ///
    /// Those of the output.
    pub fn real(&mut self, variable: usize, value: f64) -> io::Result<()> {
        self.set(variable, value.to_bits())
    }

    /// Marks the end of the record, in ticks, and flushes.
    ///
    /// # Errors
    ///
    /// A time before the present one, or those of the output.
    pub fn finish(mut self, ticks: u64) -> io::Result<()> {
        self.at(ticks)?;
        self.stamp()?;
        self.out.0.flush()
    }

    fn set(&mut self, variable: usize, value: u64) -> io::Result<()> {
        if self.variables[variable].now == Some(value) {
            return Ok(());
        }
        self.variables[variable].now = Some(value);
        if self.stamped.is_none() {
            return Ok(());
        }
        self.stamp()?;
        self.write(variable)
    }

    fn stamp(&mut self) -> io::Result<()> {
        if self.stamped != Some(self.time) {
            self.out.0.timestamp(self.time)?;
            self.stamped = Some(self.time);
        }
        Ok(())
    }

    fn first_values(&mut self) -> io::Result<()> {
        self.out.0.timestamp(self.time)?;
        self.stamped = Some(self.time);
        self.out.0.begin(SimulationCommand::Dumpvars)?;
        for variable in 0..self.variables.len() {
            self.write(variable)?;
        }
        self.out.0.end()
    }

    fn write(&mut self, variable: usize) -> io::Result<()> {
        let Written { code, width, now } = self.variables[variable];
        let out = &mut self.out.0;
        match (width, now) {
            (Some(1), Some(value)) => out.change_scalar(code, value == 1),
            (Some(1), None) => out.change_scalar(code, ::vcd::Value::X),
            (Some(_), Some(value)) => writeln!(out.writer(), "b{value:b} {code}"),
            (Some(_), None) => writeln!(out.writer(), "bx {code}"),
            (None, value) => {
                let out = out.writer();
                out.write_all(b"r")?;
                match value.map(f64::from_bits).filter(|value| value.is_finite()) {
                    Some(value) => write_number(out, value)?,
                    None => out.write_all(b"nan")?,
                }
                writeln!(out, " {code}")
            }
        }
    }
}

/// Writes scopes and variables, each in the order it first came.
fn declare<W: Write>(out: &mut Writer<W>, variables: &[Variable]) -> io::Result<Vec<Written>> {
    let codes = std::iter::successors(Some(IdCode::FIRST), |code| Some(code.next()));
    let written: Vec<_> = variables
        .iter()
        .zip(codes)
        .map(|(variable, code)| Written { code, width: variable.width, now: None })
        .collect();
    // A variable stands in a scope, by the format.
    let scoped = |path: &str| if path.contains('.') { path.into() } else { format!("top.{path}") };
    let paths: Vec<String> = variables.iter().map(|variable| scoped(&variable.path)).collect();
    let named: Vec<_> = paths.iter().map(String::as_str).zip(&written).collect();
    declare_scope(out, &named)?;
    Ok(written)
}

/// Paths are those below the scope being written.
fn declare_scope<W: Write>(out: &mut Writer<W>, inside: &[(&str, &Written)]) -> io::Result<()> {
    let mut scopes: Vec<(&str, Vec<(&str, &Written)>)> = Vec::new();
    for (path, written) in inside {
        let Some((scope, below)) = path.split_once('.') else {
            declare_variable(out, path, written)?;
            continue;
        };
        match scopes.iter_mut().find(|(known, _)| *known == scope) {
            Some((_, inside)) => inside.push((below, written)),
            None => scopes.push((scope, vec![(below, written)])),
        }
    }
    for (scope, inside) in scopes {
        out.add_module(scope)?;
        declare_scope(out, &inside)?;
        out.upscope()?;
    }
    Ok(())
}

fn declare_variable<W: Write>(out: &mut Writer<W>, name: &str, to: &Written) -> io::Result<()> {
    let range = |width: u32| ReferenceIndex::Range(width.cast_signed() - 1, 0);
    match to.width {
        None => out.var_def(VarType::Real, 64, to.code, name, None),
        Some(1) => out.var_def(VarType::Wire, 1, to.code, name, None),
        Some(width) => out.var_def(VarType::Wire, width, to.code, name, Some(range(width))),
    }
}
