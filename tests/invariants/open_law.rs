//! A law of a crate of the user's own, which this one is: found by its name, it runs like a built-in one.

use crate::patches::{Disorder, GRAINS, block, open_scene, simulation};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::open::{OpenLaw, OpenPlasticLaw, register};
use bagnold_solver::material::rheology::{MuI, PlasticLaw, Rheology, TrialStress};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::{Wall, wall};
use bagnold_solver::weakly_compressible::scene::Scene;

/// μ(I) once more, by way of f64 and a box.
#[derive(Debug)]
struct Copied(MuI);

impl OpenPlasticLaw for Copied {
    fn admissible_shear_stress(&self, trial: &TrialStress<f64>) -> f64 {
        self.0.admissible_shear_stress(trial)
    }

    fn yield_stress(&self, pressure: f64) -> f64 {
        self.0.yield_stress(pressure)
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.0.viscosity(shear_rate, pressure)
    }
}

/// A moving column on a rough bed beside a symmetry plane.
fn column(rheology: Rheology) -> Scene<2> {
    let mut scene = open_scene(block([8, 12], Disorder::FULL, 3));
    scene.rheology = rheology;
    scene.domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
    scene.gravity = Vector::<2>::new(0.0, -9.81);
    scene.walls = vec![Wall::still(1, 0.0, 1.0)];
    let extent = (Vector::zeros(), Vector::repeat(0.3));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, scene.spacing, 4);
    scene
}

#[test]
fn a_column_of_an_open_law_falls_to_the_last_bit_like_one_of_the_law_that_it_copies() {
    register("copied-friction", |parameters| Ok(OpenLaw::plastic(Copied(parameters.read()?)))).expect("a new name");
    let written = toml::to_string(&GRAINS).expect("a table").replace("mu-i", "copied-friction");
    let law: Rheology = toml::from_str(&written).expect("found by its name");
    assert!(matches!(law, Rheology::OpenPlastic(open) if open.name() == "copied-friction"));
    let [open, built_in] = [law, GRAINS].map(|law| {
        let mut simulation = simulation(column(law));
        for _ in 0..200 {
            simulation.step().expect("a step");
        }
        simulation.snapshot().to_bytes()
    });
    assert!(open == built_in);
}
