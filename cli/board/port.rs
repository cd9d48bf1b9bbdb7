//! The serial port a board is on, or a file of what once came from it.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Context, bail};
use serial2::SerialPort;

/// Bits a second, both ways; eight data bits, no parity, one stop bit.
const BAUD: u32 = 115_200;

/// After this without a byte the port is asked again: an end of the program is not held up longer.
const PATIENCE: Duration = Duration::from_millis(200);

/// Where bytes come from.
#[derive(Debug)]
pub(super) enum Source {
    Port(SerialPort),
    File(File),
}

impl Source {
    /// Opens a port, or a file if it is one.
    pub(super) fn open(path: &Path) -> anyhow::Result<Self> {
        let place = || path.display().to_string();
        if path.is_file() {
            return Ok(Self::File(File::open(path).with_context(place)?));
        }
        if path.is_dir() {
            bail!(
                "{}: found a folder, expected a serial port\nhint: helixlock board list",
                place()
            );
        }
        let opened = SerialPort::open(path, BAUD);
        let mut port = opened.with_context(|| {
            format!("{}: no serial port\nhint: helixlock board list", path.display())
        })?;
        port.set_read_timeout(PATIENCE).with_context(place)?;
        Ok(Self::Port(port))
    }

    /// The next bytes; none at the end.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        loop {
            let got = match self {
                Self::Port(port) => port.read(bytes),
                Self::File(file) => return file.read(bytes),
            };
            match got {
                Err(error) if is_wait(&error) => {}
                // What a pseudo-terminal says when the other side has gone; a port, when unplugged.
                Err(error) if error.raw_os_error() == Some(GONE) => return Ok(0),
                got => return got,
            }
        }
    }
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
