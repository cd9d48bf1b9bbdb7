//! Tables of five million rows through the whole command: processor time against `mawk` that does
//! no more than add a column up, and the most memory that was ever held.
//!
//! Only the ratios are to be quoted: machines differ. Time and memory are what Linux says of the
//! process.

use std::fs;
use std::io::{self, Error, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use helixlock_traces::csv::write_csv;
use helixlock_traces::parquet::write_parquet;
use helixlock_traces::{Column, Table};

const ROWS: u32 = 5_000_000;
/// How often a process is looked at; what it takes after the last look is missed.
const LOOK: Duration = Duration::from_millis(2);

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let files = [folder.join("large.csv"), folder.join("large.parquet")];
    write(&files)?;
    let (yardstick, _) = run(Command::new("mawk")
        .args(["-F", ",", "{ sum += $2 } END { print sum }"])
        .arg(&files[0]))?;
    writeln!(out, "| | processor time, of mawk's {yardstick:.2} s | most memory |")?;
    writeln!(out, "|---|---:|---:|")?;
    for word in ["compare", "diagnose"] {
        for (data, kind) in files.iter().zip(["CSV", "Parquet"]) {
            let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
            command.arg(word).arg("templates/screw-axis.toml").arg(data);
            let (seconds, megabytes) = run(&mut command)?;
            let share = seconds / yardstick;
            writeln!(out, "| {word}, {kind} | {seconds:.2} s, {share:.1} | {megabytes} MB |")?;
        }
    }
    Ok(())
}

/// A screw's wave over 500 m of travel, with something like noise, as a log has it.
#[expect(clippy::disallowed_methods, reason = "into a folder of Cargo's own")]
fn write(files: &[PathBuf; 2]) -> io::Result<()> {
    let rows = || (0..ROWS).map(f64::from);
    let noise = |row: f64| libm::sin(12.9898 * row) * 43_758.545_3;
    let error_um = |row: f64| {
        let wave = 0.5 * libm::sin(std::f64::consts::TAU * row / 60_000.0);
        let part = noise(row) - libm::floor(noise(row));
        libm::round(1e4 * (wave + 0.2 * (part - 0.5))) / 1e4
    };
    let table = Table::new(vec![
        Column { name: "position_mm".into(), values: rows().map(|row| row / 10_000.0).collect() },
        Column { name: "error_um".into(), values: rows().map(error_um).collect() },
    ]);
    let (mut csv, mut parquet) = (Vec::new(), Vec::new());
    write_csv(&table, &mut csv)?;
    write_parquet(&table, &mut parquet)?;
    fs::write(&files[0], csv)?;
    fs::write(&files[1], parquet)
}

/// Processor time of a command, s, and the most memory that it held, MB.
fn run(command: &mut Command) -> io::Result<(f64, u64)> {
    let mut child = command.stdout(Stdio::null()).spawn()?;
    let (mut seconds, mut most) = (0.0_f64, 0);
    let status = loop {
        seconds = seconds.max(processor_s(&child).unwrap_or(0.0));
        most = most.max(held_megabytes(&child).unwrap_or(0));
        if let Some(status) = child.try_wait()? {
            break status;
        }
        sleep(LOOK);
    };
    if status.success() {
        Ok((seconds, most))
    } else {
        Err(Error::other(format!("{command:?}: {status}")))
    }
}

/// Processor time of a process and its kernel so far: Linux counts it in hundredths of a second.
fn processor_s(child: &Child) -> Option<f64> {
    let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    // The name, which may hold anything, ends with the last parenthesis.
    let mut words = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut hundredths = || words.next()?.parse::<f64>().ok();
    Some((hundredths()? + hundredths()?) / 100.0)
}

/// The high water mark of a process that runs; nothing of one that has ended.
fn held_megabytes(child: &Child) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kib| kib * 1024 / 1_000_000)
}
