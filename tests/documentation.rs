//! What the documentation shows is what the program gives.

use std::process::Command;

use expect_test::expect_file;

/// The picture in the README is the first of the headline example's report.
#[test]
fn headline_picture_is_fresh() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["sim", "examples/sg7430-6mm/machine.toml", "-o"])
        .arg(folder.path())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the command starts");
    assert!(run.status.success(), "{run:?}");
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a report");
    let start = page.find("<svg").expect("a picture");
    let length = page[start..].find("</svg>").expect("its end") + "</svg>".len();
    expect_file!["../docs/figures/sg7430-6mm.svg"].assert_eq(&page[start..start + length]);
}
