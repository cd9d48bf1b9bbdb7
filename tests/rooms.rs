//! The arrows between rooms, the top-level modules of a crate: there is no circle.
//!
//! An arrow is a path that begins with `crate::`, or with as many `super::` as lead to the crate,
//! outside of tests. A name that the crate's root re-exports belongs to the room it comes from.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Roots of the crates, by folder.
const ROOTS: &[(&str, &str)] = &[
    ("rtl", "rtl/src/lib.rs"),
    ("netlist", "netlist/src/lib.rs"),
    ("original", "original/src/lib.rs"),
    ("traces", "traces/src/lib.rs"),
    ("import", "import/src/lib.rs"),
    ("metrology", "metrology/src/lib.rs"),
    ("report", "report/src/lib.rs"),
    ("workbench", "workbench/src/lib.rs"),
    ("plant", "plant/src/lib.rs"),
    ("gen", "gen/src/lib.rs"),
    ("sim", "sim/src/lib.rs"),
    ("lab", "lab/src/lib.rs"),
    ("cli", "cli/lib.rs"),
    ("python", "python/src/lib.rs"),
    ("evidence", "evidence/src/lib.rs"),
    ("fourier", "fourier/src/lib.rs"),
    ("xtask", "xtask/src/lib.rs"),
];

/// Every arrow between two rooms, with a file that draws it.
type Arrows = BTreeMap<(String, String), PathBuf>;

/// A crate under reading.
#[derive(Default)]
struct Rooms {
    /// The room that a name of the root leads to; rooms lead to themselves.
    owners: BTreeMap<String, String>,
    arrows: Arrows,
}

#[test]
fn no_crate_has_a_circle_of_rooms() {
    for (folder, root) in ROOTS {
        let circle = circle(arrows(&Path::new(env!("CARGO_MANIFEST_DIR")).join(root)));
        assert!(circle.is_empty(), "{folder}: a circle of rooms\n{circle:#?}");
    }
}

#[test]
fn every_crate_of_the_workspace_is_read() {
    let manifest = include_str!("../Cargo.toml");
    let members = manifest.lines().find_map(|line| line.strip_prefix("members = "));
    let folders: BTreeSet<_> = members.expect("members").split('"').skip(1).step_by(2).collect();
    let read: BTreeSet<_> = ROOTS.iter().map(|(folder, _)| *folder).collect();
    assert_eq!(read, &folders | &BTreeSet::from(["cli"]));
}

#[test]
fn a_circle_is_seen() {
    let mut rooms = Rooms::default();
    for room in ["low", "middle", "high"] {
        rooms.owners.insert(room.into(), room.into());
    }
    rooms.owners.insert("Thing".into(), "low".into());
    let mut read = |room: &str, inside: &[&str], text: &str| {
        let path: Vec<String> = [room].iter().chain(inside).map(|part| (*part).into()).collect();
        rooms.read(&path, text.parse().expect("tokens"), Path::new(room));
    };
    read("high", &[], "use crate::{middle::{a, b}, Thing}; use super::low; use crate::high::own;");
    read("middle", &["part"], "use super::own; fn f() { vec![super::super::low::g()] }");
    read("low", &[], "#[cfg(test)] mod tests { use crate::high::x; } use crate::low::own;");
    let found = |rooms: &Rooms| -> Vec<String> {
        rooms.arrows.keys().map(|(from, to)| format!("{from} {to}")).collect()
    };
    assert_eq!(found(&rooms), ["high low", "high middle", "middle low"]);
    assert!(circle(rooms.arrows.clone()).is_empty());
    rooms.read(&["low".into()], "crate::middle::h()".parse().expect("tokens"), Path::new("low"));
    let left: Vec<_> = circle(rooms.arrows).into_keys().map(|(from, _)| from).collect();
    assert_eq!(left, ["low", "middle"]);
}

/// What is left when rooms that lead nowhere, or that nothing leads to, are taken away.
fn circle(mut arrows: Arrows) -> Arrows {
    loop {
        let from: BTreeSet<String> = arrows.keys().map(|(from, _)| from.clone()).collect();
        let to: BTreeSet<String> = arrows.keys().map(|(_, to)| to.clone()).collect();
        let before = arrows.len();
        arrows.retain(|(start, end), _| to.contains(start) && from.contains(end));
        if arrows.len() == before {
            return arrows;
        }
    }
}

/// All arrows of the crate with this root.
fn arrows(root: &Path) -> Arrows {
    let mut rooms = Rooms::default();
    let tokens = tokens(root);
    for item in items(tokens.clone()) {
        rooms.own(&item);
    }
    rooms.modules(&[], tokens, root.parent().expect("a folder"), root);
    rooms.arrows
}

fn tokens(file: &Path) -> TokenStream {
    let text = std::fs::read_to_string(file).expect("a source file");
    text.parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// The items of a module, each with its attributes; without those that only tests see.
fn items(tokens: TokenStream) -> Vec<Vec<TokenTree>> {
    let (mut items, mut item) = (Vec::new(), Vec::new());
    for token in tokens {
        let ends = match &token {
            TokenTree::Punct(mark) => mark.as_char() == ';',
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace && !is_use(&item),
            _ => false,
        };
        item.push(token);
        if ends {
            items.push(std::mem::take(&mut item));
        }
    }
    items.push(item);
    items.retain(|item| !is_of_tests(item));
    items
}

fn is_use(item: &[TokenTree]) -> bool {
    item.iter().any(|token| word(token).as_deref() == Some("use"))
}

fn is_of_tests(item: &[TokenTree]) -> bool {
    let attributes = item.windows(2).filter(|pair| pair[0].to_string() == "#");
    attributes.map(|pair| pair[1].to_string().replace(' ', "")).any(|text| text == "[cfg(test)]")
}

fn word(token: &TokenTree) -> Option<String> {
    let TokenTree::Ident(word) = token else { return None };
    Some(word.to_string().trim_start_matches("r#").to_owned())
}

/// The name after `mod`, and what stands in it when that is here.
fn module(item: &[TokenTree]) -> Option<(String, Option<TokenStream>)> {
    let at = item.iter().position(|token| word(token).as_deref() == Some("mod"))?;
    let [name, inside] = item.get(at + 1..at + 3)? else { return None };
    let inside = if let TokenTree::Group(group) = inside { Some(group.stream()) } else { None };
    Some((word(name)?, inside))
}

/// Paths from a `use` or an expression behind `::`: the first name, or one for each in braces.
fn first_names(rest: &[TokenTree]) -> Vec<String> {
    match rest {
        [TokenTree::Group(group), ..] => {
            let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
            let parts = tokens.split(|token| token.to_string() == ",");
            parts.filter_map(|part| word(part.first()?)).collect()
        }
        [first, ..] => word(first).into_iter().collect(),
        [] => vec![],
    }
}

fn is_word(tokens: &[TokenTree], at: usize, expected: &str) -> bool {
    tokens.get(at).and_then(word).as_deref() == Some(expected)
}

fn is_path_mark(tokens: &[TokenTree]) -> bool {
    matches!(tokens, [a, b, ..] if a.to_string() == ":" && b.to_string() == ":")
}

impl Rooms {
    /// Notes a room, or the names that the root takes from one.
    fn own(&mut self, item: &[TokenTree]) {
        if let Some((room, _)) = module(item) {
            self.owners.insert(room.clone(), room);
        } else if let Some(at) = item.iter().position(|token| word(token).as_deref() == Some("use"))
            && let Some(room) = item.get(at + 1).and_then(word)
        {
            for name in all_names(&item[at + 2..]) {
                self.owners.entry(name).or_insert_with(|| room.clone());
            }
        }
    }

    /// Reads the modules declared in a file, and those declared in them.
    fn modules(&mut self, path: &[String], tokens: TokenStream, folder: &Path, file: &Path) {
        for item in items(tokens) {
            let Some((name, inside)) = module(&item) else { continue };
            let path = [path, std::slice::from_ref(&name)].concat();
            let inner = folder.join(&name);
            let Some(tokens) = inside else {
                let flat = folder.join(format!("{name}.rs"));
                let file = if flat.exists() { flat } else { inner.join("mod.rs") };
                let tokens = self::tokens(&file);
                self.read(&path, tokens.clone(), &file);
                self.modules(&path, tokens, &inner, &file);
                continue;
            };
            if path.len() == 1 {
                self.read(&path, tokens.clone(), file);
            }
            self.modules(&path, tokens, &inner, file);
        }
    }

    /// Reads the paths in a module and in the modules that stand inside it.
    fn read(&mut self, path: &[String], tokens: TokenStream, file: &Path) {
        for item in items(tokens) {
            if let Some((name, Some(inside))) = module(&item) {
                self.read(&[path, &[name]].concat(), inside, file);
            } else {
                self.scan(path, &item, file);
            }
        }
    }

    fn scan(&mut self, path: &[String], tokens: &[TokenTree], file: &Path) {
        let mut at = 0;
        while at < tokens.len() {
            if let TokenTree::Group(group) = &tokens[at] {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                self.scan(path, &inside, file);
            }
            let mut up = 0;
            while is_word(tokens, at, "super") && is_path_mark(&tokens[at + 1..]) {
                (up, at) = (up + 1, at + 3);
            }
            if is_word(tokens, at, "crate") && is_path_mark(&tokens[at + 1..]) {
                (up, at) = (path.len(), at + 3);
            }
            if up == path.len() {
                self.draw(&path[0], &first_names(&tokens[at..]), file);
            }
            at += 1;
        }
    }

    fn draw(&mut self, from: &str, names: &[String], file: &Path) {
        for to in names.iter().filter_map(|name| self.owners.get(name)) {
            if to != from {
                self.arrows.entry((from.into(), to.clone())).or_insert_with(|| file.into());
            }
        }
    }
}

/// Every name in a tree of names.
fn all_names(tokens: &[TokenTree]) -> Vec<String> {
    let inside = |token: &TokenTree| match token {
        TokenTree::Group(group) => {
            all_names(&group.stream().into_iter().collect::<Vec<TokenTree>>())
        }
        token => word(token).into_iter().collect(),
    };
    tokens.iter().flat_map(inside).collect()
}
