//! Pairs against brute force: every pair of nearest images, with no cells and no wrapping.

use super::{SPACING, grains, random, symmetric, water};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::IncompressibleSimulation;
use bagnold_solver::internals::incompressible::{
    Across, LaneList, Pairs, Periods, Phase, Sources, measure, search_and_measure, search_room, state, state_mut,
};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::lanes::{InstructionSet, LanePass, Lanes};
use bagnold_solver::vector::{Tensor, Vector};
use rand::RngExt;

/// Sources within `reach` of every target with their separations, by trying every image.
pub(super) fn by_force<const D: usize>(
    targets: &[Vector<D>],
    sources: &[Vector<D>],
    which: Sources,
    domain: &Domain<D>,
    reach: f64,
) -> Vec<Vec<(u32, Vector<D>)>> {
    let period = |axis: usize| match domain.axes[axis] {
        AxisBoundary::Periodic { lower, upper } => upper - lower,
        _ => 0.0,
    };
    let mut all = Vec::new();
    for (a, target) in targets.iter().enumerate() {
        let mut near = Vec::new();
        for (b, source) in sources.iter().enumerate() {
            if which == Sources::Same && a == b {
                continue;
            }
            let images = (0..3_usize.pow(D as u32)).map(|code| {
                let mut rest = code;
                target - source
                    + Vector::<D>::from_fn(|axis, _| {
                        let turn = (rest % 3) as f64 - 1.0;
                        rest /= 3;
                        turn * period(axis)
                    })
            });
            let nearest = images.min_by(|a, b| a.norm().total_cmp(&b.norm())).expect("an image");
            if nearest.norm() < reach {
                near.push((b as u32, nearest));
            }
        }
        all.push(near);
    }
    all
}

fn compare<const D: usize>(
    pairs: &Pairs<D>,
    expected: &[Vec<(u32, Vector<D>)>],
    kernel: &Kernel<D>,
    what: &str,
) -> usize {
    let mut count = 0;
    for (a, expected) in expected.iter().enumerate() {
        let mut found: Vec<_> = pairs.of(a).iter().collect();
        found.sort_by_key(|pair| pair.source);
        let names: Vec<u32> = found.iter().map(|pair| pair.source).collect();
        assert_eq!(names, expected.iter().map(|pair| pair.0).collect::<Vec<_>>(), "{what}: sources of target {a}");
        for (pair, (_, separation)) in found.iter().zip(expected) {
            assert!((pair.separation - separation).norm() < 1e-13, "{what}");
            assert!((pair.value - kernel.value_at(separation.norm())).abs() < 1e-9 * kernel.value_at(0.0), "{what}");
            let factor = kernel.gradient_factor_at(separation.norm());
            assert!((pair.gradient - factor).abs() < 1e-9 * kernel.gradient_factor_at(0.0).abs(), "{what}");
        }
        count += expected.len();
    }
    count
}

/// A list against the candidates within reach, which come first, and all of them.
fn compare_list<const D: usize>(list: &LaneList<D>, near: &[Vec<(u32, Vector<D>)>], all: &[Vec<(u32, Vector<D>)>]) {
    for (a, (near, all)) in near.iter().zip(all).enumerate() {
        let sorted = |candidates: &[usize]| {
            let mut names: Vec<u32> = candidates.iter().map(|&b| b as u32).collect();
            names.sort_unstable();
            names
        };
        let names = |expected: &[(u32, Vector<D>)]| expected.iter().map(|pair| pair.0).collect::<Vec<_>>();
        let found: Vec<usize> = list.of(a).collect();
        assert_eq!(sorted(&found), names(all), "candidates of target {a}");
        assert_eq!(sorted(&found[..near.len()]), names(near), "first candidates of target {a}");
    }
}

fn check<const D: usize>(periods: [Option<f64>; D], which: Sources) {
    let kernel = Kernel::<D>::new(KernelShape::CubicSpline, 0.5);
    let reach = kernel.support();
    let radius = 1.2 * reach;
    let lower = -0.3;
    let axes = periods.map(|period| match period {
        Some(length) => AxisBoundary::Periodic { lower, upper: lower + length },
        None => AxisBoundary::Open,
    });
    let domain = Domain { axes };
    let mut random = random(31);
    let mut set = |count: usize, spread: f64| -> Vec<Vector<D>> {
        (0..count)
            .map(|_| Vector::from_fn(|axis, _| lower + periods[axis].unwrap_or(spread) * random.random::<f64>()))
            .collect()
    };
    // targets reach beyond an open axis' sources
    let sources = set(150, 6.0);
    let targets = if which == Sources::Same { sources.clone() } else { set(120, 9.0) };
    let (mut grid, mut list, mut pairs) = search_room();
    let wrapped = Periods::of(&domain);
    grid.sort(&sources, &domain, radius);
    let expected = by_force(&targets, &sources, which, &domain, reach);
    list.search(&targets, &sources, which, &grid, &wrapped, reach, radius - reach);
    compare_list(&list, &expected, &by_force(&targets, &sources, which, &domain, radius));
    if which == Sources::Other {
        pairs.search(&targets, &sources, &grid, &wrapped, radius);
        pairs.measure(&targets, &sources, &wrapped, &kernel);
        let count = compare(&pairs, &expected, &kernel, &format!("{periods:?}"));
        assert!(count > 100, "only {count} pairs along {periods:?}");
    }
}

/// Pass that finds whether eight particles at one position may have pairs across the end of a period.
struct OfEight<'a> {
    periods: &'a Periods<2>,
    position: Vector<2>,
    reach: f64,
    across: &'a mut Across,
}

impl LanePass for OfEight<'_> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let position = [0, 1].map(|axis| V::splat(self.position[axis]));
        *self.across = self.periods.across(&position, self.reach);
    }
}

#[test]
fn away_from_the_end_of_a_period_the_shortest_way_is_the_difference() {
    let (lower, length, reach) = (-0.3, 1.0, 0.2);
    let axes = [AxisBoundary::Periodic { lower, upper: lower + length }, AxisBoundary::Open];
    let periods = Periods::of(&Domain::<2> { axes });
    let mut random = random(5);
    let mut place = || Vector::<2>::new(lower + length * random.random::<f64>(), random.random::<f64>());
    let mut seen = [0; 2];
    for _ in 0..2000 {
        let (a, mut b) = (place(), place());
        // within a step particles leave the period
        b[0] += 0.4 * reach * (b[1] - 0.5);
        let mut across = Across::None;
        InstructionSet::best().run(OfEight { periods: &periods, position: a, reach, across: &mut across });
        let edge = (a[0] - lower).min(lower + length - a[0]);
        assert_eq!(across == Across::Some, edge < 1.5 * reach, "{a}");
        let (found, shortest) = (periods.shortest_if::<f64>(across, (a - b).into()), periods.separation(&a, &b));
        // what is out of reach by both ways may differ
        if Vector::from(found).norm() < reach || shortest.norm() < reach {
            assert_eq!(Vector::from(found), shortest);
            seen[usize::from(across == Across::Some)] += 1;
        }
    }
    assert!(seen.iter().all(|&seen| seen > 20), "{seen:?}");
}

#[test]
fn periods_of_one_two_three_and_many_cells() {
    // cells are 1.2 long; a period must hold two reaches of 1
    for which in [Sources::Same, Sources::Other] {
        for along in [2.0, 2.41, 3.61, 12.0] {
            check([Some(along), None], which);
            for across in [2.0, 2.41, 3.61, 12.0] {
                check([Some(along), Some(across)], which);
            }
            check([Some(along), Some(2.5), None], which);
        }
        check([None, None], which);
        check([None, Some(3.7), Some(2.1)], which);
    }
}

/// The pairs of a phase against brute force at its present positions, and the sums over them.
fn check_phase(phase: &Phase<2>, domain: &Domain<2>, what: &str) {
    let (reach, periods) = (phase.kernel.support(), Periods::of(domain));
    let largest = phase.kernel.gradient_factor_at(0.0).abs();
    let of = |sources: &[Vector<2>], which| by_force(&phase.position, sources, which, domain, reach);
    let (free, walls) = (of(&phase.position, Sources::Same), of(&phase.wall, Sources::Other));
    for a in 0..phase.len() {
        let (mut sums, mut arms) = ((0.0, 0.0), Tensor::<2>::zeros());
        // F of free pairs is found in single precision: a few roundings of 6e-8
        let found = [
            (phase.free_pairs(a, &periods).collect::<Vec<_>>(), &free[a], 5e-7),
            (phase.wall_pairs(a, &periods).collect::<Vec<_>>(), &walls[a], 1e-9),
        ];
        for (mut found, expected, tolerance) in found {
            found.sort_by_key(|pair| pair.0);
            let names: Vec<u32> = found.iter().map(|pair| pair.0 as u32).collect();
            assert_eq!(names, expected.iter().map(|pair| pair.0).collect::<Vec<_>>(), "{what}: sources of target {a}");
            for ((_, separation, weight), (_, expected)) in found.iter().zip(expected) {
                assert!((separation - expected).norm() < 1e-13, "{what}");
                let factor = phase.kernel.gradient_factor_at(expected.norm());
                assert!((weight - factor).abs() < tolerance * largest, "{what}: {weight} for {factor}");
                sums.0 += phase.kernel.value_at(expected.norm());
                sums.1 -= factor * expected.norm_squared();
                arms -= expected * expected.transpose() * (factor * phase.lattice_volume);
            }
        }
        let lattice = (phase.lattice_volume, phase.lattice.concentration * 0.997);
        let concentration = (sums.0 + phase.kernel.value_at(0.0)) * lattice.0 / lattice.1;
        // kernel values and factors are single precision, which a few roundings leave 5e-7; a pair that is missed leaves a thousandth
        assert!((phase.concentration[a] - concentration).abs() < 5e-7, "{what}: concentration of {a}");
        let moment = if concentration < 0.95 { phase.lattice.gradient } else { 0.5 * lattice.0 * sums.1 };
        assert!(
            (phase.moment[a] - moment).abs() < 5e-7,
            "{what}: moment of {a}: {} for {moment}, concentration {concentration}",
            phase.moment[a]
        );
        if concentration > 0.98 {
            let uneven = phase.anisotropy[a] - (arms / moment - Tensor::identity());
            assert!(uneven.norm() < 2e-6, "{what}: anisotropy of {a}");
        }
    }
}

fn check_all(simulation: &IncompressibleSimulation<2>, what: &str) {
    let domain = simulation.scene().domain;
    check_phase(&state(simulation).phases.fluid, &domain, what);
    if let Some(sediment) = &state(simulation).phases.sediment {
        check_phase(sediment, &domain, what);
        let reach = state(simulation).exchange.reach();
        let kernel = Kernel::new(KernelShape::CubicSpline, 0.5 * reach);
        let (fluid, grains) = (&state(simulation).phases.fluid.position, &sediment.position);
        let of = |targets, sources| by_force(targets, sources, Sources::Other, &domain, reach);
        compare(&state(simulation).exchange.of_sediment, &of(grains, fluid), &kernel, what);
        compare(&state(simulation).exchange.of_fluid, &of(fluid, grains), &kernel, what);
    }
}

/// Moves all particles by a field of displacements and puts them back into their periods.
fn displace(simulation: &mut IncompressibleSimulation<2>, field: impl Fn(&Vector<2>) -> Vector<2>) {
    let domain = simulation.scene().domain;
    for phase in state_mut(simulation).phases.all_mut() {
        for particle in 0..phase.len() {
            let by = field(&phase.position[particle]);
            phase.displace(particle, by);
        }
    }
    state_mut(simulation).phases.wrap(&domain);
}

#[test]
fn no_pair_is_missed_in_a_shear_across_a_period() {
    // u jumps across the upper period and drifts through it, so that the layers there meet others all the time
    let cells = [10, 16];
    let mut scene = water(cells, 0.2, true, 3);
    scene.sediment = Some(grains([5, 8], 0.2, 4));
    let height = cells[1] as f64 * SPACING;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    for step in 0..60 {
        displace(&mut simulation, |x| Vector::<2>::new(0.15 * x[1] / height, 0.03) * SPACING);
        search_and_measure(state_mut(&mut simulation));
        check_all(&simulation, &format!("step {step}"));
    }
    let searches = simulation.cost().searches;
    assert!((5..50).contains(&searches), "{searches} searches: neither never nor always");
}

#[test]
fn no_pair_is_missed_when_a_drop_falls_onto_the_surface() {
    let mut scene = water([12, 8], 0.1, false, 5);
    // alone in its layer, with empty ones below
    scene.fluid.particles.position.push(Vector::<2>::new(0.06, 0.40));
    scene.fluid.particles.velocity.push(Vector::zeros());
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    let drop = state(&simulation).phases.fluid.len() - 1;
    for step in 0..100 {
        displace(
            &mut simulation,
            |x| {
                if x[1] > 0.09 { Vector::<2>::new(0.0, -0.4 * SPACING) } else { Vector::zeros() }
            },
        );
        search_and_measure(state_mut(&mut simulation));
        check_all(&simulation, &format!("step {step}"));
    }
    assert!(
        state(&simulation).phases.fluid.free_pairs(drop, &state(&simulation).search.periods).count() > 3,
        "the drop has arrived"
    );
}

#[test]
fn no_pair_is_missed_within_a_step_of_a_run_with_strong_shear() {
    let mut scene = water([14, 20], 0.05, false, 6);
    let mut random = random(7);
    for (x, u) in scene.fluid.particles.position.iter().zip(&mut scene.fluid.particles.velocity) {
        *u = Vector::<2>::new(if x[1] > 0.1 { 2.0 } else { -2.0 } + 0.3 * symmetric(&mut random), 0.0);
    }
    scene.fluid.wall.clear();
    scene.fluid.gravity = Vector::zeros();
    scene.numerics.time_step = 2e-3;
    // searched for, but not moved: the candidates of the end of a step are those of its positions
    scene.numerics.shifting = 1e-15;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    for step in 0..25 {
        simulation.step().expect("a step");
        let searches = simulation.cost().searches;
        measure(state_mut(&mut simulation));
        assert_eq!(simulation.cost().searches, searches, "measured from the candidates of the step");
        check_phase(&state(&simulation).phases.fluid, &simulation.scene().domain, &format!("end of step {step}"));
    }
    assert!(simulation.cost().searches > 5);
}
