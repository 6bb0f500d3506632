//! Discs that follow each other in a drawing, as dots of a round pen: a particle takes some ten bytes instead of fifty,
//! and a browser meets a path for each colour instead of an element for each particle.

use std::collections::HashMap;
use std::fmt::Write;
use std::iter;

/// A filled opaque circle of a finished drawing.
struct Disc<'a> {
    x: i64,
    y: i64,
    radius: u32,
    fill: &'a str,
}

impl<'a> Disc<'a> {
    fn of(line: &'a str) -> Option<Self> {
        let (x, rest) = line.strip_prefix("<circle cx=\"")?.split_once("\" cy=\"")?;
        let (y, rest) = rest.split_once("\" r=\"")?;
        // another attribute between the two, such as an opacity, is no part of a number
        let (radius, fill) = rest.strip_suffix("\"/>")?.split_once("\" fill=\"")?;
        Some(Self { x: x.parse().ok()?, y: y.parse().ok()?, radius: radius.parse().ok()?, fill })
    }
}

/// Every run of opaque discs of one size as one path per colour, in the order in which the colours appear.
pub(super) fn gathered(drawn: &str) -> String {
    let mut text = String::with_capacity(drawn.len());
    let mut lines = drawn.lines().map(|line| (line, Disc::of(line))).peekable();
    while let Some((line, disc)) = lines.next() {
        let Some(first) = disc else {
            text.push_str(line);
            text.push('\n');
            continue;
        };
        let radius = first.radius;
        let more = || lines.next_if(|(_, disc)| disc.as_ref().is_some_and(|disc| disc.radius == radius))?.1;
        dots(iter::once(first).chain(iter::from_fn(more)), radius, &mut text);
    }
    text
}

/// Discs of one radius.
fn dots<'a>(discs: impl Iterator<Item = Disc<'a>>, radius: u32, text: &mut String) {
    let mut numbers: HashMap<&str, usize> = HashMap::new();
    // the pen's steps, and where it is
    let mut paths: Vec<(&str, String, (i64, i64))> = Vec::new();
    for Disc { x, y, fill, .. } in discs {
        let number = *numbers.entry(fill).or_insert(paths.len());
        if number == paths.len() {
            paths.push((fill, format!("M{x} {y}h0"), (x, y)));
            continue;
        }
        let (_, steps, at) = &mut paths[number];
        let (right, down) = (x - at.0, y - at.1);
        let gap = if down < 0 { "" } else { " " };
        write!(steps, "m{right}{gap}{down}h0").expect("a string takes any text");
        *at = (x, y);
    }
    for (colour, steps, _) in paths {
        let width = 2 * radius;
        writeln!(text, "<path d=\"{steps}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>")
            .expect("a string takes any text");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_of_a_size_become_a_path_a_colour() {
        let drawn = "<line x1=\"0\"/>\n\
            <circle cx=\"10\" cy=\"20\" r=\"5\" fill=\"#440154\"/>\n\
            <circle cx=\"20\" cy=\"20\" r=\"5\" fill=\"#440155\"/>\n\
            <circle cx=\"30\" cy=\"19\" r=\"5\" fill=\"#440154\"/>\n\
            <circle cx=\"30\" cy=\"19\" r=\"6\" fill=\"#440154\"/>\n\
            <circle cx=\"30\" cy=\"19\" r=\"6\" opacity=\"0.5\" fill=\"#440154\"/>\n";
        let path = |d: &str, colour: &str, width: u32| {
            format!("<path d=\"{d}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>\n")
        };
        let expected = [
            "<line x1=\"0\"/>\n".to_owned(),
            path("M10 20h0m20-1h0", "#440154", 10),
            path("M20 20h0", "#440155", 10),
            path("M30 19h0", "#440154", 12),
            "<circle cx=\"30\" cy=\"19\" r=\"6\" opacity=\"0.5\" fill=\"#440154\"/>\n".to_owned(),
        ];
        assert_eq!(gathered(drawn), expected.concat());
    }
}
