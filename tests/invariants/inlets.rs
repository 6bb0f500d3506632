//! Inlets: what they feed is the integral of their rate, what it brings is booked, and a film that is fed at the rate of the uniform
//! one becomes that.

use crate::invariants::patches::{EQUATION_OF_STATE, GRAINS, SPACING, exact_pairs, simulation};
use crate::invariants::shells::shell;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::FeedRate;
use bagnold_solver::weakly_compressible::enclosure::inlet::{Inlet, Supply};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

const DENSITY: f64 = 1500.0;

fn supply(rate: FeedRate) -> Supply {
    Supply { spacing: SPACING, density: DENSITY, rate }
}

fn empty<const D: usize>() -> Scene<D> {
    let mut scene = Scene::unbounded(Flow::default(), SPACING, EQUATION_OF_STATE, GRAINS);
    scene.numerics = exact_pairs();
    scene.gravity[D - 1] = -9.81;
    scene
}

/// Grains that are fed onto a bed through an opening six spacings high, at a rate `[kg/(m s)]` that rises, ends and begins anew.
pub(crate) fn fed() -> Scene<2> {
    let mut scene = empty::<2>();
    scene.enclosure.walls = vec![shell("bed", &[[-8.0 * SPACING, 0.0], [20.0 * SPACING, 0.0]])];
    let rate = FeedRate::table(&[(0.0, 0.0), (0.004, 200.0), (0.02, 200.0), (0.024, 0.0), (0.03, 0.0), (0.034, 250.0)]);
    let (top, bottom) = (Vector::<2>::new(0.0, 6.2 * SPACING), Vector::<2>::zeros());
    let inlet = Inlet::segment("feed", top, bottom, supply(rate.expect("a table")));
    scene.enclosure.inlets = vec![inlet.expect("an opening")];
    scene.enclosure.exits.upper[0] = 9.0 * SPACING;
    scene
}

/// The same in space, through a square opening between two periodic sides.
pub(crate) fn fed_in_space() -> Scene<3> {
    let mut scene = empty::<3>();
    let width = 6.0 * SPACING;
    scene.domain.axes[1] = AxisBoundary::Periodic { lower: 0.0, upper: width };
    let corner = Vector::<3>::zeros();
    let next = [Vector::<3>::new(0.0, width, 0.0), Vector::<3>::new(0.0, 0.0, width)];
    let rate = FeedRate::constant(10.0).expect("a rate");
    scene.enclosure.inlets = vec![Inlet::rectangle("feed", corner, next, supply(rate)).expect("an opening")];
    scene
}

/// Runs a scene for a time `[s]` and holds, step by step, what was fed against the integral of the rate, and what is there against
/// what was fed; gives the number of rows.
fn check_feed<const D: usize>(scene: Scene<D>, end: f64) -> u64
where
    Simulation<D>: Compiled<D>,
{
    let inlet = scene.enclosure.inlets[0].clone();
    let gravity = scene.gravity;
    let mut simulation = simulation(scene);
    while simulation.time() < end {
        let step = simulation.time_step_bounds().step();
        simulation.step().expect("no divergence");
        let fed = simulation.inflow().inlets[0];
        // rows are looked at before a step is taken
        let moves = inlet.largest_speed() * 2.0 * step / inlet.depth;
        let off = (fed.mass - inlet.rate.mass(simulation.time())) / inlet.row_mass();
        assert!(off.abs() <= 0.5 + moves, "{off} rows at {} s", simulation.time());
        let departed = &simulation.outflow().sides;
        let state = simulation.snapshot();
        let (inside, outside): (f64, f64) = (state.mass.iter().sum(), departed.iter().map(|side| side.mass).sum());
        assert!(
            (inside + outside - fed.mass).abs() < 1e-12 * fed.mass.max(1.0),
            "{inside}, {outside} and {}",
            fed.mass
        );
        let momentum: Vector<D> = state.velocity.iter().zip(&state.mass).map(|(v, m)| v * *m).sum::<Vector<D>>()
            + departed.iter().map(|side| side.momentum).sum::<Vector<D>>();
        let supports: Vector<D> = simulation.facet_wall_impulses().iter().sum();
        let worked: f64 = departed.iter().map(|side| side.mass_times_time).sum();
        let given = gravity * (inside * simulation.time() + worked - fed.mass_times_time);
        let missing = (momentum - fed.momentum - supports - given).norm();
        assert!(missing < 1e-9 * (fed.momentum.norm() + given.norm() + 1e-3), "{missing} kg m/s without a cause");
    }
    let fed = simulation.inflow().inlets[0];
    assert_eq!(fed.particles, fed.rows * inlet.cells.len() as u64);
    fed.rows
}

#[test]
fn inflow_is_the_integral_of_the_rate() {
    let scene = fed();
    let end = 0.1;
    let exact = scene.enclosure.inlets[0].rate.mass(end) / scene.enclosure.inlets[0].row_mass();
    let rows = check_feed(scene, end);
    assert!(rows > 20 && (rows as f64 - exact).abs() < 0.6, "{rows} rows of {exact}");
    assert!(check_feed(fed_in_space(), 0.06) > 3);
}

/// A layer that flows down a slope and is fed at the rate of the uniform one.
struct Layer {
    /// `[m]`
    height: f64,
    /// Rows of particles over the height.
    rows: f64,
    /// Length of the slope, in heights.
    length: f64,
    /// Its angle `[rad]`.
    angle: f64,
    /// `[kg/m³]`
    density: f64,
    law: Rheology,
    /// Mean velocity of the uniform layer, and that of its surface `[m/s]`.
    mean: f64,
    surface: f64,
    /// Velocity at a depth below the surface, in heights, over that of the surface.
    profile: fn(f64) -> f64,
}

impl Layer {
    /// The slope with its inlet, empty.
    fn scene(&self) -> Scene<2> {
        let (length, spacing, gravity) = (self.length * self.height, self.height / self.rows, 9.81);
        let (sin, cos) = self.angle.sin_cos();
        let equation_of_state = EquationOfState {
            reference_density: self.density,
            bulk_modulus: 50.0 * self.density * gravity * (length * sin + self.height * cos),
            tension: Tension::Cut,
        };
        let mut scene = Scene::unbounded(Flow::default(), spacing, equation_of_state, self.law);
        scene.gravity = Vector::<2>::new(gravity * sin, -gravity * cos);
        // the bed begins under the rows
        scene.enclosure.walls = vec![shell("bed", &[[-self.height, 0.0], [length, 0.0]])];
        let rate = FeedRate::constant(self.density * self.mean * self.height).expect("a rate");
        let supply = Supply { spacing, density: self.density, rate };
        let inlet = Inlet::segment("feed", Vector::<2>::new(0.0, self.height), Vector::<2>::zeros(), supply);
        scene.enclosure.inlets = vec![inlet.expect("an opening")];
        scene.enclosure.exits.upper[0] = length;
        scene
    }

    /// By how much the thickness and the velocity of the upper quarter are off those of the uniform layer, in a window along the slope
    /// in heights, on average between two times `[s]`.
    fn errors(&self, scene: Scene<2>, (from, to): (f64, f64), (first, last): (f64, f64)) -> (f64, f64) {
        let mut simulation = simulation(scene);
        let (mut volume, mut above, mut samples) = (0.0, (0.0, 0.0), 0.0);
        while simulation.time() < last {
            simulation.step().expect("no divergence");
            if simulation.time() < first || simulation.steps() % 20 > 0 {
                continue;
            }
            samples += 1.0;
            let particles = simulation.particles();
            let inside = |index: &usize| (from..to).contains(&(particles.position[*index][0] / self.height));
            for index in (0..particles.flow_count()).filter(inside) {
                volume += particles.mass[index] / particles.density[index];
                let depth = 1.0 - particles.position[index][1] / self.height;
                if depth < 0.25 {
                    above.0 += particles.velocity[index][0] / (self.profile)(depth.max(0.0));
                    above.1 += 1.0;
                }
            }
        }
        let thickness = volume / samples / (to - from) / self.height;
        (thickness / self.height - 1.0, above.0 / above.1 / self.surface - 1.0)
    }
}

#[test]
fn a_film_that_is_fed_becomes_nusselts() {
    // steeper, and the pressure is too low against the shear for particles to follow
    let (height, viscosity, density): (f64, f64, f64) = (0.01, 1.0, 1000.0);
    let angle = 20_f64.to_radians();
    let surface = density * 9.81 * angle.sin() * height * height / (2.0 * viscosity);
    let law = Rheology::Newtonian(Newtonian { viscosity });
    let profile = |depth: f64| 1.0 - depth * depth;
    let (rows, length, mean) = (8.0, 8.0, 2.0 / 3.0 * surface);
    let film = Layer { height, rows, length, angle, density, law, mean, surface, profile };
    let (thickness, velocity) = film.errors(film.scene(), (1.5, 4.0), (1.2, 1.5));
    println!("thickness {:.2} %, velocity of the surface {:.2} % off", 100.0 * thickness, 100.0 * velocity);
    // particles that do not slide past each other in rows: a film between periodic sides that starts disordered is 5 % off
    assert!(thickness.abs() < 0.04, "the thickness is {thickness} off");
    assert!(velocity.abs() < 0.04, "the velocity of the surface is {velocity} off");
}

#[test]
#[ignore = "minutes: 2600 particles on a long slope"]
fn grains_that_are_fed_become_bagnolds_layer() {
    let Rheology::MuI(beads) = GRAINS else { unreachable!("grains") };
    let (height, rows, length): (f64, f64, f64) = (0.01, 8.0, 40.0);
    let (angle, solid_fraction) = (24_f64.to_radians(), DENSITY / beads.grain_density);
    let friction = angle.tan();
    let inertia = beads.reference_inertia * (friction - beads.static_friction) / (beads.limiting_friction - friction);
    // Bagnold's profile, u = ⅔ (I/d) √(φ g cos θ) [h^(3/2) − (h − z)^(3/2)]
    let rate = inertia / beads.grain_diameter * (solid_fraction * 9.81 * angle.cos()).sqrt();
    let surface = 2.0 / 3.0 * rate * height.powf(1.5);
    let profile = |depth: f64| 1.0 - depth.powf(1.5);
    let mean = 0.6 * surface;
    let layer = Layer { height, rows, length, angle, density: DENSITY, law: GRAINS, mean, surface, profile };
    let mut scene = layer.scene();
    // a layer that moves as one, so that it need not fill the slope first
    let spacing = height / rows;
    let columns = (length * rows) as usize;
    let site = |k: usize| Vector::<2>::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5) * spacing;
    scene.flow = Flow::at_rest((0..columns * rows as usize).map(site).collect(), DENSITY, spacing);
    scene.flow.velocity.fill(Vector::<2>::new(mean, 0.0));
    let (thickness, velocity) = layer.errors(scene, (16.0, 24.0), (2.5, 3.0));
    println!("thickness {:.2} %, velocity of the surface {:.2} % off", 100.0 * thickness, 100.0 * velocity);
    assert!(thickness.abs() < 0.05, "the thickness is {thickness} off");
    assert!(velocity.abs() < 0.08, "the velocity of the surface is {velocity} off");
}

#[test]
fn an_inlet_into_a_full_box_is_blocked_and_says_so() {
    let mut scene = empty::<2>();
    let side = 6.0 * SPACING;
    let lid = shell("lid", &[[0.0, side + SPACING], [0.0, side], [-6.0 * SPACING, side]]);
    let box_of = [[-6.0 * SPACING, 0.0], [side, 0.0], [side, side + SPACING], [0.0, side + SPACING]];
    scene.enclosure.walls = vec![lid, shell("box", &box_of)];
    let rate = FeedRate::constant(60.0).expect("a rate");
    let inlet = Inlet::segment("feed", Vector::<2>::new(0.0, side), Vector::<2>::zeros(), supply(rate));
    scene.enclosure.inlets = vec![inlet.expect("an opening")];
    let mut simulation = simulation(scene);
    let error = loop {
        if let Err(divergence) = simulation.step() {
            break divergence.to_string();
        }
        assert!(simulation.time() < 0.3, "seven rows fill the box");
    };
    assert!(
        error.contains("the inlet `feed` is blocked") && error.contains("compress the material by a tenth"),
        "{error}"
    );
    assert!(simulation.inflow().inlets[0].rows > 4, "{error}");
}

#[test]
fn rates_that_an_opening_does_not_pass_are_refused() {
    let with = |height: f64, rate: f64| {
        let mut scene = empty::<2>();
        let top = Vector::<2>::new(0.0, height * SPACING);
        let rate = FeedRate::constant(rate).expect("a rate");
        scene.enclosure.inlets = vec![Inlet::segment("feed", top, Vector::zeros(), supply(rate)).expect("an opening")];
        Simulation::new(scene).map(|_| ())
    };
    assert_eq!(with(6.0, 60.0), Ok(()));
    for (height, rate, field) in [(6.0, 6000.0, "inlets[0].rate"), (2.0, 1.0, "inlets[0].area")] {
        let Err(SceneError::Parameter(problem)) = with(height, rate) else { panic!("{field} is taken") };
        assert_eq!(problem.field, field, "{problem}");
    }
}
