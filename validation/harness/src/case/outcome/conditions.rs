//! Boundaries and start of a run for an external code, read from the scene that is simulated.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{Bed, IncompressibleScene, ParticleSet};
use bagnold_solver::material::pore_liquid::SKELETON_SHARE;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::Motion;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::walls::Surface;

/// Names of the lower and the upper end of each axis.
const ENDS: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["near", "far"]];
/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Kind of the conditions at the start.
const START: &str = "start";

/// A number of a boundary, or of the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Name of the boundary, or of the part of the flow.
    pub part: String,
    /// Kind of the boundary: `no slip`, `free slip`, `periodic`, `free surface`, `imposed velocity`, `friction` or
    /// `rough-wall law`; or `start`.
    pub kind: &'static str,
    /// Quantity of the value.
    pub quantity: String,
    /// Value in the unit; not a number where a boundary has no single one.
    pub value: f64,
    /// SI unit, `-` for none.
    pub unit: &'static str,
}

/// Boundaries and start of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditions {
    /// Conditions, boundaries first.
    pub rows: Vec<Condition>,
}

impl Condition {
    /// Whether it belongs to the start.
    pub fn is_of_start(&self) -> bool {
        self.kind == START
    }
}

impl Conditions {
    fn enter(&mut self, part: &str, kind: &'static str, quantity: impl Into<String>, value: f64, unit: &'static str) {
        self.rows.push(Condition { part: part.to_owned(), kind, quantity: quantity.into(), value, unit });
    }

    fn has(&self, part: &str) -> bool {
        self.rows.iter().any(|row| row.part == part)
    }

    fn vector<const D: usize>(&mut self, part: &str, quantity: &str, vector: &Vector<D>, unit: &'static str) {
        for (name, value) in AXES.iter().zip(vector.iter()) {
            self.enter(part, START, format!("{quantity} {name}"), *value, unit);
        }
    }

    /// Extents, volume and mean velocity of particles at a spacing `[m]`. The extents are those of the lattice, from which
    /// particles are displaced.
    fn fill<const D: usize>(&mut self, part: &str, places: &[Vector<D>], velocities: &[Vector<D>], spacing: f64) {
        let mut volume = 1.0;
        for (axis, name) in AXES.iter().enumerate().take(D) {
            let [lower, upper] = extent(places, spacing, axis);
            self.enter(part, START, format!("lower {name}"), lower, "m");
            self.enter(part, START, format!("upper {name}"), upper, "m");
            volume *= upper - lower;
        }
        let count = places.len() as f64;
        let filled = count * spacing.powi(D as i32);
        let (size, unit) = if D == 3 { ("volume", "m^3") } else { ("area", "m^2") };
        self.enter(part, START, size, filled, unit);
        self.enter(part, START, "share of the box between these ends", filled / volume, "-");
        self.vector(part, "mean velocity", &(velocities.iter().sum::<Vector<D>>() / count), "m/s");
    }

    /// Periods, mirrors, and free surfaces where nothing else bounds the flow.
    fn enclose<const D: usize>(&mut self, domain: &Domain<D>, places: &[Vector<D>], spacing: f64) {
        for (axis, boundary) in domain.axes.iter().enumerate() {
            let mirrors = match *boundary {
                AxisBoundary::Periodic { lower, upper } => {
                    self.enter(&ENDS[axis].join(" and "), "periodic", "period", upper - lower, "m");
                    continue;
                }
                AxisBoundary::Mirror { lower, upper } => [lower, upper],
                AxisBoundary::Open => [None, None],
            };
            let flow = extent(places, spacing, axis);
            for (end, name) in ENDS[axis].into_iter().enumerate() {
                match mirrors[end] {
                    Some(place) => self.enter(name, "free slip", "position", place, "m"),
                    None if self.has(name) => {}
                    None => self.enter(name, "free surface", "position", flow[end], "m"),
                }
            }
        }
    }
}

/// Lower and upper end `[m]` of the lattice cells of particles along an axis.
fn extent<const D: usize>(places: &[Vector<D>], spacing: f64, axis: usize) -> [f64; 2] {
    let lower = places.iter().fold(f64::INFINITY, |least, place| least.min(place[axis])) - 0.5 * spacing;
    let upper = places.iter().fold(f64::NEG_INFINITY, |most, place| most.max(place[axis])) + 0.5 * spacing;
    [lower, upper].map(|end| (end / spacing).round() * spacing)
}

fn slip(roughness: Surface) -> &'static str {
    if roughness == Surface::Rough { "no slip" } else { "free slip" }
}

impl<const D: usize> From<&Scene<D>> for Conditions {
    fn from(scene: &Scene<D>) -> Self {
        let (mut all, flow, mut material) = (Self::default(), &scene.flow, scene.equation_of_state);
        if scene.rheology.pore_liquid().is_some() {
            material.bulk_modulus *= SKELETON_SHARE;
        }
        for wall in &scene.walls {
            let name = if wall.region.is_some() { "gate" } else { ENDS[wall.axis][usize::from(wall.side < 0.0)] };
            // the other faces of a gate are its thickness, which is a choice of ours
            if !all.has(name) {
                all.enter(name, slip(wall.roughness), "position", wall.surface, "m");
                let speed = wall.velocity.norm();
                if speed > 0.0 {
                    all.enter(name, "imposed velocity", "speed", speed, "m/s");
                }
            }
        }
        for wall in &scene.enclosure.walls {
            let kind = if wall.motion == Motion::default() { slip(wall.roughness) } else { "imposed velocity" };
            all.enter(&wall.name, kind, "position", f64::NAN, "m");
        }
        all.enclose(&scene.domain, &flow.position, scene.spacing);
        if let Some(plates) = &scene.side_walls {
            all.enter("near and far", "friction", "coefficient", plates.friction, "-");
            all.enter("near and far", "friction", "distance", plates.width, "m");
        }
        all.fill("flow", &flow.position, &flow.velocity, scene.spacing);
        let pressure = flow.density.iter().map(|density| material.pressure(*density)).sum::<f64>();
        all.enter("flow", START, "mean pressure", pressure / flow.density.len() as f64, "Pa");
        all.enter("flow", START, "density without pressure", material.reference_density, "kg/m^3");
        if let Some(grain_density) = scene.rheology.grain_density() {
            all.enter("flow", START, "solid fraction", material.reference_density / grain_density, "-");
        }
        all.vector("all", "gravity", &scene.gravity, "m/s^2");
        all
    }
}

impl<const D: usize> From<&IncompressibleScene<D>> for Conditions {
    fn from(scene: &IncompressibleScene<D>) -> Self {
        let (mut all, fluid) = (Self::default(), &scene.fluid);
        match fluid.bed {
            Bed::NoSlip(level) => all.enter("bottom", "no slip", "position", level, "m"),
            Bed::Slip if fluid.wall.is_empty() => {}
            Bed::Slip => {
                let floor = extent(&fluid.wall, fluid.spacing, D - 1)[1];
                all.enter("bottom", "free slip", "position", floor, "m");
            }
            Bed::Rough { level, origin_offset, law } => {
                all.enter("bottom", "rough-wall law", "position", level, "m");
                all.enter("bottom", "rough-wall law", "origin below the position", origin_offset, "m");
                all.enter("bottom", "rough-wall law", "sand roughness", law.sand_roughness, "m");
            }
        }
        let ParticleSet { position, velocity } = &fluid.particles;
        all.enclose(&scene.domain, position, fluid.spacing);
        all.fill("fluid", position, velocity, fluid.spacing);
        all.enter("fluid", START, "density", fluid.density, "kg/m^3");
        if let Some(sediment) = &scene.sediment {
            let ParticleSet { position, velocity } = &sediment.particles;
            all.fill("sediment", position, velocity, sediment.spacing);
            let filling = sediment.filling.iter().sum::<f64>() / sediment.filling.len() as f64;
            all.enter("sediment", START, "solid fraction", filling, "-");
            all.enter("sediment", START, "grain density", sediment.density, "kg/m^3");
        }
        all.vector("all", "gravity", &fluid.gravity, "m/s^2");
        all
    }
}
