//! The rounds of a ledger: added, taken back, done again, refused; the same ledger as `learn`'s.

use anyhow::{Context, bail};
use serde::Serialize;
use serde_json::{Value, json};

use crate::shared::angular::{in_unit, key_in};

/// A ledger; what other programs have written into it stays.
#[derive(Clone, Debug)]
pub(crate) struct Book(Value);

/// A round that a page adds.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct NewRound {
    pub(crate) round: usize,
    pub(crate) added: Option<String>,
    pub(crate) dropped: Vec<String>,
    pub(crate) rms_um: Option<f64>,
    pub(crate) holdout_rms_um: Option<f64>,
    pub(crate) p_value: Option<f64>,
    pub(crate) parameters: Value,
    pub(crate) model: Value,
    pub(crate) rejected: Vec<Value>,
    pub(crate) rms_before_um: Option<f64>,
    pub(crate) holdout_rms_before_um: Option<f64>,
    pub(crate) data_hash: String,
    pub(crate) taken_back: bool,
    pub(crate) machine: String,
}

impl Book {
    /// An empty one.
    pub(crate) fn new(title: &str, unit: &str, data: &str, data_hash: &str) -> Self {
        Self(json!({
            "data": data,
            "data_hash": data_hash,
            "verdict": null,
            "accepted": true,
            "rounds": [],
            "final_check": null,
            "title": title,
            "unit": unit,
        }))
    }

    /// Reads one; `name` is for messages.
    pub(crate) fn parse(text: &str, name: &str) -> anyhow::Result<Self> {
        let book: Value = serde_json::from_str(text)
            .with_context(|| format!("{name}: found no ledger, expected one of `learn`"))?;
        if !book["rounds"].is_array() {
            bail!("{name}: found no `rounds`, expected a ledger of `learn`");
        }
        Ok(Self(book))
    }

    /// The whole of it.
    pub(crate) fn value(&self) -> &Value {
        &self.0
    }

    /// As it is written to a file.
    pub(crate) fn text(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(&self.0)? + "\n")
    }

    /// All rounds, those taken back too.
    pub(crate) fn rounds(&self) -> &[Value] {
        self.0["rounds"].as_array().map(Vec::as_slice).unwrap_or_default()
    }

    fn rounds_mut(&mut self) -> &mut [Value] {
        self.0["rounds"].as_array_mut().map(Vec::as_mut_slice).unwrap_or_default()
    }

    fn standing(&self) -> Vec<usize> {
        let all = self.rounds().iter().enumerate();
        all.filter(|(_, round)| round["taken_back"] != true).map(|(index, _)| index).collect()
    }

    /// The machine file after the last round that stands.
    pub(crate) fn machine(&self) -> Option<&str> {
        self.rounds()[*self.standing().last()?]["machine"].as_str()
    }

    /// The machine file before everything.
    pub(crate) fn first_machine(&self) -> Option<&str> {
        self.rounds().first()?["machine"].as_str()
    }

    /// Puts a round behind all others.
    pub(crate) fn push(&mut self, round: NewRound) -> anyhow::Result<()> {
        let round = NewRound { round: self.rounds().len(), ..round };
        let unit = self.0["unit"].as_str().unwrap_or("um");
        self.push_value(in_unit(&round, unit)?);
        Ok(())
    }

    /// The same with a round of another ledger.
    pub(crate) fn push_value(&mut self, mut round: Value) {
        round["round"] = self.rounds().len().into();
        if let Some(rounds) = self.0["rounds"].as_array_mut() {
            rounds.push(round);
        }
    }

    /// Notes the data that the last round saw.
    pub(crate) fn saw(&mut self, data: &str, data_hash: &str) {
        self.0["data"] = data.into();
        self.0["data_hash"] = data_hash.into();
    }

    /// Gives the last round that stands its sizes, `[rms_um, holdout_rms_um]` of these data, where it
    /// has none: it began with a refusal, before anything was fitted.
    pub(crate) fn size(&mut self, sizes_um: [Option<f64>; 2], data_hash: &str) {
        let Some(&last) = self.standing().last() else { return };
        let unit = self.0["unit"].as_str().unwrap_or("um").to_owned();
        let round = &mut self.rounds_mut()[last];
        if !round[key_in("rms_um", &unit)].is_null() || round["data_hash"] != data_hash {
            return;
        }
        for (stem, size) in ["rms", "holdout_rms"].into_iter().zip(sizes_um) {
            for key in [format!("{stem}_um"), format!("{stem}_before_um")] {
                round[key_in(&key, &unit)] = size.into();
            }
        }
    }

    /// True when a round can be taken back.
    pub(crate) fn can_undo(&self) -> bool {
        1 < self.standing().len()
    }

    /// The first of the rounds at the end that were taken back.
    fn next(&self) -> Option<usize> {
        let behind = self.standing().last().map_or(0, |last| last + 1);
        (0 < behind && behind < self.rounds().len()).then_some(behind)
    }

    /// True when a round can be done again.
    pub(crate) fn can_redo(&self) -> bool {
        self.next().is_some()
    }

    /// Takes the last round that stands back; gives the machine file before it.
    pub(crate) fn undo(&mut self) -> Option<String> {
        let standing = self.standing();
        let [.., before, last] = standing.as_slice() else { return None };
        self.rounds_mut()[*last]["taken_back"] = true.into();
        self.rounds()[*before]["machine"].as_str().map(str::to_owned)
    }

    /// Does it again; gives the machine file after it.
    pub(crate) fn redo(&mut self) -> Option<String> {
        let next = self.next()?;
        self.rounds_mut()[next]["taken_back"] = false.into();
        self.rounds()[next]["machine"].as_str().map(str::to_owned)
    }

    /// Keeps with the last round that stands that a user does not want an effect, and why.
    pub(crate) fn refuse(&mut self, effect: &str, reason: &str) {
        let Some(&last) = self.standing().last() else { return };
        let round = &mut self.rounds_mut()[last];
        if !round["refused"].is_array() {
            round["refused"] = json!([]);
        }
        if let Some(refused) = round["refused"].as_array_mut() {
            refused.retain(|known| known["effect"] != effect);
            refused.push(json!({ "effect": effect, "reason": reason }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn book() -> Book {
        let mut book = Book::new("a machine", "um", "data.csv", "hash");
        for machine in ["first", "second", "third"] {
            book.push(NewRound { machine: machine.into(), ..NewRound::default() }).unwrap();
        }
        book
    }

    #[test]
    fn rounds_are_taken_back_and_done_again_in_order() {
        let mut book = book();
        assert_eq!(book.undo().as_deref(), Some("second"));
        assert_eq!(book.undo().as_deref(), Some("first"));
        assert_eq!((book.undo(), book.can_undo()), (None, false));
        assert_eq!(book.redo().as_deref(), Some("second"));
        assert_eq!(book.machine(), Some("second"));
        assert_eq!(book.redo().as_deref(), Some("third"));
        assert_eq!((book.redo(), book.can_redo()), (None, false));
    }

    #[test]
    fn a_round_behind_one_that_was_taken_back_ends_its_return() {
        let mut book = book();
        book.undo().unwrap();
        book.push(NewRound { machine: "other".into(), ..NewRound::default() }).unwrap();
        assert_eq!((book.machine(), book.can_redo()), (Some("other"), false));
        assert_eq!(book.undo().as_deref(), Some("second"));
        assert_eq!(book.rounds().len(), 4);
    }

    #[test]
    fn a_round_that_was_not_sized_is_sized_once_by_its_own_data() {
        let mut book = Book::new("a machine", "arcsec", "data.csv", "hash");
        let round =
            NewRound { machine: "first".into(), data_hash: "a".into(), ..NewRound::default() };
        book.push(round).unwrap();
        book.size([Some(2.0), Some(3.0)], "b");
        assert_eq!(book.rounds()[0]["rms_arcsec"], Value::Null, "data of another round");
        book.size([Some(2.0), Some(3.0)], "a");
        book.size([Some(4.0), Some(5.0)], "a");
        let sizes = ["rms", "rms_before", "holdout_rms", "holdout_rms_before"];
        let sizes = sizes.map(|key| book.rounds()[0][format!("{key}_arcsec")].as_f64());
        assert_eq!(sizes, [2.0, 2.0, 3.0, 3.0].map(Some));
    }

    #[test]
    fn a_refusal_stays_with_its_last_reason() {
        let mut book = book();
        book.refuse("abbe", "no");
        book.refuse("abbe", "the guide was measured");
        let refused = &book.rounds()[2]["refused"];
        assert_eq!(*refused, json!([{ "effect": "abbe", "reason": "the guide was measured" }]));
        let again = Book::parse(&book.text().unwrap(), "ledger.json").unwrap();
        assert_eq!(again.value(), book.value());
    }
}
