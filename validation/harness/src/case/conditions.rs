//! Boundaries and start of a run for an external code, read from the scene that is simulated.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{Bed, IncompressibleScene};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::Motion;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::walls::Surface;

/// Names of the lower and the upper end of each axis.
const ENDS: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["near", "far"]];
/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// A boundary condition.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryCondition {
    /// Name of the boundary.
    pub boundary: String,
    /// Kind: `no slip`, `free slip`, `periodic`, `free surface`, `imposed velocity`, `friction` or `rough-wall law`.
    pub kind: &'static str,
    /// Quantity of the value.
    pub quantity: &'static str,
    /// Value in the unit; not a number where the boundary has no single one.
    pub value: f64,
    /// SI unit, `-` for none.
    pub unit: &'static str,
}

/// A number of the start.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialValue {
    /// Name of the quantity.
    pub quantity: String,
    /// Value in the unit.
    pub value: f64,
    /// SI unit, `-` for none.
    pub unit: &'static str,
}

/// Boundaries and start of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditions {
    /// Boundary conditions.
    pub boundaries: Vec<BoundaryCondition>,
    /// Numbers of the start.
    pub start: Vec<InitialValue>,
}

impl Conditions {
    fn bound(
        &mut self,
        boundary: &str,
        kind: &'static str,
        (quantity, value, unit): (&'static str, f64, &'static str),
    ) {
        self.boundaries.push(BoundaryCondition { boundary: boundary.to_owned(), kind, quantity, value, unit });
    }

    fn begin(&mut self, quantity: impl Into<String>, value: f64, unit: &'static str) {
        self.start.push(InitialValue { quantity: quantity.into(), value, unit });
    }

    /// Extents, volume and mean velocity of particles at a spacing `[m]`. The extents are those of the lattice, from which
    /// particles are displaced.
    fn fill<const D: usize>(&mut self, what: &str, places: &[Vector<D>], velocities: &[Vector<D>], spacing: f64) {
        let count = places.len() as f64;
        for (axis, name) in AXES.iter().enumerate().take(D) {
            let [lower, upper] = extent(places, spacing, axis);
            self.begin(format!("{what}: lower {name}"), lower, "m");
            self.begin(format!("{what}: upper {name}"), upper, "m");
        }
        let boxed: f64 = (0..D).map(|axis| extent(places, spacing, axis)).map(|[lower, upper]| upper - lower).product();
        let (size, unit) = if D == 3 { ("volume", "m^3") } else { ("area", "m^2") };
        let filled = count * spacing.powi(D as i32);
        self.begin(format!("{what}: {size}"), filled, unit);
        self.begin(format!("{what}: share of the box between these ends"), filled / boxed, "-");
        for (axis, name) in AXES.iter().enumerate().take(D) {
            let mean = velocities.iter().map(|velocity| velocity[axis]).sum::<f64>() / count;
            self.begin(format!("{what}: mean velocity {name}"), mean, "m/s");
        }
    }

    fn pull<const D: usize>(&mut self, gravity: &Vector<D>) {
        for (axis, name) in AXES.iter().enumerate().take(D) {
            self.begin(format!("gravity {name}"), gravity[axis], "m/s^2");
        }
    }

    /// Periods, mirrors, and free surfaces where nothing else bounds the flow.
    fn enclose<const D: usize>(&mut self, domain: &Domain<D>, places: &[Vector<D>], spacing: f64) {
        for (axis, boundary) in domain.axes.iter().enumerate() {
            let [lower_end, upper_end] = ENDS[axis];
            if let AxisBoundary::Periodic { lower, upper } = *boundary {
                let both = format!("{lower_end} and {upper_end}");
                self.bound(&both, "periodic", ("period", upper - lower, "m"));
                continue;
            }
            let mirrors = match *boundary {
                AxisBoundary::Mirror { lower, upper } => [lower, upper],
                _ => [None, None],
            };
            let flow = extent(places, spacing, axis);
            for (end, name) in [lower_end, upper_end].into_iter().enumerate() {
                let is_bound = self.boundaries.iter().any(|row| row.boundary == name);
                match mirrors[end] {
                    Some(place) => self.bound(name, "free slip", ("position", place, "m")),
                    None if is_bound => {}
                    None => self.bound(name, "free surface", ("position", flow[end], "m")),
                }
            }
        }
    }
}

/// Lower and upper end `[m]` of the lattice cells of particles along an axis.
fn extent<const D: usize>(places: &[Vector<D>], spacing: f64, axis: usize) -> [f64; 2] {
    let ends = places.iter().map(|place| place[axis]);
    let ends = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |ends, place| (ends.0.min(place), ends.1.max(place)));
    [ends.0 - 0.5 * spacing, ends.1 + 0.5 * spacing].map(|end| (end / spacing).round() * spacing)
}

fn slip(roughness: Surface) -> &'static str {
    if roughness == Surface::Rough { "no slip" } else { "free slip" }
}

impl<const D: usize> From<&Scene<D>> for Conditions {
    fn from(scene: &Scene<D>) -> Self {
        let mut all = Self::default();
        let (flow, spacing) = (&scene.flow, scene.spacing);
        for wall in &scene.walls {
            let name = if wall.region.is_some() { "gate" } else { ENDS[wall.axis][usize::from(wall.side < 0.0)] };
            // the other faces of a gate are its thickness, which is a choice of ours
            if all.boundaries.iter().any(|row| row.boundary == name) {
                continue;
            }
            all.bound(name, slip(wall.roughness), ("position", wall.surface, "m"));
            let speed = wall.velocity.norm();
            if speed > 0.0 {
                all.bound(name, "imposed velocity", ("speed", speed, "m/s"));
            }
        }
        for wall in &scene.enclosure.walls {
            let kind = if wall.motion == Motion::default() { slip(wall.roughness) } else { "imposed velocity" };
            all.bound(&wall.name, kind, ("position", f64::NAN, "m"));
        }
        all.enclose(&scene.domain, &flow.position, spacing);
        if let Some(plates) = &scene.side_walls {
            all.bound("near and far", "friction", ("coefficient", plates.friction, "-"));
            all.bound("near and far", "friction", ("distance", plates.width, "m"));
        }
        all.fill("flow", &flow.position, &flow.velocity, spacing);
        let material = scene.equation_of_state;
        let pressure = flow.density.iter().map(|density| material.pressure(*density)).sum::<f64>();
        all.begin("flow: mean pressure", pressure / flow.density.len() as f64, "Pa");
        all.begin("flow: density without pressure", material.reference_density, "kg/m^3");
        if let Some(grain_density) = scene.rheology.grain_density() {
            all.begin("flow: solid fraction", material.reference_density / grain_density, "-");
        }
        all.pull(&scene.gravity);
        all
    }
}

impl<const D: usize> From<&IncompressibleScene<D>> for Conditions {
    fn from(scene: &IncompressibleScene<D>) -> Self {
        let mut all = Self::default();
        let fluid = &scene.fluid;
        match fluid.bed {
            Bed::NoSlip(level) => all.bound("bottom", "no slip", ("position", level, "m")),
            Bed::Slip if fluid.wall.is_empty() => {}
            Bed::Slip => {
                let floor = extent(&fluid.wall, fluid.spacing, D - 1)[1];
                all.bound("bottom", "free slip", ("position", floor, "m"));
            }
            Bed::Rough { level, origin_offset, law } => {
                all.bound("bottom", "rough-wall law", ("position", level, "m"));
                all.bound("bottom", "rough-wall law", ("origin below the position", origin_offset, "m"));
                all.bound("bottom", "rough-wall law", ("sand roughness", law.sand_roughness, "m"));
            }
        }
        all.enclose(&scene.domain, &fluid.particles.position, fluid.spacing);
        all.fill("fluid", &fluid.particles.position, &fluid.particles.velocity, fluid.spacing);
        all.begin("fluid: density", fluid.density, "kg/m^3");
        if let Some(sediment) = &scene.sediment {
            let grains = &sediment.particles;
            all.fill("sediment", &grains.position, &grains.velocity, sediment.spacing);
            let filling = sediment.filling.iter().sum::<f64>() / sediment.filling.len() as f64;
            all.begin("sediment: solid fraction", filling, "-");
            all.begin("sediment: grain density", sediment.density, "kg/m^3");
        }
        all.pull(&fluid.gravity);
        all
    }
}
