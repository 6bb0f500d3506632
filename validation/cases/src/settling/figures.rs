//! The case's figures.

use super::flow::{FORMULATIONS, SettlingFlow, covers};
use super::metrics::beads::{LAWS, sinking};
use super::probe::{SettlingObservation, SettlingSeries};
use super::{SettlingRecord, drag_curves};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::settling::{GrainForm, SETTLING_BEADS, richardson_zaki_exponent};
use crate::shared::{distinct, range};
use bagnold_solver::material::drag::DragLaw;

/// Half of a pixel of the images `[m]`.
const HALF_PIXEL: f64 = 0.39e-3;

/// Densest suspension drawn `[-]`.
const DENSEST: f64 = 0.6;

pub(super) fn all(records: &[SettlingRecord]) -> Vec<Figure> {
    let suspensions: Vec<_> = suspensions(records).collect();
    let mut figures = Vec::new();
    let alone = alone(records);
    if !alone.is_empty() {
        figures.push(terminal(&alone));
    }
    if !suspensions.is_empty() {
        figures.push(hindered(&suspensions));
    }
    figures.extend([beads(), drag_curves::drag_coefficients()]);
    figures
}

/// The suspensions among the records.
fn suspensions(records: &[SettlingRecord]) -> impl Iterator<Item = (&SettlingFlow, &SettlingObservation)> {
    records.iter().filter(|(flow, _)| flow.is_suspension()).map(|(flow, record)| (flow, &record.data))
}

/// Grains alone, and suspensions so dilute that they stand for one: formulation, root `[m/s]`, what was seen.
fn alone(records: &[SettlingRecord]) -> Vec<(&'static str, f64, &SettlingObservation)> {
    let root = |flow: &SettlingFlow| if flow.is_suspension() { flow.sphere_velocity() } else { flow.root() };
    let alone = records.iter().filter(|(flow, _)| flow.is_dilute() || !flow.is_suspension());
    alone.map(|(flow, record)| (flow.formulation(), root(flow), &record.data)).collect()
}

fn terminal(records: &[(&str, f64, &SettlingObservation)]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("root of the balance [m/s]"), Axis::linear("error of the slip [%]"));
    let (low, high) = range(records.iter().map(|&(_, root, _)| root));
    let (low, high) = (low - 0.05 * high, 1.05 * high);
    panel.band("limit, 1 %", [(low, -1.0, 1.0), (high, -1.0, 1.0)]);
    for (slot, formulation) in FORMULATIONS.into_iter().enumerate() {
        let measured = |&(_, root, data): &(&str, f64, &SettlingObservation)| {
            let (mean, noise) = data.series.mean(&data.series.slip);
            ((root, 100.0 * (mean / root - 1.0)), 100.0 * noise / root)
        };
        let (points, error): (Vec<(f64, f64)>, Vec<f64>) =
            records.iter().filter(|record| record.0 == formulation).map(measured).unzip();
        if !points.is_empty() {
            panel.points(formulation, slot, points).error = error;
        }
    }
    Figure::new(
        "terminal-velocity",
        "Mean slip velocity of a single grain, with standard error, against the velocity at which drag balances \
         weight, for every drag law: planar grain (c = ½), spheres in a very dilute suspension (c = ¾).",
        vec![panel],
    )
}

fn hindered(records: &[(&SettlingFlow, &SettlingObservation)]) -> Figure {
    let mut slip = Panel::new("slip", Axis::linear("φ [-]"), Axis::linear("u_r [m/s]"));
    let mut sinking = Panel::new("sinking velocity", Axis::linear("φ [-]"), Axis::linear("(1 − φ) u_r [m/s]"));
    let grains = records[0].0.grains;
    let fractions = || (1..=120).map(|k| DENSEST * f64::from(k) / 120.0);
    for law in distinct(records.iter().map(|(flow, _)| flow.law)) {
        let slot = drag_curves::slot(law);
        let root = |phi| Some((phi, grains.hindered_slip(law, phi)?));
        let curve: Vec<(f64, f64)> = fractions().filter(|&phi| covers(law, phi)).filter_map(root).collect();
        let sunk = curve.iter().map(|&(phi, slip)| (phi, (1.0 - phi) * slip));
        sinking.line("", slot, sunk);
        slip.line("", slot, curve);
        let measured = |of: fn(&SettlingSeries) -> &[f64]| -> Vec<(f64, f64)> {
            let of_law = records.iter().filter(|(flow, _)| flow.law == law);
            of_law.map(|(flow, data)| (flow.solid_fraction, data.series.mean(of(&data.series)).0)).collect()
        };
        // one legend serves both panels
        slip.points(drag_curves::label(law), slot, measured(|series| &series.slip));
        sinking.points("", slot, measured(|series| &series.sinking));
    }
    let alone = grains.terminal_velocity(DragLaw::WenYu, GrainForm::Sphere).unwrap_or(f64::NAN);
    let exponent = richardson_zaki_exponent(grains.reynolds(alone));
    let published = |exponent: f64| fractions().map(move |phi| (phi, alone * libm::pow(1.0 - phi, exponent)));
    slip.reference("Richardson–Zaki (unverified)", published(exponent - 1.0));
    sinking.reference("", published(exponent));
    Figure::new(
        "hindered-settling",
        "Slip velocity of a uniform suspension and its settling velocity in a vessel: particles (points) and balance \
         of drag and weight (lines) for every law. Dashed: Richardson and Zaki (1954), not judged.",
        vec![slip, sinking],
    )
}

/// Both interfaces over time, with every law.
fn beads() -> Figure {
    let beads = &*SETTLING_BEADS;
    let mut panel = Panel::new("", Axis::linear("t [min]"), Axis::linear("height [mm]").between(0.0, 60.0));
    let scaled = |points: &[(f64, f64)]| points.iter().map(|(t, z)| (t / 60.0, 1e3 * z)).collect::<Vec<_>>();
    let bars = vec![1e3 * HALF_PIXEL; beads.upper.len()];
    panel.points("measured upper interface", 6, scaled(&beads.upper)).error.clone_from(&bars);
    panel.points("measured deposit", 7, scaled(&beads.deposit)).error = bars;
    for law in LAWS {
        let Some((velocity, _)) = sinking(beads, law) else { continue };
        let (top, bottom) = (beads.upper[0].1, beads.deposit[0].1);
        let rise = beads.rise_under(velocity);
        let meet = (top - bottom) / (velocity + rise);
        let (label, slot) = (drag_curves::label(law), drag_curves::slot(law));
        panel.line(label, slot, scaled(&[(0.0, top), (meet, top - velocity * meet)]));
        panel.line("", slot, scaled(&[(0.0, bottom), (meet, bottom + rise * meet)]));
    }
    Figure::new(
        "beads",
        "Polystyrene beads settling in silicone oil at solid fraction 0.5: measured heights of the upper interface \
         and the deposit (error bars: ± half a pixel), and predictions of drag laws for dense suspensions.",
        vec![panel],
    )
}
