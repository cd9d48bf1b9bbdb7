//! Parts of a run, each worked out on a machine of its own, and their names.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// More parts than files in a folder are good for.
const MOST_PARTS: u64 = 100_000;

/// One part of so many, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    pub(crate) number: u64,
    pub(crate) of: u64,
}

impl Shard {
    /// The cases of this part: every part has as many as the next, or one more.
    pub(crate) fn cases(self, all: u64) -> Range<u64> {
        let until = |number: u64| {
            let share = u128::from(all) * u128::from(number) / u128::from(self.of);
            u64::try_from(share).unwrap_or(all)
        };
        until(self.number - 1)..until(self.number)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            Some(Self { number: number.parse().ok()?, of: of.parse().ok()? })
        });
        let sound = |shard: &Self| (1..=shard.of).contains(&shard.number) && shard.of <= MOST_PARTS;
        numbers
            .filter(sound)
            .ok_or_else(|| format!("expected PART/PARTS, such as 1/8 to 8/8, {MOST_PARTS} at most"))
    }
}

/// Name of a part's file, which says all that has to agree between parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PartName {
    pub(crate) shard: Shard,
    /// Cases of all parts.
    pub(crate) cases: u64,
    /// What the cases are, such as `flips`.
    pub(crate) word: String,
    /// Of version, machine file, values and options.
    pub(crate) fingerprint: u64,
}

impl PartName {
    /// Reads a name; `None` for any other file.
    pub(crate) fn read(name: &str) -> Option<Self> {
        let words: Vec<&str> = name.strip_suffix(".parquet")?.split('-').collect();
        let ["part", number, "of", of, cases, word, fingerprint] = words[..] else {
            return None;
        };
        let shard = format!("{number}/{of}").parse().ok()?;
        let fingerprint = u64::from_str_radix(fingerprint, 16).ok()?;
        let (cases, word) = (cases.parse().ok()?, word.to_owned());
        let part = Self { shard, cases, word, fingerprint };
        (part.to_string() == name).then_some(part)
    }

    /// True when both are parts of one run, cut alike.
    pub(crate) fn belongs_to(&self, other: &Self) -> bool {
        *self == Self { shard: Shard { number: self.shard.number, ..other.shard }, ..other.clone() }
    }
}

impl fmt::Display for PartName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { shard: Shard { number, of }, cases, word, fingerprint } = self;
        write!(f, "part-{number}-of-{of}-{cases}-{word}-{fingerprint:016x}.parquet")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_share_all_cases_and_no_case_twice() {
        for (all, of) in [(0, 3), (2, 5), (1000, 7), (u64::MAX, 100_000)] {
            let mut next = 0;
            for number in 1..=of {
                let cases = Shard { number, of }.cases(all);
                assert_eq!(cases.start, next, "{number} of {of}");
                next = cases.end;
            }
            assert_eq!(next, all);
        }
    }

    #[test]
    fn words_that_are_no_part_are_told() {
        assert_eq!("2/3".parse(), Ok(Shard { number: 2, of: 3 }));
        for text in ["", "2", "0/3", "4/3", "1/0", "-1/3", "1/100001", "1/2/3"] {
            assert!(text.parse::<Shard>().unwrap_err().contains("PART/PARTS"), "{text}");
        }
    }

    #[test]
    fn a_name_reads_back() {
        let shard = Shard { number: 2, of: 3 };
        let name = PartName { shard, cases: 1000, word: "flips".into(), fingerprint: 0xabc };
        assert_eq!(name.to_string(), "part-2-of-3-1000-flips-0000000000000abc.parquet");
        assert_eq!(PartName::read(&name.to_string()), Some(name));
        assert_eq!(PartName::read("part-02-of-3-1000-flips-0000000000000abc.parquet"), None);
        assert_eq!(PartName::read("part-2-of-3-1000-flips-0000000000000abc.parquet.journal"), None);
    }
}
