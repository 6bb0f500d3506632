//! Other codes' curves in the figures of our own runs.

use crate::figure::{Figure, Mark, Panel, Series};

/// Our figures with those of other codes drawn in: a panel's curves go into our panel of the same title, behind the code's
/// name and with points; what has no place of its own, and pictures of particles, becomes a panel behind ours.
pub(super) fn overlay(own: &[Figure], codes: &[(&str, &[Figure])]) -> Vec<Figure> {
    let mut figures = own.to_vec();
    for figure in &mut figures {
        // a code has its colour in every panel of the figure
        let colours = figure.panels.iter().flat_map(|panel| &panel.series).map(|series| series.colour + 1).max();
        let colours = colours.unwrap_or(0);
        for (place, (code, theirs)) in codes.iter().enumerate() {
            let Some(theirs) = theirs.iter().find(|other| other.name == figure.name) else { continue };
            let own_panels = figure.panels.len();
            for (number, panel) in theirs.panels.iter().enumerate() {
                let twin = twin_of(&figure.panels[..own_panels], panel, number);
                let stride = codes.len();
                let colour = |curve: usize| colours + place + curve * stride;
                draw_in(figure, panel, twin, code, colour);
            }
        }
    }
    figures
}

/// Our panel that another shows the same of: the same title and axes, of several the one at the same place.
fn twin_of(own: &[Panel], panel: &Panel, number: usize) -> Option<usize> {
    let is_same = |own: &Panel| {
        let axes = (&own.x.label, &own.y.label) == (&panel.x.label, &panel.y.label);
        own.title == panel.title && axes && own.field.is_none() && panel.field.is_none()
    };
    Some(number).filter(|&number| own.get(number).is_some_and(is_same)).or_else(|| own.iter().position(is_same))
}

fn draw_in(figure: &mut Figure, panel: &Panel, twin: Option<usize>, code: &str, colour: impl Fn(usize) -> usize) {
    let Some(own) = twin.and_then(|twin| figure.panels.get_mut(twin)) else {
        if !panel.series.is_empty() || panel.field.is_some() {
            let title = format!("{code}: {}", panel.title);
            figure.panels.push(Panel { title: title.trim_end_matches([':', ' ']).to_owned(), ..panel.clone() });
        }
        return;
    };
    let is_new = |series: &&Series| series.mark != Mark::Reference && !own.series.contains(series);
    let curves: Vec<Series> = panel.series.iter().filter(is_new).cloned().collect();
    let mark = |mark: Mark| if mark == Mark::Line { Mark::LinePoints } else { mark };
    own.series.extend(curves.into_iter().enumerate().map(|(place, series)| {
        let label = if series.label.is_empty() { code.to_owned() } else { format!("{code}: {}", series.label) };
        Series { label, mark: mark(series.mark), colour: colour(place), ..series }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Axis;

    fn figure(title: &str, height: f64) -> Figure {
        let mut panel = Panel::new(title, Axis::linear("x [m]"), Axis::linear("y [m]"));
        panel.line("sand", 0, [(0.0, height), (1.0, 0.0)]);
        panel.reference("law", [(0.0, 1.0), (1.0, 1.0)]);
        Figure::new("deposit", "", vec![panel])
    }

    #[test]
    fn panels_without_titles_are_told_by_axes_and_place() {
        let two = |height: f64| {
            let mut figure = figure("", height);
            let mut second = figure.panels[0].clone();
            second.y = Axis::linear("h [m]");
            second.series[0].points[0].1 = 2.0 * height;
            figure.panels.push(second);
            figure
        };
        let merged = overlay(&[two(1.0)], &[("MPM", &[two(3.0)])]);
        let heights =
            |panel: usize| merged[0].panels[panel].series.iter().map(|one| one.points[0].1).collect::<Vec<_>>();
        assert_eq!((merged[0].panels.len(), heights(0), heights(1)), (2, vec![1.0, 1.0, 3.0], vec![2.0, 1.0, 6.0]));
    }

    #[test]
    fn a_codes_curves_stand_beside_ours_and_the_reference_once() {
        let merged = overlay(&[figure("a", 1.0)], &[("MPM", &[figure("a", 2.0)]), ("DEM", &[figure("b", 3.0)])]);
        let panels = &merged[0].panels;
        let labels = |panel: usize| panels[panel].series.iter().map(|one| one.label.as_str()).collect::<Vec<_>>();
        assert_eq!(labels(0), ["sand", "law", "MPM: sand"]);
        assert_ne!(panels[0].series[0].colour, panels[0].series[2].colour);
        let three = overlay(&[figure("a", 1.0)], &[("MPM", &[figure("a", 2.0)]), ("DEM", &[figure("a", 3.0)])]);
        let of_mpm = |figures: &[Figure]| figures[0].panels[0].series[2].colour;
        let alone = overlay(&[figure("a", 1.0)], &[("MPM", &[]), ("DEM", &[figure("a", 3.0)])]);
        assert_ne!(of_mpm(&three), three[0].panels[0].series[3].colour);
        assert_eq!(three[0].panels[0].series[3].colour, of_mpm(&alone), "a code that gives nothing keeps its colour");
        assert_eq!((panels[1].title.as_str(), labels(1)), ("DEM: b", vec!["sand", "law"]));
    }
}
