//! The bytes of an array in a file of XML: raw or in base 64, as they are or in blocks that zlib has compressed.

use super::array::ByteOrder;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// Most bytes that zlib makes of one.
const LARGEST_EXPANSION: usize = 1032;

/// Encoding of a whole file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encoding {
    /// Order of the bytes of headers and values.
    pub(super) order: ByteOrder,
    /// Bytes of a number of a header: 4 or 8.
    pub(super) header: usize,
    /// Whether values are compressed by zlib.
    pub(super) is_compressed: bool,
}

/// Bytes from the start of an array on; what follows the array may stand behind it.
#[derive(Debug, Clone)]
pub(super) enum EncodedArray<'file> {
    /// As they are.
    Raw(&'file [u8]),
    /// In base 64, which may be padded and begin anew between header and values; with bytes that are decoded already.
    Base64 { text: &'file [u8], decoded: Vec<u8> },
}

impl<'file> EncodedArray<'file> {
    pub(super) fn base64(text: &'file [u8]) -> Self {
        Self::Base64 { text, decoded: Vec::new() }
    }

    /// Bytes of the file that are left.
    pub(super) fn left(&self) -> usize {
        match self {
            Self::Raw(bytes) => bytes.len(),
            Self::Base64 { text, .. } => text.len(),
        }
    }

    /// The next bytes; `None` if there are fewer.
    fn take(&mut self, count: usize) -> Result<Vec<u8>, String> {
        match self {
            Self::Raw(bytes) => {
                let (taken, rest) = bytes.split_at_checked(count).ok_or("damaged (an array ends early)")?;
                *bytes = rest;
                Ok(taken.to_vec())
            }
            Self::Base64 { text, decoded } => {
                while decoded.len() < count {
                    decode_some(text, count - decoded.len(), decoded)?;
                }
                let rest = decoded.split_off(count);
                Ok(std::mem::replace(decoded, rest))
            }
        }
    }

    /// A number of a header.
    fn number(&mut self, encoding: Encoding) -> Result<usize, String> {
        let mut bytes = self.take(encoding.header)?;
        if encoding.order == ByteOrder::BigEndian {
            bytes.reverse();
        }
        let number = bytes.iter().rev().fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
        usize::try_from(number).map_err(|_| "damaged (a count without an end)".to_owned())
    }

    /// The bytes of an array, of which there must be `expected`.
    pub(super) fn array(&mut self, expected: usize, encoding: Encoding) -> Result<Vec<u8>, String> {
        let differs = |bytes: usize| format!("with {bytes} bytes of an array that needs {expected}");
        if !encoding.is_compressed {
            let bytes = self.number(encoding)?;
            return if bytes == expected { self.take(expected) } else { Err(differs(bytes)) };
        }
        let (count, size, last) = (self.number(encoding)?, self.number(encoding)?, self.number(encoding)?);
        // every block stands in the header with a number
        if count > self.left() / encoding.header {
            return Err(format!("damaged ({count} blocks of an array)"));
        }
        let last = if last == 0 { size } else { last };
        let total = count.checked_sub(1).map_or(Some(0), |whole| whole.checked_mul(size)?.checked_add(last));
        if total != Some(expected) {
            return Err(total.map_or_else(|| "damaged (blocks without an end)".to_owned(), differs));
        }
        let compressed = (0..count).map(|_| self.number(encoding)).collect::<Result<Vec<usize>, _>>()?;
        let mut bytes = Vec::new();
        for (block, compressed) in compressed.into_iter().enumerate() {
            let size = if block + 1 == count { last } else { size };
            inflate(&self.take(compressed)?, size, &mut bytes)?;
        }
        Ok(bytes)
    }
}

/// Decodes at least one group of four characters and at most what `wanted` bytes need.
fn decode_some(text: &mut &[u8], wanted: usize, decoded: &mut Vec<u8>) -> Result<(), String> {
    let mut groups = Vec::new();
    let most = wanted.div_ceil(3).min(1024) * 4;
    let mut place = 0;
    while let Some(byte) = text.get(place).filter(|_| groups.len() < most) {
        place += 1;
        if !byte.is_ascii_whitespace() {
            groups.push(*byte);
            // the group of a padding is the last of its part
            if *byte == b'=' && groups.len().is_multiple_of(4) {
                break;
            }
        }
    }
    *text = &text[place..];
    if groups.is_empty() {
        return Err("damaged (an array ends early)".to_owned());
    }
    STANDARD.decode_vec(&groups, decoded).map_err(|error| format!("damaged ({error})"))
}

/// Appends the `size` bytes of a block.
fn inflate(compressed: &[u8], size: usize, bytes: &mut Vec<u8>) -> Result<(), String> {
    if size > compressed.len().saturating_mul(LARGEST_EXPANSION) {
        return Err(format!("damaged (a block of {size} bytes in {})", compressed.len()));
    }
    let before = bytes.len();
    // a byte beyond the size tells a block that is larger
    let limit = size as u64 + 1;
    let read = ZlibDecoder::new(compressed).take(limit).read_to_end(bytes);
    read.map_err(|error| format!("damaged ({error})"))?;
    let found = bytes.len() - before;
    if found == size { Ok(()) } else { Err(format!("damaged (a block of {found} bytes for {size})")) }
}
