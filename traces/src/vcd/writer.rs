//! Writes value change dumps: scopes from dotted names, first values, then every change.

use std::io::{self, Write};

use ::vcd::{IdCode, ReferenceIndex, SimulationCommand, VarType, Writer};

use crate::dump::{Declarations, Dump, Variable, declare};
use crate::number::write_number;
use crate::vcd::Tick;

/// Writes a dump change by change; what does not change is not written.
///
/// # Examples
///
/// ```
/// use helixlock_traces::{Dump, Tick, Variable, VcdWriter};
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
    out: Library<W>,
    variables: Vec<Written>,
    time: u64,
    /// Time of the last `#` line; `None` until the first values are out.
    stamped: Option<u64>,
}

/// The library's writer, which does not print itself.
struct Library<W: Write>(Writer<W>);

impl<W: Write> std::fmt::Debug for Library<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Library")
    }
}

#[derive(Clone, Copy, Debug)]
struct Written {
    code: IdCode,
    width: Option<u32>,
    /// Bits of the value, or of the real number.
    now: Option<u64>,
}

impl<W: Write> Dump for VcdWriter<W> {
    fn begin_at(&mut self, ticks: u64) -> io::Result<()> {
        if self.stamped.is_none() {
            self.time = ticks;
        }
        Ok(())
    }

    fn at(&mut self, ticks: u64) -> io::Result<()> {
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

    fn bits(&mut self, variable: usize, value: u64) -> io::Result<()> {
        let width = self.variables[variable].width.unwrap_or(64);
        self.set(variable, value & (u64::MAX >> (64 - width)))
    }

    fn real(&mut self, variable: usize, value: f64) -> io::Result<()> {
        self.set(variable, value.to_bits())
    }

    fn finish(&mut self, ticks: u64) -> io::Result<()> {
        self.at(ticks)?;
        self.stamp()?;
        self.out.0.flush()
    }
}

impl<W: Write> VcdWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn new(out: W, tick: Tick, names: &[Variable]) -> io::Result<Self> {
        let mut out = Writer::new(out);
        out.version("helixlock")?;
        out.timescale(tick.count, tick.unit)?;
        let codes = std::iter::successors(Some(IdCode::FIRST), |code| Some(code.next()));
        let variables: Vec<Written> = names
            .iter()
            .zip(codes)
            .map(|(variable, code)| Written { code, width: variable.width, now: None })
            .collect();
        declare(&mut Declaring { out: &mut out, variables: &variables }, names)?;
        out.enddefinitions()?;
        Ok(Self { out: Library(out), variables, time: 0, stamped: None })
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

/// A header whose variables are declared scope by scope.
struct Declaring<'a, W: Write> {
    out: &'a mut Writer<W>,
    variables: &'a [Written],
}

impl<W: Write> Declarations for Declaring<'_, W> {
    fn scope(&mut self, name: &str) -> io::Result<()> {
        self.out.add_module(name)
    }

    fn upscope(&mut self) -> io::Result<()> {
        self.out.upscope()
    }

    fn variable(&mut self, index: usize, name: &str) -> io::Result<()> {
        let range = |width: u32| ReferenceIndex::Range(width.cast_signed() - 1, 0);
        let Written { code, width, .. } = self.variables[index];
        match width {
            None => self.out.var_def(VarType::Real, 64, code, name, None),
            Some(1) => self.out.var_def(VarType::Wire, 1, code, name, None),
            Some(width) => self.out.var_def(VarType::Wire, width, code, name, Some(range(width))),
        }
    }
}
