//! G = −Dᵀ, and A + s D G symmetric and positive, on disordered particles above a wall and with a surface.

use super::pairs::by_force;
use super::{random, symmetric, water};
use bagnold_solver::incompressible::{IncompressibleSimulation, SurfaceTreatment};
use bagnold_solver::internals::incompressible::{
    PressurePoisson, Sources, State, fill_pressure_rows, measure, pressure_operator, state, state_mut,
};
use bagnold_solver::vector::Vector;

struct Prepared {
    simulation: IncompressibleSimulation<2>,
    poisson: PressurePoisson<2>,
    eliminated: bool,
}

fn prepare(closed: bool, eliminated: bool, stabilisation: f64) -> Prepared {
    let mut scene = water([13, 17], 0.25, closed, 41);
    (scene.numerics.stabilisation, scene.numerics.even_pairs) = (stabilisation, 1.0);
    scene.numerics.surface = if eliminated { SurfaceTreatment::Eliminated } else { SurfaceTreatment::Completed };
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    measure(state_mut(&mut simulation));
    let poisson = pressure_operator(state_mut(&mut simulation));
    Prepared { simulation, poisson, eliminated }
}

impl Prepared {
    fn rows(&self) -> usize {
        state(&self.simulation).phases.fluid.len()
    }

    /// A field that is zero where it is no unknown.
    fn field(&self, mut value: impl FnMut(&Vector<2>) -> f64) -> Vec<f64> {
        let phase = &state(&self.simulation).phases.fluid;
        let known = |a: usize| self.eliminated && phase.at_surface[a];
        (0..self.rows()).map(|a| if known(a) { 0.0 } else { value(&phase.position[a]) }).collect()
    }

    fn apply(&self, p: &[f64]) -> Vec<f64> {
        let (mut product, mut gradient) = (vec![0.0; p.len()], vec![Vector::zeros(); p.len()]);
        let stabilisation = self.simulation.scene().numerics.stabilisation;
        let surface = &state(&self.simulation).phases.fluid.at_surface;
        self.poisson.apply(p, &mut product, &mut gradient, surface, self.eliminated, stabilisation);
        product
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn the_gradient_is_minus_the_transposed_divergence() {
    for closed in [false, true] {
        let prepared = prepare(closed, false, 0.5);
        let mut random = random(5);
        let p = prepared.field(|_| symmetric(&mut random));
        let u: Vec<Vector<2>> = p.iter().map(|_| Vector::<2>::from_fn(|_, _| symmetric(&mut random))).collect();
        let (mut work, mut counter, mut size) = (0.0, 0.0, 0.0);
        for a in 0..prepared.rows() {
            let terms = (u[a].dot(&prepared.poisson.gradient(a, &p)), p[a] * prepared.poisson.divergence(a, &u));
            work += terms.0;
            counter += terms.1;
            size += terms.0.abs() + terms.1.abs();
        }
        assert!((work + counter).abs() < 1e-14 * size, "closed {closed}: {work} against {counter} of {size}");
        assert!(work.abs() > 1e-6 * size);
    }
}

#[test]
fn the_wall_turns_the_normal_velocity_only() {
    let prepared = prepare(false, false, 0.5);
    let along = vec![Vector::<2>::new(1.0, 0.0); prepared.rows()];
    let down = vec![Vector::<2>::new(0.0, -1.0); prepared.rows()];
    let lowest = (0..prepared.rows())
        .min_by(|&a, &b| {
            let height = |a: usize| state(&prepared.simulation).phases.fluid.position[a][1];
            height(a).total_cmp(&height(b))
        })
        .expect("particles");
    // sliding along a wall does not compress, moving towards it does: about −1/spacing for the lowest row
    let sums: f64 = (0..prepared.rows()).map(|a| prepared.poisson.divergence(a, &along)).sum();
    assert!(sums.abs() < 1e-9, "{sums}");
    assert!(prepared.poisson.divergence(lowest, &down) < -0.5 / super::SPACING);
}

#[test]
fn the_operator_is_symmetric_and_positive() {
    for (eliminated, stabilisation) in [(false, 0.5), (false, 0.0), (false, 3.0), (true, 0.5), (true, 0.0)] {
        let prepared = prepare(false, eliminated, stabilisation);
        let mut random = random(6);
        for _ in 0..10 {
            let x = prepared.field(|_| symmetric(&mut random));
            let y = prepared.field(|_| symmetric(&mut random));
            let (ax, ay) = (prepared.apply(&x), prepared.apply(&y));
            let scale = (product(&x, &ax) * product(&y, &ay)).sqrt();
            let difference = (product(&y, &ax) - product(&x, &ay)).abs();
            assert!(difference < 1e-13 * scale, "{difference} of {scale}, {eliminated} {stabilisation}");
        }
        let alternating = |x: &Vector<2>| {
            let cell = (x[0] / super::SPACING).floor() + (x[1] / super::SPACING).floor();
            if cell.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 }
        };
        for x in [prepared.field(|_| 1.0), prepared.field(|x| 0.2 - x[1]), prepared.field(alternating)] {
            let energy = product(&x, &prepared.apply(&x));
            assert!(energy > 0.0, "{energy} with {eliminated} {stabilisation}");
        }
    }
}

#[test]
fn the_stabilisation_is_minus_s_times_divergence_of_gradient() {
    let with = prepare(false, false, 0.7);
    let without = prepare(false, false, 0.0);
    let mut random = random(8);
    let p = with.field(|_| symmetric(&mut random));
    let gradient: Vec<_> = (0..with.rows()).map(|a| with.poisson.gradient(a, &p)).collect();
    let (full, compact) = (with.apply(&p), without.apply(&p));
    for a in 0..with.rows() {
        let expected = -0.7 * with.poisson.divergence(a, &gradient);
        assert!((full[a] - compact[a] - expected).abs() < 1e-10 * full[a].abs().max(1e4), "row {a}");
    }
}

#[test]
fn the_operators_are_their_sums_over_all_pairs() {
    let mut prepared = prepare(false, false, 0.0);
    let mut random = random(9);
    let p = prepared.field(|_| symmetric(&mut random));
    let u: Vec<Vector<2>> = p.iter().map(|_| Vector::<2>::from_fn(|_, _| symmetric(&mut random))).collect();
    let (product, gradients) = (prepared.apply(&p), prepared.poisson.find_gradient(&p).to_vec());
    let mut divergences = vec![0.0; p.len()];
    prepared.poisson.find_divergence(&u, &mut divergences);
    let phase = &state(&prepared.simulation).phases.fluid;
    let (kernel, volume, moment, uneven) = (&phase.kernel, phase.lattice_volume, &phase.moment, &phase.mean_anisotropy);
    let of = |sources: &[Vector<2>], which| {
        by_force(&phase.position, sources, which, &prepared.simulation.scene().domain, kernel.support())
    };
    let (free, walls) = (of(&phase.position, Sources::Same), of(&phase.wall, Sources::Other));
    let full = 2.0 * volume * phase.lattice.diagonal;
    for a in 0..p.len() {
        let (mut laplacian, mut gradient, mut divergence) = (0.0, Vector::<2>::zeros(), 0.0);
        let (mut diagonal, mut near, mut arm, mut complete) = (0.0, kernel.value_at(0.0) * phase.deficit[a], 0.0, full);
        for (b, r) in free[a].iter().map(|(b, r)| (*b as usize, r)) {
            let weight = 2.0 * volume * kernel.gradient_factor_at(r.norm()) / (moment[a] + moment[b]);
            laplacian -= 2.0 * weight * (p[a] - p[b]);
            diagonal -= 2.0 * weight;
            let even = r - (uneven[a] + uneven[b]) * r * 0.5;
            gradient += even * (weight * (p[a] + p[b]));
            divergence += weight * even.dot(&(u[b] - u[a]));
            near += kernel.value_at(r.norm()) * phase.deficit[b];
        }
        for (_, r) in &walls[a] {
            let weight = volume * kernel.gradient_factor_at(r.norm());
            (arm, complete) = (arm + weight * r[1] / moment[a], complete + 2.0 * weight);
        }
        gradient[1] += 2.0 * p[a] * arm;
        divergence -= 2.0 * u[a][1] * arm;
        // neighbours that are missing at the surface are mirrored with the opposite pressure
        let mirrored = (8.0 * volume * near).min(1.0) * (4.0 + 2.0 * phase.deficit[a]) / 3.0;
        laplacian += mirrored * (complete - diagonal).max(0.0) * p[a];
        // coefficients are single precision
        assert!((product[a] - laplacian).abs() < 2e-6 * full, "row {a}: {} and {laplacian}", product[a]);
        let (of_row, one_by_one) = (gradients[a], prepared.poisson.gradient(a, &p));
        assert!(
            (of_row - gradient).norm().max((one_by_one - gradient).norm()) < 2e-6 * full * super::SPACING,
            "row {a}"
        );
        let (of_row, one_by_one) = (divergences[a], prepared.poisson.divergence(a, &u));
        assert!(
            (of_row - divergence).abs().max((one_by_one - divergence).abs()) < 2e-6 * full * super::SPACING,
            "row {a}"
        );
    }
}

/// Neighbours closer along one diagonal, as a shear leaves them: pressure carries no shear stress between them.
#[test]
fn a_uniform_pressure_carries_no_shear_stress_among_sheared_particles() {
    let mut prepared = prepare(true, false, 0.5);
    let State { scene, phases, search, .. } = state_mut(&mut prepared.simulation);
    // a shear that comes round within a period
    let phase = |x: &Vector<2>| std::f64::consts::TAU * x[1] / (17.0 * super::SPACING);
    for x in &mut phases.fluid.position {
        x[0] += 0.3 * super::SPACING * phase(x).sin();
    }
    phases.wrap(&scene.domain);
    phases.fluid.search(&scene.domain, &search.periods, 0.0);
    let state = state_mut(&mut prepared.simulation);
    measure(state);
    fill_pressure_rows(state, &mut prepared.poisson);
    let State { phases, search, .. } = state;
    let fluid = &phases.fluid;
    // stresses over the pressure where the shear is, of the rows, and of gradients along the lines between particles
    let stress = |pair: &dyn Fn(usize, usize, &Vector<2>, f64) -> Vector<2>| {
        let of = |a: usize| {
            let pairs = fluid.free_pairs(a, &search.periods);
            pairs.map(|(b, r, weight)| -0.5 * pair(a, b, &r, weight)[0] * r[1]).sum::<f64>()
        };
        (0..fluid.len()).map(|a| of(a) * phase(&fluid.position[a]).cos()).sum::<f64>().abs() / fluid.len() as f64
    };
    let plain =
        stress(&|a, b, r, weight| r * (4.0 * fluid.lattice_volume * weight / (fluid.moment[a] + fluid.moment[b])));
    let own = stress(&|a, b, _, _| {
        let link = prepared.poisson.links(a).find(|link| link.source as usize == b).expect("a link");
        link.gradient * 2.0
    });
    assert!(own < 0.3 * plain && plain > 4e-3, "{own} and {plain}");
}

#[test]
fn eliminated_particles_have_no_pressure() {
    let mut simulation = prepare(false, true, 0.5).simulation;
    state_mut(&mut simulation).phases.fluid.pressure.fill(500.0);
    simulation.step().expect("a step");
    let fluid = &state(&simulation).phases.fluid;
    let of_surface = |at_surface: bool| (0..fluid.len()).filter(move |&a| fluid.at_surface[a] == at_surface);
    assert!(of_surface(true).count() >= 13 && of_surface(true).all(|a| fluid.pressure[a] == 0.0));
    assert!(of_surface(false).all(|a| fluid.pressure[a] != 0.0));
}
