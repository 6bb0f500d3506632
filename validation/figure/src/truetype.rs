//! Tables of a TrueType font as DejaVu has them: `cmap` of format 12, `hmtx`, `loca` with long offsets, `glyf`, one `kern` of
//! format 0. Sources: Apple, TrueType Reference Manual, chapter 6; Microsoft, OpenType specification 1.9.

/// A font file.
pub(super) struct Font {
    file: Bytes,
    /// Starts of the tables in the file; `groups` of `cmap` and `pairs` of `kern` are those behind their heads.
    groups: usize,
    glyphs: usize,
    locations: usize,
    metrics: usize,
    pairs: usize,
    /// Number of glyphs with an advance of their own.
    advances: u16,
    /// Units of an em.
    pub(super) units_per_em: u16,
    /// Ascent minus descent in units.
    pub(super) line: i32,
}

/// A point of a contour in units of the font, y upwards, and whether the contour passes through it.
#[derive(Clone, Copy)]
pub(super) struct ContourPoint {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) is_on: bool,
}

/// Numbers of a file, most significant byte first; none behind its end.
#[derive(Clone, Copy)]
struct Bytes(&'static [u8]);

impl Bytes {
    fn unsigned(&self, at: usize) -> Option<u16> {
        Some(u16::from_be_bytes(*self.0.get(at..)?.first_chunk()?))
    }

    fn signed(&self, at: usize) -> Option<i16> {
        self.unsigned(at).map(u16::cast_signed)
    }

    fn long(&self, at: usize) -> Option<usize> {
        Some(u32::from_be_bytes(*self.0.get(at..)?.first_chunk()?) as usize)
    }
}

impl Font {
    pub(super) fn new(data: &'static [u8]) -> Option<Self> {
        let file = Bytes(data);
        let table = |tag: &[u8; 4]| {
            let entry = (0..usize::from(file.unsigned(4)?)).map(|table| 12 + 16 * table);
            let entry = entry.into_iter().find(|&entry| data.get(entry..entry + 4) == Some(tag))?;
            file.long(entry + 8)
        };
        let (map, horizontal) = (table(b"cmap")?, table(b"hhea")?);
        let groups = (0..usize::from(file.unsigned(map + 2)?))
            .filter_map(|entry| Some(map + file.long(map + 8 + 8 * entry)?))
            .find(|&at| file.unsigned(at) == Some(12))?;
        Some(Self {
            groups: groups + 12,
            glyphs: table(b"glyf")?,
            locations: table(b"loca")?,
            metrics: table(b"hmtx")?,
            pairs: table(b"kern")? + 10,
            advances: file.unsigned(horizontal + 34)?,
            units_per_em: file.unsigned(table(b"head")? + 18)?,
            line: i32::from(file.signed(horizontal + 4)?) - i32::from(file.signed(horizontal + 6)?),
            file,
        })
    }

    /// The glyph of a letter; 0, an empty box, where there is none.
    pub(super) fn glyph(&self, letter: char) -> u16 {
        let letter = letter as usize;
        let number = self.file.long(self.groups).unwrap_or(0);
        let group =
            first(number, |group| self.file.long(self.groups + 8 + 12 * group).is_none_or(|last| last >= letter));
        let start = self.groups + 4 + 12 * group;
        match (self.file.long(start), self.file.long(start + 8)) {
            (Some(from), Some(glyph)) if group < number && from <= letter => (glyph + letter - from) as u16,
            _ => 0,
        }
    }

    /// The way from a glyph to the next in units.
    pub(super) fn advance(&self, glyph: u16) -> i32 {
        let own = usize::from(glyph.min(self.advances.saturating_sub(1)));
        self.file.unsigned(self.metrics + 4 * own).map_or(0, i32::from)
    }

    /// The way that a pair of glyphs adds between them in units.
    pub(super) fn kerning(&self, left: u16, right: u16) -> i32 {
        let pair = usize::from(left) << 16 | usize::from(right);
        let number = self.file.unsigned(self.pairs).map_or(0, usize::from);
        let at = self.pairs
            + 8
            + 6 * first(number, |at| self.file.long(self.pairs + 8 + 6 * at).is_none_or(|at| at >= pair));
        if self.file.long(at) == Some(pair) { self.file.signed(at + 4).map_or(0, i32::from) } else { 0 }
    }

    /// The contours of a glyph, of its parts where it has any; `depth` bounds parts of parts.
    pub(super) fn contours(&self, glyph: u16, depth: u8) -> Option<Vec<Vec<ContourPoint>>> {
        let location = self.locations + 4 * usize::from(glyph);
        let (start, end) = (self.file.long(location)?, self.file.long(location + 4)?);
        if start == end {
            return Some(Vec::new());
        }
        let at = self.glyphs + start;
        match usize::try_from(self.file.signed(at)?) {
            Ok(number) => self.simple(at + 10, number),
            Err(_) => self.composite(at + 10, depth.checked_sub(1)?),
        }
    }

    fn simple(&self, at: usize, contours: usize) -> Option<Vec<Vec<ContourPoint>>> {
        const ON: u8 = 1;
        const REPEATED: u8 = 8;
        let ends: Vec<usize> = (0..contours)
            .map(|contour| self.file.unsigned(at + 2 * contour).map(usize::from))
            .collect::<Option<_>>()?;
        let number = ends.last()? + 1;
        let mut at = at + 2 * contours;
        at += 2 + usize::from(self.file.unsigned(at)?);
        let mut flags = Vec::with_capacity(number);
        while flags.len() < number {
            let flag = *self.file.0.get(at)?;
            let times = if flag & REPEATED == 0 { 0 } else { *self.file.0.get(at + 1)? };
            flags.extend(std::iter::repeat_n(flag, 1 + usize::from(times)));
            at += if flag & REPEATED == 0 { 1 } else { 2 };
        }
        // steps of x, then of y: of one byte with a sign in the flag, or of two, or none
        let mut along = |short: u8, same: u8| {
            let mut place = 0;
            let step = |&flag: &u8| {
                let is_same = flag & same != 0;
                if flag & short != 0 {
                    let step = i32::from(*self.file.0.get(at)?);
                    at += 1;
                    place += if is_same { step } else { -step };
                } else if !is_same {
                    place += i32::from(self.file.signed(at)?);
                    at += 2;
                }
                Some(place as f32)
            };
            flags[..number].iter().map(step).collect::<Option<Vec<f32>>>()
        };
        let (x, y) = (along(2, 16)?, along(4, 32)?);
        let mut from = 0;
        let contour = |&end: &usize| {
            let points =
                (from..=end).map(|i| Some(ContourPoint { x: *x.get(i)?, y: *y.get(i)?, is_on: flags[i] & ON != 0 }));
            from = end + 1;
            points.collect()
        };
        ends.iter().map(contour).collect()
    }

    /// Parts that are moved by two numbers; DejaVu scales and turns none.
    fn composite(&self, mut at: usize, depth: u8) -> Option<Vec<Vec<ContourPoint>>> {
        const WORDS: u16 = 1;
        const MORE: u16 = 0x20;
        let mut contours = Vec::new();
        loop {
            let flags = self.file.unsigned(at)?;
            let byte = |at: usize| self.file.0.get(at).map(|&byte| f32::from(byte as i8));
            let (right, up, next) = match flags & WORDS {
                0 => (byte(at + 4)?, byte(at + 5)?, 6),
                _ => (f32::from(self.file.signed(at + 4)?), f32::from(self.file.signed(at + 6)?), 8),
            };
            let moved = |point: ContourPoint| ContourPoint { x: point.x + right, y: point.y + up, ..point };
            let part = self.contours(self.file.unsigned(at + 2)?, depth)?;
            contours.extend(part.into_iter().map(|contour| contour.into_iter().map(moved).collect()));
            at += next;
            if flags & MORE == 0 {
                return Some(contours);
            }
        }
    }
}

/// The first of `number` sorted entries at which `is_reached`, or their number.
fn first(number: usize, is_reached: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, number);
    while low < high {
        let middle = low + (high - low) / 2;
        if is_reached(middle) { high = middle } else { low = middle + 1 }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::super::glyphs::add;
    use super::*;

    #[test]
    fn glyphs_fill_the_boxes_that_the_file_states() {
        // advance of A, and the pair A V, by another reader
        for (data, pair) in [(dejavu::sans::regular(), (1401, -131, 0)), (dejavu::sans::bold(), (1585, -139, 0))] {
            let font = Font::new(data).expect("a font");
            let (a, v) = (font.glyph('A'), font.glyph('V'));
            assert_eq!((font.advance(a), font.kerning(a, v), font.kerning(v, v)), pair);
            let (mut composites, mut rough) = (0, 0);
            for glyph in 0..6196 {
                let location = font.locations + 4 * usize::from(glyph);
                let head = font.glyphs + font.file.long(location).expect("a place");
                let contours = font.contours(glyph, 4).expect("a glyph");
                let mut path = tiny_skia::PathBuilder::new();
                contours.iter().for_each(|contour| add(&mut path, contour, |place| place));
                let Some(bounds) = path.finish().and_then(|path| path.compute_tight_bounds()) else { continue };
                let found = [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()];
                let stated = [2, 4, 6, 8].map(|at| f32::from(font.file.signed(head + at).expect("a number")));
                let off = found.iter().zip(&stated).map(|(found, stated)| (found - stated).abs()).fold(0.0, f32::max);
                assert!(off < 100.0, "{glyph}: {found:?}, {stated:?}");
                // where a curve ends between its points, the file states these for some glyphs
                rough += usize::from(off > 1.0);
                composites += usize::from(font.file.signed(head).expect("a number") < 0);
            }
            assert!(composites > 2000 && rough < 150, "{composites}, {rough}");
        }
    }

    #[test]
    fn damaged_fonts_are_refused_or_read() {
        let data = dejavu::sans::regular();
        for length in [0, 3, 11, 200, 5000, 300_000] {
            let cut: &'static [u8] = &data[..length];
            if let Some(font) = Font::new(cut) {
                "Ågφ∞".chars().for_each(|letter| drop(font.contours(font.glyph(letter), 4)));
            }
        }
    }
}
