//! Delays of the very parts of one device: at a corner of the data sheet, or drawn.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::circuit::Circuit;
use crate::error::Error;
use crate::library::Span;

/// All parts alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// As quick as any.
    Shortest,
    /// As the sheet calls typical.
    Typical,
    /// As slow as the sheet allows.
    Longest,
}

/// Rise and fall of every output, ps, in the order of elements and outputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Delays(pub Vec<[u64; 2]>);

impl Delays {
    /// Every part at the same corner.
    #[must_use]
    pub fn corner(circuit: &Circuit, corner: Corner) -> Self {
        Self::of(circuit, |span| match corner {
            Corner::Shortest => span.shortest_ps,
            Corner::Typical => span.typical_ps,
            Corner::Longest => span.longest_ps,
        })
    }

    /// Each edge of each output anywhere between the limits, with equal chance.
    #[must_use]
    pub fn drawn(circuit: &Circuit, seed: u64) -> Self {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        Self::of(circuit, |span| chance.random_range(span.shortest_ps..=span.longest_ps))
    }

    /// The same with another delay of both edges of one element.
    ///
    /// # Errors
    ///
    /// When the circuit has no element of that name.
    pub fn with(
        mut self,
        circuit: &Circuit,
        element: &str,
        edges: [u64; 2],
    ) -> Result<Self, Error> {
        let mut output = 0;
        for one in &circuit.elements {
            if one.name == element {
                self.0[output..output + one.outputs.len()].fill(edges);
                return Ok(self);
            }
            output += one.outputs.len();
        }
        Err(Error::NoSuchName { circuit: circuit.name.clone(), name: element.into() })
    }

    fn of(circuit: &Circuit, mut choose: impl FnMut(Span) -> u64) -> Self {
        let mut edges = Vec::new();
        for element in &circuit.elements {
            for _ in &element.outputs {
                edges.push([choose(element.limits.rise), choose(element.limits.fall)]);
            }
        }
        Self(edges)
    }
}
