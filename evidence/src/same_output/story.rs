//! What is run: stories of commands, told once for each machine, table, board, effect and seed.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{Context, ensure};

/// The stories, before they are told for anything.
pub const STORIES: &str = include_str!("stories.txt");

/// Commands that follow one another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Story {
    /// Folder of what they write, below that of the whole tree; `/` between its parts.
    pub folder: String,
    /// The commands' words.
    pub commands: Vec<Vec<String>>,
}

impl Story {
    /// The same with a word exchanged, in the folder for another one.
    fn with(&self, mark: &str, in_folder: &str, in_commands: &str) -> Self {
        let told = |word: &String| word.replace(mark, in_commands);
        Self {
            folder: self.folder.replace(mark, in_folder),
            commands: self.commands.iter().map(|words| words.iter().map(told).collect()).collect(),
        }
    }
}

/// What the stories are told of.
#[derive(Clone, Debug)]
pub struct Subjects {
    /// Each machine file and the tables beside it, below `examples`.
    pub machines: Vec<(String, Vec<String>)>,
    /// Names of boards.
    pub boards: Vec<String>,
    /// Names of effects.
    pub effects: Vec<String>,
    /// Seeds, counted from 1.
    pub seeds: u64,
}

impl Subjects {
    /// Everything the repository whose root this is knows of, and so many seeds.
    ///
    /// # Errors
    ///
    /// When a folder of examples cannot be read.
    pub fn of(root: &Path, seeds: u64) -> anyhow::Result<Self> {
        let boards = helixlock_gen::Board::all()?.into_iter().map(|board| board.name).collect();
        let effects = helixlock_plant::CATALOGUE.iter().map(|card| card.kind.to_owned()).collect();
        Ok(Self { machines: machines(&root.join("examples"))?, boards, effects, seeds })
    }
}

/// All stories, told of all their subjects.
///
/// # Errors
///
/// When a line belongs to no story or a quotation mark is left open.
pub fn told(text: &str, subjects: &Subjects) -> anyhow::Result<Vec<Story>> {
    let stories = read(text)?;
    Ok(stories.iter().flat_map(|story| told_of(story, subjects)).collect())
}

fn told_of(story: &Story, subjects: &Subjects) -> Vec<Story> {
    let seeds: Vec<_> = (1..=subjects.seeds).map(|seed| seed.to_string()).collect();
    let stories = of_machines(story, &subjects.machines);
    let stories = of_each(stories, "BOARD", &subjects.boards);
    let stories = of_each(stories, "EFFECT", &subjects.effects);
    let stories = of_each(stories, "SEED", &seeds);
    stories.into_iter().map(|story| story.with("OUT", "OUT", &story.folder)).collect()
}

fn of_each(stories: Vec<Story>, mark: &str, subjects: &[String]) -> Vec<Story> {
    let tell = |story: Story| {
        if !story.folder.contains(mark) {
            return vec![story];
        }
        subjects.iter().map(|subject| story.with(mark, subject, subject)).collect()
    };
    stories.into_iter().flat_map(tell).collect()
}

fn of_machines(story: &Story, machines: &[(String, Vec<String>)]) -> Vec<Story> {
    if !story.folder.contains("MACHINE") {
        return vec![story.clone()];
    }
    let tell = |(machine, tables): &(String, Vec<String>)| {
        let story = story.with("MACHINE", machine.trim_end_matches(".toml"), machine);
        if !story.folder.contains("DATA") {
            return vec![story];
        }
        let of_table = |table: &String| story.with("DATA", stem(table), table);
        tables.iter().map(of_table).collect()
    };
    machines.iter().flat_map(tell).collect()
}

/// Name of a table without folder and ending.
fn stem(table: &str) -> &str {
    Path::new(table).file_stem().and_then(OsStr::to_str).unwrap_or(table)
}

fn read(text: &str) -> anyhow::Result<Vec<Story>> {
    let mut stories = Vec::<Story>::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(folder) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            stories.push(Story { folder: folder.to_owned(), commands: Vec::new() });
        } else {
            let story = stories.last_mut().with_context(|| format!("no story before `{line}`"))?;
            let words = shlex::split(line).with_context(|| format!("open quotation: `{line}`"))?;
            story.commands.push(words);
        }
    }
    Ok(stories)
}

/// Machine files and the tables beside them, sorted.
fn machines(examples: &Path) -> anyhow::Result<Vec<(String, Vec<String>)>> {
    let mut machines = Vec::new();
    for folder in names(examples)? {
        let files = names(&examples.join(&folder)).unwrap_or_default();
        let of_kind = |ending: &str| -> Vec<String> {
            let wanted = files.iter().filter(|file| file.ends_with(ending));
            wanted.map(|file| format!("{folder}/{file}")).collect()
        };
        machines.extend(of_kind(".toml").into_iter().map(|file| (file, of_kind(".csv"))));
    }
    ensure!(!machines.is_empty(), "{}: no machine file, expected some", examples.display());
    Ok(machines)
}

fn names(folder: &Path) -> anyhow::Result<Vec<String>> {
    let entries = folder.read_dir().with_context(|| folder.display().to_string())?;
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn subjects() -> Subjects {
        let tables = vec!["gear/a.csv".to_owned(), "gear/b.csv".to_owned()];
        Subjects {
            machines: vec![("gear/machine.toml".to_owned(), tables)],
            boards: vec!["icestick".to_owned()],
            effects: vec!["abbe".to_owned()],
            seeds: 2,
        }
    }

    #[test]
    fn a_story_is_told_of_every_table_beside_a_machine() {
        let text = "[learn/MACHINE/DATA]\nlearn examples/MACHINE examples/DATA -o OUT/\"a b\"\n";
        let stories = told(text, &subjects()).unwrap();
        assert_eq!(stories.len(), 2);
        assert_eq!(stories[1].folder, "learn/gear/machine/b");
        let words = "learn,examples/gear/machine.toml,examples/gear/b.csv,-o,\
                     learn/gear/machine/b/a b";
        assert_eq!(stories[1].commands[0].join(","), words);
    }

    #[test]
    fn a_story_is_told_of_every_seed() {
        let stories = told("[seed/SEED]\nchallenge --seed SEED", &subjects()).unwrap();
        let folders: Vec<_> = stories.iter().map(|story| story.folder.as_str()).collect();
        assert_eq!(folders, ["seed/1", "seed/2"]);
    }

    #[test]
    fn a_command_outside_of_a_story_is_refused() {
        let error = told("sim", &subjects()).unwrap_err();
        assert_eq!(error.to_string(), "no story before `sim`");
    }

    /// Two stories in one folder would write over one another.
    #[test]
    fn every_story_has_a_folder_of_its_own() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let stories = told(STORIES, &Subjects::of(root, 3).unwrap()).unwrap();
        let mut folders: Vec<_> = stories.iter().map(|story| &story.folder).collect();
        folders.sort();
        folders.dedup();
        assert_eq!(folders.len(), stories.len());
        let words = stories.iter().flat_map(|story| &story.commands).flatten();
        let marks = ["MACHINE", "DATA", "BOARD", "EFFECT", "SEED", "OUT"];
        for word in words {
            assert!(!marks.iter().any(|mark| word.contains(mark)), "{word}");
        }
    }
}
