//! The case's figures.

use super::grain::Formulation;
use super::{Record, drag_curves};
use crate::figure::{Axis, Figure, Mark, Panel, Series};

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let mut figures = Vec::new();
    if !records.is_empty() {
        figures.extend([approach(records), terminal(records)]);
    }
    figures.extend([drag_curves::drag_coefficients(), drag_curves::hindrance()]);
    figures
}

/// The formulations that single grains have, in the order of their panels.
const FORMULATIONS: [Formulation; 2] = [Formulation::Paper, Formulation::Stabilised];

fn approach(records: &[Record]) -> Figure {
    let mut panels = Vec::new();
    for formulation in FORMULATIONS {
        let label = "slip over the root [-]";
        let mut panel = Panel::new(formulation.name(), Axis::linear("t [s]"), Axis::linear(label));
        panel.y.limits = Some((0.0, 1.2));
        let of_formulation = records.iter().filter(|(run, _)| run.formulation == formulation);
        for (run, record) in of_formulation {
            let (series, root) = (&record.data.series, run.terminal_velocity());
            let points = series.time.iter().zip(&series.slip).map(|(t, slip)| (*t, slip / root)).collect();
            let label = if panels.is_empty() { drag_curves::label(run.law) } else { "" };
            panel.series.push(Series::new(label, Mark::Line, drag_curves::slot(run.law), points));
        }
        let end = panel.series.iter().flat_map(|series| series.points.last()).fold(0.0, |end: f64, p| end.max(p.0));
        if end > 0.0 {
            let label = if panels.is_empty() { "root" } else { "" };
            panel.series.push(Series::new(label, Mark::Reference, 0, vec![(0.0, 1.0), (end, 1.0)]));
            panels.push(panel);
        }
    }
    Figure {
        name: "approach".to_owned(),
        caption: "A grain released in a periodic box of fluid gets to the slip at which its drag carries its weight. The \
                  fluid that it has set in motion meets it again across the periods, so that the slip keeps fluctuating \
                  about its root; the mean is taken over the last 0.6 of a run."
            .to_owned(),
        columns: panels.len().clamp(1, 2),
        panels,
    }
}

fn terminal(records: &[Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("root of the balance [m/s]"), Axis::linear("error of the slip [%]"));
    let roots = || records.iter().map(|(run, _)| run.terminal_velocity());
    let (low, high) = (roots().fold(f64::INFINITY, f64::min), roots().fold(0.0, f64::max));
    let (low, high) = (low - 0.05 * high, 1.05 * high);
    panel
        .bands
        .push(crate::figure::Band { label: "gate, 1 %".to_owned(), points: vec![(low, -1.0, 1.0), (high, -1.0, 1.0)] });
    for formulation in FORMULATIONS {
        let of_formulation: Vec<&Record> = records.iter().filter(|(run, _)| run.formulation == formulation).collect();
        let measured = |(run, record): &&Record| {
            let (mean, noise) = record.data.series.mean(&record.data.series.slip);
            let root = run.terminal_velocity();
            ((root, 100.0 * (mean / root - 1.0)), 100.0 * noise / root)
        };
        let (points, error) = of_formulation.iter().map(measured).unzip();
        panel
            .series
            .push(Series { error, ..Series::new(formulation.name(), Mark::Points, formulation as usize, points) });
    }
    Figure {
        name: "terminal-velocity".to_owned(),
        caption:
            "Mean slip of a grain alone against the root of its balance, for every law, with the standard error of \
                  the mean. Wen and Yu's and Gidaspow's grain alone is that of Schiller and Naumann."
                .to_owned(),
        panels: vec![panel],
        columns: 1,
    }
}
