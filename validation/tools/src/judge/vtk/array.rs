//! Numbers of an array from text or bytes.

use serde::Deserialize;
use serde::de::value::StrDeserializer;

/// Order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ByteOrder {
    LittleEndian,
    BigEndian,
}

/// Type of the values of an array, by its name in the XML formats.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub(super) enum Scalar {
    /// Eight values per byte, the first in the highest bit.
    Bit,
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float32,
    Float64,
}

impl Scalar {
    /// Type by its name in the XML formats.
    pub(super) fn of_xml(name: &str) -> Option<Self> {
        Self::deserialize(StrDeserializer::<serde::de::value::Error>::new(name)).ok()
    }

    /// Type by its name in the legacy format, which stores identifiers as 4 bytes.
    pub(super) fn of_legacy(name: &str) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_str() {
            "bit" => Self::Bit,
            "char" | "signed_char" | "vtktypeint8" => Self::Int8,
            "unsigned_char" | "vtktypeuint8" => Self::UInt8,
            "short" | "vtktypeint16" => Self::Int16,
            "unsigned_short" | "vtktypeuint16" => Self::UInt16,
            "int" | "vtkidtype" | "vtktypeint32" => Self::Int32,
            "unsigned_int" | "vtktypeuint32" => Self::UInt32,
            "long" | "vtktypeint64" => Self::Int64,
            "unsigned_long" | "vtktypeuint64" => Self::UInt64,
            "float" => Self::Float32,
            "double" => Self::Float64,
            _ => return None,
        })
    }

    /// Bytes of `count` values, unless no memory could hold them.
    pub(super) fn bytes_of(self, count: usize) -> Option<usize> {
        match self {
            Self::Bit => Some(count.div_ceil(8)),
            Self::Int8 | Self::UInt8 => Some(count),
            Self::Int16 | Self::UInt16 => count.checked_mul(2),
            Self::Int32 | Self::UInt32 | Self::Float32 => count.checked_mul(4),
            Self::Int64 | Self::UInt64 | Self::Float64 => count.checked_mul(8),
        }
    }

    /// The first `count` values of `bytes`, which holds [`Scalar::bytes_of`] them.
    pub(super) fn decode(self, bytes: &[u8], count: usize, order: ByteOrder) -> Vec<f64> {
        match self {
            Self::Bit => (0..count).map(|bit| f64::from(bytes[bit / 8] >> (7 - bit % 8) & 1)).collect(),
            Self::Int8 => each(bytes, order, |[byte]: [u8; 1]| f64::from(byte.cast_signed())),
            Self::UInt8 => each(bytes, order, |[byte]: [u8; 1]| f64::from(byte)),
            Self::Int16 => each(bytes, order, |bytes| f64::from(i16::from_le_bytes(bytes))),
            Self::UInt16 => each(bytes, order, |bytes| f64::from(u16::from_le_bytes(bytes))),
            Self::Int32 => each(bytes, order, |bytes| f64::from(i32::from_le_bytes(bytes))),
            Self::UInt32 => each(bytes, order, |bytes| f64::from(u32::from_le_bytes(bytes))),
            Self::Int64 => each(bytes, order, |bytes| i64::from_le_bytes(bytes) as f64),
            Self::UInt64 => each(bytes, order, |bytes| u64::from_le_bytes(bytes) as f64),
            Self::Float32 => each(bytes, order, |bytes| f64::from(f32::from_le_bytes(bytes))),
            Self::Float64 => each(bytes, order, f64::from_le_bytes),
        }
    }

    /// The next `count` values of a text, rounded as the type rounds them.
    pub(super) fn parse<'text>(
        self,
        words: &mut impl Iterator<Item = &'text str>,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let mut values = Vec::new();
        while values.len() < count {
            let word = words.next().ok_or_else(|| format!("with {} of {count} values", values.len()))?;
            let value =
                if self == Self::Float32 { word.parse().map(|value: f32| f64::from(value)) } else { word.parse() };
            values
                .push(value.map_err(|_| format!("with `{}` for a number", word.chars().take(40).collect::<String>()))?);
        }
        Ok(values)
    }
}

/// All values of `SIZE` bytes, each handed to `value` in little-endian order.
fn each<const SIZE: usize>(bytes: &[u8], order: ByteOrder, value: impl Fn([u8; SIZE]) -> f64) -> Vec<f64> {
    let (numbers, _) = bytes.as_chunks::<SIZE>();
    let in_order = |number: &[u8; SIZE]| {
        let mut number = *number;
        if order == ByteOrder::BigEndian {
            number.reverse();
        }
        value(number)
    };
    numbers.iter().map(in_order).collect()
}
