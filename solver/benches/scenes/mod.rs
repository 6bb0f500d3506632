#![allow(dead_code, reason = "each bench takes what it needs")]

//! The blocks that the benches step: a dam at rest beside a symmetry plane, and a periodic block that drifts.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{MuI, Newtonian, Rheology};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{Contact, MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::walls::{Wall, WallTreatment, wall};
use rand::{RngExt, SeedableRng};

const GRAVITY: f64 = 9.81;
/// Height of every dam `[m]`; the width is the same, so that the spacing alone changes with the size.
const HEIGHT: f64 = 1.0;
const DENSITY: f64 = 1000.0;

/// Material and numerics of a benchmark scene.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Law {
    /// Plain WCSPH: pairwise operators, no coupling, no damping but (15), about 20 neighbours.
    Newtonian,
    /// The recipe's step at a smoothing length over spacing `[-]`.
    MuI {
        /// h/Δ `[-]`: 1.3 gives about 20 neighbours, 1.5 about 28.
        smoothing_ratio: f64,
    },
}

impl Law {
    pub(crate) fn name(self) -> String {
        match self {
            Self::Newtonian => "newtonian_h_over_dx_1.3".to_owned(),
            Self::MuI { smoothing_ratio } => format!("mu_i_h_over_dx_{smoothing_ratio}"),
        }
    }

    fn numerics(self) -> Numerics {
        match self {
            Self::Newtonian => Numerics {
                momentum_operator: MomentumOperator::Pairwise,
                density_coupling: 0.0,
                hourglass: 0.0,
                wall_treatment: WallTreatment::Paper,
                contact: Contact::None,
                smoothing_ratio: 1.3,
                ..Numerics::default()
            },
            Self::MuI { smoothing_ratio } => Numerics { smoothing_ratio, ..Numerics::default() },
        }
    }

    fn rheology(self) -> Rheology {
        match self {
            Self::Newtonian => Rheology::Newtonian(Newtonian { viscosity: 0.001 }),
            Self::MuI { .. } => Rheology::MuI(MuI {
                static_friction: 0.382,
                limiting_friction: 0.643,
                reference_inertia: 0.279,
                grain_diameter: 2e-3,
                grain_density: 1600.0,
            }),
        }
    }
}

/// A square block or a cube of about `size` particles on a bed, hydrostatic and at rest beside its symmetry planes, free to
/// collapse on its other sides.
pub(crate) fn dam_break<const D: usize>(size: usize, law: Law) -> Scene<D> {
    let cells = (size as f64).powf(1.0 / D as f64).round() as usize;
    let spacing = HEIGHT / cells as f64;
    let equation_of_state = EquationOfState {
        reference_density: DENSITY,
        bulk_modulus: 50.0 * DENSITY * GRAVITY * HEIGHT,
        tension: Tension::Cut,
    };
    let pressure = |place: &Vector<D>| DENSITY * GRAVITY * (HEIGHT - place[1]).max(0.0);
    let flow = lattice(cells, spacing, |place| equation_of_state.density(pressure(place)));
    let mut domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }; D] };
    domain.axes[1] = AxisBoundary::Open;
    let walls = vec![Wall::still(1, 0.0, 1.0)];
    let mut gravity = Vector::zeros();
    gravity[1] = -GRAVITY;
    let extent = (Vector::zeros(), Vector::repeat(1.5 * HEIGHT));
    let wall_particles = wall::fill(&walls, &domain, extent, spacing, 4);
    Scene {
        flow,
        walls,
        wall_particles,
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain,
        gravity,
        spacing,
        equation_of_state,
        rheology: law.rheology(),
        numerics: law.numerics(),
    }
}

/// The same block on its way: its particles disordered, spreading along the bed as fast as its top sinks, so that the
/// fastest particle has about a fourteenth of the speed of sound and the list is searched every few steps.
pub(crate) fn spreading<const D: usize>(size: usize, law: Law) -> Scene<D> {
    let mut scene = dam_break::<D>(size, law);
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(11);
    let sinking = 1.3 / HEIGHT;
    for (position, velocity) in scene.flow.position.iter_mut().zip(&mut scene.flow.velocity) {
        for axis in 0..D {
            position[axis] += 0.4 * (random.random::<f64>() - 0.5) * scene.spacing;
            // without divergence
            velocity[axis] = if axis == 1 { -sinking } else { sinking / (D - 1) as f64 } * position[axis];
        }
    }
    scene
}

/// A periodic block of about `size` particles that moves by more than half a list skin in every step, and the same
/// block at rest.
pub(crate) fn drifting_and_resting(size: usize, smoothing_ratio: f64) -> [Scene<2>; 2] {
    let cells = (size as f64).sqrt().round() as usize;
    let mut resting = dam_break::<2>(cells * cells, Law::MuI { smoothing_ratio });
    resting.flow = lattice(cells, resting.spacing, |_| DENSITY);
    resting.domain = Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: HEIGHT }; 2] };
    (resting.walls, resting.wall_particles) = (Vec::new(), Vec::new());
    resting.gravity = Vector::zeros();
    let mut drifting = resting.clone();
    // Δt v = 0.4 h v/c must exceed half the skin, 0.1 h, and stay below the advective bound of 0.25 h
    drifting.flow.velocity.fill(Vector::<2>::new(0.4, 0.3) * resting.equation_of_state.sound_speed());
    [drifting, resting]
}

/// Slope of a layer of beads `[-]`: tan 24°.
const SLOPE: f64 = 0.4452;
/// Solid fraction of beads `[-]`.
const SOLID_FRACTION: f64 = 0.6;

/// A layer of about `size` particles of beads, two per diameter, that moves down a slope with Bagnold's profile and its stress
/// whatever its law: periodic along the slope and four times as long as high.
pub(crate) fn on_a_slope(size: usize, beads: MuI, rheology: Rheology) -> Scene<2> {
    let spacing = 0.5 * beads.grain_diameter;
    let rows = (size as f64 / 4.0).sqrt().round() as usize;
    let (height, length) = (rows as f64 * spacing, (4 * rows) as f64 * spacing);
    let density = SOLID_FRACTION * beads.grain_density;
    let equation_of_state = EquationOfState {
        reference_density: density,
        bulk_modulus: 50.0 * density * GRAVITY * height,
        tension: Tension::Cut,
    };
    let across = GRAVITY / SLOPE.hypot(1.0);
    let pressure = |y: f64| density * across * (height - y).max(0.0);
    let inertia = beads.reference_inertia * (SLOPE - beads.static_friction) / (beads.limiting_friction - SLOPE);
    let rate = |y: f64| inertia * (pressure(y) / beads.grain_density).sqrt() / beads.grain_diameter;
    // the rate goes with the square root of the depth
    let velocity = |y: f64| (rate(0.0) * height - rate(y) * (height - y)) / 1.5;
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(13);
    let mut flow = Flow::default();
    for index in 0..4 * rows * rows {
        let cell = [index % (4 * rows), index / (4 * rows)];
        let place = |cell: usize, shift: f64| (cell as f64 + 0.5 + 0.2 * (shift - 0.5)) * spacing;
        let position = Vector::<2>::new(place(cell[0], random.random()), place(cell[1], random.random()));
        let (y, shear) = (position[1], SLOPE * pressure(position[1]));
        flow.density.push(equation_of_state.density(pressure(y)));
        flow.mass.push(flow.density[index] * spacing * spacing);
        flow.position.push(position);
        flow.velocity.push(Vector::<2>::new(velocity(y), 0.0));
        flow.stress.push(Tensor::<2>::new(0.0, shear, shear, 0.0));
        flow.field.extend(rheology.field_in_flow(rate(y), SLOPE));
    }
    let along = AxisBoundary::Periodic { lower: 0.0, upper: length };
    let domain = Domain { axes: [along, AxisBoundary::Open] };
    let walls = vec![Wall::still(1, 0.0, 1.0)];
    let extent = (Vector::zeros(), Vector::<2>::new(length, height));
    Scene {
        wall_particles: wall::fill(&walls, &domain, extent, spacing, 4),
        walls,
        domain,
        gravity: Vector::<2>::new(SLOPE, -1.0) * across,
        ..Scene::unbounded(flow, spacing, equation_of_state, rheology)
    }
}

/// A slightly jittered lattice of `cells` particles along each axis, at rest.
fn lattice<const D: usize>(cells: usize, spacing: f64, density: impl Fn(&Vector<D>) -> f64) -> Flow<D> {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
    let mut flow = Flow::default();
    for index in 0..cells.pow(D as u32) {
        let mut rest = index;
        let position = Vector::<D>::from_fn(|_, _| {
            let cell = rest % cells;
            rest /= cells;
            (cell as f64 + 0.5 + 0.1 * (random.random::<f64>() - 0.5)) * spacing
        });
        flow.density.push(density(&position));
        flow.position.push(position);
        flow.velocity.push(Vector::zeros());
        flow.mass.push(DENSITY * spacing.powi(D as i32));
        flow.stress.push(Tensor::zeros());
    }
    flow
}
