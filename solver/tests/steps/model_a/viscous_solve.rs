//! The operator of the implicit viscous step against its sums over all pairs, and its solves against dense ones.

use super::pairs::{Pair, corrections, pairs_of};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::internals::weakly_compressible::{
    MOST_ITERATIONS, NotConverged, State, ViscousSolve, ViscousSystem, accelerations, into_state, lane, smooth_walls,
    viscosities, viscous_system, walls,
};
use bagnold_solver::lanes::LANES;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Bingham, MuI, Rheology};
use bagnold_solver::vector::{Tensor, Vector, deviator, strain_rate};
use bagnold_solver::weakly_compressible::divergence::Quantity;
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Wall, wall};
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SPACING: f64 = 0.01;
const DENSITY: f64 = 1500.0;
/// Δt η/(ρ Δ²) is near 70: far beyond an explicit step `[s]`.
const TIME_STEP: f64 = 1e-3;
const LAW: Rheology =
    Rheology::Bingham(Bingham { plastic_viscosity: 1e4, yield_stress: 2e4, regularisation_rate: 2.0 });

fn symmetric(random: &mut Pcg64Mcg) -> f64 {
    2.0 * random.random::<f64>() - 1.0
}

/// A moving patch of varying density and viscosity; `bed` puts it on a wall normal to the last axis.
fn patch<const D: usize>(cells: [usize; D], axes: [AxisBoundary; D], bed: bool, jitter: f64, tolerance: f64) -> State<D>
where
    Simulation<D>: Compiled<D>,
{
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let mut flow = Flow::default();
    for index in 0..cells.iter().product() {
        let mut rest = index;
        flow.position.push(Vector::<D>::from_fn(|axis, _| {
            let cell = rest % cells[axis];
            rest /= cells[axis];
            (cell as f64 + 0.5 + jitter * symmetric(&mut random)) * SPACING
        }));
        flow.velocity.push(Vector::from_fn(|_, _| 0.1 * symmetric(&mut random)));
        flow.density.push(DENSITY * (1.003 + 0.002 * symmetric(&mut random)));
        flow.mass.push(DENSITY * SPACING.powi(D as i32) * (1.0 + 0.05 * symmetric(&mut random)));
        flow.stress.push(Tensor::zeros());
    }
    let domain = Domain { axes };
    let walls: Vec<_> = bed.then_some(Wall::still(D - 1, 0.0, 1.0)).into_iter().collect();
    let reach = Vector::<D>::from_fn(|axis, _| cells[axis] as f64 * SPACING);
    let wall_particles = wall::fill(&walls, &domain, (Vector::zeros(), reach), SPACING, 4);
    let equation_of_state = EquationOfState { reference_density: DENSITY, bulk_modulus: 6e5, tension: Tension::Cut };
    let simulation = Simulation::new(Scene {
        flow,
        walls,
        wall_particles,
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain,
        gravity: Vector::zeros(),
        spacing: SPACING,
        equation_of_state,
        rheology: LAW,
        numerics: Numerics { viscous_step: ViscousStep::Implicit, viscous_tolerance: tolerance, ..Numerics::default() },
    });
    into_state(simulation.expect("a valid scene"))
}

fn periodic(cells: usize) -> AxisBoundary {
    AxisBoundary::Periodic { lower: 0.0, upper: cells as f64 * SPACING }
}

fn mirrors(cells: usize) -> AxisBoundary {
    AxisBoundary::Mirror { lower: Some(0.0), upper: Some(cells as f64 * SPACING) }
}

/// (M + Δt K) times a vector.
fn product<const D: usize>(patch: &State<D>, system: &mut ViscousSystem<D>, vector: &[Vector<D>]) -> Vec<Vector<D>> {
    let solve = ViscousSolve { model: &patch.model, pairs: &patch.pairs, time_step: TIME_STEP };
    for (index, value) in vector.iter().enumerate() {
        for i in 0..D {
            system.unknowns[index / LANES].direction[i][index % LANES] = value[i];
            system.unknowns[index / LANES].residual[i][index % LANES] = 0.0;
        }
    }
    solve.next_direction(system, vector.len(), 1.0);
    solve.product(system, vector.len(), &patch.images);
    (0..vector.len()).map(|index| lane(&system.unknowns[index / LANES].product, index % LANES)).collect()
}

fn random_vector<const D: usize>(count: usize, seed: u64) -> Vec<Vector<D>> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    (0..count).map(|_| Vector::from_fn(|_, _| symmetric(&mut random))).collect()
}

fn scalar_product<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

fn momentum<const D: usize>(patch: &State<D>, vector: &[Vector<D>]) -> Vec<Vector<D>> {
    vector.iter().zip(&patch.particles.mass).map(|(v, m)| v * *m).collect()
}

fn check_symmetry<const D: usize>(patch: &State<D>) {
    let mut system = viscous_system(patch, TIME_STEP);
    let count = patch.particles.flow_count();
    for seed in 0..4 {
        let (u, w) = (random_vector::<D>(count, seed), random_vector::<D>(count, seed + 100));
        let (of_u, of_w) = (product(patch, &mut system, &u), product(patch, &mut system, &w));
        let (left, right) = (scalar_product(&u, &of_w), scalar_product(&of_u, &w));
        let size = (scalar_product(&u, &of_u) * scalar_product(&w, &of_w)).sqrt();
        assert!((left - right).abs() < 1e-13 * size, "{left} and {right} of {size}");
        let inertia = scalar_product(&u, &momentum(patch, &u));
        assert!(scalar_product(&u, &of_u) > 5.0 * inertia, "the viscosity dominates");
    }
}

#[test]
fn the_operator_is_symmetric_at_walls_mirrors_and_periods() {
    check_symmetry(&patch([9, 8], [mirrors(9), AxisBoundary::Open], true, 0.2, 0.1));
    check_symmetry(&patch([9, 8], [periodic(9), AxisBoundary::Open], true, 0.2, 0.1));
    check_symmetry(&patch([9, 8], [mirrors(9), mirrors(8)], false, 0.2, 0.1));
    check_symmetry(&patch([6, 5, 6], [mirrors(6), periodic(5), AxisBoundary::Open], true, 0.2, 0.1));
}

/// The same product by plain sums over all pairs.
fn product_by_pairs<const D: usize>(patch: &State<D>, u: &[Vector<D>]) -> Vec<Vector<D>> {
    let (of, flow) = (&patch.particles, u.len());
    let (apparent, fields) = (viscosities(of), walls(of));
    let pairs = pairs_of(patch, &of.volume);
    // what stands still behind a wall moves as a line through the surface has it
    let factor = |b: &Pair<D>| {
        let (normal, depth) = (fields.normal[b.index - flow], fields.depth[b.index - flow]);
        let height = (b.r.dot(&normal) - depth).max(1e-6 * patch.model.kernel.smoothing_length());
        (1.0 + depth / height).min(6.0)
    };
    // of the viscosity that needs no pressure, half of the wall's part of the strain goes over to the resistance of the surface
    let held = |a: usize| {
        let rate = (2.0 * deviator(&strain_rate(&of.velocity_gradient[a])).norm_squared()).sqrt();
        let viscosity = LAW.viscosity(rate, 0.0).min(apparent[a]);
        (viscosity, 0.5 * viscosity / apparent[a])
    };
    let stress = |a: usize| {
        let shared = 1.0 - held(a).1;
        let slip = |b: &Pair<D>| if b.source < flow { u[a] - b.vector(u) } else { u[a] * factor(b) * shared };
        let gradient = pairs[a].iter().fold(Tensor::zeros(), |sum, b| sum - slip(b) * b.r.transpose() * b.weight);
        let (_, correction, _) = corrections(&pairs[a]);
        deviator(&strain_rate(&(gradient * correction))) * correction * (2.0 * apparent[a])
    };
    let stress: Vec<_> = (0..flow).map(stress).collect();
    let row = |a: usize| {
        let (viscosity, half_share) = held(a);
        let flux = |b: &Pair<D>| {
            if b.source < flow { stress[a] + b.tensor(&stress) } else { stress[a] * factor(b) * (1.0 - half_share) }
        };
        let force = pairs[a].iter().fold(Vector::zeros(), |sum, b| sum + flux(b) * b.r * b.weight);
        let walls = || pairs[a].iter().filter(|b| b.source >= flow);
        let (_, correction, _) = corrections(&pairs[a]);
        let stretch = |b: &Pair<D>| {
            let normal = fields.normal[b.index - flow];
            let height = normal.dot(&b.r);
            if height > 0.0 { (normal.dot(&(correction * b.r)) / height).clamp(0.0, 2.0) } else { 1.0 }
        };
        let resistance = walls().map(|b| -2.0 * b.weight * factor(b) * factor(b).min(2.0) * stretch(b)).sum::<f64>();
        let by_walls = walls().fold(Vector::<D>::zeros(), |sum, b| sum + b.r * (b.weight * factor(b) * half_share));
        let mean = 1.0 + (1.0 - 2.0 / D as f64) / D as f64;
        let counted = mean * apparent[a] * (correction * by_walls).norm_squared();
        let force = force - u[a] * (viscosity * resistance - counted).max(0.0);
        u[a] * of.mass[a] - force * (TIME_STEP * of.volume[a])
    };
    (0..flow).map(row).collect()
}

#[test]
fn the_operator_is_its_sums_over_all_pairs() {
    fn check<const D: usize>(patch: &State<D>) {
        let u = random_vector::<D>(patch.particles.flow_count(), 9);
        let (found, expected) =
            (product(patch, &mut viscous_system(patch, TIME_STEP), &u), product_by_pairs(patch, &u));
        let largest = expected.iter().map(Vector::amax).fold(0.0, f64::max);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).amax() < 1e-12 * largest, "{found} and {expected}");
        }
    }
    check(&patch([7, 6], [mirrors(7), AxisBoundary::Open], true, 0.2, 0.1));
    check(&patch([5, 5, 5], [mirrors(5), periodic(5), AxisBoundary::Open], true, 0.2, 0.1));
}

#[test]
fn the_operator_has_no_negative_direction() {
    let patch = patch([5, 5], [mirrors(5), AxisBoundary::Open], true, 0.2, 0.1);
    let matrix = assembled(&patch);
    let mut viscous = matrix.clone();
    for index in 0..patch.particles.flow_count() {
        for i in 0..2 {
            viscous[(2 * index + i, 2 * index + i)] -= patch.particles.mass[index];
        }
    }
    let eigenvalues = viscous.symmetric_eigen().eigenvalues;
    assert!(eigenvalues.min() > -1e-12 * eigenvalues.max() && eigenvalues.max() > 0.0, "{eigenvalues}");
}

/// M + Δt K, column by column.
fn assembled(patch: &State<2>) -> DMatrix<f64> {
    let mut system = viscous_system(patch, TIME_STEP);
    let count = patch.particles.flow_count();
    let mut matrix = DMatrix::zeros(2 * count, 2 * count);
    for column in 0..2 * count {
        let mut unit = vec![Vector::<2>::zeros(); count];
        unit[column / 2][column % 2] = 1.0;
        for (row, value) in product(patch, &mut system, &unit).iter().enumerate() {
            matrix[(2 * row, column)] = value[0];
            matrix[(2 * row + 1, column)] = value[1];
        }
    }
    matrix
}

#[test]
fn the_diagonal_is_exact_in_the_plane() {
    // eight cells: no particle shares a neighbour with its own image
    let patch = patch([8, 8], [periodic(8), AxisBoundary::Open], true, 0.2, 0.1);
    let (matrix, system) = (assembled(&patch), viscous_system(&patch, TIME_STEP));
    for index in 0..patch.particles.flow_count() {
        let diagonal = 1.0 / system.coefficients[index / LANES].inverse_diagonal[index % LANES];
        for i in 0..2 {
            let expected = matrix[(2 * index + i, 2 * index + i)];
            assert!((diagonal - expected).abs() < 1e-12 * expected, "{diagonal} and {expected}");
        }
    }
}

#[test]
fn the_solve_agrees_with_a_dense_one() {
    let mut patch = patch([7, 6], [mirrors(7), AxisBoundary::Open], true, 0.2, 1e-10);
    let count = patch.particles.flow_count();
    let given = random_vector::<2>(count, 3);
    let impulses = momentum(&patch, &given);
    let right = DVector::from_iterator(2 * count, impulses.iter().flat_map(|v| [v[0], v[1]]));
    let expected = assembled(&patch).cholesky().expect("a positive matrix").solve(&right);
    let largest = expected.amax();
    accelerations(&mut patch.particles).copy_from_slice(&given);
    let solve = ViscousSolve { model: &patch.model, pairs: &patch.pairs, time_step: TIME_STEP };
    solve.run(&mut patch.particles, &patch.images, &mut patch.viscous).expect("a solution");
    for (index, found) in accelerations(&mut patch.particles).iter().enumerate() {
        let expected = Vector::<2>::new(expected[2 * index], expected[2 * index + 1]);
        assert!((found - expected).norm() < 1e-7 * largest, "{found} and {expected}");
        assert!((found - given[index]).norm() > 1e-3, "the viscosity acts");
    }
    assert!((10..400).contains(&patch.viscous.iterations));
}

#[test]
fn the_viscous_forces_add_up_to_none_and_leave_a_translation_alone() {
    fn check<const D: usize>(patch: &State<D>) {
        let mut system = viscous_system(patch, TIME_STEP);
        let count = patch.particles.flow_count();
        let forces = |system: &mut _, u: &[Vector<D>]| -> Vec<_> {
            product(patch, system, u).iter().zip(momentum(patch, u)).map(|(a, b)| a - b).collect()
        };
        let found = forces(&mut system, &random_vector(count, 5));
        let (sum, scale) = (found.iter().sum::<Vector<D>>().norm(), found.iter().map(Vector::norm).sum::<f64>());
        assert!(scale > 0.0 && sum < 1e-13 * scale, "{sum} of {scale}");
        let still = forces(&mut system, &vec![Vector::repeat(1.0); count]);
        let largest = still.iter().map(Vector::norm).fold(0.0, f64::max);
        assert!(largest < 1e-12 * scale / count as f64, "{largest} of {scale}");
    }
    check(&patch([9, 8], [periodic(9), periodic(8)], false, 0.2, 0.1));
    check(&patch([6, 5, 5], [periodic(6), periodic(5), periodic(5)], false, 0.2, 0.1));
}

/// A smooth bed gives no traction along it, and no viscous one across it; a rough one holds.
#[test]
fn a_smooth_bed_leaves_a_translation_alone_and_a_rough_one_holds_it() {
    fn check<const D: usize>(mut patch: State<D>) {
        let still = vec![Vector::repeat(1.0); patch.particles.flow_count()];
        let force = |patch: &State<D>| {
            let found = product(patch, &mut viscous_system(patch, TIME_STEP), &still);
            found.iter().zip(momentum(patch, &still)).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
        };
        let rough = force(&patch);
        smooth_walls(&mut patch.particles);
        let smooth = force(&patch);
        assert!(smooth < 1e-12 * rough, "{smooth} of {rough}");
    }
    check(patch([9, 8], [periodic(9), AxisBoundary::Open], true, 0.2, 0.1));
    check(patch([6, 5, 6], [periodic(6), periodic(5), AxisBoundary::Open], true, 0.2, 0.1));
}

#[test]
fn a_shear_flow_on_the_bed_dissipates_exactly_by_friction_and_little_more_by_a_liquid() {
    let mut patch = patch([8, 10], [periodic(8), AxisBoundary::Open], true, 0.0, 0.1);
    // where the gradient stays, as in a zigzag, the wall resists twice as much: in the matrix always, which is 5 % of ten rows
    let of_liquid = shear_dissipation(&patch);
    assert!((1.0..1.06).contains(&of_liquid), "{of_liquid}");
    // the same viscosities, of a law that has none without pressure
    patch.model.rheology = Rheology::MuI(MuI {
        static_friction: 0.4,
        limiting_friction: 0.6,
        reference_inertia: 0.3,
        grain_diameter: 1e-3,
        grain_density: 2500.0,
    });
    let of_grains = shear_dissipation(&patch);
    assert!((of_grains - 1.0).abs() < 1e-12, "{of_grains}");
}

/// Power of the matrix on a straight shear over that of its strain.
fn shear_dissipation(patch: &State<2>) -> f64 {
    let mut system = viscous_system(patch, TIME_STEP);
    let rate = 3.0;
    let particles = &patch.particles;
    let count = particles.flow_count();
    let shear: Vec<_> = particles.position[..count].iter().map(|x| Vector::<2>::new(rate * x[1], 0.0)).collect();
    let found = product(patch, &mut system, &shear);
    let power = scalar_product(&shear, &found) - scalar_product(&shear, &momentum(patch, &shear));
    let expected: f64 = viscosities(particles).iter().zip(&particles.volume[..count]).map(|(eta, v)| eta * v).sum();
    power / (TIME_STEP * rate * rate * expected)
}

#[test]
fn a_force_that_is_no_number_is_refused_with_its_particle() {
    let mut patch = patch([7, 6], [mirrors(7), AxisBoundary::Open], true, 0.2, 0.1);
    let accelerations = accelerations(&mut patch.particles);
    accelerations.fill(Vector::zeros());
    accelerations[11][1] = f64::NAN;
    let solve = ViscousSolve { model: &patch.model, pairs: &patch.pairs, time_step: TIME_STEP };
    let found = solve.run(&mut patch.particles, &patch.images, &mut patch.viscous);
    assert_eq!(found, Err(NotConverged { worst: 11 }));
    let quantity = Quantity::ViscousResidual { tolerance: 0.1, most_iterations: MOST_ITERATIONS };
    let divergence = patch.divergence(11, quantity, patch.viscous.residual);
    assert_eq!(divergence.particle, patch.particles.identity[11]);
    assert!(divergence.value.is_nan() && divergence.to_string().contains("`viscous_tolerance`"), "{divergence}");
}
