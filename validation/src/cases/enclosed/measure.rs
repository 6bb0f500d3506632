//! What gauges measure, whatever the number of axes.

use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;

/// Parts that a particle's volume is spread in over a spacing to either side.
const PARTS: i32 = 8;

/// What a gauge measures.
#[derive(Debug, Clone, PartialEq)]
pub enum Measure<'a, const D: usize> {
    /// How far the material reaches.
    Front(Line<D>),
    /// Thickness of the material along gravity.
    Depth(Depth<D>),
    /// Force of the flow on a wall.
    Force {
        /// Name of the wall.
        wall: &'a str,
    },
    /// Mass that crosses an opening.
    Flux(Opening<D>),
}

/// A line along which material reaches up to where less than a section stands across it.
#[derive(Debug, Clone, PartialEq)]
pub struct Line<const D: usize> {
    /// Its start `[m]`.
    pub from: Vector<D>,
    /// Its end `[m]`.
    pub to: Vector<D>,
    /// The section: in the plane a thickness `[m]`, in space an area `[m²]`.
    pub section: f64,
    /// The unit vector across it and gravity, and how far from it along that material counts `[m]`; none where all counts.
    pub strip: Option<(Vector<D>, f64)>,
}

impl<const D: usize> Line<D> {
    /// The first place along it, from its start and where material stands on, with less than the section `[m]`: volumes are
    /// spread over a spacing to either side.
    pub(super) fn reached(&self, simulation: &Simulation<D>) -> f64 {
        let spacing = simulation.spacing();
        let (bin, length) = (0.25 * spacing, (self.to - self.from).norm());
        let along = (self.to - self.from) / length;
        let bins = (length / bin).ceil() as usize;
        let mut area = vec![0.0; bins];
        for part in 0..PARTS {
            let shift = (f64::from(part) - 0.5 * f64::from(PARTS - 1)) * 2.0 / f64::from(PARTS) * spacing;
            let shares = volumes(simulation, |place| {
                let way = place - self.from;
                if self.strip.is_some_and(|(across, half)| way.dot(&across).abs() >= half) {
                    return None;
                }
                let place = way.dot(&along) + shift;
                (place >= 0.0 && place < length).then_some((place / bin) as usize)
            });
            for (sum, share) in area.iter_mut().zip(shares) {
                *sum += share / f64::from(PARTS);
            }
        }
        let stands = |area: &f64| *area >= self.section * bin;
        let Some(first) = area.iter().position(stands) else { return 0.0 };
        let gap = area[first..].iter().position(|area| !stands(area));
        gap.map_or(length, |gap| (first + gap) as f64 * bin)
    }
}

/// A place around which the material's thickness along gravity is measured: its volume within a width, over the section.
#[derive(Debug, Clone, PartialEq)]
pub struct Depth<const D: usize> {
    /// The place `[m]`.
    pub at: Vector<D>,
    /// The unit vector along gravity `[-]`.
    pub down: Vector<D>,
    /// Width across gravity `[m]`: in space the diameter of a circle.
    pub width: f64,
    /// What is measured across gravity: in the plane the width `[m]`, in space the circle's area `[m²]`.
    pub section: f64,
}

impl<const D: usize> Depth<D> {
    /// The thickness `[m]`.
    pub(super) fn thickness(&self, simulation: &Simulation<D>) -> f64 {
        let inside = |place: Vector<D>| {
            let way = place - self.at;
            ((way - self.down * way.dot(&self.down)).norm() < 0.5 * self.width).then_some(0)
        };
        volumes(simulation, inside).first().copied().unwrap_or(0.0) / self.section
    }
}

/// An opening that mass crosses: a line in the plane, a parallelogram in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening<const D: usize> {
    /// A corner `[m]`.
    pub corner: Vector<D>,
    /// Across it, to where what crosses counts; of any length.
    pub normal: Vector<D>,
    /// Coordinates along the edges that begin at the corner, each as a vector and a divisor: what lies r from the corner has
    /// the coordinate r·vector/divisor, which is from 0 to 1 within the opening.
    pub edges: Vec<(Vector<D>, f64)>,
}

impl<const D: usize> Opening<D> {
    /// Mass `[kg]`, in the plane `[kg/m]`, that has crossed it along its normal since particles were at the places `before`,
    /// less what went back.
    pub(super) fn crossed(&self, simulation: &Simulation<D>, before: &[Vector<D>]) -> f64 {
        let particles = simulation.particles();
        let side = |place: &Vector<D>| self.normal.dot(&(place - self.corner));
        let mut sum = 0.0;
        for index in particles.by_identity() {
            let Some(&start) = before.get(particles.identity[index] as usize) else { continue };
            let end = particles.position[index];
            let (first, last) = (side(&start), side(&end));
            if (first < 0.0) == (last < 0.0) || first.is_nan() {
                continue;
            }
            let met = start + (end - start) * (first / (first - last)) - self.corner;
            if self.edges.iter().all(|(vector, divisor)| (0.0..=1.0).contains(&(met.dot(vector) / divisor))) {
                sum += particles.mass[index] * if last >= 0.0 { 1.0 } else { -1.0 };
            }
        }
        sum
    }
}

/// Volumes `[m^D]` of the particles by bins, of which `bin` names that of a place; in the order of the scene.
fn volumes<const D: usize>(simulation: &Simulation<D>, bin: impl Fn(Vector<D>) -> Option<usize>) -> Vec<f64> {
    let particles = simulation.particles();
    let mut sums: Vec<f64> = Vec::new();
    for index in particles.by_identity() {
        if let Some(bin) = bin(particles.position[index]) {
            if sums.len() <= bin {
                sums.resize(bin + 1, 0.0);
            }
            sums[bin] += particles.mass[index] / particles.density[index];
        }
    }
    sums
}
