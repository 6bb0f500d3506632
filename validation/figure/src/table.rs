//! A figure's data as CSV: a row per point, with the labels of its panel, so that a plot can be made anew elsewhere.

use super::{Figure, Mark, Panel};
use std::fmt::Write;

const HEAD: &str = "panel,x_axis,y_axis,drawn_as,label,curve,x,y,error,lower,upper,value\n";

/// Table of the data of a figure, with an empty cell for values that are not finite: series with the half height of their error bars,
/// bands with their edges, particles with their scalar.
pub fn csv(figure: &Figure) -> String {
    let mut text = HEAD.to_owned();
    for (place, panel) in figure.panels.iter().enumerate() {
        let title = format!("{} {}", place + 1, panel.title);
        add_panel(&mut text, &[title.trim_end(), &panel.x.label, &panel.y.label].map(quoted).join(","), panel);
    }
    text
}

fn add_panel(text: &mut String, start: &str, panel: &Panel) {
    // several curves may have one label or none
    let mut curve = 0;
    let mut row = |kind: &str, (label, is_first): (&str, bool), numbers: [Option<f64>; 6]| {
        curve += usize::from(is_first);
        let numbers = numbers.map(|number| number.filter(|number| !number.is_nan()).map(short).unwrap_or_default());
        writeln!(text, "{start},{kind},{},{curve},{}", quoted(label), numbers.join(","))
            .expect("a string takes any text");
    };
    for series in &panel.series {
        let kind = match series.mark {
            Mark::Line => "line",
            Mark::Reference => "reference",
            Mark::Points => "points",
            Mark::OpenPoints => "open points",
            Mark::LinePoints => "line with points",
        };
        for (place, &(x, y)) in series.points.iter().enumerate() {
            row(
                kind,
                (&series.label, place == 0),
                [Some(x), Some(y), series.error.get(place).copied(), None, None, None],
            );
        }
    }
    for band in &panel.bands {
        for (place, &(x, lower, upper)) in band.points.iter().enumerate() {
            row("band", (&band.label, place == 0), [Some(x), None, None, Some(lower), Some(upper), None]);
        }
    }
    for field in panel.field.iter().chain(&panel.opposite) {
        for (place, &(x, y)) in field.points.iter().enumerate() {
            row(
                "particles",
                (&field.label, place == 0),
                [Some(x), Some(y), None, None, None, field.values.get(place).copied()],
            );
        }
    }
}

/// A number to seven digits.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.6e}").parse().unwrap_or(number);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A field, in quotes where CSV needs them.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Field};

    #[test]
    fn every_point_has_a_row_with_its_labels() {
        let mut panel = Panel::new("rest, \"slow\"", Axis::linear("u [m/s]"), Axis::linear("y [m]"));
        panel.points("a", 0, [(0.1, 2.0)]).error = vec![0.25];
        panel.band("b", [(1.0, 1e-9, 3.0)]);
        panel.field = Some(Field::new("p [Pa]", 0.1, (0.0, 1.0), [(1.0, 2.0)], [1.0 / 3.0]));
        let text = csv(&Figure::new("profile", "", vec![panel]));
        let rows: Vec<&str> = text.lines().collect();
        let start = "\"1 rest, \"\"slow\"\"\",u [m/s],y [m]";
        assert_eq!(rows[0], HEAD.trim_end());
        assert_eq!(rows[1], format!("{start},points,a,1,0.1,2,0.25,,,"));
        assert_eq!(rows[2], format!("{start},band,b,2,1,,,1e-9,3,"));
        assert_eq!(rows[3], format!("{start},particles,p [Pa],3,1,2,,,,0.3333333"));
    }
}
