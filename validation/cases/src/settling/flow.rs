//! The flow: grains that settle in a periodic box of fluid, whose particles are as large as they are.

use super::probe::{Probe, SettlingObservation};
use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::settling::{GrainForm, SettlingGrains};
use crate::setup::{Lattice, rules};
use bagnold_solver::incompressible::{
    Continuity, DragSlip, MeanFlux, PressureSource, ProjectionNumerics, SurfaceTreatment,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::parameter::between;
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Solid fraction from which on Ergun's law is judged: it describes beds `[-]`.
const LEAST_BED: f64 = 0.2;

/// Solid fraction up to which a suspension stands for a grain alone `[-]`: 0.002 hinders by less than 1 %.
const DILUTE: f64 = 0.005;

/// Models of both phases: the bed-load paper's operators and the stabilised ones for a grain alone, volume fractions for a suspension.
pub(super) const FORMULATIONS: [&str; 3] = ["paper", "stabilised", "continuum"];

/// A grain alone, or a uniform suspension.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettlingFlow {
    /// The grains and their fluid.
    #[serde(flatten)]
    pub grains: SettlingGrains,
    /// Drag law. Ergun's has no grain alone, and begins at a solid fraction of 0.2.
    pub law: DragLaw,
    /// Solid fraction φ of a suspension `[-]`; up to 0.005 it stands for a grain alone.
    #[schemars(transform = between(1e-4, 0.64, "give at most 0.64, the share of the space that grains fill"))]
    pub solid_fraction: f64,
    /// Length of the box in diameters.
    pub columns: usize,
    /// Height of the box in diameters.
    pub rows: usize,
    /// Smoothing length of the drag in diameters `[-]`.
    #[schemars(transform = between(1.0, 10.0, "give 2 to 3, which suppress short waves"))]
    pub drag_smoothing_ratio: f64,
    /// Largest random displacement of a particle in spacings `[-]`; the paper's density source wants a lattice.
    #[schemars(transform = between(0.0, 0.5, "give 0.001 to break the symmetry, or 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Simulated time over the time in which grains get to their slip `[-]`: u_t ρ_s/(2 (ρ_s − ρ_f) g) of a grain alone,
    /// |u_r| ρ_s/((ρ_s − ρ_f) g) of a suspension.
    #[schemars(transform = between(10.0, 1e4, "give 40 for a single grain, 12 for a suspension"))]
    pub relaxation_times: f64,
    /// Numerics. Grains that share the pressure of the fluid (`continuity`) are a suspension, else one grain is alone.
    pub numerics: ProjectionNumerics,
}

impl Default for SettlingFlow {
    fn default() -> Self {
        Self {
            grains: SettlingGrains {
                grain_diameter: 1e-3,
                grain_density: 2600.0,
                fluid_density: 1000.0,
                kinematic_viscosity: 1e-6,
                gravity: 9.81,
            },
            law: DragLaw::WenYu,
            solid_fraction: 0.3,
            columns: 8,
            rows: 8,
            drag_smoothing_ratio: 2.0,
            jitter: 0.1,
            seed: 1,
            relaxation_times: 12.0,
            numerics: ProjectionNumerics {
                time_step: 1e-3,
                continuity: Continuity::Mixture,
                mean_flux: MeanFlux::Zero,
                // a thin place of a displaced lattice is no surface
                surface_threshold: 0.5,
                ..ProjectionNumerics::default()
            },
        }
    }
}

impl Flow for SettlingFlow {
    const RUNS: &'static str = include_str!("../../runs/settling.toml");
    type Observation = SettlingObservation;

    fn check(&self) -> Result<(), ParameterError> {
        let SettlingGrains { grain_density, fluid_density, .. } = self.grains;
        if grain_density <= fluid_density {
            let (rule, remedy) = ("greater than the fluid density", "give it in kg/m³; floating grains do not settle");
            return Err(ParameterError::field("grain_density", grain_density, rule, remedy));
        }
        self.check_operators()?;
        // periods that hold both kernels twice
        let least = (4.0 * self.drag_smoothing_ratio.max(self.numerics.smoothing_ratio)).ceil() as usize;
        for (name, value) in [("columns", self.columns), ("rows", self.rows)] {
            let remedy = "give 12 for a quick run; the box must be wider than both kernels";
            rules::count(name, value, least, 1000, remedy)?;
        }
        let (rule, remedy) = match (self.is_suspension(), covers(self.law, self.solid_fraction)) {
            (true, false) => ("a law for this `solid_fraction`", "choose another; \"ergun\" holds from 0.2 on"),
            _ if self.slip().is_some() => return Ok(()),
            (true, true) => {
                ("a law for this Reynolds number", "choose another; \"morsi-alexander\" holds up to 50 000")
            }
            (false, _) => (
                "a law for a single grain of its Reynolds number",
                "choose another law than \"ergun\", or \"morsi-alexander\" above a Reynolds number of 50 000",
            ),
        };
        Err(ParameterError::field("law", self.law.name(), rule, remedy))
    }

    fn variant(&self) -> Variant {
        let variant = Variant::of("formulation", self.formulation()).and("law", self.law.name());
        if self.is_suspension() { variant.and("solid_fraction", self.solid_fraction) } else { variant }
    }

    fn cost(&self) -> RunCost {
        let cells = self.lattice().len();
        let particles = if self.is_suspension() { 2 * cells } else { cells + 1 };
        RunCost::incompressible(particles as f64, self.duration() / self.numerics.time_step)
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<SettlingObservation>, ParameterError> {
        Probe::run(&self.scene(), self.grains, self.size(), self.duration(), progress)
    }
}

impl SettlingFlow {
    /// Whether it is a suspension; else it is a grain alone.
    pub fn is_suspension(&self) -> bool {
        self.numerics.continuity == Continuity::Mixture
    }

    /// Name of its model of both phases.
    pub(super) fn formulation(&self) -> &'static str {
        let [paper, stabilised, continuum] = FORMULATIONS;
        match self.numerics.drag_slip {
            _ if self.is_suspension() => continuum,
            DragSlip::Pair => paper,
            DragSlip::Mean => stabilised,
        }
    }

    /// Whether it is a suspension that stands for a grain alone.
    pub(super) fn is_dilute(&self) -> bool {
        self.is_suspension() && self.solid_fraction <= DILUTE
    }

    /// Slip at which weight and drag are in balance `[m/s]`; not a number beyond what the law covers.
    pub fn root(&self) -> f64 {
        self.slip().unwrap_or(f64::NAN)
    }

    fn slip(&self) -> Option<f64> {
        if self.is_suspension() {
            self.grains.hindered_slip(self.law, self.solid_fraction)
        } else {
            self.grains.terminal_velocity(self.law, GrainForm::Planar)
        }
    }

    /// Velocity of a grain alone as a sphere, c = ¾ `[m/s]`; that of Wen and Yu for Ergun's law.
    pub fn sphere_velocity(&self) -> f64 {
        let alone = |law| self.grains.terminal_velocity(law, GrainForm::Sphere);
        alone(self.law).or(alone(DragLaw::WenYu)).unwrap_or(f64::NAN)
    }

    /// Simulated time `[s]`. With its unit a grain alone gets to its velocity in Newton's regime, elsewhere within twice it; that
    /// of a suspension is Stokes' relaxation of a grain, an upper bound of the slip's.
    pub(super) fn duration(&self) -> f64 {
        let share = if self.is_suspension() { 1.0 } else { 0.5 };
        self.relaxation_times * (share * self.root() * self.grains.grain_density / self.grains.submerged_weight())
    }

    /// Lengths of the periods `[m]`.
    pub(super) fn size(&self) -> Vector<2> {
        Vector::<2>::new(self.lattice().length(), self.lattice().height())
    }

    /// Places of the fluid's particles.
    pub(super) fn lattice(&self) -> Lattice {
        Lattice { spacing: self.grains.grain_diameter, rows: self.rows, columns: self.columns, bottom: 0.0 }
    }

    /// The operators that grains alone and suspensions allow.
    fn check_operators(&self) -> Result<(), ParameterError> {
        let ProjectionNumerics { mean_flux, pressure_source, surface, drag_slip, .. } = self.numerics;
        if !self.is_suspension() {
            return rules::projection("numerics", &self.numerics);
        }
        let (field, value, rule) = match () {
            () if mean_flux == MeanFlux::Free => ("numerics.mean_flux", "free", "\"zero\" in a suspension"),
            () if pressure_source == PressureSource::Density => {
                ("numerics.pressure_source", "density", "\"divergence\" in a suspension")
            }
            () if surface == SurfaceTreatment::Eliminated => {
                ("numerics.surface", "eliminated", "\"completed\" in a suspension")
            }
            () if drag_slip == DragSlip::Pair => ("numerics.drag_slip", "pair", "\"mean\" in a suspension"),
            () => return Ok(()),
        };
        let remedy = "choose it, or set `numerics.continuity = \"fluid\"` for a single grain";
        Err(ParameterError::field(field, value, rule, remedy))
    }
}

/// Whether a law is judged at a solid fraction.
pub(super) fn covers(law: DragLaw, solid_fraction: f64) -> bool {
    law != DragLaw::Ergun || solid_fraction >= LEAST_BED
}
