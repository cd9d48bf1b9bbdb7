//! A dropped file: how it is read, what is asked about it, and the table it becomes.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Mutex;

use anyhow::{anyhow, bail};
use helixlock_import::recipe::{KEYS, Kind};
use helixlock_import::{ColumnRule, Proposal, Recipe, Source, Value, propose};
use helixlock_lab::fnv1a64;
use helixlock_plant::LOGGED_COLUMNS;
use helixlock_traces::csv::write_csv;
use helixlock_traces::{LONGEST_BYTES, unpacked};
use serde::{Deserialize, Serialize};

use super::folder::Folder;
use super::jobs::held;
use super::refusal::{Answered, Refusal, json};

/// Rows of the table that are shown.
const SHOWN: usize = 8;

/// Most files that are held: one for each tab that a user has open, about.
const HELD: usize = 4;

/// Files that were dropped, the newest last; a tab says which one it means.
#[derive(Debug, Default)]
pub(crate) struct Dropped {
    files: Mutex<VecDeque<File>>,
}

#[derive(Clone, Debug)]
struct File {
    name: String,
    bytes: Vec<u8>,
}

/// What a user says otherwise of a file that was dropped: pieces of recipes.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct Said {
    #[serde(default)]
    file: String,
    #[serde(default)]
    recipes: Vec<String>,
}

#[derive(Serialize)]
struct ReadingJson {
    file: String,
    name: String,
    lines: Vec<String>,
    settings: Vec<SettingJson>,
    columns: Vec<ColumnJson>,
    targets: Vec<&'static str>,
    questions: Vec<QuestionJson>,
    notes: Vec<String>,
    rows: usize,
    names: Vec<String>,
    first: Vec<Vec<Option<f64>>>,
    recipe: String,
    line: String,
}

#[derive(Serialize)]
struct SettingJson {
    section: String,
    name: String,
    value: String,
    reason: String,
    choices: &'static [&'static str],
    quoted: bool,
}

#[derive(Serialize)]
struct ColumnJson {
    from: String,
    to: Option<String>,
    unit: Option<String>,
    sign: i64,
    reason: String,
}

#[derive(Serialize)]
struct QuestionJson {
    text: String,
    answers: Vec<AnswerJson>,
}

#[derive(Serialize)]
struct AnswerJson {
    label: String,
    recipe: String,
}

/// What was saved.
#[derive(Serialize)]
struct SavedJson {
    data: String,
    recipe: Option<String>,
}

impl Dropped {
    /// Takes a file in, unpacked where gzip has packed it, and says how it would be read.
    pub(crate) fn take(&self, name: &str, bytes: Vec<u8>) -> Answered {
        let name = Path::new(name).file_name().and_then(|name| name.to_str()).unwrap_or("data");
        let bytes = unpacked(bytes, LONGEST_BYTES, Path::new(name))?;
        let file = File { name: name.strip_suffix(".gz").unwrap_or(name).to_owned(), bytes };
        let reading = read(&file, &Said::default())?;
        let answer = reading_json(&file, &reading);
        let mut files = held(&self.files);
        files.retain(|known| known.mark() != answer.file);
        files.push_back(file);
        while HELD < files.len() {
            files.pop_front();
        }
        drop(files);
        json(&answer)
    }

    /// The same file read otherwise.
    pub(crate) fn read(&self, said: &Said) -> Answered {
        let file = self.file(said)?;
        json(&reading_json(&file, &read(&file, said)?))
    }

    /// Writes the table, its recipe, and the file as it was dropped.
    pub(crate) fn save(&self, folder: &Folder, said: &Said) -> Answered {
        let file = self.file(said)?;
        let proposal = read(&file, said)?;
        if let Some(open) = proposal.questions.first() {
            return Err(anyhow!("{}", open.text).into());
        }
        let table = table_text(&proposal)?;
        if is(folder, &file.name, &file.bytes) && table == file.bytes {
            return json(&SavedJson { data: file.name, recipe: None });
        }
        let original = kept_name(folder, &file);
        let recipe = proposal.recipe.to_string();
        let data = folder.free_name("data", "csv");
        let recipe_name = recipe_name(&data);
        folder.write(&[
            (&original, &file.bytes),
            (&recipe_name, recipe.as_bytes()),
            (&data, &table),
        ])?;
        json(&SavedJson { data, recipe: Some(recipe_name) })
    }

    fn file(&self, said: &Said) -> anyhow::Result<File> {
        let files = held(&self.files);
        let one = files.iter().rfind(|file| file.mark() == said.file);
        one.cloned().ok_or_else(|| anyhow!("this file is held no more: drop it once more"))
    }
}

impl File {
    /// What tells it from others.
    fn mark(&self) -> String {
        format!("{:016x}", fnv1a64(self.name.as_bytes()) ^ fnv1a64(&self.bytes).rotate_left(1))
    }
}

/// Reads a table of the folder by a mend, and writes it beside.
pub(crate) fn mend(folder: &Folder, data: &str, recipe: &str) -> Answered {
    let file = File { name: data.to_owned(), bytes: folder.read(data)? };
    let proposal = read(&file, &Said { recipes: vec![recipe.to_owned()], ..Said::default() })?;
    if let Some(open) = proposal.questions.first() {
        return Err(anyhow!("{}", open.text).into());
    }
    let table = table_text(&proposal)?;
    let name = folder.free_name("data", "csv");
    let recipe_name = recipe_name(&name);
    let recipe = proposal.recipe.to_string();
    folder.write(&[(&recipe_name, recipe.as_bytes()), (&name, &table)])?;
    json(&SavedJson { data: name, recipe: Some(recipe_name) })
}

fn read(file: &File, said: &Said) -> Result<Proposal, Refusal> {
    let mut given = Recipe::default();
    for more in &said.recipes {
        given = given.with(&Recipe::parse(more, "recipe").map_err(|error| anyhow!("{error}"))?);
    }
    let source = Source { name: &file.name, bytes: &file.bytes };
    Ok(propose(&[source], &given).map_err(|error| anyhow!("{error}"))?)
}

fn table_text(proposal: &Proposal) -> anyhow::Result<Vec<u8>> {
    let mut text = Vec::new();
    write_csv(&proposal.table, &mut text)?;
    if proposal.table.rows() == 0 {
        bail!("found no row, expected measured data");
    }
    Ok(text)
}

fn is(folder: &Folder, name: &str, bytes: &[u8]) -> bool {
    folder.has(name) && folder.read(name).is_ok_and(|known| known == bytes)
}

/// Where the file itself is kept, beside others of its name.
fn kept_name(folder: &Folder, file: &File) -> String {
    let first = format!("originals/{}", file.name);
    if !folder.has(&first) || is(folder, &first, &file.bytes) {
        return first;
    }
    let (stem, ending) = file.name.rsplit_once('.').unwrap_or((&file.name, "txt"));
    folder.free_name(&format!("originals/{stem}"), ending)
}

fn recipe_name(data: &str) -> String {
    format!("{}.recipe.toml", data.strip_suffix(".csv").unwrap_or(data))
}

fn reading_json(file: &File, proposal: &Proposal) -> ReadingJson {
    let printable =
        |line: &String| line.chars().filter(|c| !c.is_control() || *c == '\t').take(200).collect();
    let table = &proposal.table;
    let row = |row: usize| table.columns.iter().map(move |column| finite(column.values[row]));
    let said: Vec<_> = proposal
        .questions
        .iter()
        .map(|question| QuestionJson {
            text: question.text.clone(),
            answers: question
                .answers
                .iter()
                .map(|answer| AnswerJson {
                    label: answer.label.clone(),
                    recipe: answer.recipe.clone(),
                })
                .collect(),
        })
        .collect();
    ReadingJson {
        file: file.mark(),
        name: file.name.clone(),
        lines: proposal.beginning.iter().map(printable).collect(),
        settings: settings(&proposal.recipe),
        columns: proposal.recipe.columns.iter().map(column_json).collect(),
        targets: LOGGED_COLUMNS.iter().map(|column| column.name).collect(),
        questions: said,
        notes: proposal.notes.clone(),
        rows: table.rows(),
        names: table.names().map(str::to_owned).collect(),
        first: (0..table.rows().min(SHOWN)).map(|index| row(index).collect()).collect(),
        recipe: proposal.recipe.to_string(),
        line: format!(
            "helixlock import originals/{} --recipe data.recipe.toml -o data.csv",
            file.name
        ),
    }
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

fn column_json(rule: &ColumnRule) -> ColumnJson {
    ColumnJson {
        from: rule.from.clone(),
        to: rule.to.clone(),
        unit: rule.unit.clone(),
        sign: rule.sign.unwrap_or(1),
        reason: rule.reason.clone(),
    }
}

/// Decisions in the order of a recipe.
fn settings(recipe: &Recipe) -> Vec<SettingJson> {
    let known = KEYS.iter().filter_map(|key| {
        let setting = recipe.settings.get(&(key.section.to_owned(), key.name.to_owned()))?;
        let choices = if let Kind::Text(choices) = key.kind { choices } else { &[] };
        let (value, quoted) = match &setting.value {
            Value::Text(text) => (text.clone(), true),
            Value::Whole(whole) => (whole.to_string(), false),
            Value::Number(number) => (number.to_string(), false),
            Value::List(words) => (format!("{words:?}"), false),
        };
        Some(SettingJson {
            section: key.section.to_owned(),
            name: key.name.to_owned(),
            reason: setting.reason.clone(),
            value,
            choices,
            quoted,
        })
    });
    known.collect()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    #[test]
    fn a_dropped_file_is_read_as_it_was_before_gzip_packed_it() {
        let rows: Vec<String> = (0..40).map(|row| format!("{row},{}", row % 7)).collect();
        let text = format!("position_mm,error_um\n{}\n", rows.join("\n"));
        let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(text.as_bytes()).unwrap();
        let packed = encoder.finish().unwrap();
        let dropped = |name: &str, bytes: &[u8]| {
            let taken = Dropped::default().take(name, bytes.to_vec());
            taken.map(|answer| String::from_utf8(answer.body).unwrap()).ok().unwrap()
        };
        assert_eq!(dropped("run.csv.gz", &packed), dropped("run.csv", text.as_bytes()));
        assert!(
            Dropped::default().take("run.csv.gz", packed[..packed.len() / 2].to_vec()).is_err()
        );
    }

    #[test]
    fn each_tab_reads_the_file_that_it_dropped() {
        let all = Dropped::default();
        let mark = |answer: Answered| {
            let body = answer.ok().unwrap().body;
            serde_json::from_slice::<serde_json::Value>(&body).unwrap()["file"]
                .as_str()
                .map(str::to_owned)
        };
        let drop = |error: u32| {
            let rows: Vec<String> = (0..40).map(|row| format!("{row},{error}.{row}")).collect();
            let text = format!("position_mm,error_um\n{}\n", rows.join("\n"));
            mark(all.take("run.csv", text.into_bytes())).unwrap()
        };
        let said = |file: &str| Said { file: file.to_owned(), recipes: Vec::new() };
        let (first, second) = (drop(1), drop(2));
        assert_ne!(first, second);
        assert_eq!(mark(all.read(&said(&first))), Some(first.clone()));
        for more in 3..3 + u32::try_from(HELD).unwrap() {
            drop(more);
        }
        assert!(all.read(&said(&first)).is_err() && all.read(&said("")).is_err());
    }
}
