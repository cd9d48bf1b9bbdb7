//! What the command is made of, as SPDX 2.3 in its tag-value form.
//!
//! Packages are those of `Cargo.lock` that `cargo metadata` finds for the command alone: no tests, no
//! tools. It is dated by the commit, so that the same commit gives the same bytes.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, bail};
use serde_json::Value;

/// The list for the tree at `root`.
///
/// # Errors
///
/// `cargo` or `git` that cannot be run, or say something else than they should.
pub fn sbom(root: &Path) -> anyhow::Result<String> {
    let commit = said(root, "git", &["log", "-1", "--format=%H %cI"])?;
    let (hash, date) = commit.trim().split_once(' ').context("a commit with its date")?;
    let metadata = said(root, "cargo", &["metadata", "--format-version", "1", "--locked"])?;
    let metadata: Value = serde_json::from_str(&metadata).context("`cargo metadata`")?;
    let lock = std::fs::read_to_string(root.join("Cargo.lock"))?;
    let lock: toml_edit::DocumentMut = lock.parse().context("Cargo.lock")?;
    let mut text = format!(
        "SPDXVersion: SPDX-2.3\nDataLicense: CC0-1.0\nSPDXID: SPDXRef-DOCUMENT\n\
         DocumentName: helixlock\n\
         DocumentNamespace: https://spdx.org/spdxdocs/helixlock-{hash}\n\
         Creator: Tool: helixlock-evidence\nCreated: {date}\n"
    );
    for package in linked(&metadata)? {
        describe(&mut text, package, &lock);
    }
    Ok(text)
}

/// Packages that the command is linked of, without those for tests and builds.
fn linked(metadata: &Value) -> anyhow::Result<Vec<&Value>> {
    let nodes = metadata["resolve"]["nodes"].as_array().context("a resolved tree")?;
    let root = metadata["resolve"]["root"].as_str().context("the command's package")?;
    let mut known = vec![root];
    let mut next = 0;
    while let Some(id) = known.get(next) {
        let node = nodes.iter().find(|node| node["id"] == **id).context("a package of the tree")?;
        for dependency in node["deps"].as_array().into_iter().flatten() {
            let mut kinds = dependency["dep_kinds"].as_array().into_iter().flatten();
            let linked = kinds.any(|kind| kind["kind"].is_null());
            let id = dependency["pkg"].as_str().context("a dependency")?;
            if linked && !known.contains(&id) {
                known.push(id);
            }
        }
        next += 1;
    }
    let packages = metadata["packages"].as_array().context("packages")?;
    let mut packages: Vec<&Value> = packages
        .iter()
        .filter(|package| package["id"].as_str().is_some_and(|id| known.contains(&id)))
        .collect();
    packages.sort_by_key(|package| (package["name"].to_string(), package["version"].to_string()));
    Ok(packages)
}

fn describe(text: &mut String, package: &Value, lock: &toml_edit::DocumentMut) {
    let word = |key: &str| package[key].as_str().unwrap_or("NOASSERTION").to_owned();
    let (name, version) = (word("name"), word("version"));
    let origin = match package["source"].as_str() {
        Some(_) => format!("https://crates.io/crates/{name}/{version}"),
        None => "NOASSERTION".into(),
    };
    let id = format!("SPDXRef-{name}-{version}").replace(['_', '+'], "-");
    // SPDX knows no `/` between licences, which old manifests write for `OR`.
    let licence = word("license").replace('/', " OR ");
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\nPackageName: {name}\nSPDXID: {id}\nPackageVersion: {version}\n\
         PackageDownloadLocation: {origin}\nFilesAnalyzed: false\n\
         PackageLicenseConcluded: NOASSERTION\nPackageLicenseDeclared: {licence}\n\
         PackageCopyrightText: NOASSERTION\n"
    );
    if let Some(sum) = checksum(lock, &name, &version) {
        let _ = writeln!(text, "PackageChecksum: SHA256: {sum}");
    }
    let _ = writeln!(text, "Relationship: SPDXRef-DOCUMENT DESCRIBES {id}");
}

fn checksum<'a>(lock: &'a toml_edit::DocumentMut, name: &str, version: &str) -> Option<&'a str> {
    let packages = lock.get("package")?.as_array_of_tables()?;
    let is = |table: &&toml_edit::Table, key: &str, value: &str| {
        table.get(key).and_then(toml_edit::Item::as_str) == Some(value)
    };
    let found = packages.iter().find(|one| is(one, "name", name) && is(one, "version", version))?;
    found.get("checksum")?.as_str()
}

fn said(root: &Path, program: &str, words: &[&str]) -> anyhow::Result<String> {
    let output = Command::new(program).args(words).current_dir(root).output();
    let output = output.with_context(|| format!("`{program}` cannot be started"))?;
    if !output.status.success() {
        bail!("{program} {}: {}", words.join(" "), String::from_utf8_lossy(&output.stderr));
    }
    Ok(String::from_utf8(output.stdout)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_has_what_is_linked_and_no_tests() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let text = sbom(root).unwrap();
        let has = |name: &str| text.contains(&format!("\nPackageName: {name}\n"));
        assert!(has("helixlock") && has("clap") && has("parquet"), "{text}");
        assert!(!has("expect-test") && !has("helixlock-evidence"), "{text}");
        let packages = text.matches("\nPackageName: ").count();
        let licences = text.matches("\nPackageLicenseDeclared: ").count();
        assert_eq!(packages, licences);
        assert!(!text.contains("PackageLicenseDeclared: NOASSERTION"), "{text}");
    }
}
