//! What the arrays of a column hold, batch by batch.

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Decimal128Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type,
    TimestampMicrosecondType, TimestampMillisecondType, TimestampNanosecondType,
    TimestampSecondType, UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrowPrimitiveType};
use arrow_schema::{DataType, TimeUnit};

use crate::grid::Cells;

/// A column as it grows.
#[derive(Clone, Debug, Default)]
pub(super) enum Column {
    /// No batch was read yet.
    #[default]
    Empty,
    Numbers(Vec<f64>),
    /// Seconds since the first instant of the column.
    Instants {
        first: Option<i64>,
        since: Vec<f64>,
    },
    Words {
        words: Vec<String>,
        /// How long they are together.
        bytes: usize,
    },
    /// Something else, that is left out.
    Other,
}

impl Column {
    /// Takes up the next batch.
    pub(super) fn append(&mut self, array: &dyn Array) {
        if let Self::Empty = self {
            *self = Self::of_kind(array.data_type());
        }
        let fits = match self {
            Self::Numbers(values) => numbers(array).map(|more| values.extend(more)),
            Self::Instants { first, since } => {
                instants(array, first).map(|more| since.extend(more))
            }
            Self::Words { words, bytes } => self::words(array).map(|more| {
                *bytes += more.iter().map(String::len).sum::<usize>();
                words.extend(more);
            }),
            Self::Empty | Self::Other => None,
        };
        if fits.is_none() {
            *self = Self::Other;
        }
    }

    fn of_kind(kind: &DataType) -> Self {
        match kind {
            DataType::Timestamp(..) => Self::Instants { first: None, since: Vec::new() },
            DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => {
                Self::Words { words: Vec::new(), bytes: 0 }
            }
            DataType::Dictionary(_, held) => Self::of_kind(held),
            _ => Self::Numbers(Vec::new()),
        }
    }

    /// How many cells, and bytes of words.
    pub(super) fn size(&self) -> (usize, usize) {
        match self {
            Self::Numbers(values) | Self::Instants { since: values, .. } => (values.len(), 0),
            Self::Words { words, bytes } => (words.len(), *bytes),
            Self::Empty | Self::Other => (0, 0),
        }
    }

    /// What it holds; `None` when it is left out.
    pub(super) fn cells(&self) -> Option<Cells<'_>> {
        match self {
            Self::Numbers(values) | Self::Instants { since: values, .. } => {
                Some(Cells::Numbers(values))
            }
            Self::Words { words, .. } => Some(Cells::Words(words)),
            Self::Empty | Self::Other => None,
        }
    }
}

/// The numbers of an array, NaN where there is none; `None` when it holds no numbers.
fn numbers(array: &dyn Array) -> Option<Vec<f64>> {
    Some(match array.data_type() {
        DataType::Float64 => floats::<Float64Type>(array, |value| value),
        DataType::Float32 => floats::<Float32Type>(array, f64::from),
        DataType::Int8 => floats::<Int8Type>(array, f64::from),
        DataType::Int16 => floats::<Int16Type>(array, f64::from),
        DataType::Int32 => floats::<Int32Type>(array, f64::from),
        DataType::Int64 => floats::<Int64Type>(array, wide),
        DataType::UInt8 => floats::<UInt8Type>(array, f64::from),
        DataType::UInt16 => floats::<UInt16Type>(array, f64::from),
        DataType::UInt32 => floats::<UInt32Type>(array, f64::from),
        DataType::UInt64 => floats::<UInt64Type>(array, unsigned),
        DataType::Decimal128(_, scale) => {
            let unit = 10_f64.powi(i32::from(*scale));
            floats::<Decimal128Type>(array, |value| widest(value) / unit)
        }
        DataType::Boolean => {
            let truths = array.as_boolean().iter();
            truths.map(|truth| truth.map_or(f64::NAN, |yes| f64::from(u8::from(yes)))).collect()
        }
        _ => return None,
    })
}

/// Instants of an array, in seconds since the first of the column.
///
/// That is taken off while they are whole numbers: a nanosecond of this century is none of a float.
fn instants(array: &dyn Array, first: &mut Option<i64>) -> Option<Vec<f64>> {
    let DataType::Timestamp(unit, _) = array.data_type() else { return None };
    let (ticks, in_a_second) = match unit {
        TimeUnit::Second => (ticks::<TimestampSecondType>(array), 1.0),
        TimeUnit::Millisecond => (ticks::<TimestampMillisecondType>(array), 1e3),
        TimeUnit::Microsecond => (ticks::<TimestampMicrosecondType>(array), 1e6),
        TimeUnit::Nanosecond => (ticks::<TimestampNanosecondType>(array), 1e9),
    };
    let mut since = |tick: i64| {
        let first = *first.get_or_insert(tick);
        wide(tick.saturating_sub(first)) / in_a_second
    };
    Some(ticks.into_iter().map(|tick| tick.map_or(f64::NAN, &mut since)).collect())
}

fn ticks<T: ArrowPrimitiveType<Native = i64>>(array: &dyn Array) -> Vec<Option<i64>> {
    array.as_primitive::<T>().iter().collect()
}

/// The words of an array, empty where there is none; `None` when it holds no words.
fn words(array: &dyn Array) -> Option<Vec<String>> {
    let text = |word: Option<&str>| word.unwrap_or_default().to_owned();
    Some(match array.data_type() {
        DataType::Utf8 => array.as_string::<i32>().iter().map(text).collect(),
        DataType::LargeUtf8 => array.as_string::<i64>().iter().map(text).collect(),
        DataType::Utf8View => array.as_string_view().iter().map(text).collect(),
        DataType::Dictionary(..) => {
            let coded = array.as_any_dictionary();
            let held = words(coded.values())?;
            let keys = coded.normalized_keys().into_iter().enumerate();
            let word = |(row, key): (usize, usize)| {
                if array.is_null(row) { None } else { held.get(key) }.cloned().unwrap_or_default()
            };
            keys.map(word).collect()
        }
        _ => return None,
    })
}

#[expect(clippy::cast_precision_loss, reason = "counters of 64 bits are read as floats do")]
fn wide(value: i64) -> f64 {
    value as f64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn unsigned(value: u64) -> f64 {
    value as f64
}

#[expect(clippy::cast_precision_loss, reason = "digits beyond a float's are rounded")]
fn widest(value: i128) -> f64 {
    value as f64
}

fn floats<T: ArrowPrimitiveType>(array: &dyn Array, number: impl Fn(T::Native) -> f64) -> Vec<f64> {
    array.as_primitive::<T>().iter().map(|value| value.map_or(f64::NAN, &number)).collect()
}
