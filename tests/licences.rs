//! Licences and origins of everything that is linked, by the rules of `deny.toml`.
//!
//! `cargo deny` reads the same file; this test does without it. Manifests of packages that this
//! machine has never built, those of other systems, are downloaded.

use serde_json::Value;
use spdx::{Expression, ParseMode};
use std::process::Command;

fn allowed() -> Vec<String> {
    let text = include_str!("../deny.toml");
    let rules: toml_edit::DocumentMut = text.parse().expect("deny.toml is TOML");
    let names = rules["licenses"]["allow"].as_array().expect("a list of licences");
    names.iter().filter_map(|name| Some(name.as_str()?.to_owned())).collect()
}

fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("a list of packages").clone()
}

fn permits(allowed: &[String], licence: &str) -> bool {
    let expression = Expression::parse_mode(licence, ParseMode::LAX).expect(licence);
    expression.evaluate(|asked| {
        // An exception only ever permits more.
        asked.license.id().is_some_and(|id| allowed.iter().any(|name| name == id.name))
    })
}

#[test]
fn every_package_is_under_a_licence_that_is_allowed() {
    let allowed = allowed();
    for package in packages() {
        let licence = package["license"].as_str().unwrap_or("none");
        assert!(permits(&allowed, licence), "{}: {licence}", package["name"]);
    }
}

#[test]
fn every_package_comes_from_the_registry_or_from_here() {
    for package in packages() {
        let from_registry = package["source"].as_str().is_none_or(|s| s.starts_with("registry+"));
        assert!(from_registry, "{}: {}", package["name"], package["source"]);
    }
}

#[test]
fn copyleft_is_not_allowed() {
    let allowed = allowed();
    assert!(!permits(&allowed, "GPL-3.0-only") && !permits(&allowed, "MIT AND LGPL-2.1-or-later"));
    assert!(permits(&allowed, "MIT/Apache-2.0") && permits(&allowed, "GPL-3.0-only OR MIT"));
}
