//! The equations of a step, written down pair by pair.

use super::pairs::{Pair, corrections, pairs_of};
use super::{DENSITY, SPACING};
use bagnold_solver::internals::weakly_compressible::{State, viscosities, walls};
use bagnold_solver::material::rheology::field::FieldStep;
use bagnold_solver::vector::{Tensor, Vector, deviator, equivalent_shear_stress, shear_rate, strain_rate};
use bagnold_solver::weakly_compressible::numerics::ViscositySwitch;
use bagnold_solver::weakly_compressible::terms::common_motion::correction_share;
use bagnold_solver::weakly_compressible::terms::field_diffusion::surface_sink;

/// One over a sum of a wall's neighbours, or nothing where they hardly reach it.
fn wet_inverse(sum: f64, unit: f64) -> f64 {
    if sum > 1e-12 * unit { 1.0 / sum } else { 0.0 }
}

/// Result of a step, and ∂ρ/∂t.
pub(super) struct Made<const D: usize> {
    pub(super) acceleration: Vec<Vector<D>>,
    pub(super) density_rate: Vec<f64>,
    pub(super) gradient: Vec<Tensor<D>>,
    pub(super) stress: Vec<Tensor<D>>,
    pub(super) field: Vec<f64>,
    pub(super) artificial_viscosity: Vec<f64>,
}

pub(super) fn by_pairs<const D: usize>(state: &State<D>, time_step: f64) -> Made<D> {
    let (of, model) = (&state.particles, &state.model);
    let (apparent, walls) = (viscosities(of), walls(of));
    let (numerics, law, state_equation) = (&model.numerics, &model.rheology, &model.equation_of_state);
    let (flow, real) = (of.flow_count(), of.real_count());
    let (h, c, gravity, identity) =
        (1.5 * SPACING, state_equation.sound_speed(), model.gravity, Tensor::<D>::identity());
    let field = of.field.clone().unwrap_or_else(|| vec![0.0; real]);
    let (mut volume, mut pressure) = (of.volume[..real].to_vec(), vec![0.0; real]);
    for a in 0..flow {
        (volume[a], pressure[a]) =
            (of.mass[a] / of.density[a], model.pressure(of.density[a], &FieldStep::alone(field[a])));
    }
    let pairs = pairs_of(state, &volume);
    let is_flow = |b: &&Pair<D>| b.source < flow;

    // pressure and stress of the walls
    let mut stress = of.stress[..real].to_vec();
    let row = DENSITY * gravity.norm() * SPACING;
    for w in flow..real {
        let normal = walls.normal[w - flow];
        let (mut weights, mut sum, mut tensor) = (0.0, 0.0, Tensor::zeros());
        for f in pairs[w].iter().filter(is_flow) {
            let own = pressure[f.source];
            let part = (own / (0.5 * row)).clamp(0.0, 1.0);
            let there = own + of.density[f.source] * gravity.dot(&normal) * f.r.dot(&normal) * part;
            let ratio = if own < 0.0 || !law.is_solid() { 1.0 } else { there / own.max(1e-3 * row) };
            weights += f.value;
            sum += f.value * there;
            tensor += f.tensor(&of.stress) * (f.value * ratio);
        }
        let mirror = identity - normal * normal.transpose() * (2.0 * walls.smoothness[w - flow]);
        let wet = wet_inverse(weights, 1.0);
        (pressure[w], stress[w]) = ((sum * wet).max(0.0), mirror * tensor * mirror * wet);
    }

    // corrections, pressure gradient, corrected stress
    let corrected: Vec<_> = pairs[..flow].iter().map(|pairs| corrections(pairs)).collect();
    let share = numerics.force_correction(law).unwrap_or_else(|| {
        let count = flow as f64;
        let mean = of.velocity[..flow].iter().sum::<Vector<D>>() / count;
        let speed = of.velocity[..flow].iter().map(|v| (v - mean).norm_squared()).sum::<f64>() / count;
        let shear = of.velocity_gradient[..flow].iter().map(|v| shear_rate(v).powi(2)).sum::<f64>() / count;
        correction_share(speed.sqrt() / c, shear.sqrt() * SPACING / c)
    });
    let for_forces = |a: usize| identity + (corrected[a].2 - identity) * share;
    let elasticity =
        |a: usize| model.elasticity(equivalent_shear_stress(&of.stress[a]), pressure[a], &FieldStep::alone(field[a]));
    let (mut slope, mut flux) = (Vec::new(), Vec::new());
    for a in 0..flow {
        let rise = |sum, b: &Pair<D>| sum + b.r * (b.weight * (pressure[b.source] - pressure[a]));
        slope.push(corrected[a].1 * pairs[a].iter().fold(Vector::zeros(), rise));
        let shear_speed = c * numerics.shear_modulus_ratio.sqrt();
        let elastic = numerics.elastic_damping * DENSITY * shear_speed * h;
        let damping = if law.is_plastic() { elastic * elasticity(a) } else { 0.0 };
        let eddies = of.density[a] * (0.1 * SPACING).powi(2) * shear_rate(&of.velocity_gradient[a]);
        let added = deviator(&strain_rate(&of.velocity_gradient[a])) * (2.0 * (damping + eddies));
        flux.push((of.stress[a] + added - identity * pressure[a]) * for_forces(a));
    }

    // momentum
    let speed = |b: usize| {
        let speed = (pressure[b].max(0.0) / DENSITY).sqrt();
        let number = shear_rate(&of.velocity_gradient[b]) * SPACING / speed.max(1e-30);
        let (fast, still) = ((number - 0.1) / 0.2, 1.0 - (number - 0.005) / 0.015);
        let of_grains = law.strength_is_friction() && model.field_diffusion().is_none();
        if of_grains { speed * (0.375 + 0.625 * fast.max(still).clamp(0.0, 1.0)) } else { speed }
    };
    let wall_factor = |b: &Pair<D>| {
        let (normal, depth) = (walls.normal[b.index - flow], walls.depth[b.index - flow]);
        (1.0 + depth / (b.r.dot(&normal) - depth).max(1e-6 * h)).min(6.0)
    };
    let roughness = |b: &Pair<D>| 1.0 - walls.smoothness[b.index - flow];
    let acceleration = |a: usize| {
        let mut sum = gravity;
        let resistance = |b: &Pair<D>| -b.weight * roughness(b) * wall_factor(b) * wall_factor(b).min(2.0);
        let resistance: f64 = pairs[a].iter().filter(|b| b.source >= flow).map(resistance).sum();
        let borne = (0.8 / (numerics.viscous_courant * h * h * resistance)).min(1.0);
        for b in &pairs[a] {
            let regular = b.r.norm_squared() + 1e-4 * h * h;
            if b.source < flow {
                let control = numerics.hourglass * h * (speed(a) + speed(b.source));
                let traction = (flux[a] + b.tensor(&flux)) * b.r;
                let relief = model.artificial_stress.map_or(0.0, |stress| {
                    let along: f64 = traction.dot(&b.r) / regular;
                    stress.factor(b.r.norm_squared(), along)
                });
                let slip = of.velocity[a] - b.vector(&of.velocity);
                let alpha = match numerics.viscosity_switch {
                    ViscositySwitch::Constant => numerics.artificial_viscosity,
                    ViscositySwitch::MorrisMonaghan => {
                        0.5 * (of.artificial_viscosity[a] + of.artificial_viscosity[b.source])
                    }
                };
                let strange = slip - (of.velocity_gradient[a] + b.tensor(&of.velocity_gradient)) * b.r * 0.5;
                let approach: f64 = slip.dot(&b.r);
                let felt: f64 = if law.is_solid() { strange.dot(&b.r) } else { approach };
                let push = alpha * h * c * felt.max(approach).min(0.0);
                let mean = 0.5 * (of.density[a] + of.density[b.source]);
                let damping = of.density[b.source] * (push + control * strange.dot(&b.r)) / (mean * regular);
                sum += (traction + b.r * relief) * (b.weight / of.density[a]) + b.r * (b.weight * damping);
            } else {
                let place = b.index - flow;
                let (normal, factor) = (walls.normal[place], wall_factor(b));
                let wall = b.tensor(&stress) - identity * pressure[b.source];
                let slip = (of.velocity[a] - walls.velocity[place]) * factor;
                let strange = slip - of.velocity_gradient[a] * b.r;
                let whole = (pressure[b.source].max(0.0) / DENSITY).sqrt();
                let control = numerics.hourglass * h * (speed(a) + if law.is_solid() { speed(a) } else { whole });
                // what needs no pressure follows from the velocity at the wall
                let (height, corrected) = (b.r.dot(&normal), for_forces(a) * b.r);
                let viscosity =
                    if law.is_plastic() { 0.0 } else { law.viscosity(shear_rate(&of.velocity_gradient[a]), 0.0) };
                let part = if viscosity > 0.0 { viscosity / apparent[a] } else { 0.0 };
                let further = slip - of.velocity_gradient[a] * normal * height;
                let further = further - normal * further.dot(&normal);
                let slip = slip + further * (factor - 1.0).min(1.0);
                let stretch = (normal.dot(&corrected) / height).clamp(0.0, 2.0);
                let rub = slip * (2.0 * borne * viscosity * stretch);
                let replaced = (of.stress[a] + b.tensor(&stress)) * corrected * part;
                let traction = (flux[a] + wall * for_forces(a)) * b.r + (rub - replaced) * roughness(b);
                sum += traction * (b.weight / of.density[a]);
                sum += normal * (b.weight * control * strange.dot(&normal));
            }
        }
        sum
    };
    let acceleration: Vec<_> = (0..flow).map(acceleration).collect();

    // velocities of the walls: a line through that of the surface, and as the volume of a liquid has it a fitted one
    let mut velocity: Vec<_> = (0..flow).map(|a| of.velocity[a] + acceleration[a] * time_step).collect();
    velocity.resize(real, Vector::zeros());
    let mut sliding = velocity.clone();
    for w in flow..real {
        let (normal, depth) = (walls.normal[w - flow], walls.depth[w - flow]);
        let (mut moments, mut first, mut mean) = ([0.0; 3], Vector::zeros(), Vector::zeros());
        for f in pairs[w].iter().filter(is_flow) {
            let distance = (-f.r.dot(&normal) - depth).max(0.25 * SPACING);
            let slip = f.vector(&velocity) - walls.velocity[w - flow];
            for (k, moment) in moments.iter_mut().enumerate() {
                *moment += f.value * distance.powi(k as i32);
            }
            mean += slip * f.value;
            first += slip * (f.value * distance);
        }
        let [m0, m1, m2] = moments;
        let opposite = first * (-depth * wet_inverse(m2, SPACING * SPACING));
        let (mean_slip, mean_distance) = (mean * wet_inverse(m0, 1.0), m1 * wet_inverse(m0, 1.0));
        let spread = m0 * m2 - m1 * m1 + 0.1 * (SPACING * m0).powi(2);
        let growth = (first * m0 - mean * m1) / spread.max(f64::MIN_POSITIVE);
        let is_smooth = walls.smoothness[w - flow] > 0.0;
        let along = if is_smooth { mean_slip } else { opposite };
        let fitted = if is_smooth { along } else { mean_slip - growth * (mean_distance + depth) };
        let across = normal * normal.transpose();
        let moving = |along| walls.velocity[w - flow] + across * opposite + (identity - across) * along;
        (velocity[w], sliding[w]) = (moving(along), moving(if model.slides() { fitted } else { along }));
    }

    // continuity, velocity gradient, law
    let yields = |a: usize| if pressure[a] > 0.0 { 1.0 - elasticity(a) } else { 0.0 };
    let mut made = Made {
        acceleration,
        density_rate: Vec::new(),
        gradient: Vec::new(),
        stress: Vec::new(),
        field: Vec::new(),
        artificial_viscosity: Vec::new(),
    };
    for a in 0..flow {
        let (mut gradient, mut diffusion) = (Tensor::zeros(), Tensor::zeros());
        let (mut compression, mut coupling, mut taken, mut given, mut all) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for b in &pairs[a] {
            gradient += (b.vector(&velocity) - velocity[a]) * b.r.transpose() * b.weight;
            all += b.weight;
            compression += b.weight * (velocity[a] - b.vector(&sliding)).dot(&b.r);
            if b.source < flow {
                let (own, other) = (pressure[a], pressure[b.source]);
                coupling += b.weight * (2.0 * (own - other) - (slope[a] + b.vector(&slope)).dot(&b.r));
                let factor = 4.0 * yields(a) * yields(b.source) / (own + other).max(1e-30);
                diffusion += (of.stress[a] * other - b.tensor(&of.stress) * own) * (b.weight * factor);
                taken += b.weight * field[b.source];
                given += b.weight;
            } else {
                let place = b.index - flow;
                let above = (b.r.dot(&walls.normal[place]) - walls.depth[place]).max(0.05 * SPACING);
                let factor = (1.0 + walls.depth[place] / above).min(6.0);
                given += b.weight * factor * (1.0 - walls.smoothness[place]);
            }
        }
        let coupled = if law.is_cohesive() { 0.0 } else { time_step * numerics.density_coupling * coupling };
        let rate = of.density[a] * compression + coupled;
        let gradient = gradient * corrected[a].1;
        let diffuses = if law.strength_is_friction() { numerics.stress_diffusion } else { 0.0 };
        let before = of.stress[a] + diffusion * (time_step * diffuses * c * h);
        let kept = model.field_diffusion().map_or(FieldStep::alone(field[a]), |spreads| {
            let loss = surface_sink(-2.0 * all, model.full_weight, corrected[a].0) - 2.0 * given;
            FieldStep::new(field[a], -2.0 * spreads.strength * taken, spreads.strength * loss)
        });
        let pressure = model.pressure(of.density[a] + time_step * rate, &FieldStep::alone(field[a]));
        let end = law.updated_state_of_volume(&before, &gradient, pressure, &kept, model.moduli(), time_step);
        let alpha = of.artificial_viscosity[a];
        let switched = alpha + time_step * (compression.max(0.0) - 0.1 * (alpha - 0.1) * c / h);
        let switches = numerics.viscosity_switch == ViscositySwitch::MorrisMonaghan;
        made.artificial_viscosity.push(if switches { switched.clamp(0.1, 1.0) } else { alpha });
        made.density_rate.push(rate);
        made.gradient.push(gradient);
        made.stress.push(end.stress);
        made.field.push(end.field);
    }
    made
}
