//! No part of the simulation or the diagnosis knows an effect by its name: they ask its card.

use std::fs;
use std::path::Path;

use helixlock_plant::CATALOGUE;

/// The file that says which effects the challenges hide.
const RECIPES: &str = "lab/src/challenge/recipe.rs";

/// Calls a function with every source file below a folder and its text, tests left out.
fn each_source(folder: &Path, check: &mut impl FnMut(&Path, &str)) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            each_source(&path, check);
        } else if !path.ends_with("tests.rs") {
            let text = fs::read_to_string(&path).expect("a source file");
            check(&path, text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default());
        }
    }
}

#[test]
fn no_effect_is_known_by_its_name() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in ["lab/src", "sim/src"] {
        each_source(&root.join(folder), &mut |path, text| {
            for card in CATALOGUE.iter().filter(|_| !path.ends_with(RECIPES)) {
                let name = format!("\"{}\"", card.kind);
                assert!(!text.contains(&name), "{} knows {name}", path.display());
            }
        });
    }
}
