//! The size of a written picture, which a page states so that it need not wait for the picture.

use std::io::Read;
use std::path::Path;

/// Width and height of a PNG or GIF `[px]`, read from its header; `None` for other files.
pub fn size_of(picture: &Path) -> Option<(u32, u32)> {
    let mut start = [0; 24];
    std::fs::File::open(picture).ok()?.read_exact(&mut start).ok()?;
    size_in(&start)
}

/// PNG: eight bytes of signature, eight of the first chunk's length and name, then width and height with the high byte
/// first. GIF: six bytes of signature, then both with the low byte first.
fn size_in(start: &[u8; 24]) -> Option<(u32, u32)> {
    let wide = |at: usize| Some(u32::from_be_bytes(start[at..at + 4].try_into().ok()?));
    let narrow = |at: usize| u32::from(u16::from_le_bytes([start[at], start[at + 1]]));
    if start.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some((wide(16)?, wide(20)?))
    } else if start.starts_with(b"GIF8") {
        Some((narrow(6), narrow(8)))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_bytes_of_pictures() {
        // 1600 = 0x640, 900 = 0x384
        let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x06\x40\0\0\x03\x84";
        assert_eq!(size_in(png), Some((1600, 900)));
        let gif = b"GIF89a\x40\x06\x84\x03\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
        assert_eq!(size_in(gif), Some((1600, 900)));
        assert_eq!(size_in(b"<svg width=\"160\" height="), None);
    }

    #[test]
    fn invalid_picture_has_no_size() {
        assert_eq!(size_of(Path::new("no/such.png")), None);
    }
}
