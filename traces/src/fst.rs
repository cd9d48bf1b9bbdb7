//! Waveforms in GTKWave's packed format, FST, by the crate `fst-writer`.

use std::io::{self, Seek, Write};

use fst_writer::{
    FstBodyWriter, FstFileType, FstHeaderWriter, FstInfo, FstScopeType, FstSignalId, FstSignalType,
    FstVarDirection, FstVarType, FstWriteError,
};

use crate::dump::{Declarations, Dump, Variable, declare};
use crate::vcd::Tick;

/// Memory that changes take before they are packed and written, bytes.
///
/// Chosen: a run with every signal then stays below 60 MB. Doubled: so does this part of it.
const BLOCK: usize = 32 << 20;

/// Writes a waveform packed, in blocks of bounded size.
pub struct FstWriter<W: Write + Seek> {
    /// `None` once it is finished.
    out: Option<FstBodyWriter<W>>,
    signals: Vec<Signal>,
    time: u64,
    block: usize,
}

#[derive(Clone, Copy)]
struct Signal {
    id: FstSignalId,
    width: u32,
}

impl<W: Write + Seek> std::fmt::Debug for FstWriter<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FstWriter").field("time", &self.time).finish_non_exhaustive()
    }
}

impl<W: Write + Seek> FstWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn new(out: W, tick: Tick, variables: &[Variable]) -> io::Result<Self> {
        let info = FstInfo {
            start_time: 0,
            timescale_exponent: tick.exponent(),
            version: "helixlock".into(),
            date: String::new(), // the same run makes the same bytes
            file_type: FstFileType::Verilog,
        };
        let header = FstHeaderWriter::new(out, &info).map_err(in_io)?;
        let mut declaring = Declaring { header, variables, ids: vec![None; variables.len()] };
        declare(&mut declaring, variables)?;
        let widths = variables.iter().map(|variable| variable.width.unwrap_or(0));
        let signals = declaring.ids.into_iter().flatten().zip(widths);
        Ok(Self {
            signals: signals.map(|(id, width)| Signal { id, width }).collect(),
            out: Some(declaring.header.finish().map_err(in_io)?),
            time: 0,
            block: BLOCK,
        })
    }

    /// Packs whenever the changes take so much memory, bytes.
    #[must_use]
    pub fn in_blocks_of(self, block: usize) -> Self {
        Self { block, ..self }
    }

    fn out(&mut self) -> io::Result<&mut FstBodyWriter<W>> {
        self.out.as_mut().ok_or_else(|| io::Error::other("the record has ended"))
    }
}

impl<W: Write + Seek> Dump for FstWriter<W> {
    fn begin_at(&mut self, ticks: u64) -> io::Result<()> {
        self.at(ticks)
    }

    fn at(&mut self, ticks: u64) -> io::Result<()> {
        // A block ends where a later time begins, never within an instant.
        let later = self.time < ticks;
        self.time = ticks;
        let block = self.block;
        let out = self.out()?;
        if later && block < out.size() {
            out.flush().map_err(in_io)?;
        }
        out.time_change(ticks).map_err(in_io)
    }

    fn bits(&mut self, variable: usize, value: u64) -> io::Result<()> {
        let Signal { id, width } = self.signals[variable];
        let mut digits = [b'0'; 64];
        for (bit, digit) in (0..width).rev().zip(&mut digits) {
            *digit += u8::from((value >> bit) & 1 == 1);
        }
        self.out()?.signal_change(id, &digits[..width as usize]).map_err(in_io)
    }

    fn real(&mut self, variable: usize, value: f64) -> io::Result<()> {
        let Signal { id, .. } = self.signals[variable];
        self.out()?.signal_change(id, &value.to_le_bytes()).map_err(in_io)
    }

    fn finish(&mut self, ticks: u64) -> io::Result<()> {
        self.at(ticks)?;
        match self.out.take() {
            Some(out) => out.finish().map_err(in_io)?.flush(),
            None => Ok(()),
        }
    }
}

/// A header whose variables are declared scope by scope.
struct Declaring<'a, W: Write + Seek> {
    header: FstHeaderWriter<W>,
    variables: &'a [Variable],
    ids: Vec<Option<FstSignalId>>,
}

impl<W: Write + Seek> Declarations for Declaring<'_, W> {
    fn scope(&mut self, name: &str) -> io::Result<()> {
        self.header.scope(name, "", FstScopeType::Module).map_err(in_io)
    }

    fn upscope(&mut self) -> io::Result<()> {
        self.header.up_scope().map_err(in_io)
    }

    fn variable(&mut self, index: usize, name: &str) -> io::Result<()> {
        let (signal, kind, name) = match self.variables[index].width {
            None => (FstSignalType::real(), FstVarType::Real, name.to_owned()),
            Some(1) => (FstSignalType::bit_vec(1), FstVarType::Wire, name.to_owned()),
            Some(width) => {
                let ranged = format!("{name} [{}:0]", width - 1);
                (FstSignalType::bit_vec(width), FstVarType::Wire, ranged)
            }
        };
        let declared = self.header.var(name, signal, kind, FstVarDirection::Implicit, None);
        self.ids[index] = Some(declared.map_err(in_io)?);
        Ok(())
    }
}

fn in_io(error: FstWriteError) -> io::Error {
    match error {
        FstWriteError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other),
    }
}
