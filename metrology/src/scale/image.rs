//! The table as the bytes of a 2816 EEPROM (2 KiB), binary or Intel HEX.
//!
//! | bytes      | meaning                                                              |
//! |------------|----------------------------------------------------------------------|
//! | 0 … 3      | `HLC1`                                                               |
//! | 4 … 7      | first place, µm, signed, little-endian                               |
//! | 8, 9       | distance of places, µm, little-endian                                |
//! | 10, 11     | weight of the least bit, nm, little-endian                           |
//! | 12, 13     | places a direction, little-endian                                    |
//! | 14         | 1: one table for both ways; 2: forward, then backward                |
//! | 15         | 0                                                                    |
//! | 16 …       | corrections, signed bytes in LSB, forward first                      |
//! | …          | 0xFF, as an erased EEPROM has it                                     |
//! | 2046, 2047 | CRC-16/CCITT-FALSE of bytes 0 … 2045, high byte first                |

use ihex::{Reader, Record};

use super::table::CorrectionTable;
use crate::Error;

/// Size of the EEPROM.
pub const IMAGE_BYTES: usize = 2048;

const MAGIC: &[u8; 4] = b"HLC1";
const HEADER_BYTES: usize = 16;
const CHECKED_BYTES: usize = IMAGE_BYTES - 2;
const HEX_RECORD_BYTES: usize = 16;

/// The bytes of a table.
///
/// # Errors
///
/// When the table is empty or does not fit, its directions differ in length, or a length is no whole number of the units above within range.
#[expect(clippy::cast_sign_loss, reason = "signed bytes are stored as they are")]
pub fn to_image(table: &CorrectionTable) -> Result<[u8; IMAGE_BYTES], Error> {
    let (forward, backward) = (table.forward.len(), table.backward.len());
    if forward == 0 || (backward != 0 && backward != forward) {
        let reason = format!(
            "{forward} places forward and {backward} backward, expected one or more, as many both ways or none backward"
        );
        return Err(damaged(reason));
    }
    let codes = forward + backward;
    let needed = HEADER_BYTES + codes + 2;
    if IMAGE_BYTES < needed {
        return Err(Error::ImageTooBig { needed, available: IMAGE_BYTES });
    }
    let mut image = [0xFF; IMAGE_BYTES];
    let start = in_units(
        "table start in µm",
        table.start_mm * 1000.0,
        f64::from(i32::MIN),
        f64::from(i32::MAX),
    )?;
    let step = in_units("table step in µm", table.step_mm * 1000.0, 1.0, 65535.0)?;
    let lsb = in_units("LSB in nm", table.lsb_um * 1000.0, 1.0, 65535.0)?;
    image[..4].copy_from_slice(MAGIC);
    image[4..8].copy_from_slice(&low_bytes::<4>(start));
    image[8..10].copy_from_slice(&low_bytes::<2>(step));
    image[10..12].copy_from_slice(&low_bytes::<2>(lsb));
    image[12..14].copy_from_slice(&low_bytes::<2>(i64::try_from(table.forward.len()).unwrap_or(0)));
    image[14] = if table.backward.is_empty() { 1 } else { 2 };
    image[15] = 0;
    let all = table.forward.iter().chain(&table.backward);
    for (byte, code) in image[HEADER_BYTES..CHECKED_BYTES].iter_mut().zip(all) {
        *byte = *code as u8;
    }
    let checksum = crc16(&image[..CHECKED_BYTES]);
    image[CHECKED_BYTES..].copy_from_slice(&checksum.to_be_bytes());
    Ok(image)
}

/// The table of an image.
///
/// # Errors
///
/// When the size, the first bytes, the checksum or the counts are wrong, or the distance of places
/// or the weight of a bit is zero.
#[expect(clippy::cast_possible_wrap, reason = "signed bytes are stored as they are")]
pub fn from_image(image: &[u8]) -> Result<CorrectionTable, Error> {
    if image.len() != IMAGE_BYTES {
        return Err(damaged(format!("{} bytes, expected {IMAGE_BYTES}", image.len())));
    }
    if !image.starts_with(MAGIC) {
        return Err(damaged(format!("begins with {:02x?}, expected `HLC1`", &image[..4])));
    }
    let (stored, computed) =
        (word_high_first(image, CHECKED_BYTES), crc16(&image[..CHECKED_BYTES]));
    if stored != computed {
        return Err(damaged(format!("checksum is {stored:#06x}, expected {computed:#06x}")));
    }
    let places = usize::from(word(image, 12));
    let directions = usize::from(image[14]);
    let room = CHECKED_BYTES - HEADER_BYTES;
    if !(1..=2).contains(&directions) || room < directions * places || places == 0 {
        return Err(damaged(format!(
            "{places} places in {directions} directions, expected 1 to {room} bytes"
        )));
    }
    for (name, at) in [("distance of places", 8), ("weight of the least bit", 10)] {
        if word(image, at) == 0 {
            return Err(damaged(format!("the {name} is 0, expected more")));
        }
    }
    let codes = |from: usize| image[from..from + places].iter().map(|byte| *byte as i8).collect();
    Ok(CorrectionTable {
        start_mm: f64::from(i32::from_le_bytes([image[4], image[5], image[6], image[7]])) / 1000.0,
        step_mm: f64::from(word(image, 8)) / 1000.0,
        lsb_um: f64::from(word(image, 10)) / 1000.0,
        forward: codes(HEADER_BYTES),
        backward: if directions == 2 { codes(HEADER_BYTES + places) } else { Vec::new() },
    })
}

/// An image as Intel HEX, 16 bytes a record, for any EEPROM programmer.
///
/// # Errors
///
/// When a record cannot be written; none of 2 KiB can fail.
pub fn to_hex(image: &[u8; IMAGE_BYTES]) -> Result<String, Error> {
    let data = image.chunks(HEX_RECORD_BYTES).zip((0..).step_by(HEX_RECORD_BYTES));
    let mut records: Vec<Record> =
        data.map(|(value, offset)| Record::Data { offset, value: value.to_vec() }).collect();
    records.push(Record::EndOfFile);
    ihex::create_object_file_representation(&records)
        .map(|text| text + "\n")
        .map_err(|error| damaged(format!("Intel HEX: {error}")))
}

/// The image of an Intel HEX text; bytes it does not name are erased (0xFF).
///
/// # Errors
///
/// When a record is malformed, its checksum is wrong, it lies outside 2 KiB, or the end record
/// is missing; the record is named by its number.
pub fn from_hex(text: &str) -> Result<[u8; IMAGE_BYTES], Error> {
    let mut image = [0xFF; IMAGE_BYTES];
    let mut ended = false;
    for (index, record) in Reader::new(text).enumerate() {
        let wrong = |what: String| damaged(format!("Intel HEX record {}: {what}", index + 1));
        match record.map_err(|error| wrong(error.to_string()))? {
            Record::Data { offset, value } => {
                let from = usize::from(offset);
                let place = image.get_mut(from..from + value.len());
                let place = place.ok_or_else(|| {
                    wrong(format!("address {from:#06x} lies outside 2 KiB, expected up to 0x07ff"))
                })?;
                place.copy_from_slice(&value);
            }
            Record::EndOfFile => ended = true,
            Record::ExtendedLinearAddress(0) | Record::ExtendedSegmentAddress(0) => {}
            other => return Err(wrong(format!("{other:?}, expected data below 2 KiB"))),
        }
    }
    if ended {
        Ok(image)
    } else {
        Err(damaged("Intel HEX: no end record, expected `:00000001FF`".into()))
    }
}

fn damaged(reason: String) -> Error {
    Error::Image { reason }
}

/// A whole number of units; a fraction below a thousandth of a unit is rounding.
#[expect(clippy::cast_possible_truncation, reason = "checked to fit just before")]
fn in_units(name: &'static str, value: f64, least: f64, most: f64) -> Result<i64, Error> {
    if (value - value.round()).abs() <= 1e-3 && least <= value && value <= most {
        return Ok(value.round() as i64);
    }
    Err(Error::OutOfRange { name, found: value, expected: "a whole number that fits the image" })
}

fn low_bytes<const N: usize>(value: i64) -> [u8; N] {
    let bytes = value.to_le_bytes();
    std::array::from_fn(|index| bytes[index])
}

fn word(image: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([image[at], image[at + 1]])
}

fn word_high_first(image: &[u8], at: usize) -> u16 {
    u16::from_be_bytes([image[at], image[at + 1]])
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, nothing reflected.
fn crc16(bytes: &[u8]) -> u16 {
    let bit = |crc: u16| if crc & 0x8000 == 0 { crc << 1 } else { crc << 1 ^ 0x1021 };
    bytes
        .iter()
        .fold(0xFFFF, |crc, byte| (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| bit(crc)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Check value of the CRC catalogue for `123456789`.
    #[test]
    fn checksum_check_value() {
        assert_eq!(crc16(b"123456789"), 0x29B1);
    }

    proptest! {
        #[test]
        fn tables_come_back_from_binary_and_hex(
            forward in prop::collection::vec(-127..=127i8, 1..1000),
            two_ways: bool,
            start_um in -500_000..500_000i32,
        ) {
            let backward = if two_ways { forward.iter().map(|code| -code).collect() } else { vec![] };
            let start_mm = f64::from(start_um) / 1000.0;
            let table = CorrectionTable { start_mm, step_mm: 1.0, lsb_um: 0.1, forward, backward };
            let image = to_image(&table).unwrap();
            prop_assert_eq!(&from_image(&image).unwrap(), &table);
            prop_assert_eq!(from_hex(&to_hex(&image).unwrap()).unwrap(), image);
        }

        #[test]
        fn one_flipped_bit_is_noticed(byte in 0..IMAGE_BYTES, bit in 0..8u8) {
            let table = CorrectionTable {
                start_mm: 0.0, step_mm: 1.0, lsb_um: 0.1, forward: vec![5; 300], backward: vec![],
            };
            let mut image = to_image(&table).unwrap();
            image[byte] ^= 1 << bit;
            prop_assert!(from_image(&image).is_err());
        }
    }

    #[test]
    fn one_metre_at_a_millimetre_fits_both_ways_and_more_does_not() {
        let table = |places: usize| CorrectionTable {
            start_mm: 0.0,
            step_mm: 1.0,
            lsb_um: 0.1,
            forward: vec![1; places],
            backward: vec![1; places],
        };
        assert!(to_image(&table(1001)).is_ok());
        assert_eq!(
            to_image(&table(1016)),
            Err(Error::ImageTooBig { needed: 2050, available: 2048 })
        );
    }

    /// The checksum is right, the content is not.
    #[test]
    fn a_step_or_a_bit_of_nothing_is_refused() {
        let table = CorrectionTable {
            start_mm: 0.0,
            step_mm: 1.0,
            lsb_um: 0.1,
            forward: vec![5; 3],
            backward: vec![],
        };
        for at in [8, 10] {
            let mut image = to_image(&table).unwrap();
            image[at..at + 2].copy_from_slice(&[0, 0]);
            let checksum = crc16(&image[..CHECKED_BYTES]);
            image[CHECKED_BYTES..].copy_from_slice(&checksum.to_be_bytes());
            let error = from_image(&image).unwrap_err().to_string();
            assert!(error.contains("is 0, expected more"), "{error}");
        }
        let uneven = CorrectionTable { backward: vec![5; 2], ..table };
        assert!(to_image(&uneven).is_err());
    }

    #[test]
    fn a_damaged_hex_file_names_its_record() {
        let table = CorrectionTable {
            start_mm: 0.0,
            step_mm: 1.0,
            lsb_um: 0.1,
            forward: vec![5; 3],
            backward: vec![],
        };
        let text = to_hex(&to_image(&table).unwrap()).unwrap();
        let error = from_hex(&text.replacen(":10001000", ":10001100", 1)).unwrap_err().to_string();
        assert!(error.contains("record 2"), "{error}");
        let error = from_hex(text.lines().next().unwrap()).unwrap_err().to_string();
        assert!(error.contains("no end record"), "{error}");
    }
}
