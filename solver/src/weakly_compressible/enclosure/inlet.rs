//! An inlet: an opening in a plane by which material comes in at a given rate.
//!
//! Behind the opening rows of particles move towards it with the velocity u = Q/(ρ A) of the rate Q through the area A. They are
//! the dummy particles of a rough wall that moves with them, so that they get the pressure and the stress of the flow before
//! them (hydrostatic across the opening, none where nothing stands before it), and what they give to the flow is booked as
//! that of any wall. A row whose middle reaches the opening becomes free: its particles have the velocity of the row, and the
//! pressure and stress that it had. A new row takes its place at the rear, so that the rows go one row back.
//!
//! The number of rows that are through follows from the integral of the rate. So the mass that was fed is that integral
//! to half a row and to what a row moves in a step, at any time. Where the rate is zero the rows stand, and close the
//! opening.

use super::facet::Facet;
use super::facet_wall::{BackingParticle, FacetWall, Motion};
use super::feed_rate::FeedRate;
use crate::parameter::ParameterProblem;
use crate::vector::Vector;
use crate::weakly_compressible::Surface;
use serde::{Deserialize, Serialize};

/// Largest speed of a row over that of sound `[-]`: the dynamic pressure is then 2 % of the bulk modulus.
pub const LARGEST_MACH_NUMBER: f64 = 0.2;
/// Narrowest opening in particle spacings `[-]`.
pub const NARROWEST: f64 = 3.0;
/// Compression of the material before an opening by which that is blocked `[-]`.
pub(crate) const BLOCKED: f64 = 0.1;

/// An opening with what it feeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Inlet<const D: usize> {
    /// Name in messages and results.
    pub name: String,
    /// The opening's facets, with the flow on the side of their normals, which are all one.
    pub facets: Vec<Facet<D>>,
    /// Middles of the cells of a row when it passes the opening `[m]`.
    pub cells: Vec<Vector<D>>,
    /// Length of the opening `[m]` in the plane, its area `[m²]` in space.
    pub area: f64,
    /// Depth of a row `[m]`.
    pub depth: f64,
    /// Density of the material without pressure `[kg/m³]`.
    pub density: f64,
    /// Mass per time `[kg/s]`, in the plane `[kg/(m s)]`.
    pub rate: FeedRate,
}

/// Particle spacing of an inlet, and the material that it feeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Supply {
    /// Particle spacing `[m]`, the depth of a row.
    pub spacing: f64,
    /// Density of the material without pressure `[kg/m³]`.
    pub density: f64,
    /// Mass per time `[kg/s]`, in the plane `[kg/(m s)]`.
    pub rate: FeedRate,
}

/// Cells along an edge of an opening.
fn cells_along(length: f64, spacing: f64) -> usize {
    (length / spacing).round().max(1.0) as usize
}

impl Inlet<2> {
    /// The opening between two points `[m]`, with the flow to the left of the way from one to the other; none where both are
    /// one point.
    #[must_use]
    pub fn segment(name: &str, from: Vector<2>, to: Vector<2>, supply: Supply) -> Option<Self> {
        let facet = Facet::segment(from, to)?;
        let area = (to - from).norm();
        let count = cells_along(area, supply.spacing);
        let cell = |k: usize| from + (to - from) * ((k as f64 + 0.5) / count as f64);
        Some(Self::of(name, vec![facet], (0..count).map(cell).collect(), area, supply))
    }
}

impl Inlet<3> {
    /// The rectangle of a corner and the two next to it `[m]`, with the flow on the side from which the corner, the first and
    /// the second of them are seen against the clock; none where they are in line.
    #[must_use]
    pub fn rectangle(name: &str, corner: Vector<3>, [first, second]: [Vector<3>; 2], supply: Supply) -> Option<Self> {
        let (one, other) = (first - corner, second - corner);
        let opposite = first + other;
        let facets = [Facet::triangle([corner, first, opposite])?, Facet::triangle([corner, opposite, second])?];
        let counts = [cells_along(one.norm(), supply.spacing), cells_along(other.norm(), supply.spacing)];
        let cell = |k: usize| {
            let along = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
            corner + one * along(k % counts[0], counts[0]) + other * along(k / counts[0], counts[1])
        };
        let cells = (0..counts[0] * counts[1]).map(cell).collect();
        Some(Self::of(name, facets.to_vec(), cells, one.cross(&other).norm(), supply))
    }
}

impl<const D: usize> Inlet<D> {
    fn of(name: &str, facets: Vec<Facet<D>>, cells: Vec<Vector<D>>, area: f64, supply: Supply) -> Self {
        let Supply { spacing, density, rate } = supply;
        Self { name: name.to_owned(), facets, cells, area, depth: spacing, density, rate }
    }

    /// The unit vector into the flow `[-]`.
    #[must_use]
    pub fn direction(&self) -> Vector<D> {
        self.facets.first().map_or_else(Vector::zeros, |facet| facet.normal)
    }

    /// Mass of a particle `[kg]`.
    #[must_use]
    pub fn particle_mass(&self) -> f64 {
        self.density * self.area * self.depth / self.cells.len() as f64
    }

    /// Mass of a row `[kg]`.
    #[must_use]
    pub fn row_mass(&self) -> f64 {
        self.density * self.area * self.depth
    }

    /// Speed of the rows at a time `[m/s]`.
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        self.rate.at(time) / (self.density * self.area)
    }

    /// The largest speed of the rows at any time `[m/s]`.
    #[must_use]
    pub fn largest_speed(&self) -> f64 {
        self.rate.largest() / (self.density * self.area)
    }

    /// Way of the rows since time 0 `[m]`.
    #[must_use]
    pub fn travel(&self, time: f64) -> f64 {
        self.rate.mass(time) / (self.density * self.area)
    }

    /// Distance of the next row's middle beyond the opening at a time, after a number of rows `[m]`; negative before it has reached the
    /// opening.
    pub(crate) fn beyond(&self, time: f64, fed: u64) -> f64 {
        self.travel(time) - (fed as f64 + 0.5) * self.depth
    }

    /// Displacement of the rows' surface from the opening at a time, after a number of rows `[m]`.
    pub(crate) fn displacement(&self, time: f64, fed: u64) -> Vector<D> {
        self.direction() * (self.travel(time) - fed as f64 * self.depth)
    }

    /// The rows as a rough wall, with their surface in the opening.
    #[must_use]
    pub fn wall(&self) -> FacetWall<D> {
        let (name, facets) = (self.name.clone(), self.facets.clone());
        FacetWall { name, facets, roughness: Surface::Rough, motion: Motion::default() }
    }

    /// Dummy particles of a number of rows, as deep as walls; the first row is the one to be fed next.
    pub(crate) fn backing(&self, rows: usize) -> Vec<BackingParticle<D>> {
        let (normal, volume) = (self.direction(), self.area * self.depth / self.cells.len() as f64);
        let row = |row: usize| {
            let depth = (row as f64 + 0.5) * self.depth;
            let of_cell =
                move |cell: &Vector<D>| BackingParticle { position: cell - normal * depth, normal, depth, volume };
            self.cells.iter().map(of_cell)
        };
        (0..rows).flat_map(row).collect()
    }

    /// Problem of feeding a flow of particles at a `spacing` `[m]` with a sound speed `[m/s]`.
    #[must_use]
    pub fn problem(&self, spacing: f64, sound_speed: f64) -> Option<ParameterProblem> {
        let is_sound = |value: f64| value > 0.0 && value.is_finite();
        if !(self.cells.iter().all(|cell| cell.sum().is_finite()) && is_sound(self.area) && is_sound(self.depth)) {
            let rule = "finite and greater than 0";
            return Some(ParameterProblem::new("area", self.area, rule, "give the corners of the opening in metres"));
        }
        if self.cells.len() < (NARROWEST as usize).pow(D as u32 - 1) {
            let value = format!("{} particles wide", self.cells.len());
            let rule = format!("{NARROWEST} spacings wide or more, {} m", NARROWEST * spacing);
            return Some(ParameterProblem::new("area", value, &rule, "make the opening wider or the spacing smaller"));
        }
        if !is_sound(self.density) {
            return Some(ParameterProblem::new("density", self.density, "positive and finite", "give it in kg/m³"));
        }
        let (speed, most) = (self.largest_speed(), LARGEST_MACH_NUMBER * sound_speed);
        (speed > most).then(|| {
            let largest = self.rate.largest();
            let passes = largest * most / speed;
            let rule = format!(
                "at most {passes:.4}: the material would come in at {speed:.4} m/s, faster than {LARGEST_MACH_NUMBER} of the speed of sound \
                 of {sound_speed:.4} m/s"
            );
            let stiffer = (speed / most).powi(2);
            let remedy = format!("make the opening wider, or the material stiffer by a factor of {stiffer:.3}");
            ParameterProblem::new("rate", largest, &rule, &remedy)
        })
    }
}

/// Inflow through one inlet since the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InletMass<const D: usize> {
    /// Rows.
    pub rows: u64,
    /// Particles.
    pub particles: u64,
    /// Mass `[kg]`, per metre of depth in 2-D.
    pub mass: f64,
    /// Σ m t with the times at which they became free `[kg s]`: gravity has given g times that less than to those of the start.
    pub mass_times_time: f64,
    /// Momentum `[kg m/s]`.
    pub momentum: Vector<D>,
    /// Kinetic and elastic energy `[J]`.
    pub energy: f64,
}

/// A row that has become free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InflowRow {
    /// Index of the inlet.
    pub inlet: u32,
    /// Identity of its first particle; the others follow.
    pub first: u32,
    /// Time `[s]`.
    pub time: f64,
    /// Distance of its middle beyond the opening `[m]`.
    pub beyond: f64,
}

/// Inflow through all inlets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Inflow<const D: usize> {
    /// Masses, inlet by inlet.
    pub inlets: Vec<InletMass<D>>,
    /// Row by row, in the order in which they became free.
    pub rows: Vec<InflowRow>,
}

impl<const D: usize> Inflow<D> {
    /// Empty state of a number of inlets.
    pub(crate) fn none(inlets: usize) -> Self {
        let momentum = Vector::zeros();
        let fed = InletMass { rows: 0, particles: 0, mass: 0.0, mass_times_time: 0.0, momentum, energy: 0.0 };
        Self { inlets: vec![fed; inlets], rows: Vec::new() }
    }

    /// Particles that have come in.
    #[must_use]
    pub fn particles(&self) -> u64 {
        self.inlets.iter().map(|fed| fed.particles).sum()
    }

    /// The row that a particle came with, by its identity; none for those of the start.
    #[must_use]
    pub fn row_of(&self, identity: u32) -> Option<&InflowRow> {
        self.rows[..self.rows.partition_point(|row| row.first <= identity)].last()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn supply(rate: f64) -> Supply {
        let rate = FeedRate::constant(rate).expect("a rate");
        Supply { spacing: 0.01, density: 1500.0, rate }
    }

    #[test]
    fn rows_stand_behind_the_opening_and_cover_it() {
        let inlet = Inlet::segment("feed", Vector::<2>::new(0.0, 0.052), Vector::<2>::zeros(), supply(6.0));
        let inlet = inlet.expect("an opening");
        assert!(inlet.direction() == Vector::<2>::new(1.0, 0.0) && inlet.cells.len() == 5);
        assert!((inlet.speed(1.0) * 1500.0 * 0.052 - 6.0).abs() < 1e-12);
        let backing = inlet.backing(3);
        assert_eq!(backing.len(), 15);
        assert!(backing.iter().take(5).all(|particle| (particle.position[0] + 0.005).abs() < 1e-15));
        let volume: f64 = backing.iter().map(|particle| particle.volume).sum();
        assert!((volume - 3.0 * 0.01 * 0.052).abs() < 1e-15);
        assert!((inlet.particle_mass() * 5.0 - inlet.row_mass()).abs() < 1e-12);
    }

    #[test]
    fn a_rectangle_faces_those_who_see_its_corners_against_the_clock() {
        let corners = [[0.0, 0.0, 0.0], [0.0, 0.06, 0.0], [0.0, 0.0, 0.04]].map(Vector::<3>::from);
        let inlet = Inlet::rectangle("feed", corners[0], [corners[1], corners[2]], supply(1.0)).expect("an opening");
        assert!(inlet.direction() == Vector::<3>::new(1.0, 0.0, 0.0) && inlet.cells.len() == 24);
        assert!((inlet.area - 0.0024).abs() < 1e-15);
        let line = [corners[1], corners[1] * 2.0];
        assert!(Inlet::rectangle("line", corners[0], line, supply(1.0)).is_none());
    }

    #[test]
    fn impossible_gate_is_refused() {
        let of = |width: f64, rate: f64| {
            Inlet::segment("feed", Vector::<2>::new(0.0, width), Vector::<2>::zeros(), supply(rate))
                .expect("an opening")
        };
        assert_eq!(of(0.05, 70.0).problem(0.01, 5.0), None);
        let fast = of(0.05, 150.0).problem(0.01, 5.0).expect("too fast").to_string();
        assert!(
            fast.starts_with("`rate` is 150, but must be at most 75.0000: the material would come in at 2.0000 m/s"),
            "{fast}"
        );
        assert!(fast.ends_with("stiffer by a factor of 4.000"), "{fast}");
        let narrow = of(0.02, 1.0).problem(0.01, 5.0).expect("too narrow").to_string();
        assert!(narrow.starts_with("`area` is 2 particles wide, but must be 3 spacings wide or more"), "{narrow}");
    }
}
