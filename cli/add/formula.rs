//! A formula of the command line as an effect: which of its words are parameters, and their values.

use std::collections::BTreeMap;

use anyhow::{Context, bail};
use helixlock_plant::{Custom, Entry, LoggedColumn, Parameter, Term};

/// What the command line says of a formula.
#[derive(Debug)]
pub(super) struct Given<'a> {
    pub(super) formula: &'a str,
    pub(super) name: &'a str,
    pub(super) entry: &'a str,
    /// `KEY=VALUE`
    pub(super) values: &'a [String],
}

/// Where a value begins that was not given; only one that the formula is linear in may.
const ANY: f64 = 1.0;

impl Given<'_> {
    /// The effect before its fit: words that are not logged are parameters, and those that the
    /// formula is not linear in need a value to begin with.
    pub(super) fn to_be_fitted(&self, logged: &dyn Fn(&str) -> bool) -> anyhow::Result<Term> {
        let values = self.values()?;
        let words = self.words(&values)?;
        let free: Vec<String> = words.into_iter().filter(|word| !logged(word)).collect();
        let begin = |word: &String| values.get(word.as_str()).copied().unwrap_or(ANY);
        let term = self.term(&free, free.iter().map(begin).collect())?;
        let unset =
            |what: &&Parameter| what.is_nonlinear() && !values.contains_key(what.name.as_ref());
        if let Some(what) = term.parameters.iter().find(unset) {
            bail!(
                "--formula {}: `{}` is no column of the data, and the formula is not linear in it\nhint: say where its search begins: --set {}=VALUE",
                self.formula,
                what.name,
                what.name
            );
        }
        Ok(term)
    }

    /// The effect with the values as they are given; every other word must be a known column.
    pub(super) fn as_given(&self) -> anyhow::Result<Term> {
        let values = self.values()?;
        let words = self.words(&values)?;
        let (set, rest): (Vec<String>, Vec<String>) =
            words.into_iter().partition(|word| values.contains_key(word.as_str()));
        if let Some(word) = rest.iter().find(|word| LoggedColumn::named(word).is_none()) {
            bail!(
                "--formula {}: found `{word}`, expected a known column or a parameter with --set {word}=VALUE\nhint: with --fit DATA, the columns of the data are known and parameters are fitted",
                self.formula
            );
        }
        let of = |word: &String| values[word.as_str()];
        self.term(&set, set.iter().map(of).collect())
    }

    /// Words that no sample knows by itself; a value for any other word is refused.
    fn words(&self, values: &BTreeMap<&str, f64>) -> anyhow::Result<Vec<String>> {
        let names: Vec<String> = values.keys().map(ToString::to_string).collect();
        let read = Custom::new(self.name, self.formula, &names)?;
        let mut words: Vec<String> = read.needs().into_iter().map(ToOwned::to_owned).collect();
        words.extend(names);
        words.sort();
        words.dedup();
        Ok(words)
    }

    fn values(&self) -> anyhow::Result<BTreeMap<&str, f64>> {
        let mut values = BTreeMap::new();
        for pair in self.values {
            let (key, value) = pair
                .split_once('=')
                .with_context(|| format!("--set {pair}: found no `=`, expected KEY=VALUE"))?;
            let number: f64 =
                value
                    .trim()
                    .parse()
                    .ok()
                    .filter(|number: &f64| number.is_finite())
                    .with_context(|| format!("--set {pair}: found `{value}`, expected a number"))?;
            values.insert(key.trim(), number);
        }
        Ok(values)
    }

    fn term(&self, names: &[String], values: Vec<f64>) -> anyhow::Result<Term> {
        let words = Entry::ALL.map(Entry::word).join(", ");
        let entry = Entry::ALL
            .into_iter()
            .find(|entry| entry.word() == self.entry)
            .with_context(|| format!("--entry {}: expected one of {words}", self.entry))?;
        let parameter =
            |(name, value): (&String, &f64)| Parameter::of_formula(name.clone(), *value);
        let parameters = names.iter().zip(&values).map(parameter).collect();
        Ok(Term::custom(self.name, entry, self.formula, parameters, values)?)
    }
}
