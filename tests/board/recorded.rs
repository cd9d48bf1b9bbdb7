//! `board watch` on bytes: lost and damaged ones, and a pass as a measurement.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use serial2::SerialPort;
use tempfile::TempDir;

use super::{at_port, hung_up};

/// `board watch` at one end of a pseudo-terminal, these bytes at the other.
fn watched(bytes: &[u8], words: &[&str]) -> Output {
    let (mut here, there) = SerialPort::pair().expect("a pseudo-terminal");
    here.set_write_timeout(Duration::from_secs(20)).expect("it can be set");
    let child = at_port(&there, &[&["watch", "PORT"], words].concat());
    here.write_all(bytes).expect("the other side reads");
    hung_up(child, here)
}

/// A byte turned over and one lost: both frames are said to be damaged, the rest is read.
#[test]
fn lost_bytes_are_noticed() {
    let mut bytes: Vec<u8> = (0..40).flat_map(|number| frame(number, 1000)).collect();
    bytes[40] ^= 0x10;
    bytes.remove(100);
    let count = "38";
    let output = watched(&bytes, &["--json", "--count", count]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains(&format!("{count} comparisons heard, 2 missed, 2 frames damaged")),
        "{said}"
    );
}

const MACHINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/sg7430-6mm/machine.toml");

/// Clocks of a comparison of that machine: 220 of 13906 lines at 6 rpm and 12 MHz.
const PERIOD: u32 = 1_898_461;

/// Bytes of a comparison whose meter was high for so many clocks.
fn frame(number: u16, width: u32) -> Vec<u8> {
    let mut content = vec![1];
    content.extend(number.to_le_bytes());
    content.extend(width.to_le_bytes());
    content.extend(PERIOD.to_le_bytes());
    content.extend(0x3007_u16.to_le_bytes());
    content.extend(crate::telemetry::check(&content).to_le_bytes());
    let mut wire = cobs::encode_vec(&content);
    wire.push(0);
    wire
}

/// `board watch` on a file of these bytes, with a table.
fn kept(folder: &TempDir, bytes: &[u8]) -> Output {
    let recorded = folder.path().join("recorded");
    put_bytes(&recorded, bytes);
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["board", "watch", "recorded", "--machine", MACHINE, "--csv", "pass.csv"])
        .current_dir(folder.path())
        .output()
        .expect("helixlock starts")
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
fn put_bytes(path: &Path, bytes: &[u8]) {
    std::fs::write(path, bytes).expect("the scratch folder is writable");
}

/// A pass of which two comparisons were missed, and the first of the next pass: a table of the one,
/// which `compare` reads. Its places and errors are those of the widths.
#[test]
fn a_recorded_pass_is_a_measurement() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let width = |number: u16| PERIOD / 2 + 1000 * u32::from(number);
    let numbers = (0..400).filter(|number| !(200..202).contains(number)).chain([0]);
    let bytes: Vec<u8> = numbers.flat_map(|number| frame(number, width(number))).collect();
    let output = kept(&folder, &bytes);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("398 comparisons heard, 2 missed, 0 frames damaged"), "{said}");
    let table = std::fs::read_to_string(folder.path().join("pass.csv")).expect("it was written");
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert!(table.starts_with("time_s,position_mm,error_um,steps\n"), "{table}");
    assert_eq!(rows.len(), 398);
    // Comparison 399: 220 lines of 13906 are 0.0949 mm; 150 fringes of 0.6328 µm are a turn at ×2.
    let part = f64::from(width(399)) / f64::from(PERIOD);
    let expected = [
        (399.0 + part) * f64::from(PERIOD) / 12e6,
        (399.0 + part) * 220.0 / 13_906.0 * 6.0,
        (part - 0.5) * 300.0 * 0.632_819_83 / 2.0,
        7.0,
    ];
    for (found, expected) in rows[397].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
    }
    let compared = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["compare", MACHINE, "pass.csv"])
        .current_dir(folder.path())
        .output()
        .expect("helixlock starts");
    assert!(compared.status.success(), "{}", String::from_utf8_lossy(&compared.stderr));

    let again = kept(&folder, &bytes);
    assert_eq!(again.status.code(), Some(2));
    let said = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(said.contains("pass.csv: is there already, expected a new file"), "{said}");
}
