//! `helixlock certify` keeps its bound on the examples, and says so.

use std::process::{Command, Output};

fn certify(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .arg("certify")
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the command starts")
}

/// One clock at 12 MHz is 83.3 ns; the table moves 0.6 mm/s or less in all three.
#[test]
fn examples_keep_the_bound() {
    for example in ["sg7430-6mm", "sg7430-sixth-inch", "sg7430-half-pi-module"] {
        let machine = format!("examples/{example}/machine.toml");
        let output = certify(&[&machine, "--length", "20 mm", "--json"]);
        assert_eq!(output.status.code(), Some(0), "{example}: {output:?}");
        let certificate: serde_json::Value =
            serde_json::from_slice(&output.stdout).expect("JSON alone");
        assert_eq!(certificate["holds"], true, "{example}: {certificate}");
        let largest_s = certificate["largest_difference_s"].as_f64().expect("a number");
        assert!((40e-9..83.4e-9).contains(&largest_s), "{example}: {certificate}");
        let largest_um = certificate["largest_difference_um"].as_f64().expect("a number");
        assert!(largest_um < 1e-4, "{example}: {certificate}");
    }
}

#[test]
fn a_missing_file_is_said_by_name() {
    let output = certify(&["nowhere.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nowhere.toml"));
}
