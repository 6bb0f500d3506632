//! The drag laws as curves of one grain alone.

use crate::figure::{Axis, Figure, Panel};
use bagnold_solver::material::drag::DragLaw;

/// The laws of one grain alone that differ from each other, and who shares them.
const ALONE: [(DragLaw, &str); 3] = [
    (DragLaw::SchillerNaumann, "Schiller–Naumann, Wen–Yu, Gidaspow"),
    (DragLaw::MorsiAlexander, "Morsi–Alexander"),
    (DragLaw::DiFelice, "Di Felice"),
];

/// The same colour for a law in every panel.
pub(super) fn slot(law: DragLaw) -> usize {
    DragLaw::ALL.into_iter().position(|other| other == law).unwrap_or_default()
}

/// The law's name in a figure.
pub(super) fn label(law: DragLaw) -> &'static str {
    match law {
        DragLaw::MorsiAlexander => "Morsi–Alexander",
        DragLaw::SchillerNaumann => "Schiller–Naumann",
        DragLaw::WenYu => "Wen–Yu",
        DragLaw::Ergun => "Ergun",
        DragLaw::Gidaspow => "Gidaspow",
        DragLaw::DiFelice => "Di Felice",
    }
}

/// Drag coefficient of a grain alone over the Reynolds number, and its ratio to that of Schiller and Naumann.
pub(super) fn drag_coefficients() -> Figure {
    let mut coefficient = Panel::new("", Axis::logarithmic("R [-]"), Axis::logarithmic("C_d [-]"));
    let mut ratio = Panel::new("", Axis::logarithmic("R [-]"), Axis::linear("ratio to Schiller–Naumann [-]"));
    let reynolds: Vec<f64> = (-80..=188).map(|k| libm::pow(10.0, f64::from(k) / 40.0)).collect();
    let stokes = reynolds.iter().filter(|&&r| r <= 10.0).map(|&r| (r, 24.0 / r));
    coefficient.reference("Stokes, 24/R", stokes);
    for (law, label) in ALONE {
        let in_range = reynolds.iter().copied().filter(|r| law.reynolds_range().contains(r));
        let points: Vec<(f64, f64)> = in_range.filter_map(|r| Some((r, law.drag_coefficient(r)?))).collect();
        let relative = |&(r, c): &(f64, f64)| Some((r, c / DragLaw::SchillerNaumann.drag_coefficient(r)?));
        ratio.line("", slot(law), points.iter().filter_map(relative));
        coefficient.line(label, slot(law), points);
    }
    Figure::new(
        "drag-coefficients",
        "Drag coefficient of a single grain over its Reynolds number R = |u_r| d/ν, and relative to Schiller and Naumann's. \
         Steps: joints of Morsi and Alexander's table, which ends at R = 50 000. Ergun's law has no single grain.",
        vec![coefficient, ratio],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_drawn_with_all_their_points() {
        let figure = drag_coefficients();
        for series in figure.panels.iter().flat_map(|panel| &panel.series) {
            assert!(series.points.len() > 100, "{} points", series.points.len());
            assert!(series.points.iter().all(|&(x, y)| x > 0.0 && y > 0.0 && y.is_finite()));
        }
        assert!(crate::figure::render::svg(&figure, crate::figure::FigureFormat::SCREEN).is_ok());
    }
}
