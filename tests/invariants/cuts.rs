//! Vertical cuts in soil that holds together, against limit analysis.
//!
//! The soil bears tension, and its strength is lowered step by step, each of them held until what is going to rest has come to rest. What
//! counts is when the crest begins to go down: by 0.005 of the height, which is more than yielding that elastic soil around it holds
//! back lets it go (about 0.1 γH²/G) and so little that the face is still vertical. A cut that has slumped farther is a slope, and stands at less strength.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Rheology, SofteningDruckerPrager};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use bagnold_solver::weakly_compressible::walls::{Wall, wall};

use crate::invariants::patches::{random, simulation, symmetric};

/// Height of the face `[m]`.
const HEIGHT: f64 = 4.0;
/// Bulk density `[kg/m³]`.
const DENSITY: f64 = 2000.0;
const GRAVITY: f64 = 9.81;
/// γH/c of the vertical cut without friction (Pastor, Thai & Francescato 2000 and others find 3.77 to 3.79).
const WITHOUT_FRICTION: f64 = 3.78;
/// γH/c over tan(45° + φ/2) of cuts with friction.
const WITH_FRICTION: f64 = 3.83;
/// Settlement of the crest at which a cut counts as falling, over the height `[-]`.
const FALLING: f64 = 0.005;

/// A face of some rows, soil behind it for one and a half heights, in front for one and below for half of one, on a rough base between
/// planes of symmetry.
#[derive(Clone, Copy)]
struct Cut {
    rows: usize,
    /// φ `[°]`.
    friction_angle: f64,
    /// ψ `[°]`, which does not vanish.
    dilation_angle: f64,
    /// Largest displacement of particles from their lattice, in spacings `[-]`.
    jitter: f64,
}

impl Cut {
    /// Without friction, of 16 rows on a lattice.
    const CLAY: Self = Self { rows: 16, friction_angle: 0.0, dilation_angle: 0.0, jitter: 0.0 };

    /// √(H/g) `[s]`.
    fn time() -> f64 {
        (HEIGHT / GRAVITY).sqrt()
    }

    /// With the cohesion c = γH/N at which the height is `stability` N `[-]`.
    fn law(&self, stability: f64) -> Rheology {
        let angle = self.friction_angle.to_radians();
        let (friction, cohesion) = (angle.sin(), DENSITY * GRAVITY * HEIGHT / stability * angle.cos());
        Rheology::SofteningDruckerPrager(SofteningDruckerPrager {
            peak_friction: friction,
            residual_friction: friction,
            peak_cohesion: cohesion,
            residual_cohesion: cohesion,
            softening_strain: 1.0,
            peak_dilation: self.dilation_angle.to_radians().sin(),
            dilation_strain: None,
        })
    }

    fn scene(&self, stability: f64) -> Scene<2> {
        let spacing = HEIGHT / self.rows as f64;
        let rows = self.rows as i32;
        let (behind, front, below) = (rows + rows / 2, rows, rows / 2);
        let equation_of_state = EquationOfState {
            reference_density: DENSITY,
            bulk_modulus: 200.0 * DENSITY * GRAVITY * HEIGHT,
            tension: Tension::Kept,
        };
        let mut random = random(11);
        let mut flow = Flow::default();
        for row in -below..rows {
            for column in -behind..if row < 0 { front } else { 0 } {
                let site = [column, row].map(|cell| f64::from(cell) + 0.5);
                let surface = if column < 0 { HEIGHT } else { 0.0 };
                let density = equation_of_state.density(DENSITY * GRAVITY * (surface - site[1] * spacing));
                flow.position.push(Vector::<2>::from_fn(|axis, _| {
                    (site[axis] + self.jitter * symmetric(&mut random)) * spacing
                }));
                flow.velocity.push(Vector::zeros());
                flow.density.push(density);
                flow.mass.push(density * spacing * spacing);
                flow.stress.push(Tensor::zeros());
            }
        }
        let edges = (-f64::from(behind) * spacing, f64::from(front) * spacing);
        let base = -f64::from(below) * spacing;
        let sides = AxisBoundary::Mirror { lower: Some(edges.0), upper: Some(edges.1) };
        let domain = Domain { axes: [sides, AxisBoundary::Open] };
        let walls = vec![Wall::still(1, base, 1.0)];
        let extent = (Vector::<2>::new(edges.0, base), Vector::<2>::new(edges.1, HEIGHT));
        let wall_particles = wall::fill(&walls, &domain, extent, spacing, 4);
        let gravity = Vector::<2>::new(0.0, -GRAVITY);
        let (rheology, numerics, enclosure) = (self.law(stability), Numerics::default(), BoundarySet::default());
        Scene {
            flow,
            walls,
            wall_particles,
            enclosure,
            side_walls: None,
            domain,
            gravity,
            spacing,
            equation_of_state,
            rheology,
            numerics,
        }
    }

    /// Index of the particle at the upper end of the face.
    fn crest(scene: &Scene<2>) -> usize {
        let near = |index: &usize| (scene.flow.position[*index] - Vector::<2>::new(0.0, HEIGHT)).norm();
        (0..scene.flow.position.len()).min_by(|a, b| near(a).total_cmp(&near(b))).expect("particles")
    }

    /// A cut that has come to rest under the strength of N `[-]`, from the stress that the soil had before it was cut.
    fn at_rest(&self, stability: f64) -> (Scene<2>, usize) {
        let mut scene = self.scene(stability);
        let crest = Self::crest(&scene);
        for _ in 0..16 {
            let state = held(&scene, 0.5 * Self::time());
            resume(&mut scene, state);
            // without the motion of its release, as a cut is dug slowly
            scene.flow.velocity.fill(Vector::zeros());
        }
        (scene, crest)
    }

    /// N `[-]` at which the crest begins to go down, within a range of it; how far it has gone is linear between two steps of 2 %.
    fn critical(&self, (from, to): (f64, f64)) -> f64 {
        let (mut scene, crest) = self.at_rest(from);
        let start = scene.flow.position[crest];
        let (mut stability, mut gone) = (from, 0.0);
        while stability < to {
            let next = 1.02 * stability;
            scene.rheology = self.law(next);
            let state = held(&scene, 4.0 * Self::time());
            let moved = (state.position[crest] - start).norm() / HEIGHT;
            println!("{} rows, {}°: N = {next:.3}, crest moved {moved:.5} H", self.rows, self.friction_angle);
            if moved > FALLING {
                return stability + (next - stability) * (FALLING - gone) / (moved - gone);
            }
            (stability, gone) = (next, moved);
            resume(&mut scene, state);
        }
        panic!("stands at {stability:.3}");
    }
}

/// The state after a time `[s]`.
fn held(scene: &Scene<2>, time: f64) -> Snapshot<2> {
    let mut simulation = simulation(scene.clone());
    while simulation.time() < time {
        simulation.step().expect("a stable step");
    }
    simulation.snapshot()
}

/// A scene goes on from a state.
fn resume(scene: &mut Scene<2>, state: Snapshot<2>) {
    let Snapshot { position, velocity, density, mass, stress, field, memory, .. } = state;
    scene.flow = Flow { position, velocity, density, mass, stress, field, memory };
}

/// Critical N over the exact one of soil without friction `[-]`.
fn without_friction(rows: usize, jitter: f64) -> f64 {
    let cut = Cut { rows, jitter, ..Cut::CLAY };
    let ratio = cut.critical((0.90 * WITHOUT_FRICTION, 1.10 * WITHOUT_FRICTION)) / WITHOUT_FRICTION;
    println!("{rows} rows, jitter {jitter}: {ratio:.3} of limit analysis");
    ratio
}

#[test]
fn a_cut_without_friction_falls_at_the_height_of_limit_analysis() {
    let ratio = without_friction(16, 0.1);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
#[ignore = "ten minutes: cuts of 24, 32 and 48 rows"]
fn a_cut_without_friction_falls_at_the_same_height_at_every_resolution() {
    for (rows, jitter) in [(24, 0.0), (32, 0.0), (32, 0.1), (48, 0.0)] {
        let ratio = without_friction(rows, jitter);
        assert!((ratio - 1.0).abs() < 0.05, "{ratio} with {rows} rows, jitter {jitter}");
    }
}

/// N of limit analysis with friction for soil that dilates by its friction angle (associated), and with the strength that Davis (1968)
/// gives soil without dilation, whose φ and c have the factor cos φ: tan φ* = sin φ, c* = c cos φ.
fn with_friction(friction_angle: f64) -> (f64, f64) {
    let of = |angle: f64| WITH_FRICTION * (std::f64::consts::FRAC_PI_4 + 0.5 * angle).tan();
    let angle = friction_angle.to_radians();
    (angle.cos() * of(angle.sin().atan()), of(angle))
}

/// Without dilation the cut falls between Davis's height and the associated one.
fn check_with_friction(rows: usize) {
    let (davis, associated) = with_friction(20.0);
    let found = Cut { rows, friction_angle: 20.0, ..Cut::CLAY }.critical((0.9 * davis, 1.1 * associated));
    let (over_davis, over_associated) = (found / davis, found / associated);
    println!("{rows} rows, 20°: {over_associated:.3} of the associated height, {over_davis:.3} of Davis's");
    assert!(over_davis > 0.95 && over_associated < 1.05, "{found} for {davis} to {associated}");
}

#[test]
fn a_cut_with_friction_falls_between_the_heights_with_and_without_dilation() {
    check_with_friction(16);
}

#[test]
#[ignore = "minutes: a cut of 32 rows"]
fn a_finer_cut_with_friction_falls_between_the_heights_with_and_without_dilation() {
    check_with_friction(32);
}

/// Critical N over the exact one of soil that dilates by its friction angle `[-]`.
fn associated(rows: usize, friction_angle: f64, jitter: f64) -> f64 {
    let exact = with_friction(friction_angle).1;
    let cut = Cut { rows, friction_angle, dilation_angle: friction_angle, jitter };
    let ratio = cut.critical((0.90 * exact, 1.15 * exact)) / exact;
    println!("{rows} rows, {friction_angle}°, jitter {jitter}: {ratio:.3} of limit analysis with associated flow");
    ratio
}

#[test]
fn a_cut_with_associated_flow_falls_at_the_height_of_limit_analysis() {
    let ratio = associated(16, 10.0, 0.0);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
#[ignore = "ten minutes: cuts of 24, 32 and 48 rows"]
fn a_cut_with_associated_flow_falls_at_the_same_height_at_every_resolution() {
    for (rows, jitter) in [(24, 0.0), (24, 0.1), (32, 0.0), (32, 0.1), (48, 0.0)] {
        let ratio = associated(rows, 20.0, jitter);
        assert!((ratio - 1.0).abs() < 0.05, "{ratio} with {rows} rows, jitter {jitter}");
    }
}

#[test]
#[ignore = "minutes: cuts of 24 and 32 rows"]
fn a_cut_of_less_friction_with_associated_flow_falls_at_the_height_of_limit_analysis() {
    for rows in [24, 32] {
        let ratio = associated(rows, 10.0, 0.0);
        assert!((ratio - 1.0).abs() < 0.05, "{ratio} with {rows} rows");
    }
}

/// At three quarters of its critical height a cut that has come to rest stays where it is, also where it dilates.
#[test]
fn a_safe_cut_does_not_creep() {
    let clay = Cut { jitter: 0.1, ..Cut::CLAY };
    let dilating = Cut { friction_angle: 20.0, dilation_angle: 20.0, ..clay };
    for (cut, exact) in [(clay, WITHOUT_FRICTION), (dilating, with_friction(20.0).1)] {
        let (scene, crest) = cut.at_rest(0.75 * exact);
        let state = held(&scene, 6.0 * Cut::time());
        let moved = (state.position[crest] - scene.flow.position[crest]).norm() / HEIGHT;
        println!("crest moved {moved:.2e} H");
        assert!(moved < 1e-4, "{moved}");
    }
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: bash tests/long.sh"]
    fn a_cut_of_a_lattice_falls_at_the_height_of_limit_analysis() {
        let ratio = without_friction(16, 0.0);
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    }
}
