//! The pressure of sheared grains, which makes them dilate: where it carries the weight of the grains above,
//! φ = φ_max/(1 + B I) ([`Dilatancy`]).
//!
//! φ is the sum of the grains' volumes over the kernel, fixed grains included. γ̇ is the norm of the averaged velocity
//! gradient, and the load that of the stratification.

use super::super::neighbours::{LEAST_TASK, Pair};
use super::super::phase::Phase;
use super::super::scene::{Sediment, SedimentPressure, height_axis};
use super::super::stratification::Stratification;
use super::super::terms;
use super::averaged_gradient::AveragedGradient;
use crate::material::dilatancy::Dilatancy;
use crate::vector::Vector;
use rayon::prelude::*;

/// The law of grains that dilate, and how full fixed ones are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dilating {
    pub(crate) law: Dilatancy,
    /// Volume of grains in a fixed particle over its lattice volume `[-]`.
    pub(crate) fixed_filling: f64,
}

impl Dilating {
    /// That of a sediment, if its grains dilate.
    pub(crate) fn of<const D: usize>(sediment: &Sediment<D>) -> Option<Self> {
        match sediment.pressure {
            SedimentPressure::Dilatant { dilatancy, fixed_filling } => Some(Self { law: dilatancy, fixed_filling }),
            SedimentPressure::Incompressible | SedimentPressure::None | SedimentPressure::AlongBed => None,
        }
    }
}

/// Fields of the free sediment particles.
#[derive(Debug, Default)]
pub(crate) struct GranularPressure {
    /// φ `[-]`.
    pub(crate) solid_fraction: Vec<f64>,
    /// p/φ² `[Pa]`.
    scaled_pressure: Vec<f64>,
}

impl GranularPressure {
    /// φ of every particle, not below a least one `[-]`, and the volume that it then stands for.
    pub(crate) fn find_solid_fraction<const D: usize>(
        &mut self,
        sediment: &mut Phase<D>,
        fixed_filling: f64,
        least_fraction: f64,
    ) {
        let Phase { free_pairs, wall_pairs, kernel, mass, density, lattice_volume, volume, .. } = sediment;
        let (own, density) = (kernel.value(0.0), *density);
        let fixed = *lattice_volume * fixed_filling;
        self.solid_fraction.resize(mass.len(), 0.0);
        (&mut self.solid_fraction, volume).into_par_iter().enumerate().with_min_len(LEAST_TASK).for_each(
            |(a, (fraction, volume))| {
                let free = |sum, pair: &Pair<D>| sum + pair.value * mass[pair.source as usize] / density;
                let grains = free_pairs.of(a).iter().fold(own * mass[a] / density, free);
                let walls = wall_pairs.of(a).iter().fold(0.0, |sum, pair| sum + pair.value * fixed);
                *fraction = (grains + walls).max(least_fraction);
                *volume = mass[a] / (density * *fraction);
            },
        );
    }

    /// Pressures of every particle `[Pa]`.
    pub(crate) fn find_pressures<const D: usize>(
        &mut self,
        sediment: &mut Phase<D>,
        rates: &AveragedGradient<D>,
        law: &Dilatancy,
        layer: &Stratification,
    ) {
        self.scaled_pressure.resize(sediment.len(), 0.0);
        let normal = height_axis(D);
        for a in 0..sediment.len() {
            let fraction = self.solid_fraction[a];
            let load = layer.at(sediment.position[a][normal]).overburden;
            sediment.pressure[a] = law.pressure(rates.shear_rate(a), fraction, load);
            self.scaled_pressure[a] = sediment.pressure[a] / (fraction * fraction);
        }
    }

    /// Force of the granular pressure on a particle `[N]`, per metre of width in 2-D. A fixed grain has the pressure of
    /// its partner.
    pub(crate) fn force<const D: usize>(&self, sediment: &Phase<D>, a: usize, fixed_filling: f64) -> Vector<D> {
        let own = self.scaled_pressure[a];
        let grains = |b: usize| sediment.mass[b] / sediment.density;
        let mut force = Vector::zeros();
        for pair in sediment.free_pairs.of(a) {
            let b = pair.source as usize;
            let pressures = own + self.scaled_pressure[b];
            force -= terms::granular_pressure::pull(pair.separation, pair.gradient, grains(b), pressures);
        }
        let fixed = sediment.lattice_volume * fixed_filling;
        for pair in sediment.wall_pairs.of(a) {
            force -= terms::granular_pressure::pull(pair.separation, pair.gradient, fixed, 2.0 * own);
        }
        force * grains(a)
    }
}

/// Puts the mean solid fraction along a bed of an area, `[m]` in 2-D, fixed grains included, into the stratification. Every
/// particle is spread to either side by some spacings `[-]`, as a triangle.
pub(crate) fn average_fraction<const D: usize>(
    sediment: &Phase<D>,
    fixed_filling: f64,
    spread: f64,
    area: f64,
    layer: &mut Stratification,
) {
    let normal = height_axis(D);
    let reach = spread * sediment.spacing;
    let fixed = sediment.lattice_volume * fixed_filling;
    let free = sediment.position.iter().zip(&sediment.mass).map(|(x, mass)| (x, mass / sediment.density));
    layer.renew(|strata| {
        let intervals = strata.solid_fraction.len();
        let scale = 1.0 / (area * strata.interval);
        strata.solid_fraction.fill(0.0);
        for (position, volume) in free.chain(sediment.wall.iter().map(|x| (x, fixed))) {
            let grains = volume * scale;
            let height = position[normal] - strata.base;
            let first = (((height - reach) / strata.interval).floor().max(0.0) as usize).min(intervals);
            let last = (((height + reach) / strata.interval).ceil().max(0.0) as usize).min(intervals);
            for (place, sum) in strata.solid_fraction.iter_mut().enumerate().take(last).skip(first) {
                let lower = place as f64 * strata.interval - height;
                *sum += grains * (ramp((lower + strata.interval) / reach) - ramp(lower / reach));
            }
        }
    });
}

/// Integral of the triangle 1 − |x| from −∞ to x `[-]`.
fn ramp(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.5 + x - 0.5 * x * x.abs()
}

#[cfg(test)]
mod tests {
    use super::{average_fraction, ramp};
    use crate::incompressible::phase::Phase;
    use crate::incompressible::scene::ParticleSet;
    use crate::incompressible::stratification::{Strata, Stratification};
    use crate::material::suspension_viscosity::SuspensionViscosity;
    use crate::vector::Vector;

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
        let mut layer = Stratification::of(Strata {
            base: -0.01,
            interval: 2.5e-4,
            solid_fraction: vec![0.0; 80],
            packing: 0.6,
            buoyant_weight: 15_696.0,
            bed_level: 0.0,
            depth: 0.046,
            suspension_viscosity: SuspensionViscosity::default(),
        });
        average_fraction(&sediment, 0.6, 2.0, 0.01, &mut layer);
        for (place, fraction) in layer.strata().solid_fraction.iter().enumerate().take(32) {
            assert!((fraction - 0.6).abs() < 1e-12, "interval {place}: {fraction}");
        }
        assert!(layer.at(-0.003).mixing_length < 1e-12);
        let volume: f64 = layer.strata().solid_fraction.iter().sum::<f64>() * 2.5e-4;
        assert!((volume - 0.6 * 0.01).abs() < 1e-12, "{volume} m of grains in a bed of 10 mm");
    }
}
