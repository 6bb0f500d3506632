//! Regularised yield stresses that hold nothing or that no step can solve, and viscosities that shorten the step: told before the run.

use super::SceneFlow;
use super::flow::Dimension;
use bagnold_number::four_digits;
use bagnold_solver::weakly_compressible::numerics::ViscousStep;

/// Strain of a material at rest over a run that is told `[-]`.
const MOST_CREEP: f64 = 0.01;
/// Largest viscosity over ρ Δ²/Δt that the implicit step is known to solve `[-]`: a block of mud of 20 rows at 5·10⁴.
const MOST_STIFF: f64 = 1e5;

/// Explicit viscous bound of the step over the acoustic one that is told `[-]`.
const SHORTEST: f64 = 0.01;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Warning of a viscosity that shortens explicit steps: a refusal of cost would blame the spacing alone.
    pub(super) fn costly_viscosity(&self) -> Option<String> {
        let bounds = self.step_bounds();
        let shortened = bounds.viscous / bounds.acoustic;
        (shortened < SHORTEST).then(|| {
            format!(
                "scene `{}`: the viscosity of `material` makes a step {} times as long as sound allows; lower it, or set \
                 `numerics.viscous_step = \"implicit\"`",
                self.name,
                four_digits(shortened)
            )
        })
    }

    /// Warning of a rate of a regularised yield stress, with the rate to take.
    pub(super) fn doubtful_yield(&self) -> Option<String> {
        let material = serde_json::to_value(self.material).ok()?;
        let rate = material["regularisation_rate"].as_f64()?;
        let (density, fall) = (self.bulk.density(&self.material), self.fall());
        let (stress, frequency) = (density * fall, fall.sqrt() / self.height());
        let largest = self.material.largest_viscosity(stress);
        let stiff = largest * self.step_bounds().step() / (density * self.spacing.powi(2));
        let told = |defect: &str, bound: &str, remedy: f64| {
            let remedy = four_digits(remedy);
            format!(
                "scene `{}`: with `material.regularisation_rate = {rate}` {defect}; set {bound} {remedy}",
                self.name
            )
        };
        if self.numerics.viscous_step == ViscousStep::Implicit && stiff > MOST_STIFF {
            let defect = "the viscous step is not known to be solved, for what rests is too stiff";
            return Some(told(defect, "at least", rate * stiff / MOST_STIFF));
        }
        let rests = material["yield_stress"].as_f64().is_none_or(|yield_stress| stress < yield_stress);
        let creep = rate.min(stress / largest) * self.duration;
        (rate > frequency || rests && creep > MOST_CREEP).then(|| {
            let [strain, viscosity] = [100.0 * creep, largest].map(four_digits);
            let defect = format!("material at rest creeps by {strain} % in {} s, at {viscosity} Pa s", self.duration);
            told(&defect, "at most", (0.5 * rate * MOST_CREEP / creep).min(0.01 * frequency))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::quick;
    use crate::scene::{Plane, PlaneBody};

    /// Warning for a block of 5 cm over a second, of a law with a rate `[1/s]`.
    fn told(law: &str, rate: f64) -> String {
        let mut scene = quick::<Plane, 2>();
        (scene.walls, scene.inlets, scene.duration, scene.spacing) = (Vec::new(), Vec::new(), 1.0, 0.0025);
        scene.bodies = vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (0.05, 0.05), velocity: (0.0, 0.0) }];
        scene.material = toml::from_str(&format!("{law}\nregularisation_rate = {rate:e}")).expect("a law");
        (scene.bulk.solid_fraction, scene.bulk.bulk_density) = (1.0, 1800.0);
        scene.numerics.viscous_step = ViscousStep::Implicit;
        scene.doubtful_yield().unwrap_or_default()
    }

    #[test]
    fn a_yield_stress_that_holds_nothing_or_is_too_stiff_is_told_with_the_rate_to_take() {
        let mud = "law = \"bingham\"\nyield_stress = 2000.0\nplastic_viscosity = 10.0";
        assert_eq!([0.01, 1e-3].map(|rate| told(mud, rate)), ["", ""]);
        let soft = told(mud, 1.0);
        assert!(soft.contains("creeps by 43.93 % in 1 s") && soft.ends_with("set at most 0.01138"), "{soft}");
        assert!(told(mud, 1000.0).contains("set at most 0.0"), "{}", told(mud, 1000.0));
        let stiff = told(mud, 1e-12);
        assert!(stiff.ends_with("too stiff; set at least 5.385×10⁻⁴"), "{stiff}");
        // it flows, and what has come to rest creeps slowly
        let thin = mud.replace("2000", "100");
        assert_eq!(told(&thin, 0.01), "");
        let grains = "law = \"regularised-mu-i\"\nstatic_friction = 0.382\nlimiting_friction = 0.643\n\
             reference_inertia = 0.279\ngrain_diameter = 0.001\ngrain_density = 2500.0";
        assert_eq!(told(grains, 0.005), "");
        assert!(told(grains, 1000.0).ends_with("set at most 0.005"), "{}", told(grains, 1000.0));
    }

    #[test]
    fn a_viscosity_that_shortens_explicit_steps_is_told() {
        let mut scene = quick::<Plane, 2>();
        scene.numerics.viscous_step = ViscousStep::Explicit;
        assert_eq!(scene.costly_viscosity(), None);
        scene.material = toml::from_str("law = \"newtonian\"\nviscosity = 1e9").expect("a law");
        (scene.bulk.solid_fraction, scene.bulk.bulk_density) = (1.0, 1000.0);
        assert!(scene.costly_viscosity().is_some_and(|told| told.contains("the viscosity of `material`")));
        scene.numerics.viscous_step = ViscousStep::Implicit;
        assert_eq!(scene.costly_viscosity(), None);
    }
}
