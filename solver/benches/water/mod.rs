//! Scenes of the incompressible model at several sizes.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, ColumnNumerics, DragForm, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Strata, Stratification, Turbulence,
};
use bagnold_solver::material::dilatancy::Dilatancy;
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology, RootMuI};
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::{GrainRoughness, MixingLength, MixingLengthShape, RoughWall, VON_KARMAN};
use bagnold_solver::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const GRAVITY: f64 = 9.81;
const SLOPE: f64 = 0.03;
/// Depth of the water above the bed `[m]`.
const DEPTH: f64 = 0.046;
/// Depth of the bed of grains below it `[m]`.
const BED: f64 = 0.08;
/// Spacing of the fluid in the smallest scene `[m]`.
const SPACING: f64 = 0.002;
/// Periods along the bed without and with grains `[m]`, which give both some 1400 particles.
const PERIOD: f64 = 0.12;
const BED_PERIOD: f64 = 0.04;
/// Grain diameter and spacing of the sediment `[m]`.
const GRAIN: f64 = 0.005;
const LAW: MixingLength = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 6e-4 };
const WALL: RoughWall = RoughWall { sand_roughness: GRAIN };

/// Benchmark scenes with water.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Displaced particles of water that come to rest, laminar.
    Still,
    /// Turbulent water over a fixed rough bed.
    Clear,
    /// The same over 80 mm of 5 mm grains with water between: a second phase of pairs.
    Bed,
    /// Water over grains that dilate, in columns.
    Columns,
}

impl Kind {
    /// All kinds.
    pub(crate) const ALL: [Self; 4] = [Self::Still, Self::Clear, Self::Bed, Self::Columns];

    /// Name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Clear => "clear",
            Self::Bed => "bed",
            Self::Columns => "columns",
        }
    }
}

/// A lattice from `bottom` to `top` with a jitter, and four rows of wall particles below it.
fn lattice(
    (period, bottom, top): (f64, f64, f64),
    spacing: f64,
    jitter: f64,
    random: &mut Pcg64Mcg,
) -> (Vec<Vector<2>>, Vec<Vector<2>>) {
    let (columns, rows) = ((period / spacing).round() as i32, ((top - bottom) / spacing).round() as i32);
    let place = |column, row| Vector::<2>::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * spacing;
    let set = |rows: std::ops::Range<i32>| rows.flat_map(|row| (0..columns).map(move |column| (column, row)));
    let mut jitter = || jitter * spacing * (2.0 * random.random::<f64>() - 1.0);
    let origin = Vector::<2>::new(0.0, bottom);
    let free = set(0..rows).map(|(column, row)| origin + place(column, row) + Vector::<2>::new(jitter(), jitter()));
    (free.collect(), set(-4..0).map(|(column, row)| origin + place(column, row)).collect())
}

/// A scene of some 1400 particles times the square of `refinement`: water of a finer spacing, or, with grains, of a longer
/// period.
pub(crate) fn scene(kind: Kind, refinement: u32, seed: u64) -> IncompressibleScene<2> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    match kind {
        Kind::Still | Kind::Clear => water(kind, refinement, &mut random),
        Kind::Bed => over_grains(refinement, &mut random),
        Kind::Columns => over_columns(refinement, &mut random),
    }
}

/// Velocity of the logarithmic law, somewhat slower `[m/s]`.
fn speed(z: f64) -> f64 {
    let friction_velocity = (GRAVITY * DEPTH * SLOPE).sqrt();
    let logarithm = ((z.max(0.0) + LAW.origin_offset) / (GRAIN / 30.0)).ln();
    if z > 0.0 { 0.9 * friction_velocity / VON_KARMAN * logarithm } else { 0.0 }
}

fn periodic(period: f64) -> Domain<2> {
    Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: period }, AxisBoundary::Open] }
}

fn water(kind: Kind, refinement: u32, random: &mut Pcg64Mcg) -> IncompressibleScene<2> {
    let spacing = SPACING / f64::from(refinement);
    let still = kind == Kind::Still;
    let (position, wall) = lattice((PERIOD, 0.0, DEPTH), spacing, if still { 0.1 } else { 1e-3 }, random);
    let velocity = position.iter().map(|x| Vector::<2>::new(if still { 0.0 } else { speed(x[1]) }, 0.0)).collect();
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position, velocity },
            wall,
            spacing,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: if still {
                Turbulence::Laminar
            } else {
                Turbulence::MixingLength { level: 0.0, depth: DEPTH, law: LAW }
            },
            bed: if still {
                Bed::NoSlip(0.0)
            } else {
                Bed::Rough { level: 0.0, origin_offset: LAW.origin_offset, law: WALL }
            },
            gravity: Vector::<2>::new(if still { 0.0 } else { GRAVITY * SLOPE }, -GRAVITY),
        },
        sediment: None,
        solid_fraction: SolidFraction::Overlapping,
        domain: periodic(PERIOD),
        numerics: ProjectionNumerics::default(),
    }
}

fn over_grains(refinement: u32, random: &mut Pcg64Mcg) -> IncompressibleScene<2> {
    let period = BED_PERIOD * f64::from(refinement * refinement);
    let (position, wall) = lattice((period, -BED, DEPTH), SPACING, 1e-3, random);
    let velocity = position.iter().map(|x| Vector::<2>::new(speed(x[1]), 0.0)).collect();
    let (grains, fixed) = lattice((period, -BED, 0.0), GRAIN, 1e-3, random);
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position, velocity },
            wall,
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::MixingLength { level: 0.0, depth: DEPTH, law: LAW },
            bed: Bed::NoSlip(-BED),
            gravity: Vector::<2>::new(GRAVITY * SLOPE, -GRAVITY),
        },
        sediment: Some(Sediment {
            filling: vec![1.0; grains.len()],
            particles: ParticleSet { velocity: vec![Vector::zeros(); grains.len()], position: grains },
            wall: fixed,
            spacing: GRAIN,
            smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
            density: 2600.0,
            grain_diameter: GRAIN,
            drag_diameter: GRAIN,
            law: Rheology::CoulombBingham(CoulombBingham {
                yield_stress: 7.4,
                friction: 0.6,
                plastic_viscosity: 0.3,
                regularisation_rate: 0.01,
                largest_viscosity: 1e4,
            }),
            load: SedimentLoad::Packed { level: -GRAIN, buoyant_weight: 1600.0 * GRAVITY },
            pressure: SedimentPressure::Incompressible,
            drag: DragLaw::MorsiAlexander,
            drag_form: DragForm::Grain,
            drag_smoothing_length: 3e-3,
            gravity: Vector::<2>::new(GRAVITY * SLOPE, -GRAVITY * 1600.0 / 2600.0),
        }),
        solid_fraction: SolidFraction::Overlapping,
        domain: periodic(period),
        numerics: ProjectionNumerics::default(),
    }
}

/// A bed of 8 mm, the lower 4 mm held, under 12 mm of sheared water; 1 mm particles.
fn over_columns(refinement: u32, random: &mut Pcg64Mcg) -> IncompressibleScene<2> {
    let (spacing, packing, density) = (1e-3, 0.6, 2600.0);
    let count = 60 * refinement * refinement;
    let period = spacing * f64::from(count);
    let (position, wall) = lattice((period, -8e-3, 12e-3), spacing, 1e-3, random);
    let velocity = position.iter().map(|x| Vector::<2>::new((60.0 * (x[1] + 2e-3)).max(0.0), 0.0)).collect();
    let (grains, mut fixed) = lattice((period, -4e-3, 0.0), spacing, 0.3, random);
    let below = fixed.clone();
    fixed.extend(below.iter().map(|x| x - Vector::<2>::new(0.0, 4.0 * spacing)));
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position, velocity },
            wall,
            spacing,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(-8e-3),
            gravity: Vector::<2>::new(0.3, -GRAVITY),
        },
        sediment: Some(Sediment {
            filling: vec![packing; grains.len()],
            particles: ParticleSet { velocity: vec![Vector::zeros(); grains.len()], position: grains },
            wall: fixed,
            spacing,
            smoothing_ratio: 1.2,
            density,
            grain_diameter: GRAIN,
            drag_diameter: GRAIN,
            law: Rheology::RootMuI(RootMuI {
                static_friction: 0.35,
                limiting_friction: 0.97,
                reference_inertia: 0.69,
                grain_diameter: GRAIN,
                grain_density: density,
                regularisation_rate: 5e-3,
            }),
            load: SedimentLoad::Stratified,
            pressure: SedimentPressure::Dilatant {
                dilatancy: Dilatancy { dilation: 0.31, packing, grain_diameter: GRAIN, grain_density: density },
                fixed_filling: packing,
                columns: ColumnNumerics::default(),
                turbulent_schmidt: 0.0,
            },
            drag: DragLaw::DiFelice,
            drag_form: DragForm::Exchange,
            drag_smoothing_length: 1.2 * spacing,
            gravity: Vector::<2>::new(0.3, -6.0),
        }),
        solid_fraction: SolidFraction::Averaged(Stratification::of(Strata {
            base: -8e-3,
            interval: 2.5e-4,
            solid_fraction: vec![0.0; 80],
            packing,
            buoyant_weight: packing * 1600.0 * GRAVITY,
            bed_level: 0.0,
            depth: 12e-3,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: GRAIN,
        })),
        domain: periodic(period),
        numerics: ProjectionNumerics { time_step: 1.5e-4, fluctuation_rate: 500.0, ..ProjectionNumerics::default() },
    }
}
