//! The energy ledger: what gravity and walls gave the flow since the start, and where it went.
//!
//! Over any time, K + E = K_0 + E_0 + W_g + W_w − (dissipation) + residual, with the kinetic energy K and the elastic
//! energy E of pressure and shear read off the state. Every entry is the work that a term of the scheme did in each step:
//!
//! - forces at the mean velocity of the step, v̄ = ½(vⁿ + vⁿ⁺¹), at which the change of K is exactly Σ m v̄·a Δt;
//! - deformation by the new velocity gradient with the mean of the stresses before and after the step;
//! - gravity at the new velocity, with which particles move.
//!
//! The stress acts on K as it was before the step, and on the deformation as its mean: over a run the difference is the sum
//! of Δt ½(Fⁿ⁺¹·vⁿ⁺¹ − Fⁿ·vⁿ) with the force F of the stress, of which only both ends are left. With gravity's, that is
//! ½ Δt m a·v: nothing where the flow is steady, and half a step's change of K elsewhere. Two things are left of the sum itself, and
//! entries of their own: the mean of two pressures is not that of the step where tension is cut within it, and the two sums of a
//! force are taken at places a step apart. The latter is known as far as the motion around a particle is one gradient.
//!
//! Walls: Σ m v̄·a_w Δt of their tractions, plus the part of the stress' work on the velocity gradient that they cause.
//! In the continuum the two are equal and opposite at a wall at rest, so that W_w is the work of walls that move: what a
//! wall at rest has in W_w, its extrapolation has fed into the flow, or slip along it has taken. The divergence of the
//! forces, with the correction E, is the transpose of a gradient with E; continuity takes none and the strain rate L, and
//! the difference of the two works is an entry of its own. The residual is what is left: a step has a length.
//!
//! (A density that follows tr(E ∇v) would close that gap, and makes the layer of Bagnold's profile swell: 9 % of its
//! velocity at 24°. E varies as particles pass each other, so that what it adds does not come back.)

use crate::lanes::Lanes;
use crate::lanes::algebra::{accumulate, contraction, dot, matrix_product, scaled, splat_vector, sum_of, zero_tensor};
use crate::material::equation_of_state::{EquationOfState, Tension};
use crate::vector::{Tensor, Vector, double_contraction};
use crate::weakly_compressible::terms::continuity::compression;
use crate::weakly_compressible::{GradientUse, Model, Particles};
use serde::{Deserialize, Serialize};

/// Energies `[J]`, in two dimensions `[J/m]`, since the start of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyLedger {
    /// Work of gravity.
    pub gravity: f64,
    /// Work of walls: of those that move, and what the extrapolation of those at rest feeds into the flow.
    pub walls: f64,
    /// Energy dissipated by the viscosity of a law, of eddies and of elastic damping.
    pub viscous: f64,
    /// Energy dissipated by plastic flow, and by the diffusion of the stress ratio.
    pub plastic: f64,
    /// Energy dissipated by artificial viscosity and hourglass control within the flow, and given to its artificial stress.
    pub artificial: f64,
    /// Energy dissipated by the hourglass control at walls.
    pub wall_control: f64,
    /// Energy dissipated by the density–pressure coupling.
    pub density_coupling: f64,
    /// Energy dissipated by contacts with walls.
    pub contact: f64,
    /// Energy dissipated by the friction of side walls.
    pub side_walls: f64,
    /// Energy fed in by the kernel corrections: the work that the stress does on the gradients as they are taken, less that of
    /// the same stress as the forces take it. Negative where they take energy out.
    pub correction: f64,
    /// Fed in where a step crosses the density without pressure and tension is cut: what compression stores of the part under
    /// pressure, less the work that the mean pressure does over all of the step.
    #[serde(default)]
    pub cut: f64,
    /// Fed in by the ways that particles go within a step: half the work of the law's stress on the change of what its forces are the
    /// transpose of, from V G to V′ G (1 − Δt L). Compression is booked with V′ and takes twice that of V from it.
    #[serde(default)]
    pub ways: f64,
}

impl EnergyLedger {
    /// Applies a function to every pair of entries.
    fn combined(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            gravity: f(self.gravity, other.gravity),
            walls: f(self.walls, other.walls),
            viscous: f(self.viscous, other.viscous),
            plastic: f(self.plastic, other.plastic),
            artificial: f(self.artificial, other.artificial),
            wall_control: f(self.wall_control, other.wall_control),
            density_coupling: f(self.density_coupling, other.density_coupling),
            contact: f(self.contact, other.contact),
            side_walls: f(self.side_walls, other.side_walls),
            correction: f(self.correction, other.correction),
            cut: f(self.cut, other.cut),
            ways: f(self.ways, other.ways),
        }
    }

    /// Adds the entries of another.
    pub(crate) fn add(&mut self, other: Self) {
        *self = self.combined(other, |a, b| a + b);
    }

    /// Entries since those of an earlier time.
    #[must_use]
    pub fn since(self, earlier: Self) -> Self {
        self.combined(earlier, |now, then| now - then)
    }

    /// All that was fed in beside the work of gravity `[J]`.
    #[must_use]
    pub fn given(&self) -> f64 {
        self.walls + self.correction + self.cut + self.ways
    }

    /// All that was dissipated `[J]`.
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.viscous
            + self.plastic
            + self.artificial
            + self.wall_control
            + self.density_coupling
            + self.contact
            + self.side_walls
    }
}

/// Energies of a state with the ledger that led to it, all in `[J]`, in two dimensions `[J/m]`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyAccount {
    /// ½ Σ m v².
    pub kinetic: f64,
    /// Energy of compression and of elastic shear.
    pub elastic: f64,
    /// Energy gained and lost since the start.
    pub ledger: EnergyLedger,
}

impl EnergyAccount {
    pub(crate) fn of<const D: usize>(particles: &Particles<D>, model: &Model<D>, ledger: EnergyLedger) -> Self {
        let shear_modulus = model.rheology.is_plastic().then(|| model.shear_modulus());
        let (mut kinetic, mut elastic) = (0.0, 0.0);
        for index in particles.by_identity() {
            let (mass, density) = (particles.mass[index], particles.density[index]);
            kinetic += 0.5 * mass * particles.velocity[index].norm_squared();
            elastic += mass * specific_compression_energy(model, particles, index);
            if let Some(shear_modulus) = shear_modulus {
                elastic += shear_energy(mass / density, &particles.stress[index], shear_modulus);
            }
        }
        Self { kinetic, elastic, ledger }
    }

    /// Kinetic, elastic and potential energy `[J]`, the latter from zero at the start: what can only fall while no wall
    /// moves.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic - self.ledger.gravity
    }

    /// Change since a state before that the ledger does not explain `[J]`: positive if energy came from nowhere.
    #[must_use]
    pub fn residual_since(&self, before: &Self) -> f64 {
        let (now, then) = (&self.ledger, &before.ledger);
        self.total() - before.total() - (now.given() - then.given()) + (now.dissipated() - then.dissipated())
    }
}

/// Kinetic and elastic energy of one particle `[J]`.
pub(crate) fn energy_of<const D: usize>(particles: &Particles<D>, index: usize, model: &Model<D>) -> f64 {
    let single = model.gradient_use() == GradientUse::Stress && model.rheology.is_plastic();
    let shear_modulus = single.then(|| model.shear_modulus());
    let (mass, density) = (particles.mass[index], particles.density[index]);
    let shear = |modulus| shear_energy(mass / density, &particles.stress[index], modulus);
    mass * (0.5 * particles.velocity[index].norm_squared() + specific_compression_energy(model, particles, index))
        + shear_modulus.map_or(0.0, shear)
}

/// Energy of elastic shear in a volume `[J]`.
fn shear_energy<const D: usize>(volume: f64, stress: &Tensor<D>, shear_modulus: f64) -> f64 {
    volume * double_contraction(stress, stress) / (4.0 * shear_modulus)
}

/// Energy of the compression of a particle `[J/kg]`: ∫ p/ρ² dρ from the density without pressure, ρ0 exp(−e), is exp(e) times the energy that the
/// equation of state gives at ρ exp(e).
fn specific_compression_energy<const D: usize>(model: &Model<D>, particles: &Particles<D>, index: usize) -> f64 {
    let (density, kept) = (particles.density[index], particles.kept(index));
    if model.pore_liquid.is_some() {
        return model.pore_energy(model.pressure(density, &kept), kept.value) / density;
    }
    let loosening = model.rheology.loosening(kept.value);
    loosening * compression_energy(&model.equation_of_state, density * loosening)
}

/// ∫ p/ρ² dρ from ρ0 `[J/kg]`.
fn compression_energy(equation_of_state: &EquationOfState, density: f64) -> f64 {
    let strain = (density - equation_of_state.reference_density) / equation_of_state.reference_density;
    let free = equation_of_state.tension == Tension::Cut && strain < 0.0;
    let specific_modulus = equation_of_state.bulk_modulus / equation_of_state.reference_density;
    if free { 0.0 } else { specific_modulus * (libm::log1p(strain) - strain / (1.0 + strain)) }
}

/// Contribution of the velocity step of eight particles to the ledger.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VelocityStep<'a, V, const D: usize> {
    /// Masses, zero where there is no particle.
    pub(crate) mass: V,
    pub(crate) time_step: f64,
    pub(crate) gravity: &'a Vector<D>,
    /// Velocities before the step.
    pub(crate) before: &'a [V; D],
    /// Velocities after the step, with the contact.
    pub(crate) end: &'a [V; D],
    /// Velocity change by a contact.
    pub(crate) contact: &'a [V; D],
    /// Accelerations by walls' tractions, artificial terms, and hourglass control at walls `[m/s²]`.
    pub(crate) by_walls: &'a [V; D],
    pub(crate) by_damping: &'a [V; D],
    pub(crate) by_wall_control: &'a [V; D],
}

impl<V: Lanes, const D: usize> VelocityStep<'_, V, D> {
    /// Adds the step to a sum.
    #[inline(always)]
    pub(crate) fn add_to(&self, sum: &mut VelocityWork<V>) {
        let mean = scaled(V::splat(0.5), &sum_of(self.before, self.end));
        let mass_time = self.mass * V::splat(self.time_step);
        sum.gravity = sum.gravity + mass_time * dot(&splat_vector(self.gravity), self.end);
        sum.walls = sum.walls + mass_time * dot(&mean, self.by_walls);
        sum.artificial = sum.artificial - mass_time * dot(&mean, self.by_damping);
        sum.wall_control = sum.wall_control - mass_time * dot(&mean, self.by_wall_control);
        sum.contact = sum.contact - self.mass * dot(&mean, self.contact);
    }
}

/// Entries of the ledger that the velocity step makes, lane by lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VelocityWork<V> {
    gravity: V,
    walls: V,
    artificial: V,
    wall_control: V,
    contact: V,
}

impl<V: Lanes> VelocityWork<V> {
    /// Nothing yet.
    #[inline(always)]
    pub(crate) fn new() -> Self {
        let zero = V::splat(0.0);
        Self { gravity: zero, walls: zero, artificial: zero, wall_control: zero, contact: zero }
    }

    /// Adds the lanes, in their order, to a block's ledger.
    #[inline(always)]
    pub(crate) fn add_to(self, ledger: &mut EnergyLedger) {
        ledger.gravity += sum_of_lanes(self.gravity);
        ledger.walls += sum_of_lanes(self.walls);
        ledger.artificial += sum_of_lanes(self.artificial);
        ledger.wall_control += sum_of_lanes(self.wall_control);
        ledger.contact += sum_of_lanes(self.contact);
    }
}

/// The lanes added in their order.
#[inline(always)]
pub(crate) fn sum_of_lanes<V: Lanes>(lanes: V) -> f64 {
    lanes.to_array().iter().sum()
}

/// Cause of a push after the velocity step of a particle, and so the entry in which its loss is booked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PushCause {
    /// A contact with a wall of segments.
    Contact,
    /// The friction of side walls.
    SideWalls,
}

/// Contribution of a push that follows the velocity step of a particle to the ledger.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PushStep<'a, const D: usize> {
    pub(crate) mass: f64,
    pub(crate) time_step: f64,
    pub(crate) gravity: &'a Vector<D>,
    /// Velocity without the push.
    pub(crate) velocity: Vector<D>,
    pub(crate) push: Vector<D>,
    /// Work of the walls that pushed, at their velocities `[J]`.
    pub(crate) given: f64,
    /// Of the step, and what of it came from walls' tractions, artificial terms, and hourglass control at walls `[m/s²]`.
    pub(crate) acceleration: &'a Vector<D>,
    pub(crate) by_walls: &'a Vector<D>,
    pub(crate) by_damping: &'a Vector<D>,
    pub(crate) by_wall_control: &'a Vector<D>,
}

impl<const D: usize> PushStep<'_, D> {
    /// Adds the push to a sum that has the step without it: every force has worked at a mean velocity that is half the push
    /// more.
    #[inline(always)]
    pub(crate) fn add_to(&self, sum: &mut EnergyLedger, cause: PushCause) {
        let momentum = self.mass * self.time_step * self.push;
        sum.gravity += momentum.dot(self.gravity);
        sum.walls += 0.5 * momentum.dot(self.by_walls) + self.given;
        sum.artificial -= 0.5 * momentum.dot(self.by_damping);
        sum.wall_control -= 0.5 * momentum.dot(self.by_wall_control);
        // earlier contacts in this step are in both of these means, once with each sign
        let mean = self.velocity + 0.5 * (self.push - self.time_step * self.acceleration);
        let lost = self.given - self.mass * mean.dot(&self.push);
        match cause {
            PushCause::Contact => sum.contact += lost,
            PushCause::SideWalls => sum.side_walls += lost,
        }
    }
}

/// Contribution of the deformation of eight particles to the ledger.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DeformationStep<'a, V, const D: usize> {
    /// Volumes before the step, zero where there is no particle.
    pub(crate) volume: V,
    pub(crate) time_step: f64,
    /// Elastic shear modulus of a law that carries its stress along `[Pa]`.
    pub(crate) shear_modulus: Option<f64>,
    /// Stress beside the law's that acted, of elastic damping and eddies `[Pa]`.
    pub(crate) added_stress: &'a [[V; D]; D],
    /// Pressures before and after the step `[Pa]`.
    pub(crate) pressure: (V, V),
    /// ∇·v of the flow among itself as continuity takes it `[1/s]`.
    pub(crate) divergence: V,
    /// Share by which the volume grows in the step `[-]`.
    pub(crate) growth: V,
    /// Velocity gradient of the flow among itself before any correction `[1/s]`, and the correction E of the forces `[-]`.
    pub(crate) raw_gradient: &'a [[V; D]; D],
    /// Velocity gradient L with that of walls before any correction `[1/s]`.
    pub(crate) gradient: &'a [[V; D]; D],
    pub(crate) force_correction: &'a [[V; D]; D],
    /// ε′ after the step, and the part of it that walls cause `[1/s]`.
    pub(crate) rate: &'a [[V; D]; D],
    pub(crate) rate_by_walls: &'a [[V; D]; D],
    /// ε′ before the step, at which the added stress is taken `[1/s]`.
    pub(crate) rate_before: &'a [[V; D]; D],
    /// s before and after the step `[Pa]`.
    pub(crate) stress_before: &'a [[V; D]; D],
    pub(crate) stress: &'a [[V; D]; D],
}

impl<V: Lanes, const D: usize> DeformationStep<'_, V, D> {
    /// Adds the step to a sum.
    #[inline(always)]
    pub(crate) fn add_to(&self, sum: &mut StressWork<V>) {
        let (volume, time_step) = (self.volume, V::splat(self.time_step));
        let work = volume * time_step;
        let half = V::splat(0.5);
        let mean_rate = scaled_sum(half, self.rate_before, self.rate);
        sum.viscous = sum.viscous + work * contraction(self.added_stress, &mean_rate);
        let law = scaled_sum(half, self.stress_before, self.stress);
        let mut acting = law;
        for i in 0..D {
            accumulate(&mut acting[i], V::splat(1.0), &self.added_stress[i]);
        }
        let pressure = half * (self.pressure.0 + self.pressure.1);
        let mut whole = acting;
        for i in 0..D {
            whole[i][i] = whole[i][i] - pressure;
        }
        let by_walls = contraction(&acting, self.rate_by_walls);
        let taken = contraction(&acting, self.rate) - by_walls - pressure * self.divergence;
        let given = contraction(&matrix_product(&whole, self.force_correction), self.raw_gradient);
        sum.correction = sum.correction + work * (taken - given);
        let flow = matrix_product(self.raw_gradient, self.force_correction);
        // the added stress acts once, at the start
        let turned = matrix_product(&flow, self.gradient);
        let turned = time_step * (contraction(&law, &turned) + pressure * compression(&turned));
        let pressed = pressure * (compression(&flow) + self.divergence + self.divergence);
        sum.ways = sum.ways + half * work * (turned - self.growth * (contraction(&law, &flow) + pressed));
        sum.walls = sum.walls + work * by_walls;
        match self.shear_modulus {
            None => sum.viscous = sum.viscous + work * contraction(&law, self.rate),
            Some(shear_modulus) => {
                // what the acting stress has done and elastic shear has not kept; what a trial has beyond the yield is no
                // work, since no force ever had it
                let compliance = V::splat(0.25 / shear_modulus);
                let kept = (V::splat(1.0) + self.growth) * contraction(self.stress, self.stress);
                let lost = contraction(self.stress_before, self.stress_before) - kept;
                sum.plastic = sum.plastic + volume * compliance * lost + work * contraction(&law, self.rate);
            }
        }
    }
}

/// c (a + b).
#[inline(always)]
fn scaled_sum<V: Lanes, const D: usize>(factor: V, a: &[[V; D]; D], b: &[[V; D]; D]) -> [[V; D]; D] {
    let mut sum = zero_tensor::<V, D>();
    for i in 0..D {
        accumulate(&mut sum[i], factor, &a[i]);
        accumulate(&mut sum[i], factor, &b[i]);
    }
    sum
}

/// Contribution of the compression of eight particles to the ledger.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CompressionStep<V> {
    /// Masses, zero where there is no particle.
    pub(crate) mass: V,
    /// Densities `[kg/m³]` before and after the step.
    pub(crate) density: (V, V),
    /// Pressures `[Pa]` before and after it.
    pub(crate) pressure: (V, V),
    /// Changes of the density by walls and by the coupling `[kg/m³]`.
    pub(crate) by_walls: V,
    pub(crate) by_coupling: V,
    /// Density without pressure `[kg/m³]`, below which tension is cut; zero where it is kept.
    pub(crate) free: V,
}

impl<V: Lanes> CompressionStep<V> {
    /// Adds the step to a sum.
    #[inline(always)]
    pub(crate) fn add_to(&self, sum: &mut StressWork<V>) {
        let square = (self.density.0 * self.density.1).max(V::splat(f64::MIN_POSITIVE));
        let factor = self.mass / square;
        let mean = V::splat(0.5) * (self.pressure.0 + self.pressure.1);
        sum.walls = sum.walls + factor * mean * self.by_walls;
        sum.density_coupling = sum.density_coupling - factor * mean * self.by_coupling;
        let (before, after) = self.density;
        let pressed = after.max(self.free) - before.max(self.free);
        sum.cut = sum.cut + factor * mean * (pressed - (after - before));
    }
}

/// Effect of dilation on the compression of eight particles in the ledger.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DilationStep<V> {
    /// Volumes, zero where there is no particle.
    pub(crate) volume: V,
    /// Bulk modulus `[Pa]`.
    pub(crate) bulk_modulus: f64,
    /// Pressures `[Pa]` of the new density before and after the dilation.
    pub(crate) pressure: (V, V),
    /// Plastic volume strain that the step adds `[-]`.
    pub(crate) strain: V,
}

impl<V: Lanes> DilationStep<V> {
    /// Takes from the plastic work what dilation against the pressure has stored in compression. At a given density the energy of it,
    /// m exp(e) ψ(ρ exp(e)), grows with e by V K (1 + s) ln(1 + s), s = p/K: p with a part p/2K more.
    #[inline(always)]
    pub(crate) fn add_to(&self, sum: &mut StressWork<V>) {
        let stored = |pressure: V| {
            let relative = pressure / V::splat(self.bulk_modulus);
            (V::splat(1.0) + relative) * V::lane_by_lane([relative], &|[strain]| libm::log1p(strain))
        };
        let mean = V::splat(0.5 * self.bulk_modulus) * (stored(self.pressure.0) + stored(self.pressure.1));
        let work = self.volume * mean * self.strain;
        // where nothing dilates also of a particle whose state is lost
        let zero = V::splat(0.0);
        sum.plastic = sum.plastic - work.if_less(zero, self.strain, zero) - work.if_less(self.strain, zero, zero);
    }
}

/// Entries of the ledger that the stress makes, lane by lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StressWork<V> {
    walls: V,
    viscous: V,
    plastic: V,
    density_coupling: V,
    correction: V,
    cut: V,
    ways: V,
}

impl<V: Lanes> StressWork<V> {
    /// Nothing yet.
    #[inline(always)]
    pub(crate) fn new() -> Self {
        let zero = V::splat(0.0);
        Self {
            walls: zero,
            viscous: zero,
            plastic: zero,
            density_coupling: zero,
            correction: zero,
            cut: zero,
            ways: zero,
        }
    }

    /// Adds the lanes, in their order, to a block's ledger.
    #[inline(always)]
    pub(crate) fn add_to(self, ledger: &mut EnergyLedger) {
        ledger.walls += sum_of_lanes(self.walls);
        ledger.viscous += sum_of_lanes(self.viscous);
        ledger.plastic += sum_of_lanes(self.plastic);
        ledger.density_coupling += sum_of_lanes(self.density_coupling);
        ledger.correction += sum_of_lanes(self.correction);
        ledger.cut += sum_of_lanes(self.cut);
        ledger.ways += sum_of_lanes(self.ways);
    }

    /// Books as plastic what the mean of the pressures has worked on a growing volume and neither pressure of a mixture has stored: by
    /// dilation and by the way of the liquid through the pores.
    #[inline(always)]
    pub(crate) fn add_pore_flow(&mut self, mass: V, densities: (V, V), pressures: (V, V), stored: (V, V)) {
        let least = V::splat(f64::MIN_POSITIVE);
        let volume = (mass / densities.0.max(least), mass / densities.1.max(least));
        let worked = V::splat(0.5) * (pressures.0 + pressures.1) * (volume.0 - volume.1);
        self.plastic = self.plastic + worked - (volume.1 * stored.1 - volume.0 * stored.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{InstructionSet, LANES, LanePass};

    /// Steps of compression from a density below ρ0 to one above, and the share of the energy that they miss.
    struct Chain<'a>(u32, Tension, &'a mut f64);

    impl LanePass for Chain<'_> {
        fn run<V: Lanes>(self) {
            let Self(steps, tension, missed) = self;
            let law = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension };
            let (mut sum, mut worked) = (StressWork::<V>::new(), 0.0);
            let density = |step: u32| 995.0 + 15.0 * f64::from(step) / f64::from(steps);
            for step in 0..steps {
                let (before, after) = (density(step), density(step + 1));
                let pressure = (law.pressure(before), law.pressure(after));
                worked += 0.5 * (pressure.0 + pressure.1) * (after - before) / (before * after);
                CompressionStep {
                    mass: V::splat(1.0),
                    density: (V::splat(before), V::splat(after)),
                    pressure: (V::splat(pressure.0), V::splat(pressure.1)),
                    by_walls: V::splat(0.0),
                    by_coupling: V::splat(0.0),
                    free: V::splat(if tension == Tension::Cut { law.reference_density } else { 0.0 }),
                }
                .add_to(&mut sum);
            }
            let stored = compression_energy(&law, 1010.0) - compression_energy(&law, 995.0);
            let cut = sum_of_lanes(sum.cut) / LANES as f64;
            assert!(tension == Tension::Cut || cut == 0.0, "nothing is cut");
            *missed = (stored - worked - cut) / stored;
        }
    }

    #[test]
    fn compression_across_the_cut_is_booked_to_second_order() {
        for steps in [2, 4, 7, 10, 40] {
            for tension in [Tension::Cut, Tension::Kept] {
                let mut missed = f64::NAN;
                InstructionSet::best().run(Chain(steps, tension, &mut missed));
                // without the entry 3 % at four steps
                assert!(missed.abs() < 0.02 / f64::from(steps * steps), "{steps} steps, {tension:?}: {missed}");
            }
        }
    }
}
