//! A bed of grains in columns under a stream; tests of whole steps, which are another crate, include this file too.

use crate::domain::{AxisBoundary, Domain};
use crate::incompressible::{
    Bed, ColumnNumerics, DragForm, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Strata, Stratification, Turbulence,
};
use crate::material::dilatancy::Dilatancy;
use crate::material::drag::DragLaw;
use crate::material::rheology::{Rheology, RootMuI};
use crate::material::suspension_viscosity::SuspensionViscosity;
use crate::material::turbulence::GrainRoughness;
use crate::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SPACING: f64 = 1e-3;
pub(crate) const PACKING: f64 = 0.6;
pub(crate) const DENSITY: f64 = 2600.0;
const DIAMETER: f64 = 5e-3;

const LAW: Rheology = Rheology::RootMuI(RootMuI {
    static_friction: 0.35,
    limiting_friction: 0.97,
    reference_inertia: 0.69,
    grain_diameter: DIAMETER,
    grain_density: DENSITY,
    regularisation_rate: 5e-3,
});

/// A bed of 8 mm, the lower 4 mm held, under 12 mm of water of a velocity.
pub(crate) fn scene(length: f64, velocity: impl Fn(f64) -> f64, seed: u64) -> IncompressibleScene<2> {
    let columns = (length / SPACING).round() as i32;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut rows = |from: i32, to: i32, jitter: f64| -> Vec<Vector<2>> {
        let site = |i: i32, k: i32| Vector::<2>::new(f64::from(i) + 0.5, f64::from(k) + 0.5);
        let mut displaced =
            |x: Vector<2>| (x + Vector::<2>::from_fn(|_, _| jitter * (2.0 * random.random::<f64>() - 1.0))) * SPACING;
        (from..to).flat_map(|k| (0..columns).map(move |i| site(i, k))).map(&mut displaced).collect()
    };
    let water = rows(-8, 12, 1e-3);
    let grains = rows(-4, 0, 0.3);
    let at_rest = vec![Vector::zeros(); grains.len()];
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet {
                velocity: water.iter().map(|x| Vector::<2>::new(velocity(x[1]), 0.0)).collect(),
                position: water,
            },
            wall: rows(-12, -8, 0.0),
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(-8e-3),
            gravity: Vector::<2>::new(0.3, -9.81),
        },
        sediment: Some(Sediment {
            filling: vec![PACKING; grains.len()],
            particles: ParticleSet { position: grains, velocity: at_rest },
            wall: rows(-11, -4, 0.0),
            spacing: SPACING,
            smoothing_ratio: 1.2,
            density: DENSITY,
            grain_diameter: DIAMETER,
            drag_diameter: DIAMETER,
            law: LAW,
            load: SedimentLoad::Stratified,
            pressure: SedimentPressure::Dilatant {
                dilatancy: Dilatancy {
                    dilation: 0.31,
                    packing: PACKING,
                    grain_diameter: DIAMETER,
                    grain_density: DENSITY,
                },
                fixed_filling: PACKING,
                columns: ColumnNumerics::default(),
                turbulent_schmidt: 0.0,
            },
            drag: DragLaw::DiFelice,
            drag_form: DragForm::Exchange,
            drag_smoothing_length: 1.2 * SPACING,
            gravity: Vector::<2>::new(0.3, -6.0),
        }),
        solid_fraction: SolidFraction::Averaged(Stratification::of(Strata {
            base: -8e-3,
            interval: 2.5e-4,
            solid_fraction: vec![0.0; 80],
            packing: PACKING,
            buoyant_weight: 15_696.0,
            bed_level: 0.0,
            depth: 12e-3,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: DIAMETER,
        })),
        domain: Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: length }, AxisBoundary::Open] },
        numerics: ProjectionNumerics { time_step: 1.5e-4, fluctuation_rate: 500.0, ..ProjectionNumerics::default() },
    }
}

/// The same with grains that eddies carry by a Schmidt number `[-]`, if it is not 0.
pub(crate) fn with_eddies(mut scene: IncompressibleScene<2>, schmidt: f64) -> IncompressibleScene<2> {
    let Some(Sediment { pressure: SedimentPressure::Dilatant { turbulent_schmidt, .. }, .. }) = &mut scene.sediment
    else {
        panic!("grains that dilate")
    };
    *turbulent_schmidt = schmidt;
    scene
}

pub(crate) fn shear_flow(height: f64) -> f64 {
    (60.0 * (height + 2e-3)).max(0.0)
}
