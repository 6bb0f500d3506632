//! Pairwise operators near a free surface, as the paper describes them: (10) pushes where the pressure is uniform, and
//! (11) is far off there. The default numerics do not use them.

use crate::invariants::patches::{
    DENSITY, Disorder, EQUATION_OF_STATE, SPACING, SYRUP, block, exact_pairs, open_scene, simulation,
};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Contact, MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;

/// Rows beside a surface that see it, for a support of three spacings.
const SEEN: f64 = 3.0;
const CELLS: [usize; 2] = [24, 20];

/// Accelerations `[m/s²]` of a first step by the paper's operators, with the places before it in spacings.
fn accelerations(mut scene: Scene<2>, rheology: Rheology) -> Vec<(Vector<2>, Vector<2>)> {
    scene.rheology = rheology;
    scene.numerics = Numerics {
        momentum_operator: MomentumOperator::Pairwise,
        contact: Contact::None,
        density_coupling: 0.0,
        artificial_viscosity: 0.0,
        hourglass: 0.0,
        ..exact_pairs()
    };
    let before = scene.flow.clone();
    let mut simulation = simulation(scene);
    simulation.step().expect("a stable step");
    let after = simulation.snapshot().velocity;
    let gained = after.iter().zip(&before.velocity).map(|(new, old)| (new - old) / simulation.time());
    before.position.iter().map(|place| place / SPACING).zip(gained).collect()
}

/// Rows between a place and the nearest of the block's surfaces.
fn rows_from_surface(place: &Vector<2>) -> f64 {
    let [x, y] = [place[0].min(CELLS[0] as f64 - place[0]), place[1].min(CELLS[1] as f64 - place[1])];
    x.min(y)
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, number) = values.fold((0.0, 0.0), |(sum, number), value| (sum + value * value, number + 1.0));
    (sum / number).sqrt()
}

#[test]
fn equation_10_pushes_where_the_pressure_is_uniform_above_all_at_a_surface() {
    let inviscid = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
    let disorder = Disorder { jitter: 0.2, compression: (0.005, 0.005), ..Disorder::NONE };
    let scene = open_scene(block(CELLS, disorder, 3));
    let pressure = EQUATION_OF_STATE.pressure(scene.flow.density[0]);
    assert!(scene.flow.density.iter().all(|density| *density == scene.flow.density[0]), "a uniform pressure");
    // a pressure that fell to nothing over a spacing would give this
    let unit = pressure / (DENSITY * SPACING);
    let found = accelerations(scene, inviscid);
    let part = |at_surface: bool| {
        let own = found.iter().filter(|(place, _)| (rows_from_surface(place) < SEEN) == at_surface);
        root_mean_square(own.map(|(_, acceleration)| acceleration.norm() / unit))
    };
    let (inside, surface) = (part(false), part(true));
    println!("{inside:.3} inside, {surface:.3} at the surface, over p/(ρ Δ)");
    assert!(inside > 0.02, "{inside}");
    assert!(surface > 2.0 * inside, "{surface} for {inside}");
}

#[test]
fn equation_11_is_far_off_at_a_surface_and_not_inside() {
    // u = c y²: ν ∇²u = 2 c ν everywhere
    let mut scene = open_scene(block(CELLS, Disorder::NONE, 3));
    let Rheology::Newtonian(Newtonian { viscosity }) = SYRUP else { panic!("a liquid") };
    let curvature = 10.0;
    for (place, velocity) in scene.flow.position.iter().zip(&mut scene.flow.velocity) {
        *velocity = Vector::<2>::new(curvature * place[1] * place[1], 0.0);
    }
    let exact = 2.0 * curvature * viscosity / DENSITY;
    let found = accelerations(scene, SYRUP);
    let error = |at_surface: bool| {
        let side = |place: &Vector<2>| place[0].min(CELLS[0] as f64 - place[0]) >= SEEN;
        let height = |place: &Vector<2>| place[1].min(CELLS[1] as f64 - place[1]);
        let own = found.iter().filter(|(place, _)| side(place) && (height(place) < SEEN) == at_surface);
        root_mean_square(own.map(|(_, acceleration)| acceleration[0] / exact - 1.0))
    };
    let (inside, surface) = (error(false), error(true));
    println!("{inside:.3} inside, {surface:.3} at the surface");
    assert!(inside < 0.2, "{inside}");
    assert!(surface > 5.0 * inside && surface > 1.0, "{surface} for {inside}");
}
