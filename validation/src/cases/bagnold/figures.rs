//! The case's figures.

use super::Record;
use super::metrics::{convergence_errors, friction, history_from_rest, inertial_numbers, particle_history};
use super::parameters::{BagnoldParameters, Start};
use super::runs::{BagnoldRun, Purpose};
use crate::cases::Arrangement;
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};
use crate::reference::LayerTransient;

pub(super) fn all(parameters: &BagnoldParameters, records: &[Record]) -> Vec<Figure> {
    let mut figures = Vec::new();
    let steady: Vec<&Record> = records
        .iter()
        .filter(|(run, _)| {
            run.purpose == Purpose::Steady && run.start == parameters.starts.first().copied().unwrap_or(Start::Rest)
        })
        .collect();
    if !steady.is_empty() {
        figures.push(profiles(&steady));
        figures.push(stresses(&steady));
        figures.push(transients(&steady));
    }
    let outside: Vec<&Record> =
        records.iter().filter(|(run, _)| matches!(run.purpose, Purpose::Arrest | Purpose::Runaway)).collect();
    if !outside.is_empty() {
        figures.push(arrest_and_runaway(&outside));
    }
    figures.extend(convergence(parameters, records));
    figures
}

fn label(run: &BagnoldRun) -> String {
    format!("{}°", run.slope_angle)
}

fn profiles(records: &[&Record]) -> Figure {
    let mut absolute = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h [-]"));
    let mut error = Panel::new("", Axis::linear("(u − exact)/u(h) [%]"), Axis::linear("y/h [-]"));
    error.series.push(Series::new("exact", Mark::Reference, 0, vec![(0.0, 0.0), (0.0, 1.0)]));
    for (slot, (run, record)) in records.iter().enumerate() {
        let exact = run.profile();
        let Some(surface) = exact.surface_velocity() else { continue };
        let h = exact.layer_height;
        let data = &record.data.profile;
        let bins: Vec<usize> = (0..data.height.len()).filter(|&bin| data.samples[bin] > 0.0).collect();
        let curve: Vec<f64> = (0..=100).map(|k| f64::from(k) / 100.0).collect();
        let exact_label = if slot == 0 { "Bagnold (36), exact" } else { "" };
        let reference = curve.iter().map(|y| (exact.velocity(y * h).unwrap_or(0.0), *y)).collect();
        absolute.series.push(Series::new(exact_label, Mark::Reference, slot, reference));
        let points = bins.iter().map(|&b| (data.velocity[b], data.height[b] / h)).collect();
        absolute.series.push(Series::new(&label(run), Mark::Points, slot, points));
        let differences = bins
            .iter()
            .map(|&b| {
                let expected = exact.velocity(data.height[b]).unwrap_or(0.0);
                (100.0 * (data.velocity[b] - expected) / surface, data.height[b] / h)
            })
            .collect();
        error.series.push(Series::new(&label(run), Mark::LinePoints, slot, differences));
    }
    Figure {
        name: "velocity-profile".to_owned(),
        caption: "Mean velocity along the slope in 20 bins over the depth, against Bagnold's profile (36), which is exact \
                  for the μ(I) law. Left in metres per second, right the difference in percent of the exact surface velocity."
            .to_owned(),
        panels: vec![absolute, error],
        columns: 2,
    }
}

fn stresses(records: &[&Record]) -> Figure {
    let mut pressure = Panel::new("", Axis::linear("p [Pa]"), Axis::linear("y/h [-]"));
    let mut inertia = Panel::new("", Axis::linear("I/I(θ), exact [-]"), Axis::linear("y/h [-]"));
    let mut implied = Panel::new("", Axis::linear("μ(I)/tanθ − 1 [%]"), Axis::linear("y/h [-]"));
    inertia.series.push(Series::new("exact", Mark::Reference, 0, vec![(1.0, 0.0), (1.0, 1.0)]));
    implied.series.push(Series::new("exact", Mark::Reference, 0, vec![(0.0, 0.0), (0.0, 1.0)]));
    for (slot, (run, record)) in records.iter().enumerate() {
        let exact = run.profile();
        let Some(steady) = exact.inertial_number() else { continue };
        let h = exact.layer_height;
        let data = &record.data.profile;
        let line = vec![(exact.pressure(0.0), 0.0), (0.0, 1.0)];
        pressure.series.push(Series::new(if slot == 0 { "hydrostatic" } else { "" }, Mark::Reference, slot, line));
        let points = (0..data.height.len())
            .filter(|&b| data.samples[b] > 0.0)
            .map(|b| (data.pressure[b], data.height[b] / h))
            .collect();
        pressure.series.push(Series::new(&label(run), Mark::Points, slot, points));
        let numbers = inertial_numbers(data, &exact);
        let inside: Vec<_> = numbers.iter().filter(|(y, _)| (0.1..=0.9).contains(&(y / h))).collect();
        inertia.series.push(Series::new(
            &label(run),
            Mark::LinePoints,
            slot,
            inside.iter().map(|(y, i)| (i / steady, y / h)).collect(),
        ));
        let tangent = libm::tan(exact.slope_angle);
        implied.series.push(Series::new(
            &label(run),
            Mark::LinePoints,
            slot,
            inside.iter().map(|(y, i)| (100.0 * (friction(&exact, *i) / tangent - 1.0), y / h)).collect(),
        ));
    }
    Figure {
        name: "pressure-and-stress".to_owned(),
        caption: "Pressure against the hydrostatic line, inertial number against its constant exact value, and the stress \
                  ratio that the measured inertial number implies, relative to tanθ. The flow turns an error of 0.1 % of the \
                  friction coefficient into one of 0.8 % (25°) to 2 % (22°) of the velocity."
            .to_owned(),
        panels: vec![pressure, inertia, implied],
        columns: 3,
    }
}

fn transients(records: &[&Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("t [s]"), Axis::linear("depth mean of u [m/s]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        if run.start == Start::Rest
            && let Some((history, _)) = history_from_rest(run)
        {
            let end = record.simulated_time;
            let points = history.times.iter().zip(&history.depth_means).filter(|(t, _)| **t <= end);
            let name = if slot == 0 { "1-D transient solver" } else { "" };
            panel.series.push(Series::new(name, Mark::Reference, slot, thinned(points.map(|(t, u)| (*t, *u)))));
        }
        let history = particle_history(&record.data);
        let points = thinned(history.times.iter().zip(&history.depth_means).map(|(t, u)| (*t, *u)));
        panel.series.push(Series::new(&label(run), Mark::Line, slot, points));
    }
    Figure {
        name: "approach".to_owned(),
        caption:
            "Depth mean of the velocity from rest, against the one-dimensional solver, which shares nothing with the \
                  particles but the law."
                .to_owned(),
        panels: vec![panel],
        columns: 1,
    }
}

fn arrest_and_runaway(records: &[&Record]) -> Figure {
    let mut panels = Vec::new();
    for (slot, (run, record)) in records.iter().enumerate() {
        let title =
            format!("{}°: {}", run.slope_angle, if run.purpose == Purpose::Arrest { "arrest" } else { "runaway" });
        let mut panel = Panel::new(&title, Axis::linear("t [s]"), Axis::linear("depth mean of u [m/s]"));
        let end = record.simulated_time;
        let start = run.start_profile();
        let reference = if run.purpose == Purpose::Arrest {
            LayerTransient::from_profile(run.profile(), 100, 1e-3, |y| start.velocity(y).unwrap_or(0.0))
        } else {
            LayerTransient::from_rest(run.profile(), 100, 2e-3)
        };
        if let Ok(history) = reference.and_then(|mut layer| layer.run(end, &[])) {
            let points = thinned(history.times.iter().zip(&history.depth_means).map(|(t, u)| (*t, *u)));
            panel.series.push(Series::new("1-D transient solver", Mark::Reference, slot, points));
        }
        let history = particle_history(&record.data);
        let points = thinned(history.times.iter().zip(&history.depth_means).map(|(t, u)| (*t, *u)));
        panel.series.push(Series::new("particles", Mark::Line, slot, points));
        panels.push(panel);
    }
    Figure {
        name: "arrest-and-runaway".to_owned(),
        caption: "Below the static friction angle a layer that starts with a steady profile comes to rest; above the limiting \
                  friction angle a layer from rest accelerates without end (stopped when its mean passes half the sound speed)."
            .to_owned(),
        columns: panels.len().min(2),
        panels,
    }
}

fn convergence(parameters: &BagnoldParameters, records: &[Record]) -> Option<Figure> {
    let angle = parameters.convergence_slope_angle;
    let mut panel =
        Panel::new("", Axis::logarithmic("rows over the layer [-]"), Axis::logarithmic("relative L2 of u [%]"));
    let kinds = [
        (Arrangement::Lattice, Start::Profile, "lattice, from the profile"),
        (Arrangement::Jittered, Start::Rest, "jittered, from rest"),
    ];
    for (slot, (particles, start, name)) in kinds.into_iter().enumerate() {
        let errors = convergence_errors(records, angle, particles, start);
        if errors.len() >= 2 {
            if slot == 0 {
                let (rows, error) = errors[0];
                let guide = errors.iter().map(|(n, _)| (*n, error * rows / n)).collect();
                panel.series.push(Series::new("first order", Mark::Reference, slot, guide));
            }
            panel.series.push(Series::new(name, Mark::LinePoints, slot, errors));
        }
    }
    if panel.series.is_empty() {
        return None;
    }
    if let (Some(first), Some(last)) = (panel.series[0].points.first(), panel.series[0].points.last()) {
        panel.bands.push(Band {
            label: "gate at 40 rows".to_owned(),
            points: vec![(first.0, 1e-3, 0.7), (last.0, 1e-3, 0.7)],
        });
    }
    Some(Figure {
        name: "convergence".to_owned(),
        caption: format!(
            "Relative L2 error of the velocity profile at {angle}° with the number of rows over the layer."
        ),
        panels: vec![panel],
        columns: 1,
    })
}

/// At most a few hundred points of a long series.
fn thinned(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let points: Vec<_> = points.collect();
    let stride = points.len().div_ceil(400).max(1);
    points.into_iter().step_by(stride).collect()
}
