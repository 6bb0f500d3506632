//! The pressure of sheared grains, p = ρ_s (d γ̇ B φ/(φ_max − φ))², which makes them dilate: where it carries the weight
//! of the grains above, φ = φ_max/(1 + B I).
//!
//! φ is the sum of the grains' volumes over the kernel, fixed grains included. γ̇ is the norm of the
//! averaged velocity gradient. Densely packed grains are elastic instead, p = p′ + K (φ − φ_max) if that is more. Pair
//! forces are equal and opposite: F_ab = −v_a v_b (p_a/φ_a² + p_b/φ_b²) ∇W with the volumes v of the grains in a particle.

use super::averaged_gradient::AveragedGradient;
use super::pairs::{LEAST_TASK, Pair};
use super::phase::{Phase, height_axis};
use super::stratification::Stratification;
use crate::vector::Vector;
use rayon::prelude::*;

/// Stiffness of packed grains dp/dφ `[Pa]`. At rest they carry the load at φ_max, and none once they are looser by
/// load/stiffness, some thousandths.
const STIFFNESS: f64 = 1e4;

/// Spacings over which a particle is spread to either side in the mean solid fraction `[-]`: rows of grains that dilate
/// lie two apart, and their drag is that of the mean fraction, not of a row's.
const SPREAD: f64 = 2.0;

/// Least φ_max − φ `[-]`.
const LEAST_ROOM: f64 = 0.02;

/// Least φ of a particle that is alone `[-]`.
const LEAST_FRACTION: f64 = 1e-3;

/// B and φ_max.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dilatancy {
    pub(super) dilation: f64,
    pub(super) packing: f64,
    pub(super) grain_diameter: f64,
    /// Volume of grains in a fixed particle over its lattice volume `[-]`.
    pub(super) fixed_filling: f64,
}

impl Dilatancy {
    /// Pressure of grains `[Pa]` from their density `[kg/m³]`, shear rate `[1/s]`, solid fraction `[-]` and the load on
    /// them `[Pa]`.
    fn pressure(&self, density: f64, rate: f64, fraction: f64, load: f64) -> f64 {
        let room = (self.packing - fraction).max(LEAST_ROOM);
        let root = self.grain_diameter * rate * self.dilation * fraction / room;
        // twice the load is enough to open a bed, and bounds what a single fast particle does
        let sheared = (density * root * root).min(2.0 * load + 20.0);
        let elastic = load + STIFFNESS * (fraction - self.packing);
        sheared.max(elastic)
    }
}

/// Fields of the free sediment particles.
#[derive(Debug, Default)]
pub(super) struct GranularPressure {
    /// φ `[-]`.
    pub(super) solid_fraction: Vec<f64>,
    /// p/φ² `[Pa]`.
    scaled_pressure: Vec<f64>,
}

impl GranularPressure {
    /// φ of every particle, and the volume that it then stands for.
    pub(super) fn find_solid_fraction<const D: usize>(&mut self, sediment: &mut Phase<D>, dilatancy: &Dilatancy) {
        let Phase { free_pairs, wall_pairs, kernel, mass, density, lattice_volume, volume, .. } = sediment;
        let (own, density) = (kernel.value(0.0), *density);
        let fixed = *lattice_volume * dilatancy.fixed_filling;
        self.solid_fraction.resize(mass.len(), 0.0);
        (&mut self.solid_fraction, volume).into_par_iter().enumerate().with_min_len(LEAST_TASK).for_each(
            |(a, (fraction, volume))| {
                let free = |sum, pair: &Pair<D>| sum + pair.value * mass[pair.source as usize] / density;
                let grains = free_pairs.of(a).iter().fold(own * mass[a] / density, free);
                let walls = wall_pairs.of(a).iter().fold(0.0, |sum, pair| sum + pair.value * fixed);
                *fraction = (grains + walls).max(LEAST_FRACTION);
                *volume = mass[a] / (density * *fraction);
            },
        );
    }

    /// Pressures of every particle `[Pa]`.
    pub(super) fn find_pressures<const D: usize>(
        &mut self,
        sediment: &mut Phase<D>,
        rates: &AveragedGradient<D>,
        dilatancy: &Dilatancy,
        layer: &Stratification,
    ) {
        self.scaled_pressure.resize(sediment.len(), 0.0);
        let normal = height_axis(D);
        for a in 0..sediment.len() {
            let fraction = self.solid_fraction[a];
            let load = layer.at(sediment.position[a][normal]).overburden;
            sediment.pressure[a] = dilatancy.pressure(sediment.density, rates.shear_rate(a), fraction, load);
            self.scaled_pressure[a] = sediment.pressure[a] / (fraction * fraction);
        }
    }

    /// Force of the granular pressure on a particle `[N]`, per metre of width in 2-D. A fixed grain has the pressure of
    /// its partner.
    pub(super) fn force<const D: usize>(&self, sediment: &Phase<D>, a: usize, dilatancy: &Dilatancy) -> Vector<D> {
        let own = self.scaled_pressure[a];
        let grains = |b: usize| sediment.mass[b] / sediment.density;
        let mut force = Vector::zeros();
        for pair in sediment.free_pairs.of(a) {
            let b = pair.source as usize;
            force -= pair.separation * (grains(b) * (own + self.scaled_pressure[b]) * pair.gradient);
        }
        let fixed = sediment.lattice_volume * dilatancy.fixed_filling;
        for pair in sediment.wall_pairs.of(a) {
            force -= pair.separation * (fixed * 2.0 * own * pair.gradient);
        }
        force * grains(a)
    }

    /// Puts the mean solid fraction along the bed, fixed grains included, into the stratification.
    pub(super) fn average<const D: usize>(
        sediment: &Phase<D>,
        dilatancy: &Dilatancy,
        area: f64,
        layer: &mut Stratification,
    ) {
        let intervals = layer.solid_fraction.len();
        let mut sums = std::mem::take(&mut layer.solid_fraction);
        sums.fill(0.0);
        let normal = height_axis(D);
        // a particle is spread to either side, as a triangle
        let reach = SPREAD * sediment.spacing;
        let scale = 1.0 / (area * layer.interval);
        let fixed = sediment.lattice_volume * dilatancy.fixed_filling;
        let free = sediment.position.iter().zip(&sediment.mass).map(|(x, mass)| (x, mass / sediment.density));
        for (position, volume) in free.chain(sediment.wall.iter().map(|x| (x, fixed))) {
            let grains = volume * scale;
            let height = position[normal] - layer.base;
            let first = (((height - reach) / layer.interval).floor().max(0.0) as usize).min(intervals);
            let last = (((height + reach) / layer.interval).ceil().max(0.0) as usize).min(intervals);
            for (place, sum) in sums.iter_mut().enumerate().take(last).skip(first) {
                let lower = place as f64 * layer.interval - height;
                *sum += grains * (ramp((lower + layer.interval) / reach) - ramp(lower / reach));
            }
        }
        layer.solid_fraction = sums;
        layer.integrate();
    }
}

/// Integral of the triangle 1 − |x| from −∞ to x `[-]`.
fn ramp(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.5 + x - 0.5 * x * x.abs()
}

#[cfg(test)]
mod tests {
    use super::{Dilatancy, GranularPressure, ramp};
    use crate::incompressible::phase::Phase;
    use crate::incompressible::scene::ParticleSet;
    use crate::incompressible::stratification::Stratification;
    use crate::vector::Vector;

    const SAND: Dilatancy = Dilatancy { dilation: 0.31, packing: 0.6, grain_diameter: 5e-3, fixed_filling: 0.6 };

    /// The 1-D layer's closure, φ = φ_max/(1 + B I) with I = γ̇ d √(ρ_s/p′), is where the pressure carries the load.
    #[test]
    fn sheared_grains_carry_their_load_at_the_fraction_of_their_inertia() {
        for (rate, load) in [(5.0, 10.0), (50.0, 10.0), (50.0, 100.0), (200.0, 30.0)] {
            let inertia = rate * 5e-3 * (2600.0_f64 / load).sqrt();
            let fraction = 0.6 / (1.0 + 0.31 * inertia);
            let pressure = SAND.pressure(2600.0, rate, fraction, load);
            assert!((pressure / load - 1.0).abs() < 1e-12, "{rate} 1/s, {load} Pa: {pressure} Pa");
            assert!(SAND.pressure(2600.0, rate, fraction + 0.01, load) > load);
            assert!(SAND.pressure(2600.0, rate, fraction - 0.01, load) < load);
        }
    }

    #[test]
    fn grains_at_rest_carry_their_load_at_the_densest_packing() {
        for load in [1.0, 100.0] {
            assert_eq!(SAND.pressure(2600.0, 0.0, 0.6, load), load);
            assert_eq!(SAND.pressure(2600.0, 0.0, 0.58, load), 0.0);
            assert!(SAND.pressure(2600.0, 0.0, 0.601, load) > load);
        }
    }

    #[test]
    fn the_triangle_has_the_area_one() {
        assert_eq!((ramp(-2.0), ramp(0.0), ramp(2.0)), (0.0, 0.5, 1.0));
        assert!((ramp(0.5) - 0.875).abs() < 1e-15);
    }

    /// Rows of a resting bed, the lower ones held, fill it evenly at φ_max: no eddy has room within.
    #[test]
    fn a_resting_bed_leaves_no_room_at_its_held_grains() {
        let row = |k: i32| (0..10).map(move |i| Vector::<2>::new(f64::from(i) + 0.5, f64::from(k) + 0.5) * 1e-3);
        let free: Vec<_> = (-6..0).flat_map(row).collect();
        let held: Vec<_> = (-13..-6).flat_map(row).collect();
        let count = free.len();
        let particles = ParticleSet { position: free, velocity: vec![Vector::zeros(); count] };
        let sediment = Phase::new(&particles, &held, 1e-3, 2600.0, 1.5).filled(&vec![0.6; count]);
        let mut layer = Stratification::new(-0.01, 2.5e-4, vec![0.0; 80], 0.6, 15_696.0, 0.0, 0.046);
        GranularPressure::average(&sediment, &SAND, 0.01, &mut layer);
        for (place, fraction) in layer.solid_fraction.iter().enumerate().take(32) {
            assert!((fraction - 0.6).abs() < 1e-12, "interval {place}: {fraction}");
        }
        assert!(layer.at(-0.003).mixing_length < 1e-12);
        let volume: f64 = layer.solid_fraction.iter().sum::<f64>() * 2.5e-4;
        assert!((volume - 0.6 * 0.01).abs() < 1e-12, "{volume} m of grains in a bed of 10 mm");
    }
}
