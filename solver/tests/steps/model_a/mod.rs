//! A whole step against plain sums over all pairs, one particle after the other.

mod pairs;
mod step_by_pairs;
mod viscous_solve;

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::internals::weakly_compressible::{accelerations, energy_of, state};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Bingham, MuI, NonlocalMuI, Rheology, SofteningDruckerPrager};
use bagnold_solver::vector::{Tensor, Vector, deviator, strain_rate};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{
    Contact, MomentumOperator, Numerics, PairPrecision, ViscositySwitch,
};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Surface, Wall, wall};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use step_by_pairs::by_pairs;

const SPACING: f64 = 0.01;
const DENSITY: f64 = 1500.0;

const GRAINS: MuI = MuI {
    static_friction: 0.38,
    limiting_friction: 0.64,
    reference_inertia: 0.28,
    grain_diameter: 5e-3,
    grain_density: 2500.0,
};
const SOIL: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.6,
    residual_friction: 0.4,
    peak_cohesion: 200.0,
    residual_cohesion: 50.0,
    softening_strain: 0.25,
    peak_dilation: 0.2,
    dilation_strain: Some(0.3),
};
const MUD: Bingham = Bingham { plastic_viscosity: 5.0, yield_stress: 100.0, regularisation_rate: 2.0 };

/// A jittered block with a free surface, on a rough belt, between a smooth wall and a mirror, and in space periodic across.
fn block<const D: usize>(rheology: Rheology, tension: Tension, numerics: Numerics) -> Simulation<D>
where
    Simulation<D>: Compiled<D>,
{
    let mut random = Pcg64Mcg::seed_from_u64(17);
    let mut symmetric = || 2.0 * random.random::<f64>() - 1.0;
    let cells: [usize; D] = std::array::from_fn(|axis| [7, 6, 5][axis]);
    let mut flow = Flow::default();
    for index in 0..cells.iter().product() {
        let mut rest = index;
        flow.position.push(Vector::<D>::from_fn(|axis, _| {
            let cell = rest % cells[axis];
            rest /= cells[axis];
            (cell as f64 + 0.5 + 0.2 * symmetric()) * SPACING
        }));
        flow.velocity.push(Vector::from_fn(|_, _| 0.3 * symmetric()));
        flow.density.push(DENSITY * (1.002 + 0.004 * symmetric()));
        flow.mass.push(DENSITY * SPACING.powi(D as i32) * (1.0 + 0.05 * symmetric()));
        flow.stress.push(deviator(&strain_rate(&Tensor::from_fn(|_, _| 500.0 * symmetric()))));
        if rheology.field().is_some() {
            flow.field.push(0.1 + 0.1 * symmetric());
        }
    }
    let reach = Vector::<D>::from_fn(|axis, _| cells[axis] as f64 * SPACING);
    let mut axes = [AxisBoundary::Open; D];
    for axis in 1..D - 1 {
        axes[axis] = AxisBoundary::Periodic { lower: 0.0, upper: reach[axis] };
    }
    axes[0] = AxisBoundary::Mirror { lower: None, upper: Some(reach[0]) };
    let domain = Domain { axes };
    let belt =
        Wall { velocity: Vector::from_fn(|axis, _| if axis == 0 { 0.2 } else { 0.0 }), ..Wall::still(D - 1, 0.0, 1.0) };
    let walls = vec![belt, Wall { roughness: Surface::Smooth, ..Wall::still(0, 0.0, 1.0) }];
    let mut simulation = Simulation::new(Scene {
        flow,
        wall_particles: wall::fill(&walls, &domain, (Vector::zeros(), reach), SPACING, 4),
        walls,
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain,
        gravity: Vector::from_fn(|axis, _| if axis + 1 == D { -9.81 } else { 3.0 }),
        spacing: SPACING,
        equation_of_state: EquationOfState { reference_density: DENSITY, bulk_modulus: 6e5, tension },
        rheology,
        numerics: Numerics { contact: Contact::None, smagorinsky_constant: 0.1, ..numerics },
    })
    .expect("a valid scene");
    let particles = &mut state(&mut simulation).particles;
    let flow = particles.flow_count();
    particles.artificial_viscosity[..flow].fill_with(|| 0.5 + 0.3 * symmetric());
    simulation
}

/// The largest difference of two fields over the largest value.
fn difference<'a>(found: impl Iterator<Item = &'a f64>, expected: impl Iterator<Item = &'a f64>) -> f64 {
    let (mut error, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
    for (found, expected) in found.zip(expected) {
        assert!(found.is_finite());
        (error, largest) = (error.max((found - expected).abs()), largest.max(expected.abs()));
    }
    error / largest
}

fn check<const D: usize>(rheology: Rheology, tension: Tension, numerics: Numerics)
where
    Simulation<D>: Compiled<D>,
{
    for pair_precision in [PairPrecision::Double, PairPrecision::Single] {
        let mut simulation = block::<D>(rheology, tension, Numerics { pair_precision, ..numerics });
        let (time_step, before) = (simulation.time_step_bounds().step(), simulation.particles().density.clone());
        let expected = by_pairs(state(&mut simulation), time_step);
        simulation.step().expect("a step");
        let accelerations = accelerations(&mut state(&mut simulation).particles).to_vec();
        let (of, flow) = (simulation.particles(), accelerations.len());
        let rate: Vec<f64> = (0..flow).map(|a| (of.density[a] - before[a]) / time_step).collect();
        let field = of.field.clone().unwrap_or_else(|| vec![0.0; flow]);
        let errors = [
            difference(accelerations.iter().flatten(), expected.acceleration.iter().flatten()),
            difference(rate.iter(), expected.density_rate.iter()),
            difference(of.velocity_gradient[..flow].iter().flatten(), expected.gradient.iter().flatten()),
            difference(of.stress[..flow].iter().flatten(), expected.stress.iter().flatten()),
            difference(field.iter().take(flow), expected.field.iter()),
            difference(of.artificial_viscosity.iter().take(flow), expected.artificial_viscosity.iter()),
        ];
        let allowed = if state(&mut simulation).model.pairs_in_single() { 1e-5 } else { 1e-10 };
        assert!(
            errors.iter().all(|error| *error < allowed),
            "{}, {pair_precision:?}, {D}: {errors:?}",
            rheology.name()
        );
    }
}

#[test]
fn a_step_of_grains_is_its_sums_over_all_pairs() {
    check::<2>(Rheology::MuI(GRAINS), Tension::Cut, Numerics::default());
    check::<3>(Rheology::MuI(GRAINS), Tension::Cut, Numerics::default());
}

#[test]
fn a_step_of_grains_with_a_fluidity_is_its_sums_over_all_pairs() {
    check::<2>(Rheology::NonlocalMuI(NonlocalMuI::of(GRAINS)), Tension::Cut, Numerics::default());
    check::<3>(Rheology::NonlocalMuI(NonlocalMuI::of(GRAINS)), Tension::Cut, Numerics::default());
}

#[test]
fn a_step_of_soil_under_tension_is_its_sums_over_all_pairs() {
    check::<2>(Rheology::SofteningDruckerPrager(SOIL), Tension::Kept, Numerics::default());
    check::<3>(Rheology::SofteningDruckerPrager(SOIL), Tension::Kept, Numerics::default());
}

#[test]
fn a_step_of_mud_is_its_sums_over_all_pairs() {
    let (momentum_operator, viscosity_switch) = (MomentumOperator::ByLaw, ViscositySwitch::MorrisMonaghan);
    check::<2>(Rheology::Bingham(MUD), Tension::Kept, Numerics { momentum_operator, ..Numerics::default() });
    check::<3>(Rheology::Bingham(MUD), Tension::Kept, Numerics { viscosity_switch, ..Numerics::default() });
}

/// ½ m v², m K/ρ0 (ln(1 + e) − e/(1 + e)) of the compression e, and V s:s/(4 G), particle by particle and all together.
#[test]
fn the_energy_of_a_particle_is_its_motion_compression_and_shear() {
    fn check<const D: usize>()
    where
        Simulation<D>: Compiled<D>,
    {
        let mut simulation = block::<D>(Rheology::MuI(GRAINS), Tension::Cut, Numerics::default());
        let account = simulation.energy().expect("an account");
        let (state, mut sum) = (state(&mut simulation), 0.0);
        let of = &state.particles;
        for a in 0..of.flow_count() {
            let strain = (of.density[a] / DENSITY - 1.0).max(0.0);
            let compression = 6e5 / DENSITY * (libm::log1p(strain) - strain / (1.0 + strain));
            let shear = of.stress[a].norm_squared() / (4.0 * 0.3 * 6e5 * of.density[a]);
            let expected = of.mass[a] * (0.5 * of.velocity[a].norm_squared() + compression + shear);
            let found = energy_of(state, a);
            assert!((found - expected).abs() < 1e-12 * expected, "{found} and {expected}");
            sum += expected;
        }
        assert!((account.kinetic + account.elastic - sum).abs() < 1e-12 * sum);
    }
    check::<2>();
    check::<3>();
}
