//! The serial port a board is on, or a file of what once came from it.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Context, anyhow, bail};
use serial2::SerialPort;

/// Bits a second, both ways; eight data bits, no parity, one stop bit.
const BAUD: u32 = 115_200;

const HINT: &str = "\n\nhint: `helixlock board list` shows the ports";

/// After this without a byte the port is asked again: an end of the program is not held up longer.
const PATIENCE: Duration = Duration::from_millis(200);

/// Longer than this no request takes to be sent.
const WRITING: Duration = Duration::from_secs(2);

/// Where bytes come from.
#[derive(Debug)]
pub(super) enum Source {
    Port(Line),
    File(File),
}

impl Source {
    /// Opens a port, or a file if it is one.
    pub(super) fn open(path: &Path) -> anyhow::Result<Self> {
        let place = || path.display().to_string();
        if path.is_file() {
            return Ok(Self::File(File::open(path).with_context(place)?));
        }
        Ok(Self::Port(Line::new(open_port(path)?)))
    }

    /// The next bytes; none at the end.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Port(line) => loop {
                if let Some(got) = line.read(bytes)? {
                    return Ok(got);
                }
            },
            Self::File(file) => file.read(bytes),
        }
    }
}

/// A port that is ours alone.
#[derive(Debug)]
pub(super) struct Line(SerialPort);

impl Line {
    pub(super) fn new(port: SerialPort) -> Self {
        Self(port)
    }

    /// The next bytes; nothing when it was silent for a while, no byte when it has gone.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<Option<usize>> {
        match self.0.read(bytes) {
            Err(error) if is_wait(&error) => Ok(None),
            // What a pseudo-terminal says when the other side has gone; a port, when unplugged.
            Err(error) if error.raw_os_error() == Some(GONE) => Ok(Some(0)),
            got => got.map(Some),
        }
    }

    /// Sends all of these.
    pub(super) fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write_all(bytes)
    }
}

/// Opens a port that no other program of ours has.
pub(super) fn open_port(path: &Path) -> anyhow::Result<SerialPort> {
    let place = || path.display().to_string();
    if path.is_dir() {
        bail!("{}: found a folder, expected a serial port{HINT}", place());
    }
    let opened = SerialPort::open(path, BAUD);
    if opened.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::ResourceBusy) {
        bail!("{}: another program has this port", place());
    }
    let mut port =
        opened.map_err(|error| anyhow!("{}: no serial port: {error}{HINT}", path.display()))?;
    if !is_ours(&port).with_context(place)? {
        bail!("{}: another program has this port", place());
    }
    port.set_read_timeout(PATIENCE).with_context(place)?;
    port.set_write_timeout(WRITING).with_context(place)?;
    Ok(port)
}

/// Locks it, as programs for serial ports do; false when another one has.
#[cfg(unix)]
fn is_ours(port: &SerialPort) -> io::Result<bool> {
    use std::fs::TryLockError;
    use std::os::fd::AsFd;

    // The lock is that of the open port, and lasts as long as it does.
    let same = File::from(port.as_fd().try_clone_to_owned()?);
    match same.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

/// Where a port is opened once only.
#[cfg(not(unix))]
fn is_ours(_port: &SerialPort) -> io::Result<bool> {
    Ok(true)
}

/// EIO.
const GONE: i32 = 5;

fn is_wait(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::TimedOut | io::ErrorKind::Interrupted)
}

/// Prints the ports, one a line.
pub(super) fn list(out: &mut impl Write) -> anyhow::Result<ExitCode> {
    let mut ports = SerialPort::available_ports().context("the serial ports")?;
    ports.sort();
    for port in &ports {
        writeln!(out, "{}", port.display())?;
    }
    if ports.is_empty() {
        writeln!(out, "no serial port; is the board plugged in?")?;
    }
    Ok(if ports.is_empty() { ExitCode::from(1) } else { ExitCode::SUCCESS })
}
