//! How far a run is from the exact profile, and from the independent one-dimensional solution in time.

use super::Record;
use super::flow::{BagnoldFlow, LayerStart};
use crate::layer::{DepthProfile, LayerObservation, Preparation};
use crate::reference::one_dimension::{BagnoldProfile, LayerTransient, TransientHistory};
use crate::shared::{Arrangement, distinct};
use crate::statistics::{Extrapolation, interpolated, linear_fit, relative_l2};

/// A steady run's errors.
#[derive(Debug, Clone, Copy)]
pub(super) struct SteadyErrors {
    /// Relative L2 of the bins' velocities `[%]`.
    pub(super) velocity_l2: f64,
    /// Relative error of the topmost bin's velocity `[%]`.
    pub(super) surface_velocity_error: f64,
    /// Mean of |μ(I)/tanθ − 1| over 0.1 h … 0.9 h `[%]`.
    pub(super) implied_stress_error: f64,
    /// Intercept of a line through u over y < 0.2 h less that of the exact profile, over u(h) `[%]`.
    pub(super) wall_slip: f64,
}

impl SteadyErrors {
    /// Errors of a measured depth profile; none where there is no steady flow.
    pub(super) fn of(profile: &DepthProfile, exact: &BagnoldProfile) -> Option<Self> {
        let surface = exact.surface_velocity()?;
        let velocity = |y: f64| exact.velocity(y).unwrap_or(f64::NAN);
        let top = profile.filled().last()?;
        let low: Vec<usize> = profile.filled().filter(|&bin| profile.height[bin] < 0.2 * exact.layer_height).collect();
        let intercept = |velocity: &dyn Fn(usize) -> f64| {
            let line: Vec<(f64, f64)> = low.iter().map(|&bin| (profile.height[bin], velocity(bin))).collect();
            linear_fit(&line).map(|fit| fit.intercept)
        };
        let slip = intercept(&|bin| profile.velocity[bin])? - intercept(&|bin| velocity(profile.height[bin]))?;
        let stress = stress_errors(profile, exact);
        Some(Self {
            velocity_l2: 100.0 * profile.velocity_l2(velocity),
            surface_velocity_error: 100.0 * (profile.velocity[top] / velocity(profile.height[top]) - 1.0),
            implied_stress_error: 100.0 * stress.iter().sum::<f64>() / stress.len() as f64,
            wall_slip: 100.0 * slip / surface,
        })
    }
}

/// |μ(I)/tanθ − 1| of bins between 0.1 h and 0.9 h, with μ(I) of (31) and I from central differences of the bins' velocities
/// and their pressures.
fn stress_errors(profile: &DepthProfile, exact: &BagnoldProfile) -> Vec<f64> {
    let tangent = libm::tan(exact.inclination);
    let error = |(bin, rate): (usize, f64)| {
        let speed = (profile.pressure[bin] / exact.grains.grain_density).sqrt();
        let inertial_number = rate * exact.grains.grain_diameter / speed;
        let friction = exact.grains.static_friction
            + (exact.grains.limiting_friction - exact.grains.static_friction)
                / (1.0 + exact.grains.reference_inertia / inertial_number);
        (friction / tangent - 1.0).abs()
    };
    let inside = |(bin, _): &(usize, f64)| (0.1..=0.9).contains(&(profile.height[*bin] / exact.layer_height));
    profile.shear_rates().into_iter().filter(inside).map(error).collect()
}

/// Runs of one kind, of which several may differ in their rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ConvergenceStudy {
    pub(super) slope_angle: f64,
    pub(super) arrangement: Arrangement,
    pub(super) start: LayerStart,
}

/// The studies of the spacing: on the lattice from the profile, and of displaced particles from rest, with their
/// errors coarse to fine.
pub(super) fn convergence_studies(records: &[Record]) -> Vec<(ConvergenceStudy, Vec<(f64, f64)>)> {
    let kinds = [(Arrangement::Lattice, LayerStart::Profile), (Arrangement::Jittered, LayerStart::Rest)];
    let angles = distinct(records.iter().filter(|(run, _)| run.is_steady()).map(|(run, _)| run.slope_angle));
    let of_angle = |slope_angle| kinds.map(|(arrangement, start)| ConvergenceStudy { slope_angle, arrangement, start });
    let studies = angles.into_iter().flat_map(of_angle).map(|study| (study, convergence_errors(records, study)));
    studies.filter(|(_, errors)| errors.len() >= 2).collect()
}

/// (rows, velocity L2 `[%]`) of the runs of a study, coarse to fine: of the mean velocity over the seeds of a
/// resolution, bin by bin, for what one seed's displacements do to its height is no error of the spacing. Where the study has layers
/// that are raised again, of displaced particles it is made of them alone.
fn convergence_errors(records: &[Record], study: ConvergenceStudy) -> Vec<(f64, f64)> {
    let is_own = |(run, _): &&Record| {
        let BagnoldFlow { slope_angle, arrangement, start, .. } = *run;
        run.is_steady() && study == ConvergenceStudy { slope_angle, arrangement, start }
    };
    let mut own: Vec<&Record> = records.iter().filter(is_own).collect();
    let is_raised = |record: &&Record| record.0.layer.preparation == Preparation::Raised;
    if own.iter().any(is_raised) {
        own.retain(is_raised);
    }
    own.sort_by_key(|(run, _)| run.layer.resolution);
    let error = |seeds: &[&Record]| {
        let (run, _) = seeds[0];
        let exact = run.profile();
        let is_steady = seeds.iter().all(|(run, record)| run.unsteadiness(&record.data).is_none());
        let profiles: Vec<&DepthProfile> = seeds.iter().map(|(_, record)| &record.data.profile).collect();
        let pairs = mean_over_seeds(&profiles);
        exact.surface_velocity()?;
        let l2 = relative_l2(pairs.iter().map(|&(y, velocity)| (velocity, exact.velocity(y).unwrap_or(f64::NAN))));
        (!pairs.is_empty()).then_some((run.layer.resolution as f64, if is_steady { 100.0 * l2 } else { f64::NAN }))
    };
    own.chunk_by(|one, other| one.0.layer.resolution == other.0.layer.resolution).filter_map(error).collect()
}

/// (height, velocity) of the bins that all profiles fill, in the mean over them.
fn mean_over_seeds(profiles: &[&DepthProfile]) -> Vec<(f64, f64)> {
    let number = profiles.len() as f64;
    let bins = profiles.iter().map(|profile| profile.height.len()).min().unwrap_or(0);
    let mean = |of: fn(&DepthProfile) -> &[f64], bin: usize| {
        profiles.iter().map(|profile| of(profile)[bin]).sum::<f64>() / number
    };
    let filled = (0..bins).filter(|&bin| profiles.iter().all(|profile| profile.samples[bin] > 0.0));
    filled.map(|bin| (mean(|profile| &profile.height, bin), mean(|profile| &profile.velocity, bin))).collect()
}

/// The 1-D solution from rest and the steady depth mean.
pub(super) fn history_from_rest(run: &BagnoldFlow) -> Option<(TransientHistory, f64)> {
    let profile = run.profile();
    let steady = profile.depth_mean()?;
    let scale = libm::pow(profile.layer_height / 0.01, 1.5);
    let mut layer = LayerTransient::from_rest(profile, 100, 1e-3 * scale).ok()?;
    Some((layer.run(6.0 * scale, &[]).ok()?, steady))
}

/// The 1-D solution of a layer that comes to rest or runs away, until a time `[s]`.
pub(super) fn transient_of(run: &BagnoldFlow, end: f64) -> Option<TransientHistory> {
    let start = run.start_profile();
    let layer = match run.start {
        LayerStart::Profile => {
            LayerTransient::from_profile(run.profile(), 100, 1e-3, |y| start.velocity(y).unwrap_or(0.0))
        }
        LayerStart::Rest | LayerStart::Uncompressed => LayerTransient::from_rest(run.profile(), 100, 2e-3),
    };
    layer.and_then(|mut layer| layer.run(end, &[])).ok()
}

/// The particles' depth means as a history.
pub(super) fn particle_history(data: &LayerObservation) -> TransientHistory {
    let series = &data.series;
    TransientHistory { times: series.time.clone(), depth_means: series.mean_velocity.clone(), profiles: Vec::new() }
}

/// Depth mean at a time `[s]`, of a run that ends between two samples on the line of its last ones; not a number where the
/// history ended before.
pub(super) fn mean_at(history: &TransientHistory, time: f64) -> f64 {
    let samples: Vec<(f64, f64)> = history.times.iter().copied().zip(history.depth_means.iter().copied()).collect();
    interpolated(&samples, time, (Extrapolation::Nothing, Extrapolation::Line(1.0))).unwrap_or(f64::NAN)
}
