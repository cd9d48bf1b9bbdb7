//! Numbers for a plot: a line of JSON that says what follows, then arrays of floats.

use helixlock_workbench::{Answer, Kind};
use serde::Serialize;

use super::refusal::Answered;

/// Bytes that a browser can view as arrays: each begins at a multiple of eight.
#[derive(Debug, Default)]
pub(crate) struct Frame {
    bytes: Vec<u8>,
    arrays: Vec<Array>,
}

/// One array of a frame.
#[derive(Debug, Serialize)]
struct Array {
    name: String,
    bits: u32,
    count: usize,
}

#[derive(Serialize)]
struct Head<'a, T> {
    #[serde(flatten)]
    about: &'a T,
    arrays: &'a [Array],
}

impl Frame {
    /// Adds an array in full precision: coordinates, which are zoomed into.
    pub(crate) fn push_f64(&mut self, name: &str, values: &[f64]) {
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self.push(name, 64, values.len());
    }

    /// Adds an array in single precision: heights on a screen.
    #[expect(clippy::cast_possible_truncation, reason = "seven digits are more than a screen has")]
    pub(crate) fn push_f32(&mut self, name: &str, values: &[f64]) {
        self.bytes.extend(values.iter().flat_map(|value| (*value as f32).to_le_bytes()));
        self.push(name, 32, values.len());
    }

    fn push(&mut self, name: &str, bits: u32, count: usize) {
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        self.arrays.push(Array { name: name.to_owned(), bits, count });
    }

    /// Length of the head as four bytes, the head, the arrays.
    pub(crate) fn answer(self, about: &impl Serialize) -> Answered {
        let mut head = serde_json::to_vec(&Head { about, arrays: &self.arrays })?;
        head.resize((head.len() + 4).next_multiple_of(8) - 4, b' ');
        let mut body = Vec::with_capacity(4 + head.len() + self.bytes.len());
        body.extend(u32::try_from(head.len())?.to_le_bytes());
        body.extend(head);
        body.extend(self.bytes);
        Ok(Answer { status: 200, kind: Kind::Binary, body })
    }
}
