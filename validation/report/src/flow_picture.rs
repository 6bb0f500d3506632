//! The flow of a case in one picture: what moves, before the values that are measured of it.

use super::CaseReport;
use crate::figure::{Axis, Field, Figure, Panel};
use crate::observation::{Frame, Outcome};

/// Name of the picture among the figures of a case.
const NAME: &str = "snapshot";
/// Speed over that of free fall through the pressure head below which a body is at rest `[-]`.
const AT_REST: f64 = 0.01;

/// The picture: of the case's own figure of particles the panel with the largest values, else of its finest run.
pub(super) fn of_case(case: &CaseReport) -> Option<Figure> {
    let own = case.figures.iter().find_map(|figure| {
        let caption = format!("The flow at one time; see the figure {} for further times and places.", figure.name);
        Some((fastest_panel(figure)?.clone(), caption))
    });
    let (panel, caption) = own.or_else(|| of_frames(case))?;
    Some(Figure::new(NAME, &caption, vec![panel]))
}

/// Of the panels with the first one's colours, the one with the largest values.
fn fastest_panel(figure: &Figure) -> Option<&Panel> {
    let first = figure.panels.iter().find_map(|panel| panel.field.as_ref())?;
    let squares = |panel: &Panel| {
        let field = panel.field.as_ref().filter(|field| field.label == first.label);
        field.map(|field| field.values.iter().filter(|value| value.is_finite()).map(|value| value * value).sum::<f64>())
    };
    let all = figure.panels.iter().filter_map(|panel| Some((squares(panel)?, panel)));
    all.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, panel)| panel)
}

/// The fastest picture of the finest run that ended well.
fn of_frames(case: &CaseReport) -> Option<(Panel, String)> {
    let runs = case
        .runs
        .iter()
        .zip(&case.frames)
        .filter(|(run, frames)| !frames.is_empty() && !matches!(run.outcome, Outcome::Diverged { .. }));
    let (run, frames) = runs.max_by_key(|(run, _)| run.particles)?;
    let squares = |frame: &Frame| frame.speeds().iter().map(|speed| speed * speed).sum::<f64>();
    let frame = frames.iter().max_by(|one, other| squares(one).total_cmp(&squares(other)))?;
    let (values, label) = coloured(frame);
    let spacing = spacing(frame);
    // of a body in space the slice beside the plane z = 0, and one phase of two
    let phases = frame.scalar("phase");
    let is_shown = |particle: &usize| {
        frame.position[*particle][2].abs() < spacing && phases.get(*particle).is_none_or(|phase| *phase == 0.0)
    };
    let shown: Vec<usize> = (0..frame.position.len()).filter(is_shown).collect();
    let end = values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let points = shown.iter().map(|&particle| (frame.position[particle][0], frame.position[particle][1]));
    let mut panel = Panel::new(&format!("t = {:.3} s", frame.time), Axis::linear("x [m]"), Axis::linear("y [m]"));
    panel.field =
        Some(Field::new(label, spacing, (0.0, end), points, shown.iter().filter_map(|&own| values.get(own).copied())));
    let named = if run.variant.is_empty() { String::new() } else { format!(" of run {}", run.variant) };
    Some((panel, format!("The particles{named}.")))
}

/// Speeds; of a body at rest pressures.
fn coloured(frame: &Frame) -> (Vec<f64>, &'static str) {
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let (speeds, pressures) = (frame.speeds(), frame.pressures());
    // kPa; water of two phases has no density, and flows
    let square_of_fall = 2e3 * largest(&pressures) / largest(frame.scalar("density"));
    let is_at_rest = square_of_fall.is_finite() && largest(&speeds) < AT_REST * square_of_fall.sqrt();
    if is_at_rest { (pressures, "p [kPa]") } else { (speeds, "|v| [m/s]") }
}

/// Particle spacing `[m]`: by the volume of a particle, else by the area of all.
fn spacing(frame: &Frame) -> f64 {
    if let (Some(mass), Some(density)) = (frame.scalar("mass").first(), frame.scalar("density").first()) {
        let is_plane = frame.position.iter().all(|place| place[2] == 0.0);
        return (mass / density).powf(if is_plane { 0.5 } else { 1.0 / 3.0 });
    }
    let phases = frame.scalar("phase");
    let number = phases.iter().filter(|phase| **phase == 0.0).count();
    let side = |axis: usize| {
        let places = frame.position.iter().map(|place| place[axis]);
        let (least, most) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), own| (a.min(own), b.max(own)));
        most - least
    };
    (side(0) * side(1) / number as f64).sqrt()
}
