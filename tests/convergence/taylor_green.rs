//! The decay of a periodic vortex lattice, an exact solution of the Navier–Stokes equations: kinetic energy falls as
//! exp(−4 ν k² t) for u = U (sin kx cos ky, −cos kx sin ky).

use crate::convergence::orders;
use crate::invariants::patches::simulation;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::run::StopReason;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

const DENSITY: f64 = 1000.0;
/// Velocity U `[m/s]`, in a box of 1 m.
const SPEED: f64 = 1.0;
/// Sound speed `[m/s]`, ten times U.
const SOUND_SPEED: f64 = 10.0;

fn vortices(cells: usize, jitter: f64, reynolds: f64, numerics: Numerics) -> Simulation<2> {
    simulation(scene(cells, jitter, reynolds, numerics))
}

fn scene(cells: usize, jitter: f64, reynolds: f64, numerics: Numerics) -> Scene<2> {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(cells as u64);
    let spacing = 1.0 / cells as f64;
    let equation_of_state = EquationOfState {
        reference_density: DENSITY,
        bulk_modulus: DENSITY * SOUND_SPEED * SOUND_SPEED,
        tension: Tension::Kept,
    };
    let mut flow = Flow::default();
    for index in 0..cells * cells {
        let mut place = |cell: usize| (cell as f64 + 0.5 + jitter * (2.0 * random.random::<f64>() - 1.0)) * spacing;
        let [x, y] = [place(index % cells), place(index / cells)];
        let (k_x, k_y) = (TAU * x, TAU * y);
        flow.position.push(Vector::<2>::new(x, y));
        flow.velocity.push(Vector::<2>::new(k_x.sin() * k_y.cos(), -k_x.cos() * k_y.sin()) * SPEED);
        let pressure = 0.25 * DENSITY * SPEED * SPEED * ((2.0 * k_x).cos() + (2.0 * k_y).cos());
        let density = equation_of_state.density(pressure);
        flow.density.push(density);
        flow.mass.push(density * spacing * spacing);
        flow.stress.push(Tensor::zeros());
    }
    Scene {
        flow,
        walls: Vec::new(),
        wall_particles: Vec::new(),
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain: Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: 1.0 }; 2] },
        gravity: Vector::zeros(),
        spacing,
        equation_of_state,
        rheology: Rheology::Newtonian(Newtonian { viscosity: DENSITY * SPEED / reynolds }),
        numerics,
    }
}

fn kinetic_energy(state: &Snapshot<2>) -> f64 {
    state.velocity.iter().zip(&state.mass).map(|(v, m)| 0.5 * m * v.norm_squared()).sum()
}

/// Decay rate of the kinetic energy over the exact 4 ν k², less one, until the energy has fallen by e.
fn rate_error(cells: usize, jitter: f64, reynolds: f64, numerics: Numerics) -> f64 {
    let rate = 4.0 * TAU * TAU * SPEED / reynolds;
    let mut simulation = vortices(cells, jitter, reynolds, numerics);
    let start = kinetic_energy(&simulation.snapshot());
    let reason = simulation.run(1.0 / rate, f64::INFINITY, |_| ControlFlow::Continue(()));
    assert_eq!(reason, StopReason::Finished);
    (start / kinetic_energy(&simulation.snapshot())).ln() / (rate * simulation.time()) - 1.0
}

/// An operator without any damping; C = 0.1, because (11) is unstable at the default bound of 0.2.
fn bare(momentum_operator: MomentumOperator) -> Numerics {
    Numerics {
        momentum_operator,
        artificial_viscosity: 0.0,
        hourglass: 0.0,
        viscous_courant: 0.1,
        pair_precision: PairPrecision::Double,
        ..Numerics::default()
    }
}

#[test]
fn the_single_divergence_decays_with_second_order_on_a_lattice() {
    for reynolds in [1.0, 10.0] {
        let run = |cells| rate_error(cells, 0.0, reynolds, bare(MomentumOperator::SingleDivergence)).abs();
        let errors = [16, 32, 64].map(run);
        println!("Re {reynolds}: {errors:.4?}, orders {:.2?}", orders(&errors));
        assert!(errors[2] < 0.02, "Re {reynolds}: {errors:?}");
        assert!(orders(&errors).iter().all(|&order| order > 1.5), "Re {reynolds}: {errors:?}");
    }
}

#[test]
fn the_uncorrected_divergence_decays_with_a_floor_of_its_own() {
    let errors = [16, 32, 64].map(|cells| rate_error(cells, 0.0, 1.0, bare(MomentumOperator::UncorrectedDivergence)));
    println!("{errors:.4?}");
    // at fixed h/Δ the uncorrected sum is not consistent: on this lattice it is off by 0.3 %
    assert!(errors[2].abs() < 0.02 && errors[1].abs() < errors[0].abs() && errors[2].abs() < errors[1].abs());
}

#[test]
fn a_frozen_disorder_of_the_particles_lowers_the_viscosity() {
    // Not a gate but a limit of the method, so that a change shows. On disordered particles that hardly move, the
    // flow finds motions of single particles that the wide stencil of the gradient does not see, and the dissipation
    // is lower by a share that grows with the square of the jitter and does not fall with the resolution.
    let error = |cells, jitter| rate_error(cells, jitter, 1.0, bare(MomentumOperator::SingleDivergence));
    let excess = |jitter| [32, 64].map(|cells| error(cells, jitter) - error(cells, 0.0));
    let (small, large) = (excess(0.05), excess(0.1));
    println!("jitter 0.05: {small:.4?}, 0.1: {large:.4?}");
    for (small, large) in small.iter().zip(large) {
        assert!(large < -0.02 && large > -0.09, "{large}");
        assert!((2.5..6.0).contains(&(large / small)), "{large} against {small}");
    }
}

/// Viscosity factor of (11) for this flow on a square lattice, by hand: to the lowest order in kΔ the force
/// is 2 ν k² u times −2 Σ V F (x⁴ − x²y²)/(r² + (0.01 h)²), which tends to one in the continuum.
fn lattice_factor(smoothing_ratio: f64) -> f64 {
    let kernel = Kernel::<2>::new(KernelShape::WendlandC2, smoothing_ratio);
    let reach = (2.0 * smoothing_ratio).ceil() as i32;
    let mut sum = 0.0;
    for i in -reach..=reach {
        for j in -reach..=reach {
            let (x, y) = (f64::from(i), f64::from(j));
            let square = x * x + y * y;
            let regular = square + 1e-4 * smoothing_ratio * smoothing_ratio;
            sum -= 2.0 * kernel.gradient_factor_at(square.sqrt()) * (x.powi(4) - x * x * y * y) / regular;
        }
    }
    sum
}

#[test]
fn the_pairwise_viscosity_is_off_by_its_lattice_sum_and_does_not_converge() {
    for smoothing_ratio in [1.3, 1.5, 2.0] {
        let expected = lattice_factor(smoothing_ratio) - 1.0;
        let numerics = Numerics { smoothing_ratio, ..bare(MomentumOperator::Pairwise) };
        let errors = [32, 64].map(|cells| rate_error(cells, 0.0, 1.0, numerics));
        println!("h/Δ = {smoothing_ratio}: {errors:.4?}, lattice sum {expected:.4}");
        // first order in time and second in kh remain
        assert!((errors[1] - expected).abs() < 0.01, "h/Δ = {smoothing_ratio}: {errors:?} for {expected}");
        assert!((errors[0] - expected).abs() < 0.03, "h/Δ = {smoothing_ratio}: {errors:?} for {expected}");
    }
    assert!(lattice_factor(1.5) > 1.05, "at the recipe's h/Δ (11) is several per cent too viscous");
    assert!((lattice_factor(6.0) - 1.0).abs() < 1e-3, "the sum tends to one");
}

#[test]
fn schwaigers_correction_changes_little_in_a_full_neighbourhood() {
    let error = |operator| rate_error(32, 0.0, 1.0, bare(operator));
    let (plain, corrected) = (error(MomentumOperator::Pairwise), error(MomentumOperator::PairwiseCorrected));
    println!("(11) {plain:.4}, (13) {corrected:.4}");
    assert!((corrected - plain).abs() < 0.01, "{plain} and {corrected}");
}

/// The paper's (13) with (14) by a sum over all particles `[m/s²]`, of an even shear with the gradient `shear` `[1/s]`
/// of v_x along y, whose velocity gradient is exact.
fn schwaiger_sum(position: &[Vector<2>], a: usize, spacing: f64, smoothing_length: f64, shear: f64) -> Vector<2> {
    let kernel = Kernel::<2>::new(KernelShape::WendlandC2, smoothing_length);
    let kinematic_viscosity = 1.0;
    let volume = spacing * spacing;
    let (mut plain, mut deficit, mut moment) = (Vector::<2>::zeros(), Vector::<2>::zeros(), Tensor::<2>::zeros());
    for b in (0..position.len()).filter(|&b| b != a) {
        let r = position[a] - position[b];
        let gradient = r * (volume * kernel.gradient_factor_at(r.norm()));
        let regular = r.norm_squared() + 1e-4 * smoothing_length * smoothing_length;
        plain += gradient * (8.0 * kinematic_viscosity * r.x * shear * r.y / regular);
        deficit += gradient;
        moment -= gradient * r.transpose();
    }
    let scale = moment.trace() / (2.0 * moment.determinant());
    (plain - Vector::<2>::new(2.0 * kinematic_viscosity * shear * deficit.y, 0.0)) * scale
}

#[test]
fn schwaigers_correction_is_the_sum_over_displaced_particles() {
    let (cells, spacing, shear) = (16, 1.0 / 64.0, 1.0);
    // steps so short that a velocity does not change within one
    let numerics = Numerics { viscous_courant: 1e-6, ..bare(MomentumOperator::PairwiseCorrected) };
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(14);
    let mut scene = scene(64, 0.0, 1.0, numerics);
    let mut flow = Flow::default();
    for index in 0..cells * cells {
        let mut place = |cell: usize| (24.5 + cell as f64 + 0.2 * (2.0 * random.random::<f64>() - 1.0)) * spacing;
        let position = Vector::<2>::new(place(index % cells), place(index / cells));
        flow.position.push(position);
        flow.velocity.push(Vector::<2>::new(shear * position.y, 0.0));
        flow.density.push(DENSITY);
        flow.mass.push(DENSITY * spacing * spacing);
        flow.stress.push(Tensor::zeros());
    }
    let position = flow.position.clone();
    scene.flow = flow;
    let mut simulation = simulation(scene);
    let start = simulation.snapshot();
    let reason = simulation.run(1e-9, f64::INFINITY, |_| ControlFlow::Continue(()));
    assert_eq!(reason, StopReason::Finished);
    let end = simulation.snapshot();
    let length = numerics.smoothing_ratio * spacing;
    // neighbourhoods that the surfaces do not reach
    let inside = (0..cells * cells).filter(|a| [a % cells, a / cells].iter().all(|place| (4..12).contains(place)));
    let (mut error, mut size) = (0.0, 0.0);
    for a in inside {
        let found = (end.velocity[a] - start.velocity[a]) / simulation.time();
        let expected = schwaiger_sum(&position, a, spacing, length, shear);
        error = f64::max(error, (found - expected).norm());
        size = f64::max(size, expected.norm());
    }
    println!("largest difference {error:.3e} m/s², largest acceleration {size:.3e} m/s²");
    assert!(error < 1e-4 * size, "{error} of {size}");
}
