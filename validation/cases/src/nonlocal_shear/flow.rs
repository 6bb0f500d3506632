//! The flow: grains that are sheared in a chute, below a plate or on a heap.

use super::channel::{Channel, ChannelGrains, Motion, UpperBoundary};
use super::exact::ExactShear;
use super::probe::{ShearObservation, ShearProbe};
use crate::case::recording::{SimulationStage, watch};
use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::grains::GLASS_BEADS;
use crate::setup::{acoustic_step, rules};
use bagnold_solver::material::rheology::{MuI, NonlocalMuI, Rheology};
use bagnold_solver::parameter::{between, inside, positive};
use bagnold_solver::weakly_compressible::{Numerics, SideWalls};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Samples of a run.
const SAMPLES: f64 = 200.0;
/// Part of a run that is averaged over, the last `[-]`.
const WINDOW: f64 = 0.5;
/// Velocity of the start over that of the steady flow `[-]`: a run that stayed as it began would not pass.
const HASTE: f64 = 1.1;
/// Largest friction of a chute's walls, or below a plate, over μ_2 `[-]`: there the shear rate has no bound.
pub(super) const MOST_FRICTION: f64 = 0.999;

/// Cause of the shear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Drive {
    /// Gravity along the two walls of a vertical chute.
    Chute,
    /// A plate that drags grains under gravity.
    DraggedBed,
    /// Gravity on the slope of a heap, which flows at its surface over grains that side walls hold.
    Heap,
}

/// Grains in a steady shear flow, whose stresses the balance of momentum gives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NonlocalShearFlow {
    /// Cause of the flow: a plate, a chute or a heap.
    pub drive: Drive,
    /// Half the distance of the walls of a chute, depth of a bed or a heap, over the grain diameter `[-]`.
    #[schemars(transform = between(2.0, 1000.0, "give 20 diameters, for a plug between the sheared layers of a chute, and for the tail of a bed"))]
    pub thickness: f64,
    /// Friction that the walls of a chute bear, ρ g W/p `[-]`.
    #[schemars(transform = positive("give it between the grains' static and limiting friction"))]
    pub wall_friction: f64,
    /// Velocity of the plate over √(g D) `[-]`.
    #[schemars(transform = positive("give 2 to shear some diameters below the plate"))]
    pub plate_velocity: f64,
    /// Inclination of the surface of a heap `[°]`.
    #[schemars(transform = inside(0.0, 90.0, "give it between the angles of the grains' friction coefficients"))]
    pub slope_angle: f64,
    /// Distance of the side walls of a heap over the grain diameter `[-]`.
    #[schemars(transform = between(1.0, 1e4, "give 30 diameters for a narrow channel"))]
    pub side_wall_distance: f64,
    /// Friction of the grains on these side walls `[-]`.
    #[schemars(transform = between(0.001, 2.0, "give 0.3 for glass beads on glass plates"))]
    pub side_wall_friction: f64,
    /// Particles per grain diameter.
    #[schemars(transform = between(1.0, 100.0, "give 2 to resolve the decay length, which is 1.2 diameters or more"))]
    pub particles_per_diameter: usize,
    /// Pressure in the chute and below the plate over ρ_s g D `[-]`.
    #[schemars(transform = positive("give 10 for the weight of ten grains"))]
    pub load: f64,
    /// Gravity `[m/s²]`; along a chute it follows from the friction of its walls.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Solid fraction φ `[-]`.
    #[schemars(transform = between(0.01, 1.0, "give 0.5 to 0.64, the share of the space that grains fill"))]
    pub solid_fraction: f64,
    /// The grains; those of a heap may have the local law.
    pub material: Rheology,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "give 0.5 s below a plate, 1 s in a chute or 2 s on a heap, in which the initial error decays"))]
    pub duration: f64,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
}

impl Default for NonlocalShearFlow {
    fn default() -> Self {
        Self {
            drive: Drive::Chute,
            thickness: 20.0,
            wall_friction: 0.53,
            plate_velocity: 2.18,
            slope_angle: 26.0,
            side_wall_distance: 30.0,
            side_wall_friction: 0.3,
            particles_per_diameter: 2,
            load: 10.0,
            gravity: 9.81,
            solid_fraction: GLASS_BEADS.solid_fraction,
            material: Rheology::NonlocalMuI(NonlocalMuI::of(GLASS_BEADS.law)),
            columns: 8,
            jitter: 0.1,
            seed: 1,
            duration: 1.0,
            numerics: Numerics::default(),
        }
    }
}

impl Flow for NonlocalShearFlow {
    const RUNS: &'static str = include_str!("../../runs/nonlocal-shear.toml");
    type Observation = ShearObservation;

    fn check(&self) -> Result<(), ParameterError> {
        let refused = |field, value: String, rule: &str, remedy| Err(ParameterError::field(field, value, rule, remedy));
        if !(matches!(self.material, Rheology::NonlocalMuI(_)) || self.is_local() && self.drive == Drive::Heap) {
            let rule = if self.drive == Drive::Heap { "\"nonlocal-mu-i\" or \"mu-i\"" } else { "\"nonlocal-mu-i\"" };
            let remedy = "choose it: a local law has no creeping tail, and its chutes flow at every width";
            return refused("material.law", format!("\"{}\"", self.material.name()), rule, remedy);
        }
        rules::material("material", &self.material)?;
        rules::columns("columns", self.columns, &self.numerics)?;
        let NonlocalMuI { static_friction, limiting_friction, .. } = self.law();
        if self.drive == Drive::Chute {
            let remedy = "reduce it: above the grains' limiting friction no flow is steady";
            rules::between("wall_friction", self.wall_friction, 0.0, MOST_FRICTION * limiting_friction, remedy)?;
        }
        match self.drive {
            _ if self.steady(&self.nominal()).is_some() => Ok(()),
            Drive::Chute => {
                let defect = format!(
                    "with {} no chute flows at a half width of {} diameters",
                    self.wall_friction, self.thickness
                );
                refused("wall_friction", defect, "", "raise it, or raise `thickness`")
            }
            Drive::DraggedBed => {
                let defect = format!("with {} no flow below the plate is steady", self.plate_velocity);
                refused("plate_velocity", defect, "", "reduce it, or raise `load` or `thickness`")
            }
            Drive::Heap => {
                let [least, most] = [static_friction, limiting_friction].map(|mu| libm::atan(mu).to_degrees());
                let rule = format!(
                    "an angle of steady flow, between {least:.3}° and {most:.3}°, the grains' static and limiting friction angles"
                );
                let remedy = "raise it if the heap is at rest, reduce it if the flow accelerates";
                refused("slope_angle", self.slope_angle.to_string(), &rule, remedy)
            }
        }
    }

    fn variant(&self) -> Variant {
        let flow = match self.drive {
            Drive::Chute => "chute",
            Drive::DraggedBed => "dragged-bed",
            Drive::Heap if self.is_local() => "local-heap",
            Drive::Heap => "heap",
        };
        Variant::of("flow", flow).and("particles_per_diameter", self.particles_per_diameter)
    }

    fn cost(&self) -> RunCost {
        self.with_channel(None, |channel| {
            let ChannelGrains { rows, columns, numerics, .. } = channel.grains;
            let step = acoustic_step(&numerics, channel.spacing(), channel.equation_of_state().sound_speed());
            RunCost::weakly_compressible((rows * columns) as f64, self.duration / step)
        })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<ShearObservation>, ParameterError> {
        self.with_channel(self.steady(&self.nominal()), |channel| {
            let (end, interval) = (self.duration, self.duration / SAMPLES);
            let stage = SimulationStage { progress, end, interval, window: 0.0, context: &() };
            let watched = watch(
                stage,
                |beginning| channel.scene(beginning),
                |_| ShearProbe::new(channel, self.duration - self.window()),
                |probe, snapshot| {
                    probe.observe(snapshot);
                    ControlFlow::Continue(())
                },
            )?;
            Ok(watched.ending.record(&watched.simulation, |_| watched.kept.finish()))
        })
    }
}

/// The grains of a flow as they are found: at a pressure and a density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearedGrains {
    /// Mean pressure in a chute, pressure below a plate; on a heap there is none `[Pa]`.
    pub load: f64,
    /// Density of the bulk `[kg/m³]`.
    pub density: f64,
}

impl NonlocalShearFlow {
    /// Length of the window before the end that is averaged over `[s]`.
    pub fn window(&self) -> f64 {
        WINDOW * self.duration
    }

    /// Whether its grains have the local law.
    pub fn is_local(&self) -> bool {
        matches!(self.material, Rheology::MuI(_))
    }

    /// The law, without cooperation where it is local; without a friction for one that is refused.
    pub fn law(&self) -> NonlocalMuI {
        match self.material {
            Rheology::NonlocalMuI(law) => law,
            Rheology::MuI(grains) => NonlocalMuI { cooperativity: 0.0, ..NonlocalMuI::of(grains) },
            _ => NonlocalMuI::of(MuI { static_friction: f64::NAN, ..GLASS_BEADS.law }),
        }
    }

    /// Grain diameter D `[m]`.
    pub(super) fn diameter(&self) -> f64 {
        self.law().grain_diameter
    }

    /// Velocity of the plate `[m/s]`.
    pub(super) fn plate_speed(&self) -> f64 {
        self.plate_velocity * (self.gravity * self.diameter()).sqrt()
    }

    /// The side walls of a heap.
    pub(super) fn side_walls(&self) -> SideWalls {
        SideWalls { width: self.side_wall_distance * self.diameter(), friction: self.side_wall_friction }
    }

    /// The grains as the run is made for.
    pub fn nominal(&self) -> ShearedGrains {
        let NonlocalMuI { grain_density, grain_diameter, .. } = self.law();
        ShearedGrains {
            load: self.load * grain_density * self.gravity * grain_diameter,
            density: self.solid_fraction * grain_density,
        }
    }

    /// The grains and the flow as they were found: at the pressure and the density of the run.
    pub fn found(&self, seen: &ShearObservation) -> (ShearedGrains, Self) {
        let (density, pressure) = (seen.density, seen.mean_pressure());
        let half_width = self.thickness * self.diameter();
        match self.drive {
            Drive::Chute => {
                let driving = self.driving(&self.nominal())[0];
                let wall_friction = density * driving * half_width / pressure;
                (ShearedGrains { load: pressure, density }, Self { wall_friction, ..self.clone() })
            }
            Drive::DraggedBed => {
                (ShearedGrains { load: pressure - 0.5 * density * self.gravity * half_width, density }, self.clone())
            }
            Drive::Heap => (ShearedGrains { load: 0.0, density }, self.clone()),
        }
    }

    /// The steady flow without particles at the pressure that was found; none where nothing flows.
    pub fn exact(&self, seen: &ShearObservation) -> Option<ExactShear> {
        let (grains, flow) = self.found(seen);
        flow.steady(&grains)
    }

    /// Particles.
    pub fn particles(&self) -> ChannelGrains {
        let Self { columns, jitter, seed, numerics, .. } = *self;
        let rows = (self.width() / self.diameter() * self.particles_per_diameter as f64).round() as usize;
        ChannelGrains { density: self.nominal().density, rows, columns, jitter, seed, numerics }
    }

    /// Calls with the channel of particles that the run begins with, in the motion of a steady flow.
    fn with_channel<T>(&self, steady: Option<ExactShear>, call: impl FnOnce(&Channel<'_>) -> T) -> T {
        let grains = self.nominal();
        let start = |height: f64| {
            let Some(steady) = &steady else { return Motion::default() };
            let velocity = HASTE * steady.velocity(height);
            Motion {
                velocity,
                shear_rate: HASTE * steady.shear_rate(height),
                shear_stress: steady.shear_stress(height),
            }
        };
        call(&Channel {
            grains: self.particles(),
            rheology: self.material,
            width: self.width(),
            gravity: self.driving(&grains),
            pressure: &|height| self.pressure(&grains, height),
            above: match self.drive {
                Drive::Chute => UpperBoundary::Wall(0.0),
                Drive::DraggedBed => UpperBoundary::Wall(self.plate_speed()),
                Drive::Heap => UpperBoundary::Surface(self.side_walls()),
            },
            start: &start,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(change: impl FnOnce(&mut NonlocalShearFlow)) -> String {
        let mut flow = NonlocalShearFlow::default();
        change(&mut flow);
        flow.check().expect_err("refused").to_string()
    }

    #[test]
    fn flows_that_are_not_steady_are_refused() {
        let narrow = message(|flow| flow.thickness = 5.0);
        assert!(narrow.starts_with("`wall_friction`: with 0.53 no chute flows"), "{narrow}");
        let steep = message(|flow| flow.wall_friction = 0.7);
        assert!(steep.starts_with("`wall_friction` is 0.7, but must be between 0 and 0.64"), "{steep}");
        let fast = message(|flow| (flow.drive, flow.plate_velocity) = (Drive::DraggedBed, 1e6));
        assert!(fast.starts_with("`plate_velocity`: with 1000000 no flow"), "{fast}");
        for angle in [15.0, 40.0] {
            let heap = message(|flow| (flow.drive, flow.slope_angle) = (Drive::Heap, angle));
            let expected = format!("`slope_angle` is {angle}, but must be an angle of steady flow, between 20.9");
            assert!(heap.starts_with(&expected), "{heap}");
        }
        let local = message(|flow| flow.material = Rheology::MuI(GLASS_BEADS.law));
        assert!(local.starts_with("`material.law` is \"mu-i\", but must be \"nonlocal-mu-i\""), "{local}");
    }
}
