//! After warm-up the step does not allocate: every buffer is reused, also when the neighbours are searched anew.
//!
//! A target of its own with a single test, because the counter sees every thread of the process.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{IncompressibleScene, Sediment, SedimentPressure};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{MuI, Newtonian, Rheology};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Wall, wall};
use counting::ALLOCATIONS;
use rand::{RngExt, SeedableRng};
use std::sync::atomic::Ordering;

const SPACING: f64 = 0.01;
const GRAVITY: f64 = 9.81;

#[path = "../threads.rs"]
mod threads;

#[path = "../invariants/two_phases.rs"]
#[expect(dead_code, reason = "the scenes of the invariants, of which this target needs one")]
mod two_phases;

#[path = "../../solver/benches/water/mod.rs"]
#[expect(dead_code, reason = "the scenes of the benchmarks, of which this target needs one")]
mod water;

/// The system's allocator with a counter.
mod counting {
    #![expect(unsafe_code, reason = "an allocator cannot be written without; it only counts and passes on")]

    use std::alloc::{GlobalAlloc, Layout, System};
    use std::sync::atomic::{AtomicU64, Ordering};

    /// Allocations of all threads since the start.
    pub(crate) static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

    struct Counting;

    // SAFETY: every call goes to the system's allocator unchanged.
    unsafe impl GlobalAlloc for Counting {
        unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
            ALLOCATIONS.fetch_add(1, Ordering::SeqCst);
            // SAFETY: the caller's promise about `layout` is passed on.
            unsafe { System.alloc(layout) }
        }

        unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
            // SAFETY: `pointer` came from `System` with this layout.
            unsafe { System.dealloc(pointer, layout) }
        }

        unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
            ALLOCATIONS.fetch_add(1, Ordering::SeqCst);
            // SAFETY: `pointer` came from `System` with this layout.
            unsafe { System.realloc(pointer, layout, size) }
        }
    }

    #[global_allocator]
    static COUNTING: Counting = Counting;
}

/// A jittered column that collapses on a bed beside a mirror plane; in 3-D periodic across.
fn column<const D: usize>(cells: [usize; D], numerics: Numerics, rheology: Rheology) -> Simulation<D>
where
    Simulation<D>: Compiled<D>,
{
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(23);
    let equation_of_state = EquationOfState { reference_density: 1500.0, bulk_modulus: 6e5, tension: Tension::Cut };
    let height = cells[D - 1] as f64 * SPACING;
    let mut flow = Flow::default();
    for index in 0..cells.iter().product() {
        let mut rest = index;
        let position = Vector::<D>::from_fn(|axis, _| {
            let cell = rest % cells[axis];
            rest /= cells[axis];
            (cell as f64 + 0.5 + 0.2 * (random.random::<f64>() - 0.5)) * SPACING
        });
        flow.density.push(equation_of_state.density(1500.0 * GRAVITY * (height - position[D - 1]).max(0.0)));
        flow.position.push(position);
        flow.velocity.push(Vector::zeros());
        flow.mass.push(1500.0 * SPACING.powi(D as i32));
        flow.stress.push(Tensor::zeros());
    }
    let mut domain = Domain { axes: [AxisBoundary::Open; D] };
    domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
    if D == 3 {
        domain.axes[1] = AxisBoundary::Periodic { lower: 0.0, upper: cells[1] as f64 * SPACING };
    }
    let walls = vec![Wall::still(D - 1, 0.0, 1.0)];
    let reach = Vector::<D>::from_fn(|axis, _| (cells[axis] as f64 + 30.0) * SPACING);
    let wall_particles = wall::fill(&walls, &domain, (Vector::zeros(), reach), SPACING, 4);
    let mut gravity = Vector::zeros();
    gravity[D - 1] = -GRAVITY;
    let scene = Scene {
        flow,
        walls,
        wall_particles,
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain,
        gravity,
        spacing: SPACING,
        equation_of_state,
        rheology,
        numerics,
    };
    Simulation::new(scene).expect("a valid scene")
}

fn advance<const D: usize>(simulation: &mut Simulation<D>, steps: usize)
where
    Simulation<D>: Compiled<D>,
{
    for _ in 0..steps {
        if let Err(divergence) = simulation.step() {
            panic!("{divergence}");
        }
    }
}

/// Allocations in `steps` steps after `warm_up` steps, all inside a pool of `threads` threads.
fn allocations<const D: usize>(
    cells: [usize; D],
    numerics: Numerics,
    rheology: Rheology,
    threads: usize,
    (warm_up, steps): (usize, usize),
) -> u64
where
    Simulation<D>: Compiled<D>,
{
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    pool.install(|| {
        let mut simulation = column(cells, numerics, rheology);
        advance(&mut simulation, warm_up);
        let (before, searches) = (ALLOCATIONS.load(Ordering::SeqCst), simulation.neighbour_searches());
        advance(&mut simulation, steps);
        let found = ALLOCATIONS.load(Ordering::SeqCst) - before;
        let searches = simulation.neighbour_searches() - searches;
        assert!(searches >= 3, "only {searches} neighbour searches in the counted steps");
        found
    })
}

/// Grains in columns that eddies carry.
fn suspended() -> IncompressibleScene<2> {
    let mut scene = water::scene(water::Kind::Columns, 1, 3);
    let Some(Sediment { pressure: SedimentPressure::Dilatant { turbulent_schmidt, .. }, .. }) = &mut scene.sediment
    else {
        panic!("grains that dilate")
    };
    *turbulent_schmidt = 0.7;
    scene
}

/// The same of an incompressible run.
fn projection_allocations(scene: IncompressibleScene<2>, threads: usize, (warm_up, steps): (usize, usize)) -> u64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    pool.install(|| {
        let mut simulation = two_phases::simulation(scene);
        two_phases::advance(&mut simulation, warm_up);
        let (before, searches) = (ALLOCATIONS.load(Ordering::SeqCst), simulation.cost().searches);
        two_phases::advance(&mut simulation, steps);
        let found = ALLOCATIONS.load(Ordering::SeqCst) - before;
        assert!(simulation.cost().searches >= searches + 3, "too few searches in the counted steps");
        found
    })
}

#[test]
fn a_step_after_warm_up_does_not_allocate() {
    let law = MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };
    let grains = Rheology::MuI(law);
    let syrup = Rheology::Newtonian(Newtonian { viscosity: 5.0 });
    let pairwise =
        Numerics { momentum_operator: MomentumOperator::Pairwise, viscous_courant: 0.125, ..Numerics::paper() };
    let implicit = Numerics { viscous_step: ViscousStep::Implicit, ..Numerics::default() };
    let paste = Rheology::RegularisedMuI(law.regularised(0.1));
    let before = ALLOCATIONS.load(Ordering::SeqCst);
    drop(std::hint::black_box(vec![0_u8; 100]));
    assert!(ALLOCATIONS.load(Ordering::SeqCst) > before, "the counter counts");
    // 8550 particles: more than twice the shortest part of every parallel loop
    for threads in [1, 2] {
        let plane = allocations([95, 90], Numerics::default(), grains, threads, (250, 100));
        assert_eq!(plane, 0, "allocations in 2-D on {threads} threads");
    }
    let paper = allocations([40, 60], pairwise, syrup, 2, (500, 200));
    assert_eq!(paper, 0, "allocations of the pairwise operators");
    let solved = allocations([95, 90], implicit, paste, 2, (250, 100));
    assert_eq!(solved, 0, "allocations of the implicit viscous step");
    let space = allocations([12, 8, 24], Numerics::default(), grains, 2, (150, 50));
    assert_eq!(space, 0, "allocations in 3-D");
    for scene in [two_phases::bed([40, 40], 6, 3), suspended()] {
        assert_eq!(projection_allocations(scene, 2, (300, 300)), 0, "allocations of an incompressible step");
    }
}
