//! The drag laws as curves: one grain alone, and how its neighbours hinder it.

use crate::figure::{Axis, Figure, Panel};
use crate::reference::settling::{GrainForm, SettlingGrains, richardson_zaki_exponent};
use bagnold_solver::material::drag::DragLaw;

/// The laws of one grain alone that differ from each other, and who shares them.
const ALONE: [(DragLaw, &str); 3] = [
    (DragLaw::SchillerNaumann, "Schiller–Naumann, Wen–Yu, Gidaspow"),
    (DragLaw::MorsiAlexander, "Morsi–Alexander"),
    (DragLaw::DiFelice, "Di Felice"),
];

/// The laws of a suspension, from few grains to a bed.
const SUSPENSION: [DragLaw; 4] = [DragLaw::WenYu, DragLaw::DiFelice, DragLaw::Ergun, DragLaw::Gidaspow];

/// Densest suspension drawn: about a random close packing.
const DENSEST: f64 = 0.62;

/// Quartz sand of 1 mm in water.
const SAND: SettlingGrains = SettlingGrains {
    grain_diameter: 1e-3,
    grain_density: 2600.0,
    fluid_density: 1000.0,
    kinematic_viscosity: 1e-6,
    gravity: 9.81,
};

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
        "Drag coefficient of one grain alone over its Reynolds number R = |u_r| d/ν, and relative to Schiller and \
         Naumann's. The steps are the joints of Morsi and Alexander's table, which ends at R = 50 000. Ergun's law \
         describes beds and has no grain alone.",
        vec![coefficient, ratio],
    )
}

/// Exchange coefficient per grain over that of a grain alone, and the settling velocity that follows, over the fraction.
pub(super) fn hindrance() -> Figure {
    let fractions: Vec<f64> = (1..=124).map(|k| DENSEST * f64::from(k) / 124.0).collect();
    let mut panels: Vec<Panel> = [(0.0, "R → 0"), (100.0, "R = 100")]
        .into_iter()
        .map(|(reynolds, title)| exchange_panel(&fractions, reynolds, title))
        .collect();
    panels.push(velocity_panel(&fractions));
    // one legend serves the panels that share their laws
    panels[1].series.iter_mut().for_each(|series| series.label.clear());
    Figure::new(
        "hindrance",
        "Exchange coefficient K(φ)/φ of a suspension over that of Schiller and Naumann's grain alone, at two slips R \
         = |u_r| d/ν, and the velocity at which sand of 1 mm sinks in water over that of one grain after the same \
         law (Ergun: after Wen and Yu). Gidaspow's law is Wen and Yu's up to φ = 0.2 and Ergun's above; the two do \
         not meet. Dashed: Richardson and Zaki (1954), unverified: observed, not judged.",
        panels,
    )
    .in_columns(3)
}

fn exchange_panel(fractions: &[f64], reynolds: f64, title: &str) -> Panel {
    let mut panel = Panel::new(title, Axis::linear("φ [-]"), Axis::logarithmic("K(φ)/φ over a grain alone [-]"));
    let slip = reynolds * SAND.kinematic_viscosity / SAND.grain_diameter;
    let exchange_of_a_grain = |law: DragLaw, fraction: f64| {
        let (d, rho, nu) = (SAND.grain_diameter, SAND.fluid_density, SAND.kinematic_viscosity);
        law.exchange_coefficient(fraction, slip, d, rho, nu) / fraction
    };
    // a dilute law has the same exchange of a grain at every fraction
    let alone = exchange_of_a_grain(DragLaw::SchillerNaumann, 1.0);
    for law in SUSPENSION {
        let points = fractions.iter().map(|&phi| (phi, exchange_of_a_grain(law, phi) / alone));
        panel.line(label(law), slot(law), points);
    }
    panel
}

fn velocity_panel(fractions: &[f64]) -> Panel {
    let mut panel = Panel::new("sand, 1 mm", Axis::linear("φ [-]"), Axis::linear("(1 − φ) u_r/u_t [-]"));
    panel.y.limits = Some((0.0, 1.0));
    let alone = |law: DragLaw| SAND.terminal_velocity(law, GrainForm::Sphere);
    if let Some(terminal) = alone(DragLaw::WenYu) {
        let exponent = richardson_zaki_exponent(SAND.reynolds(terminal));
        let points = fractions.iter().map(|&phi| (phi, libm::pow(1.0 - phi, exponent)));
        panel.reference("Richardson–Zaki (unverified)", points);
    }
    for law in SUSPENSION {
        let terminal = alone(law).or(alone(DragLaw::WenYu));
        let relative = |&phi: &f64| Some((phi, SAND.hindered_velocity(law, phi)? / terminal?));
        panel.line("", slot(law), fractions.iter().filter_map(relative));
    }
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_drawn_with_all_their_points() {
        for figure in [drag_coefficients(), hindrance()] {
            for series in figure.panels.iter().flat_map(|panel| &panel.series) {
                assert!(series.points.len() > 100, "{}: {} points", figure.name, series.points.len());
                assert!(series.points.iter().all(|&(x, y)| x > 0.0 && y > 0.0 && y.is_finite()), "{}", figure.name);
            }
            assert!(crate::figure::render::svg(&figure, crate::figure::FigureFormat::SCREEN).is_ok());
        }
    }
}
