//! Every scene that cannot be simulated, with its exact message.

use crate::invariants::patches::{Disorder, block, open_scene};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{MuI, Newtonian, Rheology};
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;

fn sound() -> Scene<2> {
    open_scene(block([6, 6], Disorder::NONE, 1))
}

/// The message of a scene that one change has spoilt; both ways to refuse it agree.
fn message(spoil: impl FnOnce(&mut Scene<2>)) -> String {
    let mut scene = sound();
    assert_eq!(scene.check(), Ok(()));
    spoil(&mut scene);
    let found = scene.check().expect_err("a bad scene");
    assert_eq!(Simulation::new(scene).map(drop).expect_err("a bad scene").to_string(), found.to_string());
    found.to_string()
}

#[test]
fn an_empty_scene() {
    assert_eq!(message(|scene| scene.flow = Flow::default()), "the scene has no flow particles");
}

#[test]
fn too_many_particles() {
    assert_eq!(
        SceneError::TooLarge(40_000_000).to_string(),
        "the scene has 40000000 particles, more than the neighbour list can address; use larger particles"
    );
}

#[test]
fn arrays_of_different_lengths() {
    let expected = |array: &str| format!("the flow's {array} has 35 entries, but there are 36 positions");
    assert_eq!(message(|scene| scene.flow.velocity.truncate(35)), expected("velocity"));
    assert_eq!(message(|scene| scene.flow.density.truncate(35)), expected("density"));
    assert_eq!(message(|scene| scene.flow.mass.truncate(35)), expected("mass"));
    assert_eq!(message(|scene| scene.flow.stress.truncate(35)), expected("stress"));
}

#[test]
fn states_that_are_no_states() {
    assert_eq!(
        message(|scene| scene.flow.position[5][1] = f64::NAN),
        "the position of particle 5 is NaN, but must be finite"
    );
    assert_eq!(
        message(|scene| scene.flow.velocity[6][0] = f64::INFINITY),
        "the velocity of particle 6 is inf, but must be finite"
    );
    assert_eq!(
        message(|scene| scene.flow.density[7] = 0.0),
        "the density of particle 7 is 0, but must be positive and finite"
    );
    assert_eq!(
        message(|scene| scene.flow.mass[8] = -0.25),
        "the mass of particle 8 is -0.25, but must be positive and finite"
    );
}

#[test]
fn materials_that_are_no_materials() {
    assert_eq!(
        message(|scene| scene.spacing = 0.0),
        "`spacing` is 0, but must be positive and finite; give it in SI units"
    );
    assert_eq!(
        message(|scene| scene.equation_of_state.reference_density = -1500.0),
        "`reference_density` is -1500, but must be positive and finite; give it in SI units"
    );
    assert_eq!(
        message(|scene| scene.equation_of_state.bulk_modulus = f64::NAN),
        "`bulk_modulus` is NaN, but must be positive and finite; give it in SI units"
    );
}

#[test]
fn laws_that_are_no_laws() {
    assert_eq!(
        message(|scene| scene.rheology = Rheology::Newtonian(Newtonian { viscosity: -1.0 })),
        "`viscosity` is -1, but must be finite and not negative; give the dynamic viscosity in Pa·s; 0.001 for \
         water, 0 for none"
    );
    let law = MuI {
        static_friction: 0.4,
        limiting_friction: 0.3,
        reference_inertia: 0.3,
        grain_diameter: 1e-3,
        grain_density: 2500.0,
    };
    assert_eq!(
        message(|scene| scene.rheology = Rheology::MuI(law)),
        "`limiting_friction` is 0.3, but must be finite and at least `static_friction`; give the friction of fast \
         flow, or `static_friction` itself for a law without rate dependence"
    );
}

#[test]
fn numerics_out_of_range() {
    let expected = |field: &str, value: f64, rule: &str| {
        format!("`{field}` is {value}, but must be {rule}; see the default numerics with `bagnold show`")
    };
    let remedied = [
        (message(|scene| scene.numerics.smoothing_ratio = 0.9), expected("smoothing_ratio", 0.9, "between 1 and 2.5")),
        (
            message(|scene| scene.numerics.density_coupling = -1.0),
            expected("density_coupling", -1.0, "between 0 and 10"),
        ),
        (
            message(|scene| scene.numerics.artificial_viscosity = 2.5),
            expected("artificial_viscosity", 2.5, "between 0 and 2"),
        ),
        (
            message(|scene| scene.numerics.smagorinsky_constant = f64::NAN),
            expected("smagorinsky_constant", f64::NAN, "between 0 and 1"),
        ),
        (message(|scene| scene.numerics.hourglass = 3.0), expected("hourglass", 3.0, "between 0 and 2")),
        (
            message(|scene| scene.numerics.shear_modulus_ratio = 0.0),
            expected("shear_modulus_ratio", 0.0, "above 0 and at most 1.5"),
        ),
        (
            message(|scene| scene.numerics.acoustic_courant = 0.0),
            expected("acoustic_courant", 0.0, "above 0 and at most 1"),
        ),
        (
            message(|scene| scene.numerics.advective_courant = 1.5),
            expected("advective_courant", 1.5, "above 0 and at most 1"),
        ),
        (
            message(|scene| scene.numerics.viscous_courant = -0.1),
            expected("viscous_courant", -0.1, "above 0 and at most 1"),
        ),
        (
            message(|scene| scene.numerics.viscous_tolerance = 0.9),
            expected("viscous_tolerance", 0.9, "between 1e-10 and 0.5"),
        ),
        (message(|scene| scene.numerics.verlet_skin = 0.0), expected("verlet_skin", 0.0, "above 0 and at most 1")),
    ];
    for (found, expected) in remedied {
        assert_eq!(found, expected);
    }
}

#[test]
fn an_implicit_viscous_step_without_a_viscous_divergence() {
    assert_eq!(
        message(|scene| scene.numerics.viscous_step = ViscousStep::Implicit),
        "`viscous_step` is implicit, but must be explicit with an elastoplastic law; choose \"explicit\", or a regularised law"
    );
    assert_eq!(
        message(|scene| {
            scene.rheology = Rheology::Newtonian(Newtonian { viscosity: 1.0 });
            scene.numerics = Numerics { viscous_step: ViscousStep::Implicit, ..Numerics::paper() };
        }),
        "`viscous_step` is implicit, but must be explicit with the pairwise momentum operators; choose the operator \
         \"single-divergence\", or \"explicit\""
    );
}

#[test]
fn a_period_shorter_than_the_reach_of_the_kernel() {
    assert_eq!(
        message(|scene| {
            scene.numerics.verlet_skin = 0.5;
            scene.domain.axes[1] = AxisBoundary::Periodic { lower: 0.5, upper: 0.53125 };
        }),
        "the period along axis 1 is 0.03125 m, but must be at least 0.045 m, the reach of the kernel; make the domain \
         longer or the particles smaller"
    );
}

#[test]
fn particles_on_top_of_each_other() {
    let mut scene = sound();
    let (first, velocity) = (scene.flow.position[0], Vector::<2>::zeros());
    for _ in 0..3000 {
        scene.flow.position.push(first);
        scene.flow.velocity.push(velocity);
        scene.flow.density.push(1500.0);
        scene.flow.mass.push(0.15);
        scene.flow.stress.push(Tensor::<2>::zeros());
    }
    let found = Simulation::new(scene).map(drop).expect_err("a crowd").to_string();
    let (start, end) =
        ("the number of neighbours of particle ", " is 1024, but must be in the range that the model allows");
    assert!(found.starts_with(start) && found.ends_with(end), "{found}");
}

#[test]
fn a_density_far_from_the_reference() {
    let mut scene = sound();
    scene.flow.density[3] = 6000.0;
    assert_eq!(
        Simulation::new(scene).map(drop).expect_err("a crushed particle").to_string(),
        "the density of particle 3 is 6000, but must be in the range that the model allows"
    );
}

#[test]
fn a_stress_that_is_not_finite() {
    let mut scene = sound();
    scene.flow.stress[2][(0, 1)] = f64::NAN;
    assert_eq!(
        scene.check().map_err(|error| error.to_string()),
        Err("the stress of particle 2 is NaN, but must be finite".to_owned())
    );
}
