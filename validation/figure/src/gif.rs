//! Animation → GIF: every picture is rendered like a figure (SVG, raster), then mapped to one fixed palette; of each picture
//! after the first only the pixels that change are stored.

use super::animation::Animation;
use super::error::FigureError;
use super::format::FigureFormat;
use super::palette::FIRST;
use super::{raster, render};
use plotters::style::RGBColor;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::LazyLock;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// Duration of the last picture `[s]`.
const LAST_SECONDS: f64 = 2.0;
/// The palette's index for "as in the picture before".
const UNCHANGED: u8 = 255;
/// Shades of grey, black and white included: text, axes and grid.
const GREYS: u32 = 32;
/// Colours of the colour map, and of its mixtures with white that smooth the edges of particles.
const COLOURS: u32 = 110;
const PALE: u32 = 50;

/// Bits a channel by which the palette's nearest colour is looked up: a search for every pixel takes as long as drawing.
const BITS: u32 = 6;

static PALETTE: LazyLock<Vec<RGBColor>> = LazyLock::new(palette);

/// The animation as the bytes of a GIF that repeats for ever; the same data give the same bytes.
///
/// # Errors
/// No picture, pictures of different sizes, or a picture that cannot be drawn.
pub fn encode(animation: &Animation) -> Result<Vec<u8>, FigureError> {
    let pictures: Vec<IndexedImage> = animation
        .frames
        .par_iter()
        .map(|frame| {
            let pixels = raster::pixels(
                &render::svg(&animation.figure(frame), FigureFormat::HALF)?,
                FigureFormat::HALF.scale as f32,
            )?;
            Ok(IndexedImage::of(&pixels))
        })
        .collect::<Result<_, FigureError>>()?;
    let Some(first) = pictures.first() else { return Err(FigureError::Animation("it has no picture".to_owned())) };
    if pictures.iter().any(|picture| (picture.width, picture.height) != (first.width, first.height)) {
        return Err(FigureError::Animation("its pictures have different sizes".to_owned()));
    }
    let refused = |error: gif::EncodingError| FigureError::Animation(error.to_string());
    let colours: Vec<u8> = PALETTE.iter().flat_map(|&RGBColor(red, green, blue)| [red, green, blue]).collect();
    let (width, height) = (first.width as u16, first.height as u16);
    let mut encoder = gif::Encoder::new(Vec::new(), width, height, &colours).map_err(refused)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(refused)?;
    for (index, picture) in pictures.iter().enumerate() {
        let seconds = if index + 1 == pictures.len() { LAST_SECONDS } else { animation.seconds_per_frame };
        let before = index.checked_sub(1).map(|before| &pictures[before]);
        let mut frame = picture.since(before);
        // GIF counts hundredths of a second
        frame.delay = (100.0 * seconds).round().clamp(1.0, 6000.0) as u16;
        encoder.write_frame(&frame).map_err(refused)?;
    }
    encoder.into_inner().map_err(|error| FigureError::Animation(error.to_string()))
}

/// Greys, the colour map, and its mixtures with white.
fn palette() -> Vec<RGBColor> {
    let share = |step: u32, count: u32| f64::from(step) / f64::from(count - 1);
    let greys = (0..GREYS).map(|step| {
        let grey = (255.0 * share(step, GREYS)).round() as u8;
        RGBColor(grey, grey, grey)
    });
    let full = (0..COLOURS).map(|step| FIRST.at(share(step, COLOURS)));
    let pale = [1.0 / 3.0, 2.0 / 3.0].into_iter().flat_map(|white| {
        (0..PALE).map(move |step| {
            let RGBColor(red, green, blue) = FIRST.at(share(step, PALE));
            let mix = |channel: u8| (f64::from(channel) + white * (255.0 - f64::from(channel))).round() as u8;
            RGBColor(mix(red), mix(green), mix(blue))
        })
    });
    greys.chain(full).chain(pale).collect()
}

/// A picture in indices of the palette.
struct IndexedImage {
    width: usize,
    height: usize,
    indices: Vec<u8>,
}

impl IndexedImage {
    fn of(pixels: &Pixmap) -> Self {
        // the sheet is white and opaque, so that premultiplied colours are the colours
        let mut known = vec![None; 1 << (3 * BITS)];
        let index = |pixel: &PremultipliedColorU8| {
            let leading = [pixel.red(), pixel.green(), pixel.blue()].map(|channel| channel >> (8 - BITS));
            let place = leading.iter().fold(0, |place, &channel| place << BITS | usize::from(channel));
            *known[place].get_or_insert_with(|| nearest(leading.map(whole), &PALETTE))
        };
        let indices = pixels.pixels().iter().map(index).collect();
        Self { width: pixels.width() as usize, height: pixels.height() as usize, indices }
    }

    /// The smallest rectangle with everything that differs from the picture before.
    fn since(&self, before: Option<&Self>) -> gif::Frame<'_> {
        let differs = |x: usize, y: usize| {
            let place = y * self.width + x;
            before.is_none_or(|before| self.indices[place] != before.indices[place])
        };
        let rows: Vec<usize> = (0..self.height).filter(|&y| (0..self.width).any(|x| differs(x, y))).collect();
        let columns: Vec<usize> = (0..self.width).filter(|&x| rows.iter().any(|&y| differs(x, y))).collect();
        // a picture in which nothing has changed still lasts its time
        let span = |ends: &[usize]| match (ends.first(), ends.last()) {
            (Some(&first), Some(&last)) => first..last + 1,
            _ => 0..1,
        };
        let (rows, columns) = (span(&rows), span(&columns));
        let mut buffer = Vec::with_capacity(rows.len() * columns.len());
        for y in rows.clone() {
            for x in columns.clone() {
                buffer.push(if differs(x, y) { self.indices[y * self.width + x] } else { UNCHANGED });
            }
        }
        gif::Frame {
            transparent: before.map(|_| UNCHANGED),
            left: columns.start as u16,
            top: rows.start as u16,
            width: columns.len() as u16,
            height: rows.len() as u16,
            buffer: Cow::Owned(buffer),
            ..gif::Frame::default()
        }
    }
}

/// A channel that has the given leading bits.
fn whole(leading: u8) -> u8 {
    (u32::from(leading) * 255 / ((1 << BITS) - 1)) as u8
}

/// The palette's colour that is nearest in RGB; the first of equals.
fn nearest([red, green, blue]: [u8; 3], palette: &[RGBColor]) -> u8 {
    let square = |a: u8, b: u8| (i32::from(a) - i32::from(b)).pow(2);
    let distance = |&RGBColor(r, g, b): &RGBColor| square(red, r) + square(green, g) + square(blue, b);
    (0_u8..).zip(palette).min_by_key(|(_, colour)| distance(colour)).map_or(0, |(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::super::animation::AnimationFrame;
    use super::super::palette::BLACK;
    use super::super::{Axis, Mark, Series};
    use super::*;
    use plotters::style::WHITE;

    /// Two particles, of which one moves to the right and slows down.
    fn animation(frames: usize) -> Animation {
        let axis = |label: &str, upper| Axis { limits: Some((0.0, upper)), ..Axis::linear(label) };
        let frame = |index: usize| AnimationFrame {
            title: format!("t = {index} s"),
            points: vec![[1.0, 0.5], [2.0 + index as f32, 0.5]],
            values: vec![0.0, 1.0 - 0.2 * index as f32],
            diameter: 0.5,
            lines: vec![Series::new("", Mark::Reference, 0, vec![(0.0, 1.0), (6.0, 1.0)])],
        };
        Animation {
            name: "two-particles".to_owned(),
            caption: String::new(),
            x: axis("x [m]", 6.0),
            y: axis("y [m]", 2.0),
            label: "|v| [m/s]".to_owned(),
            limits: (0.0, 1.0),
            seconds_per_frame: 0.08,
            frames: (0..frames).map(frame).collect(),
        }
    }

    fn decoded(bytes: &[u8]) -> (usize, usize, Vec<gif::Frame<'static>>) {
        let mut decoder = gif::Decoder::new(bytes).expect("a GIF");
        let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("readable") {
            frames.push(frame.clone());
        }
        (width, height, frames)
    }

    #[test]
    fn every_picture_is_there_for_its_time_and_half_the_sheet_wide() {
        let (width, height, frames) = decoded(&encode(&animation(4)).expect("encoded"));
        assert_eq!(width, 800);
        assert!((200..800).contains(&height), "{height}");
        assert_eq!(frames.iter().map(|frame| frame.delay).collect::<Vec<_>>(), [8, 8, 8, 200]);
        assert_eq!((usize::from(frames[0].width), usize::from(frames[0].height)), (width, height));
        // only the title and the moving particle change
        assert!(frames[1..].iter().all(|frame| usize::from(frame.width) < width && usize::from(frame.height) < height));
    }

    #[test]
    fn pictures_put_on_each_other_give_the_last_one() {
        let animation = animation(3);
        let (width, _, frames) = decoded(&encode(&animation).expect("encoded"));
        let mut canvas = frames[0].buffer.to_vec();
        for frame in &frames[1..] {
            for (place, &index) in frame.buffer.iter().enumerate() {
                let (x, y) = (place % usize::from(frame.width), place / usize::from(frame.width));
                if Some(index) != frame.transparent {
                    canvas[(y + usize::from(frame.top)) * width + x + usize::from(frame.left)] = index;
                }
            }
        }
        let last = render::svg(&animation.figure(&animation.frames[2]), FigureFormat::SCREEN).expect("SVG");
        let expected = IndexedImage::of(&raster::pixels(&last, FigureFormat::HALF.scale as f32).expect("raster"));
        assert!(canvas == expected.indices);
    }

    #[test]
    fn the_same_data_give_the_same_bytes_and_none_an_error() {
        assert!(encode(&animation(3)).expect("encoded") == encode(&animation(3)).expect("encoded"));
        assert!(matches!(encode(&animation(0)), Err(FigureError::Animation(_))));
        // a picture that repeats the one before
        let mut still = animation(2);
        still.frames[1] = still.frames[0].clone();
        assert_eq!(decoded(&encode(&still).expect("encoded")).2.len(), 2);
    }

    #[test]
    fn the_palette_leaves_an_index_free_and_has_white_black_and_the_colour_map() {
        let palette = &PALETTE;
        assert!(palette.len() <= usize::from(UNCHANGED));
        for RGBColor(red, green, blue) in [WHITE, BLACK, FIRST.at(1.0)] {
            let index = nearest([red, green, blue], palette);
            assert_eq!(palette[usize::from(index)], RGBColor(red, green, blue));
            let leading = [red, green, blue].map(|channel| whole(channel >> (8 - BITS)));
            let found = palette[usize::from(nearest(leading, palette))];
            assert!(red.abs_diff(found.0).max(green.abs_diff(found.1)).max(blue.abs_diff(found.2)) <= 8, "{found:?}");
        }
    }
}
