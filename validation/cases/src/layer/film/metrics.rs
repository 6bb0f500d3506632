//! How the runs are judged.

use super::Record;
use super::flow::FilmFlow;
use crate::case::Flow;
use crate::layer::{self, BINS, Top};
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant, quantities};
use crate::observation::Outcome;
use crate::reference::film::SteadyFilm;
use crate::setup::energy_ledger;
use crate::shared::Arrangement;
use crate::statistics::{linear_fit, log_log_slope, relative_l2};

quantities! {
    [layer::PARTICLES_LOST, energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    VELOCITY_L2: verified("velocity_l2", "%", "relative L2 error of the velocity profile, √(Σ(u − u_ref)²/Σu_ref²) over its bins"),
    FLUX_ERROR: verified("flux_error", "%", "error of the depth-integrated velocity"),
    VELOCITY_L2_COMPRESSIBLE:
        verified("velocity_l2_compressible", "%", "relative L2 error of the velocity profile against the weakly compressible Newtonian film"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence of the Newtonian film"),
    SKIN_DIFFERENCE:
        verified("skin_difference", "%", "relative L2 difference between velocities with a wider and a narrower skin of the neighbour lists"),
    PLUG_EDGE_ERROR: verified("plug_edge_error", "spacings", "height of the edge of the plug minus the exact height"),
}

const EXACT: &str = "exact solution of the film";
const INTEGRATED: &str = "steady film of the law, integrated over the depth";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics: Vec<Metric> = records.iter().flat_map(of_run).chain(skin_difference(records)).collect();
    for particles in [Arrangement::Lattice, Arrangement::Jittered] {
        let errors = convergence_errors(records, particles);
        if errors.len() < 2 {
            continue;
        }
        let rows = Value::list(errors.iter().map(|(rows, _)| *rows));
        let variant = Variant::of("fluid", "newtonian").and("particles", particles.name()).and("resolution", rows);
        let order = OBSERVED_ORDER.of(&variant, -log_log_slope(&errors).unwrap_or(f64::NAN));
        let source = "convergence to the weakly compressible film, exact for the model";
        let order = order.against(None, source, Confidence::Exact);
        metrics.push(match particles {
            Arrangement::Lattice => order
                .gated(Limit::AtLeast(1.5), "1.5: the project's aim on a lattice")
                .with_snapshot_tolerance(0.01, 0.0),
            // no order of its own: it ends where the floor begins
            Arrangement::Jittered => order.with_snapshot_tolerance(0.05, 0.05),
        });
    }
    metrics
}

fn of_run(record: &Record) -> Vec<Metric> {
    let (run, recorded) = record;
    let variant = run.variant();
    if run.has_wide_skin() {
        // judged beside the film that it is a twin of
        return Vec::new();
    }
    if run.is_compared() {
        return compared(record);
    }
    let compressible = compressible_l2(record).map(|value| {
        let source = "exact weakly compressible film, η du/dy = p tanθ";
        let metric = VELOCITY_L2_COMPRESSIBLE.of(&variant, value).exactly(0.0, source);
        metric.with_snapshot_tolerance(1e-3, 1e-4).unless(unsteadiness(record).as_ref())
    });
    let mut common = vec![layer::particles_lost(&variant, recorded)];
    common.extend(energy_ledger::metrics(&variant, &recorded.data.energy, energy_ledger::EnergyScale::Steady));
    common.into_iter().chain(profile(record)).chain(compressible).chain(plug_edge(record)).collect()
}

/// Errors of the velocities and of the flux `[%]`.
fn errors(record: &Record) -> [(Quantity, f64); 2] {
    let (film, profile) = (record.0.film(), &record.1.data.profile);
    let velocity_l2 = 100.0 * profile.velocity_l2(|y| film.velocity(y));
    [(VELOCITY_L2, velocity_l2), (FLUX_ERROR, flux_error(record))]
}

/// Why a film's profile is not that of a steady flow; none where it is.
fn unsteadiness((run, record): &Record) -> Option<String> {
    record.data.unsteadiness(run.window())
}

/// What another set of numerics gives: to be seen beside the default, not to be judged.
fn compared(record: &Record) -> Vec<Metric> {
    // a run that diverged has no profile to speak of
    if matches!(record.1.outcome, Outcome::Diverged { .. }) {
        return Vec::new();
    }
    let variant = record.0.variant();
    let not_steady = unsteadiness(record);
    let observed = |(quantity, value): (Quantity, f64)| {
        let metric = quantity.of(&variant, value).exactly(0.0, EXACT).with_snapshot_tolerance(0.02, 0.05);
        metric.unless(not_steady.as_ref())
    };
    errors(record).map(observed).to_vec()
}

/// Error of the depth-integrated velocity `[%]`.
fn flux_error((run, record): &Record) -> f64 {
    let profile = &record.data.profile;
    // Every particle carries the same volume, so the mean over all samples is the mean over the depth. A mean over
    // bins is not: coarse films fill some of them with the grains of a row's edge only.
    let (sum, count) = profile.filled().fold((0.0, 0.0), |(sum, count), bin| {
        (sum + profile.samples[bin] * profile.velocity[bin], count + profile.samples[bin])
    });
    100.0 * (sum / count * run.layer.layer_height / run.film().flux() - 1.0)
}

/// A list with a skin holds more pairs than there are, of which those out of reach weigh nothing: lists that are renewed at
/// other times give the same flow, except for the order of sums. Pairs that a list lacks, or has too late, make a difference.
fn skin_difference(records: &[Record]) -> Option<Metric> {
    let (run, wide) = records.iter().find(|(run, _)| run.has_wide_skin())?;
    let is_twin = |other: &&Record| {
        is_studied(&other.0, Arrangement::Lattice) && other.0.layer.resolution == run.layer.resolution
    };
    let (_, own) = records.iter().find(is_twin)?;
    let (wide, own) = (&wide.data.profile, &own.data.profile);
    let velocities = wide.velocity.iter().copied().zip(own.velocity.iter().copied());
    let difference = 100.0 * relative_l2(velocities.filter(|(wide, own)| wide.is_finite() && own.is_finite()));
    // pairs are single precision, and lists group the sums over them
    let reason =
        "1e-4 %: expected single-precision rounding, not amplified by laminar flow; double precision left 1e-13 %";
    Some(
        SKIN_DIFFERENCE
            .of(&run.variant(), difference)
            .exactly(0.0, "the same film with neighbour lists renewed at other times")
            .gated(Limit::AtMost(1e-4), reason)
            .with_snapshot_tolerance(0.0, 1e-5),
    )
}

fn profile(record: &Record) -> Vec<Metric> {
    let run = &record.0;
    // first order in the spacing at the bed, so that 20 rows have twice the error of 40; a code that gives more points than our bins has as many
    // rows
    let points = record.1.data.profile.height.len();
    let rows = if points > BINS { run.layer.resolution.max(points) } else { run.layer.resolution };
    let limit = match (run.film(), rows) {
        (SteadyFilm::Newtonian(_), 10..) if run.top == Top::Mirror => {
            Some((3.0, "3 % with 10 particle rows; a mirror that wrongly transmits shear would bend the profile"))
        }
        (SteadyFilm::Newtonian(_), 40..) => Some((1.0, "the project's aim: 1 % with 40 particles over the depth")),
        (SteadyFilm::Newtonian(_), 20..) => {
            Some((2.0, "2 % with 20 particle rows: twice the limit of 40 rows, since errors are first-order"))
        }
        (SteadyFilm::Eddies(_), 20..) => {
            Some((3.0, "3 % with 20 rows: 1.5 times the Newtonian limit, as stress is quadratic in shear rate"))
        }
        // what a law of one's own may be off by is for its author to say
        (SteadyFilm::Integrated(_), _) => None,
        (_, 40..) => Some((2.0, "the project's aim: 2 % with 40 particles over the depth")),
        (_, 20..) => Some((3.0, "3 % with 20 rows: 1 % creep of the regularised yield, 2 % first-order error")),
        _ => None,
    };
    let exact = if matches!(run.film(), SteadyFilm::Integrated(_)) { INTEGRATED } else { EXACT };
    let not_steady = unsteadiness(record);
    let judged = |(quantity, value): (Quantity, f64)| {
        let metric = quantity.of(&run.variant(), value).exactly(0.0, exact).with_snapshot_tolerance(1e-3, 1e-4);
        let metric = metric.unless(not_steady.as_ref());
        match limit {
            Some((limit, reason)) if quantity == VELOCITY_L2 => metric.gated(Limit::AtMost(limit), reason),
            Some((limit, reason)) => metric.gated(Limit::Within(-limit, limit), reason),
            None => metric,
        }
    };
    errors(record).map(judged).to_vec()
}

fn plug_edge((run, record): &Record) -> Option<Metric> {
    let (film, profile) = (run.film(), &record.data.profile);
    let exact = film.plug_edge()?;
    let rates = profile.shear_rates().into_iter().map(|(bin, rate)| (profile.height[bin], rate));
    let sheared = rates.filter(|(y, _)| (0.1..=0.8).contains(&(y / exact)));
    let points: Vec<(f64, f64)> = sheared.map(|(y, rate)| (y, libm::pow(rate.abs(), film.flow_index()))).collect();
    let edge = linear_fit(&points).map_or(f64::NAN, |fit| -fit.intercept / fit.slope);
    let spacing = run.layer.layer_height / run.layer.resolution as f64;
    let reason = "1 spacing: expected accuracy of edges extrapolated by a line through |du/dy|ⁿ";
    let error = PLUG_EDGE_ERROR
        .of(&run.variant(), (edge - exact) / spacing)
        .exactly(0.0, "edge of the plug at h − τ_y/(ρ g sinθ)")
        .gated(Limit::Within(-1.0, 1.0), reason)
        .with_snapshot_tolerance(0.01, 0.01)
        .unless(record.data.unsteadiness(run.window()).as_ref());
    Some(error)
}

/// Relative L2 `[%]` of the bins' velocities against the weakly compressible film; for the Newtonian only.
fn compressible_l2((run, record): &Record) -> Option<f64> {
    let exact = |y: f64| run.weakly_compressible_velocity(y).unwrap_or(f64::NAN);
    run.is_newtonian().then(|| 100.0 * record.data.profile.velocity_l2(exact))
}

/// Whether a film belongs to the convergence study of an arrangement.
fn is_studied(run: &FilmFlow, particles: Arrangement) -> bool {
    let plain = !run.is_compared() && !run.has_wide_skin() && run.top == Top::Free;
    plain && run.is_newtonian() && run.arrangement == particles
}

/// (rows, velocity L2 `[%]` against the weakly compressible film) of the Newtonian runs of an arrangement, coarse to fine.
pub(super) fn convergence_errors(records: &[Record], particles: Arrangement) -> Vec<(f64, f64)> {
    let studied = records.iter().filter(|(run, _)| is_studied(run, particles));
    let error = |record: &Record| Some((record.0.layer.resolution as f64, compressible_l2(record)?));
    let mut errors: Vec<(f64, f64)> = studied.filter_map(error).collect();
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    errors
}
