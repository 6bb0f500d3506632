//! The case's figures.

use super::Record;
use super::flow::FilmFlow;
use super::metrics::convergence_errors;
use crate::figure::{Axis, Figure, Panel};
use crate::observation::Outcome;
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::weakly_compressible::{MomentumOperator, Numerics};

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let newtonian = |run: &FilmFlow| run.is_newtonian() && run.arrangement == Arrangement::Jittered;
    let finest = records.iter().filter(|(run, _)| newtonian(run)).map(|(run, _)| run.layer.resolution).max();
    let jittered: Vec<&Record> = records
        .iter()
        .filter(|(run, _)| run.arrangement == Arrangement::Jittered && !run.is_compared())
        // a second Newtonian film may have been run for the comparison
        .filter(|(run, _)| !newtonian(run) || Some(run.layer.resolution) == finest)
        .collect();
    let compared = records.iter().find(|(run, _)| run.is_compared());
    let mut figures = Vec::new();
    if !jittered.is_empty() {
        figures.push(profiles(&jittered));
    }
    let errors = convergence_errors(records, Arrangement::Lattice);
    let displaced = convergence_errors(records, Arrangement::Jittered);
    if errors.len() >= 2 {
        let mut panel =
            Panel::new("", Axis::logarithmic("rows over the film [-]"), Axis::logarithmic("relative L2 of u [%]"));
        panel.order(2, "second order", &errors);
        panel.line_points("Newtonian, lattice", 0, errors);
        if displaced.len() >= 2 {
            panel.line_points("Newtonian, perturbed", 1, displaced);
        }
        figures.push(Figure::new(
            "convergence",
            "Relative L2 error of the Newtonian velocity profile against the exact weakly compressible film, over \
             the number of particles across the depth: second order on a lattice, with a residual for perturbed \
             particles.",
            vec![panel],
        ));
    }
    if let Some((first, _)) = compared {
        let rows = first.layer.resolution;
        let films: Vec<&Record> =
            records.iter().filter(|(run, _)| newtonian(run) && run.layer.resolution == rows).collect();
        figures.push(operators(&films));
    }
    figures
}

fn label(run: &FilmFlow) -> &'static str {
    match run.material {
        Rheology::Newtonian(_) if run.has_eddies() => "Newtonian with eddies",
        Rheology::Newtonian(_) => "Newtonian",
        Rheology::Bingham(_) => "Bingham",
        Rheology::HerschelBulkley(_) => "Herschel–Bulkley",
        other => other.name(),
    }
}

fn numerics_label(run: &FilmFlow) -> &'static str {
    let numerics = &run.layer.numerics;
    match numerics.momentum_operator {
        MomentumOperator::Pairwise => "(10) and (11), Morris–Adami walls",
        MomentumOperator::PairwiseCorrected if numerics.kernel == Numerics::paper().kernel => {
            "the paper's set: as above, cubic spline, h/Δ = 1.3, switch (16)"
        }
        MomentumOperator::PairwiseCorrected => "(10) and (13), Morris–Adami walls",
        _ => "single divergence, extrapolated walls (default)",
    }
}

fn profiles(records: &[&Record]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h [-]"));
    let mut rate = Panel::new("", Axis::linear("du/dy [1/s]"), Axis::linear("y/h [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let (film, h) = (run.film(), run.layer.layer_height);
        let exact: Vec<(f64, f64)> =
            (0..=200).map(|k| f64::from(k) / 200.0).map(|y| (film.velocity(y * h), y)).collect();
        let name = if slot == 0 { "exact" } else { "" };
        let rates = exact.windows(2).map(|p| ((p[1].0 - p[0].0) / ((p[1].1 - p[0].1) * h), 0.5 * (p[0].1 + p[1].1)));
        rate.reference(name, rates);
        velocity.reference(name, exact);
        let data = &record.data.profile;
        velocity.points(label(run), slot, data.drawn(&data.velocity, h));
        let rates = data.shear_rates().into_iter().map(|(bin, rate)| (rate, data.height[bin] / h));
        rate.points(label(run), slot, rates);
    }
    Figure::new(
        "velocity-profile",
        "Velocity and shear rate over the depth, from perturbed particles, with the exact solutions. The plug of \
         yield-stress fluids begins where the shear rate falls to zero.",
        vec![velocity, rate],
    )
}

/// The Newtonian film with every set of numerics: the profile, and its error in parts of the surface velocity.
fn operators(films: &[&Record]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h [-]"));
    let mut error = Panel::new("", Axis::linear("(u − u exact)/u exact(h) [%]"), Axis::linear("y/h [-]"));
    for (slot, (run, record)) in films.iter().enumerate() {
        let (film, h) = (run.film(), run.layer.layer_height);
        if slot == 0 {
            let exact = (0..=200).map(|k| f64::from(k) / 200.0).map(|y| (film.velocity(y * h), y));
            velocity.reference("exact", exact);
            error.reference("", [(0.0, 0.0), (0.0, 1.0)]);
        }
        let data = &record.data.profile;
        let surface = film.velocity(h);
        let errors = data.drawn(&data.velocity, h).map(|(u, y)| (100.0 * (u - film.velocity(y * h)) / surface, y));
        let diverged = matches!(record.outcome, Outcome::Diverged { .. });
        let name = format!("{}{}", numerics_label(run), if diverged { " (diverged)" } else { "" });
        velocity.points(&name, slot, data.drawn(&data.velocity, h));
        error.line_points("", slot, errors);
    }
    Figure::new(
        "operators",
        "Newtonian film from perturbed particles, with default operators and walls and with those of the collapse paper: (10), \
         (11), (13) and its no-slip walls. Only the default is judged.",
        vec![velocity, error],
    )
}
