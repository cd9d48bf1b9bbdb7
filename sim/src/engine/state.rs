//! Flip-flops as a bit vector: compared, saved and read back.

use bitvec::field::BitField;
use bitvec::order::Lsb0;
use bitvec::vec::BitVec;
use helixlock_netlist::Netlist;
use thiserror::Error;

/// One bit a flip-flop, in the order of [`Netlist::registers`], each register lowest bit first.
pub type FlipFlops = BitVec<u8, Lsb0>;

/// First bytes of a saved snapshot; the digit is the version of the format.
const MAGIC: &[u8; 8] = b"helixff1";

/// A moment of a design: enough to go on from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snapshot {
    /// Rising edges taken since power-up.
    pub clock: u64,
    /// What drives each input, in the order of [`Netlist::inputs`].
    pub inputs: Vec<u64>,
    /// The flip-flops.
    pub flip_flops: FlipFlops,
}

/// Bytes that are not a snapshot.
#[derive(Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The first eight bytes are something else.
    #[error("snapshot: the first bytes are {found:02x?}, expected `helixff1`")]
    Magic {
        /// What stands there.
        found: Vec<u8>,
    },
    /// Cut off, or something follows.
    #[error("snapshot: {found} bytes, expected {expected}")]
    Length {
        /// Number of bytes given.
        found: usize,
        /// Number of bytes its header speaks of.
        expected: usize,
    },
}

impl Snapshot {
    /// As bytes, the same on every machine: `helixff1`, then little-endian 64-bit clock number,
    /// number of inputs, number of flip-flops, the inputs, and the flip-flops eight to a byte.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let header = [self.clock, self.inputs.len() as u64, self.flip_flops.len() as u64];
        let mut bytes = MAGIC.to_vec();
        bytes.extend(header.iter().chain(&self.inputs).flat_map(|word| word.to_le_bytes()));
        bytes.extend(self.flip_flops.chunks(8).map(BitField::load_le::<u8>));
        bytes
    }

    /// Reads what [`Snapshot::to_bytes`] wrote.
    ///
    /// # Errors
    ///
    /// [`SnapshotError`] when the bytes begin otherwise, or are too few or too many.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let body = bytes.strip_prefix(MAGIC).ok_or_else(|| SnapshotError::Magic {
            found: bytes.iter().take(8).copied().collect(),
        })?;
        let length = |expected| SnapshotError::Length { found: bytes.len(), expected };
        let (words, _) = body.as_chunks::<8>();
        let [clock, inputs, flip_flops, ..] =
            words.iter().map(|word| u64::from_le_bytes(*word)).collect::<Vec<_>>()[..]
        else {
            return Err(length(32));
        };
        let expected = expected_length(inputs, flip_flops);
        if bytes.len() != expected {
            return Err(length(expected));
        }
        let (words, bits) = body[24..].split_at(8 * as_size(inputs));
        let mut flip_flops_read = FlipFlops::from_slice(bits);
        flip_flops_read.truncate(as_size(flip_flops));
        let inputs = words.as_chunks::<8>().0.iter().map(|word| u64::from_le_bytes(*word));
        Ok(Self { clock, inputs: inputs.collect(), flip_flops: flip_flops_read })
    }
}

/// Paths of the registers in which two states of a design differ, in order.
#[must_use]
pub fn differences<'a>(netlist: &'a Netlist, one: &FlipFlops, other: &FlipFlops) -> Vec<&'a str> {
    let mut low = 0;
    let mut paths = Vec::new();
    for register in &netlist.registers {
        let signal = netlist.signal(register.output);
        let bits = low..low + signal.width as usize;
        if one[bits.clone()] != other[bits.clone()] {
            paths.push(signal.path.as_str());
        }
        low = bits.end;
    }
    paths
}

/// Flip-flops holding the given values, one a register.
pub(crate) fn pack(netlist: &Netlist, values: impl IntoIterator<Item = u64>) -> FlipFlops {
    let mut bits = FlipFlops::new();
    for (register, value) in netlist.registers.iter().zip(values) {
        let low = bits.len();
        bits.resize(low + netlist.signal(register.output).width as usize, false);
        bits[low..].store_le(value);
    }
    bits
}

/// The value of each register.
///
/// # Panics
///
/// When there are more or fewer flip-flops than the design has.
pub(crate) fn unpack(netlist: &Netlist, bits: &FlipFlops) -> Vec<u64> {
    let widths = netlist.registers.iter().map(|register| netlist.signal(register.output).width);
    assert_eq!(bits.len(), widths.clone().sum::<u32>() as usize, "flip-flops of this design");
    let mut rest = bits.as_bitslice();
    let mut values = Vec::with_capacity(netlist.registers.len());
    for width in widths {
        let (value, above) = rest.split_at(width as usize);
        values.push(value.load_le());
        rest = above;
    }
    values
}

/// Length in bytes of a snapshot with so many inputs and flip-flops.
fn expected_length(inputs: u64, flip_flops: u64) -> usize {
    let words = as_size(inputs).saturating_mul(8);
    words.saturating_add(as_size(flip_flops.div_ceil(8))).saturating_add(32)
}

/// A count as a size; what does not fit is longer than any slice.
fn as_size(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bitvec::bitvec;

    fn snapshot() -> Snapshot {
        let flip_flops = bitvec![u8, Lsb0; 1, 0, 1, 1, 0, 0, 0, 1, 1];
        Snapshot { clock: 8_000_000_000, inputs: vec![7, u64::MAX], flip_flops }
    }

    #[test]
    fn bytes_are_as_documented() {
        let bytes = snapshot().to_bytes();
        assert_eq!(bytes.len(), 8 + 3 * 8 + 2 * 8 + 2);
        assert_eq!(bytes[8..16], 8_000_000_000_u64.to_le_bytes());
        assert_eq!(bytes[48..], [0b1000_1101, 0b1]);
    }

    #[test]
    fn what_was_saved_is_read_back() {
        assert_eq!(Snapshot::from_bytes(&snapshot().to_bytes()), Ok(snapshot()));
    }

    #[test]
    fn every_cut_is_noticed() {
        let bytes = snapshot().to_bytes();
        for length in 0..bytes.len() {
            assert!(Snapshot::from_bytes(&bytes[..length]).is_err(), "{length} bytes");
        }
        let longer = [&bytes[..], &[0]].concat();
        let error = SnapshotError::Length { found: bytes.len() + 1, expected: bytes.len() };
        assert_eq!(Snapshot::from_bytes(&longer), Err(error));
    }

    #[test]
    fn absurd_counts_are_refused() {
        let mut bytes = snapshot().to_bytes();
        bytes[16..24].fill(0xff);
        assert!(Snapshot::from_bytes(&bytes).is_err());
    }
}
