//! Where a layer of grains is beyond what particles can follow, known before it runs.

use super::flow::{BagnoldFlow, LayerStart};
use bagnold_solver::weakly_compressible::terms::stress_diffusion::STEEPEST;

/// γ̇ Δ/√(p/ρ) = I √φ Δ/D `[-]` up to which layers were found to be steady and within 2 % of Bagnold's profile: 0.10 for glass
/// at 25° and 20 rows; not at 0.135 (5 % after 20 s) and 0.27 (the layer loses 6 % of its height in 8 s).
const LARGEST_AGITATION: f64 = 0.12;

/// The agitation `[-]` at which a layer of 60 rows holds to 0.8 % for the two seconds of a run from the exact profile.
const LARGEST_AGITATION_FROM_PROFILE: f64 = 0.21;

/// Agitation `[-]` that a refined layer is to have: at 0.10 to 0.12 some layers still lose height.
const SAFE_AGITATION: f64 = 0.07;

/// Froude number of the depth mean `[-]` up to which layers were found to be steady; one of 12 is not, or diverges.
const LARGEST_FROUDE_NUMBER: f64 = 10.0;

impl BagnoldFlow {
    /// Why a steady flow is not expected to hold, and what helps; none where it is, and where there is none.
    pub(super) fn beyond_limits(&self) -> Option<String> {
        let largest = match self.start {
            LayerStart::Rest => LARGEST_AGITATION,
            LayerStart::Profile => LARGEST_AGITATION_FROM_PROFILE,
            LayerStart::Uncompressed => return None,
        };
        let profile = self.profile();
        let (inertia, mean) = (profile.inertial_number()?, profile.depth_mean()?);
        let spacing = self.layer.layer_height / self.layer.resolution as f64;
        let agitation = inertia * profile.solid_fraction.sqrt() * spacing / profile.grains.grain_diameter;
        let fall = self.layer.gravity * self.layer.layer_height * libm::cos(self.slope_angle.to_radians());
        let froude_number = mean / fall.sqrt();
        if agitation > largest {
            let rows = (self.layer.resolution as f64 * agitation / SAFE_AGITATION).ceil();
            return Some(format!(
                "N = I √φ Δ/D is {agitation:.2}; above {largest} layers sink and become unsteady: set `resolution = {rows}` or a gentler slope"
            ));
        }
        if profile.grains.static_friction > STEEPEST {
            return Some(format!(
                "a static friction above {STEEPEST} is ill-posed at small inertial numbers: a layer of 0.8 flows 5 % too fast"
            ));
        }
        (froude_number > LARGEST_FROUDE_NUMBER).then(|| {
            format!(
                "the Froude number is {froude_number:.1}; above {LARGEST_FROUDE_NUMBER} layers were not steady: set a gentler slope or a thinner layer"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::BagnoldFlow;
    use crate::case::{RunList, Tier};
    use crate::reference::grains::GLASS_BEADS;
    use bagnold_solver::material::rheology::{MuI, Rheology};

    #[test]
    fn shipped_layers_are_within_the_limits_and_finer_grains_are_not() {
        for tier in [Tier::Quick, Tier::Paper] {
            let list = RunList::<BagnoldFlow>::of_tier(tier);
            // the coarsest layers of the study of the spacing are there to show its error
            let judged = list.flows().iter().filter(|run| run.layer.resolution >= 20);
            assert_eq!(judged.filter_map(BagnoldFlow::beyond_limits).next(), None);
        }
        let coarse = |rows: usize, slope_angle: f64| {
            let mut flow = BagnoldFlow { slope_angle, ..BagnoldFlow::default() };
            flow.layer.resolution = rows;
            flow
        };
        // I = 0.133 at 25°: 0.103 at 20 rows
        assert_eq!(coarse(20, 25.0).beyond_limits(), None);
        let reason = coarse(10, 25.0).beyond_limits().expect("twice as coarse");
        assert!(reason.contains("Δ/D is 0.21;") && reason.contains("`resolution = 30`"), "{reason}");
        assert_eq!(coarse(10, 20.0).beyond_limits(), None, "there is no steady flow to miss");
        let mut steep = coarse(40, 41.2);
        let law = MuI { static_friction: 0.8, limiting_friction: 1.2, ..GLASS_BEADS.law };
        steep.material = Rheology::MuI(MuI { grain_diameter: 2e-4, ..law });
        let reason = steep.beyond_limits().expect("ill-posed");
        assert!(reason.contains("ill-posed"), "{reason}");
        let mut thick = coarse(1000, 29.0);
        thick.layer.layer_height = 0.1;
        let reason = thick.beyond_limits().expect("fast");
        assert!(reason.contains("Froude number"), "{reason}");
    }
}
