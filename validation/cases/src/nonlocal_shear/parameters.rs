//! Parameters, tiers and runs.

use super::channel::ChannelGrains;
use super::flow::{RheologyChoice, ShearFlow};
use super::run::ShearRun;
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::grains::GLASS_BEADS;
use crate::setup::rules;
use bagnold_solver::material::rheology::{NonlocalMuI, Rheology};
use bagnold_solver::parameter::{between, each, inside, positive, unique};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::walls::SideWalls;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A vertical chute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ChuteParameters {
    /// Half the distance of its walls over the grain diameter `[-]`.
    #[schemars(transform = between(2.0, 1000.0, "20 diameters have a plug between two sheared layers"))]
    pub half_width: f64,
    /// Friction that its walls bear, ρ g W/p `[-]`.
    #[schemars(transform = positive("give it between the grains' friction coefficients"))]
    pub wall_friction: f64,
    /// Particles per grain diameter, one run each; empty for none.
    #[schemars(transform = each(between(1.0, 100.0, PARTICLES)))]
    #[schemars(transform = unique("name every resolution once"))]
    pub particles_per_diameter: Vec<usize>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "1 s lets the start decay"))]
    pub duration: f64,
}

/// Grains under gravity below a plate that drags them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DraggedBedParameters {
    /// Thickness over the grain diameter `[-]`.
    #[schemars(transform = between(2.0, 1000.0, "20 diameters hold the tail"))]
    pub depth: f64,
    /// Velocity of the plate over √(g D) `[-]`.
    #[schemars(transform = positive("2 shears some diameters below the plate"))]
    pub plate_velocity: f64,
    /// Particles per grain diameter, one run each; empty for none.
    #[schemars(transform = each(between(1.0, 100.0, PARTICLES)))]
    #[schemars(transform = unique("name every resolution once"))]
    pub particles_per_diameter: Vec<usize>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "0.5 s lets the start decay"))]
    pub duration: f64,
}

/// A heap between side walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeapParameters {
    /// Thickness over the grain diameter `[-]`.
    #[schemars(transform = between(2.0, 1000.0, "20 diameters hold a flow of 10 and its tail"))]
    pub depth: f64,
    /// Inclination of the surface `[°]`.
    #[schemars(transform = inside(0.0, 90.0, "give it between the angles of the grains' friction coefficients"))]
    pub slope_angle: f64,
    /// Distance of the side walls over the grain diameter `[-]`.
    #[schemars(transform = between(1.0, 1e4, "30 diameters are a narrow channel"))]
    pub width: f64,
    /// Friction of the grains on the side walls `[-]`.
    #[schemars(transform = between(0.001, 2.0, "0.3 is that of glass beads on glass plates"))]
    pub wall_friction: f64,
    /// Particles per grain diameter of grains that flow together, one run each; empty for none.
    #[schemars(transform = each(between(1.0, 100.0, PARTICLES)))]
    #[schemars(transform = unique("name every resolution once"))]
    pub particles_per_diameter: Vec<usize>,
    /// Particles per grain diameter under the local law, one run each; empty for none.
    #[schemars(transform = each(between(1.0, 100.0, PARTICLES)))]
    #[schemars(transform = unique("name every resolution once"))]
    pub local_particles_per_diameter: Vec<usize>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "2 s let the start decay"))]
    pub duration: f64,
}

const PARTICLES: &str = "2 resolve the length over which the flow decays, which is 1.2 diameters at least";

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NonlocalShearParameters {
    /// The grains.
    pub material: Rheology,
    /// Solid fraction φ `[-]`.
    #[schemars(transform = between(0.01, 1.0, "grains fill 0.5 to 0.64 of the space"))]
    pub solid_fraction: f64,
    /// Gravity `[m/s²]`; along a chute it follows from the friction of its walls.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Pressure in the chute and below the plate over ρ_s g D `[-]`.
    #[schemars(transform = positive("10 is the weight of ten grains"))]
    pub load: f64,
    /// The chute.
    pub chute: ChuteParameters,
    /// The dragged bed.
    pub dragged_bed: DraggedBedParameters,
    /// The heap.
    pub heap: HeapParameters,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.1 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for NonlocalShearParameters {
    type Run = ShearRun;

    fn of_tier(tier: Tier) -> Self {
        let resolutions = match tier {
            Tier::Quick => vec![2],
            Tier::Paper => vec![2, 4],
            Tier::Fine => vec![2, 4, 8],
        };
        Self {
            material: Rheology::NonlocalMuI(NonlocalMuI::of(GLASS_BEADS.law)),
            solid_fraction: GLASS_BEADS.solid_fraction,
            gravity: 9.81,
            load: 10.0,
            chute: ChuteParameters {
                half_width: 20.0,
                wall_friction: 0.53,
                particles_per_diameter: resolutions.clone(),
                duration: 1.0,
            },
            dragged_bed: DraggedBedParameters {
                depth: 20.0,
                plate_velocity: 2.18,
                particles_per_diameter: resolutions.clone(),
                duration: 0.5,
            },
            heap: HeapParameters {
                depth: 20.0,
                slope_angle: 26.0,
                width: 30.0,
                wall_friction: 0.3,
                particles_per_diameter: resolutions.clone(),
                local_particles_per_diameter: resolutions,
                duration: 2.0,
            },
            columns: 8,
            jitter: 0.1,
            seed: 1,
            numerics: Numerics::default(),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        if self.law().is_none() {
            let name = format!("\"{}\"", self.material.name());
            let remedy = "a local law has no tail, and its chutes flow at every width";
            return Err(ParameterError::field("material.law", name, "\"nonlocal-mu-i\"", remedy));
        }
        rules::material("material", &self.material)?;
        rules::columns("columns", self.columns, &self.numerics)
    }

    fn check_runs(&self, runs: &[&ShearRun]) -> Result<(), ParameterError> {
        let Some(law) = self.law() else { return Ok(()) };
        for run in runs {
            let flows = run.flow.steady(&run.nominal()).is_some();
            match run.flow {
                ShearFlow::Chute { wall_friction, .. } => {
                    let (field, remedy) =
                        ("chute.wall_friction", "beyond the grains' limiting friction nothing is steady");
                    rules::between(field, wall_friction, 0.0, 0.999 * law.limiting_friction, remedy)?;
                    if !flows {
                        let remedy = "the narrower a chute, the more friction it needs; give more, or a larger `chute.half_width`";
                        let rule = format!(
                            "that of a chute that flows at a half width of {} diameters",
                            self.chute.half_width
                        );
                        return Err(ParameterError::field(field, wall_friction, &rule, remedy));
                    }
                }
                ShearFlow::DraggedBed { .. } if !flows => {
                    let rule = "a velocity that a steady flow below the plate has";
                    let remedy = "a larger `load` or `dragged_bed.depth` bears a faster plate";
                    let field = "dragged_bed.plate_velocity";
                    return Err(ParameterError::field(field, self.dragged_bed.plate_velocity, rule, remedy));
                }
                ShearFlow::Heap { .. } if !flows => {
                    let remedy = "a gentler heap is at rest, a steeper one has no steady flow";
                    let rule = format!(
                        "between the angles of the grains' friction, {} and {} degrees, ends excluded, and so that the layer flows",
                        libm::atan(law.static_friction).to_degrees(),
                        libm::atan(law.limiting_friction).to_degrees()
                    );
                    return Err(ParameterError::field("heap.slope_angle", self.heap.slope_angle, &rule, remedy));
                }
                ShearFlow::DraggedBed { .. } | ShearFlow::Heap { .. } => {}
            }
        }
        Ok(())
    }

    fn runs(&self) -> Vec<ShearRun> {
        let Some(law) = self.law() else { return Vec::new() };
        let diameter = law.grain_diameter;
        let run = |flow: ShearFlow, particles_per_diameter: usize, duration: f64| ShearRun {
            flow,
            grains: ChannelGrains {
                law,
                solid_fraction: self.solid_fraction,
                rows: (flow.width() / diameter * particles_per_diameter as f64).round() as usize,
                columns: self.columns,
                jitter: self.jitter,
                seed: self.seed,
                numerics: self.numerics,
            },
            particles_per_diameter,
            load: self.load * law.grain_density * self.gravity * diameter,
            gravity: self.gravity,
            duration,
        };
        let ChuteParameters { half_width, wall_friction, duration, .. } = self.chute;
        let chute = ShearFlow::Chute { half_width: half_width * diameter, wall_friction };
        let chutes = self.chute.particles_per_diameter.iter().map(|&count| run(chute, count, duration));
        let DraggedBedParameters { depth, plate_velocity, duration, .. } = self.dragged_bed;
        let plate_velocity = plate_velocity * (self.gravity * diameter).sqrt();
        let bed = ShearFlow::DraggedBed { depth: depth * diameter, plate_velocity };
        let beds = self.dragged_bed.particles_per_diameter.iter().map(|&count| run(bed, count, duration));
        let heap = |cooperation| ShearFlow::Heap {
            depth: self.heap.depth * diameter,
            inclination: self.heap.slope_angle.to_radians(),
            side_walls: SideWalls { width: self.heap.width * diameter, friction: self.heap.wall_friction },
            cooperation,
        };
        let duration = self.heap.duration;
        let cooperating =
            self.heap.particles_per_diameter.iter().map(|&count| run(heap(RheologyChoice::Nonlocal), count, duration));
        let alone = self
            .heap
            .local_particles_per_diameter
            .iter()
            .map(|&count| run(heap(RheologyChoice::Local), count, duration));
        chutes.chain(beds).chain(cooperating).chain(alone).collect()
    }
}

impl NonlocalShearParameters {
    fn law(&self) -> Option<NonlocalMuI> {
        match self.material {
            Rheology::NonlocalMuI(law) => Some(law),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(change: impl FnOnce(&mut NonlocalShearParameters)) -> String {
        let mut parameters = NonlocalShearParameters::of_tier(Tier::Quick);
        change(&mut parameters);
        parameters.check_all().expect_err("refused").to_string()
    }

    #[test]
    fn flows_that_are_not_steady_are_refused() {
        assert!(NonlocalShearParameters::of_tier(Tier::Fine).check_all().is_ok());
        let narrow = message(|parameters| parameters.chute.half_width = 5.0);
        assert!(
            narrow.starts_with("`chute.wall_friction` is 0.53, but must be that of a chute that flows"),
            "{narrow}"
        );
        let steep = message(|parameters| parameters.chute.wall_friction = 0.7);
        assert!(steep.starts_with("`chute.wall_friction` is 0.7, but must be between 0 and 0.64"), "{steep}");
        let fast = message(|parameters| parameters.dragged_bed.plate_velocity = 1e6);
        assert!(fast.starts_with("`dragged_bed.plate_velocity` is 1000000, but must be a velocity that"), "{fast}");
        for slope_angle in [15.0, 40.0] {
            let heap = message(|parameters| {
                parameters.heap.slope_angle = slope_angle;
                parameters.heap.particles_per_diameter.clear();
            });
            let expected = format!(
                "`heap.slope_angle` is {slope_angle}, but must be between the angles of the grains' friction, 20.9"
            );
            assert!(heap.starts_with(&expected), "{heap}");
        }
        let local = message(|parameters| parameters.material = Rheology::MuI(GLASS_BEADS.law));
        assert!(local.starts_with("`material.law` is \"mu-i\", but must be \"nonlocal-mu-i\""), "{local}");
    }
}
