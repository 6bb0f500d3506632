//! Metrics of scenes: their balances, and their gauges compared with measurements.

use super::flow::Dimension;
use super::setting::{SceneInlet, SceneWall};
use super::sides::SceneSides;
use super::{FedMass, Measurand, MeasuredSeries, SceneFlow, SceneObservation, SceneRecord, prediction, series};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, Variant, quantities};
use crate::output::caution_about;
use crate::setup::energy_ledger::{self, CORRECTION_WORK, ENERGY_RESIDUAL, ENERGY_RISE, EnergyScale, WALL_WORK};
use crate::statistics::{Extrapolation, interpolated};
use bagnold_number::{four_digits, short_digits};
use bagnold_solver::weakly_compressible::numerics::ViscousStep;

/// Impulse that implicit viscous steps may leave out, over that of gravity `[%]`.
const MOST_UNSOLVED: f64 = 0.5;

/// Largest difference of the mass that was fed from the integral of the rate, over a row `[-]`.
const FARTHEST: f64 = 0.7;
/// Numerical viscosity over the liquid's own that is warned of `[-]`.
const MOST_NUMERICAL: f64 = 0.25;
/// Largest root mean square of the speed of a liquid at rest at the end, over √(g H) `[-]`: particles that fall into place have as much. In
/// slow flows viscosity takes most of the energy.
const REST: f64 = 0.02;
/// γ̇ Δ √(ρ/p) above which sheared grains bear too little friction `[-]`: 0.2 % too little at 0.15, 1 % at 0.31, 9 to 14 % at 0.46, under a load.
const MOST_AGITATION: f64 = 0.2;
/// Least loss over the energy that went through a liquid `[-]`: a smaller one moves nothing that is measured.
const LEAST_LOSS: f64 = 1e-3;
/// Times of equal length from which the error of a mean is taken.
const BLOCKS: usize = 4;
/// Least way of a front, in particle spacings, from which its return is said `[-]`.
const FRONT_ROWS: f64 = 5.0;

quantities! { pub(super) [ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK, CORRECTION_WORK]
    MASS_RESIDUAL: accounted("mass_residual", "%", "mass inside plus outflow minus initial mass minus inflow, over the total"),
    MOMENTUM_RESIDUAL:
        accounted("momentum_residual", "%", "impulse not explained by gravity, walls and sides, over the impulse of gravity or of the inflow"),
    FORCE_RESIDUAL:
        accounted("force_residual", "%", "sum of the impulses of all walls minus that of all particles, over the impulse of gravity or of the inflow"),
    UNSOLVED: accounted("unsolved", "%", "residual impulse of the implicit viscous steps, over the impulse of gravity"),
    VISCOUS_ITERATIONS: accounted("viscous_iterations", "-", "iterations of an implicit viscous step, mean over all steps"),
    THROUGH_WALLS: accounted("through_walls", "-", "number of particles behind a wall at the end"),
    MASS_LEFT: accounted("mass_left", "%", "outflow through open sides over the initial mass and inflow"),
    WATER_RESIDUAL:
        accounted("water_residual", "%", "volume lost minus water expelled and pore liquid compressed, over the largest volume lost or gained"),
    CUT_OFF: accounted("cut_off", "%", "share of the bodies behind walls, removed at the start, as `cut_at_most` limits it of each body"),
    FEED_ERROR:
        accounted("feed_error", "-", "largest difference between inflow and the integral of its rate, over the mass of one row"),
    FINAL_RMS_SPEED:
        accounted("final_rms_speed", "m/s", "root mean square of the speed in the scene, mean over the last tenth of the run"),
    MACH_NUMBER:
        accounted("mach_number", "-", "largest relative speed of the slower 99.5 % of the particles over the sound speed, seen from the wall beside which they are slowest; not validated above 0.2"),
    NUMERICAL_VISCOSITY:
        accounted("numerical_viscosity", "Pa s", "viscosity of the liquid times what artificial terms, hourglass control and density coupling dissipate less what the scheme feeds in, over what the viscosity does; disorder that the viscosity itself damps is not in it"),
    FRONT: accounted("front", "m", "distance of the front along the line of a gauge at the end"),
    DEPTH: accounted("depth", "m", "thickness of the material at a gauge at the end"),
    GAUGE_ERROR: validated("gauge_error", "%", "√⟨(g(t)/m − 1)²⟩ over the measured values m at times t; the gauge g is interpolated linearly between its rows; m where it has no value are left out"),
}

const fn mean_force<S: Dimension<D>, const D: usize>() -> Quantity {
    let description = "time average, from the start, of the force of the flow on the wall of a gauge";
    Quantity::accounted("mean_force", S::FORCE_UNIT, description)
}

const fn mass_crossed<S: Dimension<D>, const D: usize>() -> Quantity {
    let description = "mass that crosses the line or parallelogram of a gauge until the end";
    Quantity::accounted("mass_crossed", S::MASS_UNIT, description)
}

const fn mass_fed<S: Dimension<D>, const D: usize>() -> Quantity {
    Quantity::accounted("mass_fed", S::MASS_UNIT, "inflow through an inlet until the end")
}

const fn discharge_of<S: Dimension<D>, const D: usize>() -> Quantity {
    let description = "mean mass per time through the line or parallelogram of a gauge, while 20 to 80 % of the mass crosses that has at the end";
    Quantity::accounted("discharge", S::FLUX_UNIT, description)
}

/// All quantities of a case of scenes.
pub(crate) const fn quantities_of<S: Dimension<D>, const D: usize>() -> [Quantity; 24] {
    let mut all = [mass_fed::<S, D>(); 24];
    all[22] = discharge_of::<S, D>();
    (all[20], all[21]) = (mean_force::<S, D>(), mass_crossed::<S, D>());
    let mut place = 0;
    while place < QUANTITIES.len() {
        all[place] = QUANTITIES[place];
        place += 1;
    }
    all
}

/// The metrics of all runs.
pub(crate) fn all<S: Dimension<D>, const D: usize>(records: &[SceneRecord<S, D>]) -> Vec<Metric> {
    records.iter().flat_map(of_run).collect()
}

fn of_run<S: Dimension<D>, const D: usize>((parameters, record): &SceneRecord<S, D>) -> Vec<Metric> {
    let (variant, data) = (parameters.named(), &record.data);
    let mut metrics = balances(&variant, data, parameters.sides.has_mirror());
    if parameters.numerics.viscous_step == ViscousStep::Implicit {
        let share = 100.0 * data.unsolved_impulse / data.gravity_impulse;
        let reason = "0.5 % of gravity's impulse: what viscous steps may leave unsolved; a smaller `viscous_tolerance` reduces it";
        let unsolved = UNSOLVED.of(&variant, share).exactly(0.0, "an exact solution has no residual");
        metrics.push(unsolved.gated(Limit::AtMost(MOST_UNSOLVED), reason).with_snapshot_tolerance(1.0, 1e-3));
        metrics.push(VISCOUS_ITERATIONS.of(&variant, data.viscous_iterations).with_snapshot_tolerance(0.05, 0.0));
    }
    if data.water.largest > 0.0 {
        let share = 100.0 * data.water.missing / data.water.largest;
        let residual = WATER_RESIDUAL.of(&variant, share).exactly(0.0, "the grains' volume is lost as water");
        metrics.push(residual.with_snapshot_tolerance(0.5, 0.05));
    }
    metrics.extend(feeds(&variant, data, parameters));
    metrics.extend(energy(&variant, data, parameters));
    metrics.push(FINAL_RMS_SPEED.of(&variant, final_mean(&data.rms_speed)).with_snapshot_tolerance(0.1, 1e-3));
    let mach = data.largest_speed / parameters.equation_of_state().sound_speed();
    metrics.push(MACH_NUMBER.of(&variant, mach).with_snapshot_tolerance(0.1, 1e-3));
    metrics.extend(numerical_viscosity(&variant, data, parameters));
    tell_coarse_shear(data, parameters);
    let all = series::of_run(parameters, data);
    let front = all.iter().find_map(|series| match &series.measure {
        Measurand::Front(line) => Some((line.clone(), series.values.first()?.clone())),
        _ => None,
    });
    for series in all {
        let own = variant.clone().and("gauge", series.gauge);
        let first = series.values.first().map_or(&[][..], Vec::as_slice);
        let last = first.last().copied().unwrap_or(f64::NAN);
        let metric = match series.measure {
            Measurand::Front(line) => {
                let farthest = largest(first);
                let absent = last.is_nan();
                let subject = format!("front `{}` of scene `{}`", series.gauge, parameters.name);
                if (absent || last < 0.5 * farthest) && farthest > FRONT_ROWS * parameters.spacing {
                    let far = four_digits(farthest);
                    let near = if absent { "nothing".to_owned() } else { format!("{} m", four_digits(last)) };
                    let text = format!(
                        "{subject} falls back from {far} m to {near}: the layer is thinner than `thickness` there; \
                         reduce `thickness` and `spacing`, or start the line farther along"
                    );
                    caution_about(&subject, &text);
                }
                if first.len() > 1 && first.iter().all(|front| *front >= (line.to - line.from).norm()) {
                    let remedy =
                        "along a bed, draw the line on its surface; elsewhere lengthen it or raise `thickness`";
                    caution_about(&subject, &format!("{subject} is at the end of its line throughout: {remedy}"));
                }
                let why = || "at the end, the material is thinner than `thickness` everywhere on the line".to_owned();
                FRONT
                    .of(&own, last)
                    .remarked(absent.then(why))
                    .predicted(prediction::of_front(parameters, data, &line, first))
            }
            Measurand::Depth(depth) => {
                let front = front.as_ref().map(|(line, fronts)| (line, &fronts[..]));
                DEPTH
                    .of(&own, last)
                    .predicted(front.and_then(|front| prediction::of_depth(parameters, data, &depth, front, last)))
            }
            Measurand::Force(_) => {
                let means: Vec<f64> = series.values.iter().map(|component| mean(component)).collect();
                mean_force::<S, D>().of(&own, size(&means))
            }
            // what it reads has no one quantity: studies take its columns
            Measurand::Probe(_) | Measurand::Position(_) | Measurand::Turn(_) => continue,
            Measurand::Flux(_) => {
                if let Some((mean, error)) = discharge(&data.time, first) {
                    let steady = discharge_of::<S, D>().of(&own, mean).with_snapshot_tolerance(0.1, 0.0);
                    let source = "standard error of the mean of four equal times";
                    metrics.push(steady.known_to(Origin::Repeat, Some(error), source));
                }
                mass_crossed::<S, D>().of(&own, last)
            }
        };
        metrics.push(metric.with_snapshot_tolerance(0.1, 0.1 * largest(first)));
        metrics.extend(errors(&own, (&data.time, parameters.duration), first, &series.measured));
    }
    metrics
}

/// The balances of a run in which something can be missing; `has_mirror` tells of planes of symmetry, which are no walls.
fn balances<const D: usize>(variant: &Variant, data: &SceneObservation<D>, has_mirror: bool) -> Vec<Metric> {
    let mass = data.whole_mass();
    let closed = "2e-5 %: single-precision rounding expected in long runs; 1e-7 % measured after thousands of steps";
    let mut metrics = vec![
        MASS_RESIDUAL
            .of(variant, 100.0 * data.missing_mass / mass)
            .exactly(0.0, "no particle is lost: each is inside, or has left through an open side")
            .gated(
                Limit::AtMost(1e-10),
                "1e-10 %: rounding expected in sums over millions of particles; 1e-12 % was measured with thousands",
            )
            .with_snapshot_tolerance(1.0, 1e-9),
        MOMENTUM_RESIDUAL
            .of(variant, 100.0 * data.missing_impulse / data.impulse())
            .exactly(0.0, "change of momentum = impulses of gravity, walls and sides")
            .gated(Limit::AtMost(2e-5), closed)
            .with_snapshot_tolerance(1.0, 1e-7),
        THROUGH_WALLS
            .of(variant, data.behind as f64)
            .exactly(0.0, "no particle passes a wall")
            .gated(Limit::AtMost(0.0), "0: walls are impermeable; a particle behind a wall makes the run invalid")
            .with_snapshot_tolerance(0.0, 0.0),
        MASS_LEFT
            .of(variant, 100.0 * data.left.iter().map(|side| side.mass).sum::<f64>() / mass)
            .with_snapshot_tolerance(0.1, 1.0),
        CUT_OFF.of(variant, 100.0 * data.cut_off).with_snapshot_tolerance(0.1, 1.0),
    ];
    if !has_mirror {
        let residual = FORCE_RESIDUAL
            .of(variant, 100.0 * data.unassigned_impulse / data.impulse())
            .exactly(0.0, "the reported wall forces are all forces of walls on particles");
        metrics.push(residual.gated(Limit::AtMost(2e-5), closed).with_snapshot_tolerance(1.0, 1e-7));
    }
    metrics
}

/// Inflow through inlets, and its difference from the prescribed inflow.
fn feeds<S: Dimension<D>, const D: usize>(
    variant: &Variant,
    data: &SceneObservation<D>,
    parameters: &SceneFlow<S, D>,
) -> Vec<Metric> {
    let of_inlet = |(inlet, fed): (&S::Inlet, &FedMass)| {
        let own = variant.clone().and("inlet", inlet.name());
        [
            mass_fed::<S, D>().of(&own, fed.mass).with_snapshot_tolerance(1e-6, 0.0),
            FEED_ERROR
                .of(&own, fed.farthest)
                .exactly(0.0, "integral of the prescribed rate; material enters row by row")
                .gated(Limit::AtMost(FARTHEST), "0.7 rows: half a row, plus a step's motion at 0.2 c (sound speed c)")
                .with_snapshot_tolerance(0.5, 0.1),
        ]
    };
    parameters.inlets.iter().zip(&data.fed).flat_map(of_inlet).collect()
}

/// The energy's balance. What a wall of the scene gives may be meant, so that only what is not booked is judged.
/// Gravity, height and stiffness of the scene give the scales of energy and time.
fn energy<S: Dimension<D>, const D: usize>(
    variant: &Variant,
    data: &SceneObservation<D>,
    parameters: &SceneFlow<S, D>,
) -> Vec<Metric> {
    let book = &data.energy;
    if book.total.is_empty() {
        return Vec::new();
    }
    let (fall, height) = (parameters.fall(), parameters.height());
    let numerics = &parameters.numerics;
    let smoothing_length = numerics.smoothing_ratio * parameters.spacing;
    let sound_speed = parameters.equation_of_state_over(fall).sound_speed();
    let scale = EnergyScale::WorkOver {
        fall_time: height / fall.sqrt(),
        weight_by_height: data.whole_mass() * fall,
        time_step: numerics.acoustic_courant * smoothing_length / sound_speed,
        crossing_time: height / sound_speed,
    };
    let share = |value: f64| 100.0 * value / scale.of(book).0;
    vec![
        energy_ledger::residual(variant, book, scale),
        ENERGY_RISE.of(variant, share(book.rise())).with_snapshot_tolerance(0.5, 0.1),
        WALL_WORK.of(variant, share(book.walls)).with_snapshot_tolerance(0.2, 0.5),
        CORRECTION_WORK.of(variant, share(book.correction)).with_snapshot_tolerance(0.2, 0.5),
    ]
}

/// Viscosity of a liquid by which the scheme's own dissipation would be that of the law's; none at rest. A large one is warned of.
fn numerical_viscosity<S: Dimension<D>, const D: usize>(
    variant: &Variant,
    data: &SceneObservation<D>,
    parameters: &SceneFlow<S, D>,
) -> Option<Metric> {
    let (law, (viscous, numerical)) = (&parameters.material, data.energy.viscous_and_numerical());
    let (fall, through) = (parameters.fall(), data.energy.turnover());
    let is_at_rest = final_mean(&data.rms_speed) < REST * fall.sqrt() && viscous < 0.5 * through;
    let is_small = viscous <= 0.0 || viscous.max(numerical) <= LEAST_LOSS * through;
    if law.is_plastic() || law.is_solid() || is_at_rest || is_small {
        return None;
    }
    let rate = data.rms_speed.iter().copied().fold(0.0, f64::max) / parameters.height();
    let own = law.viscosity(rate, parameters.bulk.density(law) * fall);
    let share = numerical / viscous;
    if share > MOST_NUMERICAL {
        let subject = format!("numerical viscosity of scene `{}`", parameters.name);
        let [times, lost] = [share, 100.0 * numerical / through].map(four_digits);
        let text = format!(
            "{subject}: {times} times the liquid's own, and {lost} % of the energy converted; reduce `spacing`"
        );
        caution_about(&subject, &text);
    }
    let metric = NUMERICAL_VISCOSITY.of(variant, own * share).with_snapshot_tolerance(0.1, 0.0);
    let source = "the material's own viscosity, at the largest root mean square of the speed over its height";
    Some(metric.against(Some(own).filter(|own| own.is_finite()), source, Confidence::Exact))
}

/// Warns of grains that are sheared faster than particles of their size can follow: the mean shear rate is that whose plastic work at the
/// mean pressure and the strength at rest is the dissipated energy.
fn tell_coarse_shear<S: Dimension<D>, const D: usize>(data: &SceneObservation<D>, parameters: &SceneFlow<S, D>) {
    let law = &parameters.material;
    // an impact is no shear: walls that move, or gravity along a period, drive one
    let is_driven = parameters.walls.iter().any(|wall| !wall.motion().is_rest()) || parameters.is_pulled_along();
    if !is_driven || !law.strength_is_friction() {
        return;
    }
    let (density, [Some(start), Some(end)]) = (parameters.bulk.density(law), [data.time.first(), data.time.last()])
    else {
        return;
    };
    let square = parameters.fall() - 0.5 * parameters.pull().norm() * parameters.height();
    let Some(strength) = law.strength_at_rest(density * square) else { return };
    let dissipated: f64 = ["viscosity", "plastic flow"].map(|cause| data.energy.dissipated_by(cause)).iter().sum();
    let rate = dissipated / (end - start) * density / (data.whole_mass() * strength);
    let agitation = rate * parameters.spacing / square.sqrt();
    if agitation > MOST_AGITATION {
        let subject = format!("shear of scene `{}`", parameters.name);
        let [own, finer] =
            [agitation, 0.5 * MOST_AGITATION / agitation * parameters.spacing].map(|own| short_digits(own, 2));
        let text = format!(
            "{subject}: N = γ̇ Δ √(ρ/p) is {own} in the mean; above {MOST_AGITATION} friction comes out too small; set \
             `spacing` = {finer}, or slower walls"
        );
        caution_about(&subject, &text);
    }
}

/// A gauge's series beside what was measured; `time` is that of its rows and of the run's end.
fn errors(variant: &Variant, time: (&[f64], f64), series: &[f64], measured: &[&MeasuredSeries]) -> Vec<Metric> {
    let error = |measured: &&MeasuredSeries| {
        let limit = (measured.limit > 0.0).then_some(Limit::AtMost(measured.limit));
        let ((error, compared), all) = (error(time, series, &measured.points), measured.points.len());
        let left_out = || format!("gauge `{}` has a value at {compared} of {all} measurements", measured.gauge);
        GAUGE_ERROR
            .of(variant, 100.0 * error)
            .remarked((compared < all).then(left_out))
            .against(Some(0.0), &measured.source, Confidence::Medium)
            .gated_by(limit, "limit stated in the scene's file")
            .with_snapshot_tolerance(0.1, 1.0)
            .of_user()
    };
    measured.iter().map(error).collect()
}

/// Mean mass per time while 20 to 80 % of the mass crosses that has at the end, from its series, and the standard error of the mean of four
/// equal times; none with fewer rows.
fn discharge(time: &[f64], crossed: &[f64]) -> Option<(f64, f64)> {
    let whole = *crossed.last()?;
    let row = |share: f64| crossed.iter().position(|mass| mass / whole >= share);
    let (from, to) = (row(0.2)?, row(0.8)?);
    let length = (to.checked_sub(from)?) / BLOCKS;
    let rate = |from: usize, to: usize| (crossed[to] - crossed[from]) / (time[to] - time[from]);
    let rates = (0..BLOCKS).map(|block| rate(from + block * length, from + (block + 1) * length));
    let mean = (length > 0).then(|| rate(from, to))?;
    let square: f64 = rates.map(|rate| (rate - mean).powi(2)).sum();
    Some((mean, (square / (BLOCKS * (BLOCKS - 1)) as f64).sqrt()))
}

/// Size of a vector of some components; of two, as `hypot` rounds it.
fn size(components: &[f64]) -> f64 {
    match *components {
        [one, other] => libm::hypot(one, other),
        _ => components.iter().map(|component| component * component).sum::<f64>().sqrt(),
    }
}

/// Mean over all samples but the first, before which nothing has been.
fn mean(series: &[f64]) -> f64 {
    let series = series.get(1..).unwrap_or_default();
    series.iter().sum::<f64>() / series.len() as f64
}

/// Mean over the last tenth of the samples, one at least.
fn final_mean(series: &[f64]) -> f64 {
    let last = &series[series.len() - series.len().div_ceil(10)..];
    last.iter().sum::<f64>() / last.len() as f64
}

fn largest(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Root mean square of value/measured − 1 at the measured times at which the series has a value, and their number; NaN where it has none,
/// or ends before. The last row may stand up to a row's time before the end of the run, up to which its line goes on.
fn error((time, end): (&[f64], f64), series: &[f64], points: &[(f64, f64)]) -> (f64, usize) {
    let samples: Vec<(f64, f64)> = time.iter().copied().zip(series.iter().copied()).collect();
    let at = |time: f64| interpolated(&samples, time, (Extrapolation::Nothing, Extrapolation::Line(1.0 + 1e-9)));
    let row = time.last().zip(time.iter().rev().nth(1)).map_or(0.0, |(last, before)| last - before);
    let last = time.last().map(|last| last.max(end.min(last + row)));
    let square = |&(time, measured): &(f64, f64)| Some((at(time)? / measured - 1.0).powi(2));
    let squares: Vec<f64> = points.iter().filter_map(square).collect();
    let is_whole = points.iter().all(|(at, _)| time.first() <= Some(at) && last.as_ref() >= Some(at));
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (if is_whole { mean.sqrt() } else { f64::NAN }, squares.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::ABSENT;

    #[test]
    fn a_discharge_is_the_rate_between_its_start_and_its_end() {
        // 1 s of nothing, 8 s of 3 kg/s, 1 s of nothing
        let time: Vec<f64> = (0..=100).map(|k| 0.1 * f64::from(k)).collect();
        let crossed: Vec<f64> = time.iter().map(|time| 3.0 * (time - 1.0).clamp(0.0, 8.0)).collect();
        let (rate, error) = discharge(&time, &crossed).expect("rows");
        assert!((rate - 3.0).abs() < 1e-9 && error < 1e-9, "{rate} ± {error} kg/s");
        let back: Vec<f64> = crossed.iter().map(|mass| -mass).collect();
        assert!(discharge(&time, &back).is_some_and(|(rate, _)| (rate + 3.0).abs() < 1e-9));
        assert_eq!([discharge(&time, &[0.0; 101]), discharge(&time[..3], &[0.0, 1.0, 2.0])], [None, None]);
    }

    #[test]
    fn the_error_is_that_at_the_measured_times() {
        let (time, series) = ([0.0, 1.0, 2.0], [1.0, 2.0, 4.0]);
        let until = |end: f64| (&time[..], end);
        assert!(error(until(2.0), &series, &[(0.0, 1.0), (0.5, 1.5), (2.0, 4.0)]).0 < 1e-15);
        assert!((error(until(2.0), &series, &[(1.5, 2.0)]).0 - 0.5).abs() < 1e-15);
        assert!(error(until(2.0), &series, &[(1.0, 2.0), (2.5, 4.0)]).0.is_nan(), "the run ended before");
        assert_eq!(
            error(until(2.5), &series, &[(1.0, 2.0), (2.5, 5.0)]),
            (0.0, 2),
            "the last row stands before the end"
        );
        assert!(error(until(4.0), &series, &[(1.0, 2.0), (3.5, 4.0)]).0.is_nan(), "more than a row before");
        // without a front at first
        let late = [ABSENT, 2.0, 4.0];
        assert_eq!(error(until(2.0), &late, &[(0.5, 9.0), (1.0, 2.0)]), (0.0, 1));
        assert!(error(until(2.0), &late, &[(0.5, 9.0)]).0.is_nan(), "nothing is compared");
    }
}
