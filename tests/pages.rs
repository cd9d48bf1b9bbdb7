//! `--page FILE.html`: campaigns and formulas as a page that stands alone.

use std::fs;

use crate::support::command::{few_samples, helixlock, scratch, word};

/// Words, and what the page has to say.
const STORIES: &[(&str, &[&str])] = &[
    (
        "certify examples/sg7430-6mm/machine.toml --length 10 --pulses 100",
        &["Every difference keeps its bound", "<td>direction_discriminator</td>", "fig. 17"],
    ),
    (
        "faults examples/sg7430-6mm/machine.toml --instants 1",
        &["138 flip-flops at 1 instants", "<td>reset_counter</td>", "self-clear of the ring"],
    ),
    (
        "sweep examples/sg7430-6mm/machine.toml --set drive.frequency=20..160:8Hz --length 10 -o OUT/cases.csv",
        &["8 cases over drive.frequency", "with correction", "<td>yes</td>"],
    ),
    (
        "discover examples/outside-the-catalogue/machine.toml OUT/outside-the-catalogue.csv",
        &["Proposed: sawtooth along position", "What else could stand there", "δ = size*fract("],
    ),
];

#[test]
fn a_page_says_what_the_report_says() {
    for (line, says) in STORIES {
        let folder = scratch();
        let (page, page_word) = word(&folder, "page.html");
        few_samples(folder.path(), "outside-the-catalogue", 4);
        let line = line.replace("OUT", folder.path().to_str().expect("text"));
        let mut words: Vec<&str> = line.split(' ').collect();
        words.extend(["--page", &page_word]);
        let run = helixlock(&words);
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{line}");
        assert!(run.stdout.contains(&format!("{page_word}: the same as a page")), "{}", run.stdout);
        let html = fs::read_to_string(page).expect("the page is written");
        for text in says.iter().chain(&["<svg", "<h1>"]) {
            assert!(html.contains(text), "{line}: no `{text}` in\n{html}");
        }
        for outside in ["http:", "https:", "src=", "NaN", "inf<"] {
            assert!(!html.replace("http://www.w3.org/", "").contains(outside), "{line}: {outside}");
        }
    }
}

#[test]
fn a_part_has_no_page() {
    let words = "faults examples/sg7430-6mm/machine.toml --shard 1/2 -o parts --page page.html";
    let run = helixlock(&words.split(' ').collect::<Vec<_>>());
    assert_eq!(run.status, 2, "{}", run.stdout);
    assert!(run.stderr.contains("cannot be used with"), "{}", run.stderr);
}
