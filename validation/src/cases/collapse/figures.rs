//! The case's figures.

use super::Record;
use super::column::{ColumnRun, Geometry};
use super::deposit::Collapse;
use crate::figure::{Axis, Field, Figure, Mark, Panel, Series};
use crate::observe::Frame;
use crate::reference::{CollapseLaw, PLANAR_HEIGHT, PLANAR_RUN_OUT, ROUND_HEIGHT, ROUND_RUN_OUT};

pub(in crate::cases) fn all(records: &[Record]) -> Vec<Figure> {
    if records.is_empty() {
        return Vec::new();
    }
    let mut figures = vec![scaling(records), deposits(records), histories(records)];
    figures.extend(records.iter().map(|(run, record)| pictures(run, &record.frames)));
    figures
}

fn name(material: &str) -> &'static str {
    if material == "lagree" { "grains of Lagrée et al." } else { "sand of Table 2" }
}

/// Run-out and height over the aspect ratio, with every published law of the geometry.
fn scaling(records: &[Record]) -> Figure {
    let round = records.iter().any(|(run, _)| run.geometry == Geometry::Round);
    // the laws of the geometry, and Lube's of the other one: the paper compared planar runs with the round law
    let run_out_laws: Vec<CollapseLaw> = if round {
        ROUND_RUN_OUT.iter().chain(&PLANAR_RUN_OUT[..1]).copied().collect()
    } else {
        PLANAR_RUN_OUT.iter().chain(&ROUND_RUN_OUT[..1]).copied().collect()
    };
    let height_laws: Vec<CollapseLaw> =
        if round { ROUND_HEIGHT.iter().chain(&PLANAR_HEIGHT[..1]).copied().collect() } else { PLANAR_HEIGHT.to_vec() };
    let panel = |label: &str, laws: &[CollapseLaw], measure: fn(&Collapse) -> f64, legend: bool| {
        let mut panel = Panel::new("", Axis::logarithmic("h0/r0 [-]"), Axis::logarithmic(label));
        for law in laws {
            // a source keeps its colour from panel to panel
            let known =
                run_out_laws.iter().position(|other| other.source.split(',').next() == law.source.split(',').next());
            let slot = known.unwrap_or(run_out_laws.len());
            for (part, curve) in law.curves().into_iter().enumerate() {
                let entry = if legend && part == 0 { law.source } else { "" };
                panel.series.push(Series::new(entry, Mark::Line, slot + 2, curve));
            }
        }
        for (slot, material) in ["sand", "lagree"].into_iter().enumerate() {
            let points: Vec<(f64, f64)> = records
                .iter()
                .filter(|(run, _)| run.material == material)
                .map(|(run, record)| (run.initial_height(), measure(&record.data)))
                .collect();
            if !points.is_empty() {
                let entry = if legend { name(material) } else { "" };
                panel.series.push(Series::new(entry, Mark::Points, slot, points));
            }
        }
        panel
    };
    Figure {
        name: "scaling".to_owned(),
        caption: "Run-out and final height of the columns over their aspect ratio, with the published laws of their \
                  geometry and Lube's run-out of the other one. Coefficients depend on the grains, exponents much less."
            .to_owned(),
        panels: vec![
            panel("run-out (r∞ − r0)/r0 [-]", &run_out_laws, Collapse::run_out, true),
            panel("final height h∞/r0 [-]", &height_laws, Collapse::final_height, false),
        ],
        columns: 2,
    }
}

fn label(run: &ColumnRun) -> String {
    let material = if run.material == "lagree" { "Lagrée" } else { "sand" };
    format!("{material}, a = {}", run.aspect_ratio)
}

fn deposits(records: &[Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("x/r0 [-]"), Axis::linear("thickness/r0 [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let end = record.data.deposit.iter().rposition(|bin| bin.1 > 0.0).map_or(0, |last| last + 1);
        panel.series.push(Series::new(&label(run), Mark::Line, slot, record.data.deposit[..end].to_vec()));
    }
    Figure {
        name: "deposits".to_owned(),
        caption:
            "Thickness of the deposits, volume per bin of 0.1 r0. Run-out is read where the thickness first falls \
                  below 0.02 r0."
                .to_owned(),
        panels: vec![panel],
        columns: 1,
    }
}

fn histories(records: &[Record]) -> Figure {
    let mut front = Panel::new("", Axis::linear("t/√(h0/g) [-]"), Axis::linear("(front − r0)/r0 over a [-]"));
    let mut energy =
        Panel::new("", Axis::linear("t/√(h0/g) [-]"), Axis::linear("kinetic/initial potential energy [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let (data, a, scale) = (&record.data, run.initial_height(), run.time_scale());
        let time = || data.time.iter().map(|t| t / scale);
        let way = time().zip(data.front.iter().map(|front| (front - 1.0) / a)).collect();
        let initial = data.potential_energy.first().copied().unwrap_or(f64::NAN);
        let share = time().zip(data.kinetic_energy.iter().map(|kinetic| kinetic / initial)).collect();
        front.series.push(Series::new(&label(run), Mark::Line, slot, way));
        energy.series.push(Series::new("", Mark::Line, slot, share));
    }
    Figure {
        name: "histories".to_owned(),
        caption: "The front's way over the aspect ratio and the kinetic energy over the initial potential energy, in \
                  times of free fall √(h0/g). Deposits come to rest."
            .to_owned(),
        panels: vec![front, energy],
        columns: 2,
    }
}

/// Speed and pressure at the pictures' times; of a round column the slice beside a symmetry plane.
fn pictures(run: &ColumnRun, frames: &[Frame]) -> Figure {
    let r = run.half_width;
    let slice = |frame: &Frame| -> Vec<usize> {
        (0..frame.position.len()).filter(|&index| frame.position[index][2] < run.spacing()).collect()
    };
    let far = frames.iter().flat_map(|frame| &frame.position).map(|x| x[0] / r).fold(1.0, f64::max);
    let high = frames.iter().flat_map(|frame| &frame.position).map(|x| x[1] / r).fold(0.0, f64::max);
    let speed = |frame: &Frame| -> Vec<f64> {
        let velocity = frame.vectors.iter().find(|(name, _, _)| name == "velocity");
        velocity.map_or(Vec::new(), |(_, _, v)| v.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).collect())
    };
    let pressure = |frame: &Frame| -> Vec<f64> {
        let pressure = frame.scalars.iter().find(|(name, _, _)| name == "pressure");
        pressure.map_or(Vec::new(), |(_, _, p)| p.iter().map(|p| p * 1e-3).collect())
    };
    let largest =
        |values: &dyn Fn(&Frame) -> Vec<f64>| frames.iter().flat_map(values).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let (fastest, deepest) = (largest(&speed), largest(&pressure));
    let mut panels = Vec::new();
    for frame in frames {
        let title = format!("t = {:.2} √(h0/g)", frame.time / run.time_scale());
        for (values, label, limit) in [(speed(frame), "|v| [m/s]", fastest), (pressure(frame), "p [kPa]", deepest)] {
            let x = Axis { limits: Some((0.0, far)), ..Axis::linear("x/r0 [-]") };
            let y = Axis { limits: Some((0.0, high)), ..Axis::linear("y/r0 [-]") };
            let mut panel = Panel::new(&title, x, y);
            panel.field = Some(Field {
                points: slice(frame)
                    .into_iter()
                    .map(|index| (frame.position[index][0] / r, frame.position[index][1] / r))
                    .collect(),
                values: slice(frame).into_iter().map(|index| values[index]).collect(),
                label: label.to_owned(),
                diameter: run.spacing() / r,
                limits: Some((0.0, limit)),
            });
            panels.push(panel);
        }
    }
    Figure {
        name: format!("pictures-{}-{}", run.material, run.aspect_ratio.to_string().replace('.', "-")),
        caption: format!("{}: speed (left) and pressure (right) through the collapse and in the deposit.", label(run)),
        panels,
        columns: 2,
    }
}
