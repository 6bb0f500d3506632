//! Saved states of grains in columns and of a mixture: continued, they end bitwise identical to a run without
//! interruption.

use super::columns::moving_bed::{scene, shear_flow, with_eddies};
use super::mixture::suspension;
use bagnold_solver::incompressible::{IncompressibleScene, IncompressibleSimulation, MeanFlux, SavedIncompressible};
use bagnold_solver::vector::Vector;

const STEPS: usize = 30;

fn advance(simulation: &mut IncompressibleSimulation<2>, steps: usize) {
    for _ in 0..steps {
        simulation.step().unwrap();
    }
}

fn check(scene: &IncompressibleScene<2>) {
    let end = |simulation: &IncompressibleSimulation<2>| {
        let beside = (simulation.holding_force(), simulation.mean_pressure_gradient(), simulation.cost());
        (simulation.snapshot().to_bytes(), simulation.voidage().to_vec(), beside)
    };
    let mut whole = IncompressibleSimulation::new(scene.clone()).unwrap();
    advance(&mut whole, STEPS);
    for saved in [0, 1, 16] {
        let mut first = IncompressibleSimulation::new(scene.clone()).unwrap();
        advance(&mut first, saved);
        let written = postcard::to_stdvec(&first.save()).unwrap();
        let read: SavedIncompressible<2> = postcard::from_bytes(&written).unwrap();
        let mut second = IncompressibleSimulation::continued(scene.clone(), read).unwrap();
        advance(&mut second, STEPS - saved);
        assert!(end(&second) == end(&whole), "saved after {saved} steps");
    }
}

#[test]
fn grains_in_columns_go_on_in_the_same_bits() {
    for eddies in [0.0, 0.7] {
        check(&with_eddies(scene(0.03, shear_flow, 3), eddies));
    }
}

#[test]
fn a_mixture_goes_on_in_the_same_bits() {
    let flow = |x: Vector<2>| Vector::<2>::new(0.02 * (300.0 * x[1]).sin(), 0.0);
    for mean_flux in [MeanFlux::Free, MeanFlux::Zero] {
        let simulation = suspension(flow, |_| Vector::zeros(), (mean_flux, 9.81));
        check(simulation.scene());
    }
}
