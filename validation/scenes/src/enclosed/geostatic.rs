//! Stress at the start: the weight of the material above, and a share K_0 of it across gravity.
//!
//! With the vertical stress σ (pressure positive, vertical along gravity) and the horizontal one K_0 σ in D dimensions
//!
//! p = σ (1 + (D − 1) K_0)/D, s = σ (1 − K_0) (I/D − n nᵀ), τ = √(½ s:s) = σ |1 − K_0| q/D, q = √(D (D − 1)/2),
//!
//! with n along gravity. The law's pressure in the plane is the mean of the stresses in the plane, so that D = 2 there. The material yields
//! at τ = μ p + k, which bounds K_0 by Rankine's (1857) active and passive ratios,
//!
//! K_a = (q − μ − m)/(q + (D − 1) μ), K_p = (q + μ + m)/(q − (D − 1) μ), m = D k/σ;
//!
//! in the plane, with μ = sin φ and k = 0, they are (1 − sin φ)/(1 + sin φ) and its inverse.

use bagnold_solver::vector::{Tensor, Vector};

/// Stress of a body with a level surface that has come to rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct GeostaticStress<const D: usize> {
    /// K_0, the ratio of the horizontal to the vertical stress `[-]`.
    pub(super) lateral_ratio: f64,
    /// Unit vector against gravity, or against its part across periodic sides `[-]`.
    pub(super) up: Vector<D>,
    /// Gravity along periodic sides over that across them `[-]`; zero of a body that starts without shear stress.
    pub(super) slope: Vector<D>,
}

impl<const D: usize> GeostaticStress<D> {
    /// Pressure `[Pa]` under a vertical stress `[Pa]`.
    pub(super) fn pressure(&self, vertical: f64) -> f64 {
        vertical * ((1.0 + (D as f64 - 1.0) * self.lateral_ratio) / D as f64)
    }

    /// Deviatoric stress `[Pa]` under a vertical stress `[Pa]`; tension is positive.
    pub(super) fn deviator(&self, vertical: f64) -> Tensor<D> {
        (Tensor::identity() / D as f64 - self.up * self.up.transpose()) * (vertical * (1.0 - self.lateral_ratio))
    }

    /// Shear stress `[Pa]` under a vertical stress `[Pa]` that holds a layer on its slope, as far as the strength `[Pa]` of its material.
    pub(super) fn shear(&self, vertical: f64, strength: f64) -> Tensor<D> {
        let shear = self.slope * vertical.min(strength / self.slope.norm().max(f64::MIN_POSITIVE));
        self.up * shear.transpose() + shear * self.up.transpose()
    }
}

/// Active and passive ratio `[-]` of a material with a friction coefficient μ `[-]` and a cohesion k over the vertical stress `[-]`, in D
/// dimensions; where no ratio is too large the passive one is infinite.
pub(super) fn rankine_ratios<const D: usize>(friction: f64, cohesion: f64) -> (f64, f64) {
    let dimensions = D as f64;
    let shear = (0.5 * dimensions * (dimensions - 1.0)).sqrt();
    let (strength, lateral) = (friction + dimensions * cohesion, (dimensions - 1.0) * friction);
    let passive = if lateral < shear { (shear + strength) / (shear - lateral) } else { f64::INFINITY };
    (((shear - strength) / (shear + lateral)).max(0.0), passive)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::{DomainSide, quick};
    use crate::scene::{FlowSide, PlaneBody, PlaneFlow, PlaneSides, WallLine};
    use bagnold_solver::vector::equivalent_shear_stress;
    use bagnold_solver::weakly_compressible::simulation::Simulation;
    use bagnold_solver::weakly_compressible::walls::Surface;

    /// Stresses along and across gravity `[Pa]`, pressure positive, and shear stress over pressure `[-]`.
    fn start<const D: usize>(lateral_ratio: f64, up: Vector<D>, across: Vector<D>) -> ([f64; 2], f64) {
        let geostatic = GeostaticStress::<D> { lateral_ratio, up, slope: Vector::zeros() };
        let (pressure, deviator) = (geostatic.pressure(800.0), geostatic.deviator(800.0));
        assert!(deviator.trace().abs() < 1e-12);
        let along = |n: Vector<D>| pressure - (deviator * n).dot(&n);
        ([along(up), along(across)], equivalent_shear_stress(&deviator) / pressure)
    }

    #[test]
    fn the_vertical_stress_is_the_weight_and_the_horizontal_one_its_share_along_any_gravity() {
        for ratio in [0.5, 1.0, 1.7] {
            let plane = start::<2>(ratio, Vector::<2>::new(0.6, 0.8), Vector::<2>::new(-0.8, 0.6));
            let (up, across) = (Vector::<3>::new(2.0, 1.0, 2.0) / 3.0, Vector::<3>::new(1.0, 2.0, -2.0) / 3.0);
            for ([vertical, horizontal], _) in [plane, start::<3>(ratio, up, across)] {
                assert!((vertical - 800.0).abs() < 1e-10 && (horizontal - 800.0 * ratio).abs() < 1e-10, "{ratio}");
            }
        }
    }

    #[test]
    fn a_layer_on_a_slope_is_held_up_to_its_strength() {
        let (up, downhill) = (Vector::<2>::new(-0.6, 0.8), Vector::<2>::new(0.8, 0.6));
        let layer = GeostaticStress::<2> { lateral_ratio: 1.0, up, slope: downhill * 0.5 };
        // on a plane across the layer, the material above is pushed downhill by its weight and the plane holds it
        for (strength, held) in [(900.0, 400.0), (300.0, 300.0), (0.0, 0.0)] {
            let stress = layer.shear(800.0, strength);
            assert!((stress * up - downhill * held).norm() < 1e-12, "{strength}: {stress}");
            assert!((equivalent_shear_stress(&stress) - held).abs() < 1e-12 && stress.trace().abs() < 1e-12);
        }
        let level = GeostaticStress::<2> { slope: Vector::zeros(), ..layer };
        assert_eq!(level.shear(800.0, 900.0), Tensor::<2>::zeros());
    }

    #[test]
    fn the_material_yields_at_rankines_ratios() {
        let (active, passive) = rankine_ratios::<2>(0.5, 0.0);
        assert!((active - 1.0 / 3.0).abs() < 1e-15 && (passive - 3.0).abs() < 1e-14, "30°: {active}, {passive}");
        let clay = rankine_ratios::<2>(0.0, 0.1);
        assert!((clay.0 - 0.8).abs() < 1e-15 && (clay.1 - 1.2).abs() < 1e-15, "σ ∓ 2 c: {clay:?}");
        for friction in [0.1, 0.382, 0.6] {
            let (plane, space) = (rankine_ratios::<2>(friction, 0.0), rankine_ratios::<3>(friction, 0.0));
            for (ratio, in_space) in [(plane.0, space.0), (plane.1, space.1)] {
                let stress = start::<2>(ratio, Vector::<2>::y(), Vector::<2>::x()).1;
                let stress_in_space = start::<3>(in_space, Vector::<3>::z(), Vector::<3>::x()).1;
                assert!((stress - friction).abs() < 1e-14 && (stress_in_space - friction).abs() < 1e-14, "{friction}");
            }
        }
        assert_eq!(rankine_ratios::<3>(0.9, 0.0).1, f64::INFINITY);
    }

    /// A box of beads between smooth walls.
    fn boxed(lateral_pressure_ratio: Option<f64>) -> PlaneFlow {
        let wall = |name: &str, points: &[(f64, f64)]| WallLine {
            name: name.to_owned(),
            points: points.to_vec(),
            closed: false,
            flow: FlowSide::Left,
            surface: Surface::Smooth,
            both_sides: false,
            motion: Vec::new(),
            load: None,
            turn: None,
        };
        let tier: PlaneFlow = quick();
        let none = DomainSide::None;
        PlaneFlow {
            sides: PlaneSides { left: none, right: none, bottom: none, top: none },
            bodies: vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (0.2, 0.1), velocity: (0.0, 0.0) }],
            walls: vec![
                wall("left", &[(0.0, 0.15), (0.0, 0.0)]),
                wall("floor", &[(0.0, 0.0), (0.2, 0.0)]),
                wall("right", &[(0.2, 0.0), (0.2, 0.15)]),
            ],
            gauges: Vec::new(),
            lateral_pressure_ratio: lateral_pressure_ratio.unwrap_or(tier.lateral_pressure_ratio),
            ..tier
        }
    }

    /// Ratio of the horizontal to the vertical stress in the middle of the box, the vertical stress over the weight above, and the root mean
    /// square of the speed over √(g H), after 0.2 s `[-]`.
    fn after_a_while(lateral_pressure_ratio: Option<f64>) -> [f64; 3] {
        let (scene, _) = boxed(lateral_pressure_ratio).scene().expect("a scene");
        let density = scene.equation_of_state.reference_density;
        let mut simulation = Simulation::new(scene).expect("sound");
        while simulation.time() < 0.2 {
            simulation.step().expect("no divergence");
        }
        let particles = simulation.particles();
        let (mut horizontal, mut vertical, mut weight, mut square) = (0.0, 0.0, 0.0, 0.0);
        for i in 0..particles.flow_count() {
            let place = particles.position[i];
            square += particles.velocity[i].norm_squared() / particles.flow_count() as f64;
            if (place.x - 0.1).abs() < 0.05 && (place.y - 0.05).abs() < 0.03 {
                horizontal += particles.pressure[i] - particles.stress[i][(0, 0)];
                vertical += particles.pressure[i] - particles.stress[i][(1, 1)];
                weight += density * 9.81 * (0.1 - place.y);
            }
        }
        [horizontal / vertical, vertical / weight, (square / 0.981).sqrt()]
    }

    #[test]
    fn a_box_of_grains_rests_with_the_given_ratio_and_hydrostatic_without_one() {
        for (given, expected) in [(None, 1.0), (Some(0.618), 0.618), (Some(1.6), 1.6)] {
            let [ratio, weight, speed] = after_a_while(given);
            println!("{given:?}: {ratio}, {weight}, {speed}");
            assert!((ratio / expected - 1.0).abs() < 0.03, "{given:?}: {ratio}");
            assert!(
                (weight - 1.0).abs() < 0.02 && speed < 2e-3,
                "{given:?}: {weight} of the weight, {speed} of √(g H)"
            );
        }
    }
}
