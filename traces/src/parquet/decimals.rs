//! Decimals: whole numbers of some power of ten.

use ::parquet::basic::ConvertedType;
use ::parquet::schema::types::ColumnDescriptor;

/// Most bytes of a decimal that is read: 38 digits.
const MOST_BYTES: usize = 16;

/// True for decimals of up to 38 digits; those of no fixed length tell theirs value by value.
pub(super) fn is_decimal(column: &ColumnDescriptor) -> bool {
    let fits = usize::try_from(column.type_length()).is_ok_and(|bytes| bytes <= MOST_BYTES);
    column.converted_type() == ConvertedType::DECIMAL && (fits || column.type_length() < 0)
}

/// What the whole numbers of a column are divided by: 1 but for decimals.
pub(super) fn scale(column: &ColumnDescriptor) -> f64 {
    if is_decimal(column) { 10_f64.powi(column.type_scale()) } else { 1.0 }
}

/// A whole number of big-endian bytes, in two's complement; NaN for more of them than 16.
#[expect(clippy::cast_precision_loss, reason = "digits beyond a float's are rounded")]
pub(super) fn whole(bytes: &[u8]) -> f64 {
    if MOST_BYTES < bytes.len() {
        return f64::NAN;
    }
    let sign = if bytes.first().is_some_and(|first| 0x7F < *first) { -1 } else { 0_i128 };
    bytes.iter().fold(sign, |number, byte| (number << 8) | i128::from(*byte)) as f64
}

#[cfg(test)]
mod tests {
    use super::whole;

    #[test]
    fn bytes_are_in_twos_complement() {
        for number in [0_i32, 1, -1, 127, 128, -128, -129, 123_456, i32::MAX, i32::MIN] {
            assert_eq!(whole(&number.to_be_bytes()).to_bits(), f64::from(number).to_bits());
        }
        assert_eq!(whole(&[0xFF]).to_bits(), (-1.0_f64).to_bits());
        assert!(whole(&[0; 17]).is_nan());
    }
}
