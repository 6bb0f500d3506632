//! Every term books its work: what the ledger leaves open is the length of a step. (That no wall at rest feeds the flow is
//! what the case `water-column` is about.)

use crate::patches::{Disorder, GRAINS, periodic_scene, simulation};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

const STEPS: usize = 100;

/// Residual after the steps over what was dissipated meanwhile, with a share of the longest acoustic step.
fn open_share<const D: usize>(scene: Scene<D>, courant: f64) -> f64
where
    Simulation<D>: Compiled<D>,
{
    let numerics = Numerics { acoustic_courant: courant, ..scene.numerics };
    let mut simulation = simulation(Scene { numerics, ..scene });
    let start = simulation.energy().expect("the single divergence keeps a ledger");
    for _ in 0..(STEPS as f64 * 0.4 / courant) as usize {
        simulation.step().expect("a stable step");
    }
    let end = simulation.energy().expect("the same");
    assert!(end.ledger.dissipated() > 0.0, "nothing was dissipated");
    end.residual_since(&start) / end.ledger.dissipated()
}

#[test]
fn a_disordered_block_loses_what_its_terms_dissipate() {
    for rheology in [GRAINS, Rheology::Newtonian(Newtonian { viscosity: 5.0 })] {
        let plane = |courant| open_share(Scene { rheology, ..periodic_scene([17, 14], Disorder::FULL, 11) }, courant);
        let space = open_share(Scene { rheology, ..periodic_scene([8, 7, 9], Disorder::FULL, 11) }, 0.1);
        let (long, short) = (plane(0.4), plane(0.1));
        println!("{rheology:?}: {long:.4} and {short:.4} in the plane, {space:.4} in space");
        assert!(short.abs() < 0.02 && space.abs() < 0.02, "{short}, {space}");
        // of first order: a quarter of the step leaves a quarter open, and something more for the noise of another path
        assert!(short.abs() < 0.4 * long.abs(), "{long} should fall with the step to a quarter, not {short}");
    }
}
