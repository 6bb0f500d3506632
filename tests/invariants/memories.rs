//! Memory of a law beside its field: numbers of its own, which go with the particle.

use crate::invariants::determinism::column;
use crate::invariants::patches::{GRAINS, SPACING, advance, simulation};
use bagnold_solver::material::rheology::field::{FieldBoundary, MOST_MEMORIES};
use bagnold_solver::material::rheology::field::{FieldDiffusion, FieldReturn, FieldStep, LawField, Memory};
use bagnold_solver::material::rheology::open::{OpenFieldLaw, OpenLaw, Parameters, register};
use bagnold_solver::material::rheology::{Rheology, TrialStress};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use std::sync::Once;

/// Bonds between grains that plastic work breaks, beside friction that softens with the plastic strain; it remembers the largest pressure
/// that it has borne.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Bonded {
    friction: f64,
    softening_strain: f64,
    cohesion: f64,
    /// Plastic work that breaks all bonds `[J/m³]`.
    toughness: f64,
}

const fn kept(name: &'static str, unit: &'static str, initial: f64) -> LawField {
    LawField { name, unit, description: "for a test", initial, bounds: (0.0, 1e12), diffusion: None }
}

const MEMORIES: &[LawField] =
    &[kept("broken_bonds", "-", 0.0), kept("largest_pressure", "Pa", 7.0), kept("label", "-", 0.5)];

impl OpenFieldLaw for Bonded {
    fn field(&self) -> LawField {
        kept("plastic_strain", "-", 0.0)
    }

    fn memories(&self) -> &[LawField] {
        MEMORIES
    }

    fn end_of_step(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64> {
        let beyond = (trial.shear_stress - self.yield_stress(trial.pressure, field)).max(0.0);
        FieldReturn { shear_stress: trial.shear_stress - beyond, field: field.value + beyond / trial.shear_modulus }
    }

    fn memory_after(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>, end: &FieldReturn<f64>) -> Memory<f64> {
        let [broken, largest, label] = field.memory;
        let work = end.shear_stress * (end.field - field.value);
        [broken + work / self.toughness, largest.max(trial.pressure), label]
    }

    fn yield_stress(&self, pressure: f64, field: &FieldStep<f64>) -> f64 {
        let friction = self.friction * (1.0 - 0.5 * (field.value / self.softening_strain).min(1.0));
        self.cohesion * (1.0 - field.memory[0]).max(0.0) + friction * pressure.max(0.0)
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        0.5 * self.friction * pressure.max(0.0) / shear_rate.max(1e-6)
    }

    fn contact_friction(&self) -> f64 {
        0.5 * self.friction
    }
}

pub(crate) fn bonded(cohesion: f64) -> Rheology {
    static ONCE: Once = Once::new();
    let make = |parameters: &Parameters| Ok(OpenLaw::with_field(parameters.read::<Bonded>()?));
    ONCE.call_once(|| register("bonded", make).expect("a new name"));
    let parameters =
        [("friction", 0.6), ("softening_strain", 0.2), ("cohesion", cohesion), ("toughness", 1.0 + 0.1 * cohesion)];
    Rheology::open("bonded", &parameters).expect("a law")
}

/// A column of it whose particles are labelled.
pub(crate) fn labelled<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let mut scene = column(cells);
    scene.rheology = bonded(5.0);
    let count = scene.flow.position.len();
    scene.flow.memory = (0..count).map(|identity| [0.0, 0.0, identity as f64 / count as f64]).collect();
    scene
}

/// Simple shear of one point, first under one pressure, then under another one. What has broken follows from the plastic work alone,
/// ∫τ dκ, which no function of the plastic strain tells when the pressure changes.
#[test]
fn two_memories_soften_a_law_each_by_its_own() {
    let (law, modulus, rate, step) = (bonded(40.0), 2e5, 1.0, 1e-6);
    let shear = Tensor::<2>::new(0.0, rate, 0.0, 0.0);
    let (mut stress, mut field, mut memory) = (Tensor::<2>::zeros(), 0.0, [0.0, 7.0, 0.5]);
    let (mut strain, mut broken, mut highest) = (0.0, 0.0_f64, 0.0_f64);
    for count in 0..150_000 {
        let pressure = if count < 60_000 { 100.0 } else { 30.0 };
        let kept = FieldStep::alone(field).with_memory(memory);
        let end = law.updated_state(&stress, &shear, pressure, &kept, modulus, step);
        (stress, field, memory) = (end.stress, end.field, end.memory);
        highest = highest.max(stress[(0, 1)]);
        // τ = c (1 − B) + μ(κ) p with dB = τ dκ/W, all in increments of the strain that is not elastic
        let friction = 0.6 * (1.0 - 0.5 * (strain / 0.2_f64).min(1.0));
        let exact = 40.0 * (1.0 - broken).max(0.0) + friction * pressure;
        // elastic up to 100 Pa over G
        if count > 500 {
            let increment = rate * step;
            strain += increment;
            broken += exact * increment / 5.0;
        }
        if count > 60_100 || (1500..60_000).contains(&count) {
            // what is elastic of the strain, 5e-4, is what the plastic one may differ by
            assert!((stress[(0, 1)] - exact).abs() < 0.2, "{} for {exact} after {count}", stress[(0, 1)]);
        }
    }
    assert!((highest - 100.0).abs() < 0.1, "the peak {highest}");
    assert_eq!((memory[1], memory[2]), (100.0, 0.5), "the largest pressure stays, what nothing changes stays");
    assert!(memory[0] > 0.9 && (memory[0] - broken).abs() < 0.02, "{} of {broken}", memory[0]);
}

#[test]
fn a_memory_goes_with_its_particle() {
    let mut scene = labelled([40, 30]);
    scene.enclosure.exits.upper = Vector::<2>::new(0.41, f64::INFINITY);
    scene.flow.velocity.iter_mut().for_each(|velocity| velocity[0] += 1.0);
    let count = scene.flow.position.len();
    let mut simulation = simulation(scene);
    advance(&mut simulation, 200);
    assert!(simulation.neighbour_searches() > 3 && simulation.outflow().particles() > 10);
    let particles = simulation.particles();
    let memory = particles.memory.as_ref().expect("memories");
    for index in 0..particles.flow_count() {
        assert_eq!(memory[index][2], f64::from(particles.identity[index]) / count as f64);
        assert!(memory[index][1] >= particles.pressure[index].max(0.0) * (1.0 - 1e-12), "of all pressures the largest");
    }
    let snapshot = simulation.snapshot();
    assert!(snapshot.memory.iter().filter(|memory| memory[0] > 1e-6).count() > 50, "bonds break");
    // and the column is not that of a law whose bonds never break
    let bytes = snapshot.to_bytes();
    assert_eq!(bytes.len() % 8, 0);
    assert!(bytes.len() > 8 * (snapshot.position.len() * (2 + 2 + 4 + 1 + 1 + MOST_MEMORIES)), "part of the state");
}

#[test]
fn inflow_has_the_initial_memory() {
    let mut scene = crate::invariants::inlets::fed();
    scene.rheology = bonded(0.0);
    let begun = scene.flow.position.len() as u32;
    let mut simulation = simulation(scene);
    advance(&mut simulation, 120);
    let particles = simulation.particles();
    let memory = particles.memory.as_ref().expect("memories");
    let arrived: Vec<_> = (0..particles.flow_count()).filter(|&index| particles.identity[index] >= begun).collect();
    assert!(arrived.len() > 5 && arrived.iter().all(|&index| memory[index][2] == 0.5 && memory[index][1] >= 7.0));
}

#[test]
fn memories_that_do_not_fit_are_refused() {
    let message = |change: fn(&mut Scene<2>)| {
        let mut scene = labelled([20, 12]);
        change(&mut scene);
        Simulation::new(scene).expect_err("refused").to_string()
    };
    assert_eq!(
        message(|scene| scene.flow.memory.truncate(7)),
        "the flow's memory has 7 entries, but there are 240 positions"
    );
    assert_eq!(
        message(|scene| scene.flow.memory[3][1] = -1.0),
        "the largest_pressure of particle 3 is -1, but must be finite and in the range that its law gives"
    );
    assert_eq!(
        message(|scene| scene.rheology = GRAINS),
        "the flow gives 240 particles internal variables, but its law `mu-i` has none beside its field; leave `memory` out"
    );
    // a state of another law
    let saved = simulation(labelled([20, 12]));
    let mut other = column([20, 12]);
    other.rheology = crate::invariants::fields::nonlocal();
    assert!(Simulation::continued(other, saved.save()).is_err());
}

/// A law that declares what it is told to.
#[derive(Debug)]
struct Declared(&'static [LawField]);

impl OpenFieldLaw for Declared {
    fn field(&self) -> LawField {
        kept("first", "-", 0.0)
    }

    fn memories(&self) -> &[LawField] {
        self.0
    }

    fn end_of_step(&self, _trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64> {
        FieldReturn { shear_stress: 0.0, field: field.value }
    }

    fn yield_stress(&self, _pressure: f64, _field: &FieldStep<f64>) -> f64 {
        0.0
    }

    fn viscosity(&self, _shear_rate: f64, _pressure: f64) -> f64 {
        0.0
    }

    fn contact_friction(&self) -> f64 {
        0.0
    }
}

#[test]
fn a_law_that_declares_what_cannot_be_kept_is_refused() {
    const SPREADING: LawField = LawField {
        diffusion: Some(FieldDiffusion {
            strength: SPACING,
            wall: FieldBoundary::NoFlux,
            surface: FieldBoundary::NoFlux,
        }),
        ..kept("second", "-", 0.0)
    };
    const FOUR: &[LawField] =
        &[kept("a", "-", 0.0), kept("b", "-", 0.0), kept("c", "-", 0.0), kept("too_many", "-", 0.0)];
    const TWICE: &[LawField] = &[kept("first", "-", 0.0)];
    const OUTSIDE: &[LawField] = &[kept("second", "-", -1.0)];
    register("declares-four", |_| Ok(OpenLaw::with_field(Declared(FOUR)))).expect("a new name");
    register("declares-twice", |_| Ok(OpenLaw::with_field(Declared(TWICE)))).expect("a new name");
    register("declares-outside", |_| Ok(OpenLaw::with_field(Declared(OUTSIDE)))).expect("a new name");
    register("declares-spreading", |_| Ok(OpenLaw::with_field(Declared(&[SPREADING])))).expect("a new name");
    let message = |name: &str| Rheology::open(name, &[]).expect_err("refused").to_string();
    assert_eq!(
        message("declares-four"),
        "`too_many` of the law `declares-four` is number 4, but must be among the first 3 beside the law's field; leave \
         out quantities that follow from the others"
    );
    assert_eq!(
        message("declares-twice"),
        "`first` of the law `declares-twice` is declared twice, but must be declared once; give each another name"
    );
    assert_eq!(
        message("declares-outside"),
        "`second` of the law `declares-outside` is -1, but must be finite and from 0 to 1000000000000 at first; give the value \
         that particles begin with"
    );
    assert_eq!(
        message("declares-spreading"),
        "`second` of the law `declares-spreading` is a diffusing quantity, but must be without diffusion, because only a law's \
         field diffuses; make it the law's field"
    );
}
