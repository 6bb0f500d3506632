//! A law of a crate of the user's own, which this one is: found by its name, it runs like a built-in one.

use crate::invariants::patches::{Disorder, GRAINS, block, open_scene, simulation};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::field::{FieldReturn, FieldStep, LawField};
use bagnold_solver::material::rheology::open::{OpenFieldLaw, OpenLaw, OpenPlasticLaw, Parameters, register};
use bagnold_solver::material::rheology::{MuI, PlasticLaw, Rheology, TrialStress};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::walls::{Wall, wall};
use std::sync::Once;

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

    fn contact_friction(&self) -> f64 {
        self.0.contact_friction()
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

/// Friction that falls from a peak to a residual value over a plastic strain: the law of the book's chapter.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Softening {
    peak_friction: f64,
    residual_friction: f64,
    softening_strain: f64,
    cohesion: f64,
}

impl OpenFieldLaw for Softening {
    fn field(&self) -> LawField {
        LawField {
            name: "plastic_strain",
            unit: "-",
            description: "plastic shear strain so far",
            initial: 0.0,
            bounds: (0.0, 1e6),
            diffusion: None,
        }
    }

    fn end_of_step(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64> {
        let yield_stress = self.yield_stress(trial.pressure, field);
        if trial.shear_stress <= yield_stress {
            return FieldReturn { shear_stress: trial.shear_stress, field: field.value };
        }
        let strain = (trial.shear_stress - yield_stress) / trial.shear_modulus;
        FieldReturn { shear_stress: yield_stress, field: field.value + strain }
    }

    fn yield_stress(&self, pressure: f64, field: &FieldStep<f64>) -> f64 {
        let softened = (field.value / self.softening_strain).min(1.0);
        let friction = self.peak_friction + softened * (self.residual_friction - self.peak_friction);
        self.cohesion + friction * pressure.max(0.0)
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.residual_friction * pressure.max(0.0) / shear_rate.max(1e-6)
    }

    fn contact_friction(&self) -> f64 {
        self.residual_friction
    }
}

fn softening(cohesion: f64) -> Rheology {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let make = |parameters: &Parameters| Ok(OpenLaw::with_field(parameters.read::<Softening>()?));
        register("softens", make).expect("a new name");
    });
    let text = format!(
        "law = \"softens\"\npeak_friction = 0.6\nresidual_friction = 0.4\nsoftening_strain = 0.2\ncohesion = {cohesion}"
    );
    toml::from_str(&text).expect("found by its name")
}

/// Simple shear of one point under a pressure: elastic to the peak, then down a line to the residual stress.
#[test]
fn a_softening_law_goes_from_its_peak_to_its_residual_strength() {
    let (law, pressure, modulus, rate, step) = (softening(5.0), 100.0, 2e4, 1.0, 1e-5);
    let shear = Tensor::<2>::new(0.0, rate, 0.0, 0.0);
    let (mut stress, mut strain, mut highest) = (Tensor::<2>::zeros(), 0.0, 0.0_f64);
    for count in 1..=40_000 {
        let field = FieldStep::alone(strain);
        (stress, strain) = law.updated_state(&stress, &shear, pressure, &field, modulus, step).stress_and_field();
        highest = highest.max(stress[(0, 1)]);
        let total = rate * step * f64::from(count);
        if strain > 0.0 {
            // what is not elastic is plastic
            assert!((strain - (total - stress[(0, 1)] / modulus)).abs() < 1e-4 * total, "{strain} of {total}");
            let expected = 5.0 + pressure * (0.6 - 0.2 * (strain / 0.2).min(1.0));
            assert!((stress[(0, 1)] - expected).abs() < 0.01, "{} for {expected}", stress[(0, 1)]);
        }
    }
    assert!((highest - 65.0).abs() < 0.05 && (stress[(0, 1)] - 45.0).abs() < 1e-9, "{highest}, {stress}");
    assert_eq!(law.contact_friction(), 0.4);
}

#[test]
fn the_energy_ledger_closes_with_a_law_that_softens() {
    let mut simulation = simulation(column(softening(20.0)));
    let start = simulation.energy().expect("a ledger");
    for _ in 0..400 {
        simulation.step().expect("a step");
    }
    let end = simulation.energy().expect("a ledger");
    let open = end.residual_since(&start) / end.ledger.dissipated();
    let strained = simulation.snapshot().field.iter().filter(|&&strain| strain > 1e-3).count();
    println!("{open:.4} of what was dissipated stays open, {strained} particles have yielded");
    assert!(end.ledger.plastic > 0.2 * end.ledger.dissipated(), "{:?}", end.ledger);
    assert!(open.abs() < 0.02 && strained > 30, "{open}, {strained}");
}
