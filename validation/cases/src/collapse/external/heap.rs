//! A heap as another code gives it → snapshots: whether it is the heap of the case, at its start and later.

use crate::case::ParticleFrame;
use crate::collapse::heap::radius;
use crate::input::FieldError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::Snapshot;

/// Columns of the velocity.
pub(super) const SPEEDS: [&str; 3] = ["vx", "vy", "vz"];
/// Largest factor by which material may become more or less in a collapse, in volume `[-]`: grains dilate and codes lose some.
const BULKING: f64 = 1.2;
/// The same at the start `[-]`.
const SAME_SIZE: f64 = 1.03;
/// Share of the largest cell below which a cell is empty `[-]`.
const LEAST_CELL: f64 = 0.01;
/// Largest distance of the centroid at the start from the right one, over width and height `[-]`.
const SAME_PLACE: f64 = 0.02;

/// Region that particles of a heap may occupy, and their weight.
pub(super) struct Room {
    /// Particle spacing of ours `[m]`.
    pub(super) spacing: f64,
    /// Largest coordinate `[m]`.
    pub(super) reach: f64,
    /// Bulk density `[kg/m³]`.
    pub(super) density: f64,
    /// Total initial area `[m²]`, or in space volume `[m³]`.
    pub(super) size: f64,
    /// The start, if it is a block at the origin.
    pub(super) start: Option<Start>,
    /// Name of the collapsing body, in words.
    pub(super) kind: &'static str,
    /// Remedy for places that are out of reach.
    pub(super) origin: &'static str,
}

/// A block at the origin before it collapses.
pub(super) struct Start {
    /// Last time at which it still stands `[s]`.
    pub(super) until: f64,
    /// Width, or radius `[m]`.
    pub(super) width: f64,
    /// Height `[m]`.
    pub(super) height: f64,
    /// Mean distance of the mass from the symmetry plane or axis `[m]`.
    pub(super) middle: f64,
}

impl Room {
    /// Refuses a picture whose particles have another area or volume together than the start has.
    fn check(&self, sum: f64, axes: usize, picture: &ParticleFrame) -> Result<(), FieldError> {
        let (size, unit) = if axes == 2 { ("area", "m^2") } else { ("volume", "m^3") };
        let given = if picture.column(size).is_empty() { "mass" } else { size };
        let is_start = self.start.as_ref().is_some_and(|start| picture.time <= start.until);
        let factor = if is_start { SAME_SIZE } else { BULKING };
        let field = format!("particles.columns.{given}");
        self.check_size(sum, factor, &field, &format!("{unit} over all particles at {} s", picture.time))
    }

    fn check_size(&self, sum: f64, factor: f64, field: &str, unit: &str) -> Result<(), FieldError> {
        if sum > self.size / factor && sum < self.size * factor {
            return Ok(());
        }
        let rule = format!("within a factor {factor} of the {}'s initial value, {:.4e}", self.kind, self.size);
        let remedy = "check unit, size, solid fraction, and whether the part asked for is given";
        Err(FieldError::new(field, format!("{sum:.4e} {unit}"), &rule, remedy))
    }

    /// Refuses a deposit of another area or volume.
    pub(super) fn check_profile(&self, x: &[f64], thickness: &[f64], axes: usize) -> Result<(), FieldError> {
        if let Some(x) = x.first().filter(|x| **x < 0.0) {
            return Err(FieldError::new("profile.columns.x", format!("{x} m"), "0 m or more", self.origin));
        }
        let around = |x: f64| if axes == 2 { 1.0 } else { std::f64::consts::FRAC_PI_2 * x };
        let part =
            |k: usize| 0.5 * (x[k + 1] - x[k]) * (thickness[k] * around(x[k]) + thickness[k + 1] * around(x[k + 1]));
        // the innermost bin begins at the plane or axis
        let inner = thickness[0] * if axes == 2 { x[0] } else { std::f64::consts::FRAC_PI_4 * x[0] * x[0] };
        let sum = inner + (0..x.len() - 1).map(part).sum::<f64>();
        let unit = if axes == 2 { "m^2 below it" } else { "m^3 below it" };
        self.check_size(sum, BULKING, "profile.columns.thickness", unit)
    }

    /// Refuses a start that is another block: its centroid, and its extent to a cell of the given particles.
    fn check_start<const D: usize>(&self, snapshot: &Snapshot<D>) -> Result<(), FieldError> {
        let Some(start) = self.start.as_ref().filter(|start| snapshot.time <= start.until) else { return Ok(()) };
        let cells = snapshot.mass.iter().zip(&snapshot.density).map(|(mass, density)| mass / density);
        let (sum, largest) = cells.clone().fold((0.0, 0.0_f64), |(sum, largest), cell| (sum + cell, largest.max(cell)));
        // cells of a mesh that hold next to nothing are no part of the block
        let is_filled = |cell: f64| cell > LEAST_CELL * largest;
        let filled = cells.clone().filter(|cell| is_filled(*cell)).count();
        let cell = libm::pow(sum / filled as f64, 1.0 / D as f64);
        let horizontal = |place: &Vector<D>| if D == 2 { place[0].abs() } else { radius(place) };
        let vertical = |place: &Vector<D>| place[1];
        for (field, place, size, middle) in [
            ("x", &horizontal as &dyn Fn(&Vector<D>) -> f64, start.width, start.middle),
            ("y", &vertical, start.height, 0.5 * start.height),
        ] {
            let places = snapshot.position.iter().map(place);
            let mean = places.clone().zip(cells.clone()).map(|(place, cell)| place * cell).sum::<f64>() / sum;
            let ends = places.zip(cells.clone()).filter(|(_, cell)| is_filled(*cell)).map(|(place, _)| place);
            let end = ends.fold(0.0, f64::max) + 0.5 * cell;
            let field = format!("particles.columns.{field}");
            let at = format!("at {} s", snapshot.time);
            let remedy = "give the start of the case, which `bagnold export` writes";
            if (mean - middle).abs() > SAME_PLACE * size {
                let rule = format!("{middle:.4} m within 2 % of {size:.4} m, as the {} starts", self.kind);
                return Err(FieldError::new(&field, format!("on average {mean:.4} m {at}"), &rule, remedy));
            }
            if (end - size).abs() > cell + 0.01 * size {
                let rule = format!("up to {size:.4} m within a cell of {cell:.4} m");
                return Err(FieldError::new(&field, format!("up to {end:.4} m {at}"), &rule, remedy));
            }
        }
        Ok(())
    }
}

pub(super) fn snapshot<const D: usize>(room: &Room, picture: &ParticleFrame) -> Result<Snapshot<D>, FieldError> {
    let Room { spacing, reach, density: bulk_density, .. } = *room;
    let least = if D == 2 { [-spacing, -reach, -reach] } else { [-spacing, -reach, -spacing] };
    picture.within(reach, least, room.origin)?;
    if D == 2 && !picture.column("z").is_empty() {
        let remedy = &format!("leave it out: a planar {} has x along the bed and y upwards", room.kind);
        return Err(FieldError::finding("particles.columns.z", "given for a planar run", remedy));
    }
    let axes = ["x", "y", "z"];
    let places: Vec<&[f64]> = axes[..D]
        .iter()
        .map(|axis| picture.needed(axis, "give two coordinates in a planar column, three in a round one"))
        .collect::<Result<_, _>>()?;
    let count = places[0].len();
    let velocities: Vec<&[f64]> = SPEEDS[..D].iter().map(|speed| picture.column(speed)).collect();
    let size = if D == 2 { "area" } else { "volume" };
    let (mass, density) = if picture.column(size).is_empty() {
        let remedy = format!("name the column of the {size}, or those of mass and density");
        let wanted = |name| {
            picture
                .needed(name, "")
                .map_err(|_| FieldError::new(&format!("particles.columns.{size}"), "missing", "given", &remedy))
        };
        (wanted("mass")?.to_vec(), wanted("density")?.to_vec())
    } else {
        let mass = picture.column(size).iter().map(|size| size * bulk_density).collect();
        (mass, vec![bulk_density; count])
    };
    let sum: f64 = mass.iter().zip(&density).map(|(mass, density)| mass / density).sum();
    room.check(sum, D, picture)?;
    let of = |columns: &[&[f64]], particle: usize| {
        Vector::<D>::from_fn(|axis, _| columns[axis].get(particle).copied().unwrap_or(f64::NAN))
    };
    let snapshot = Snapshot {
        time: picture.time,
        position: (0..count).map(|particle| of(&places, particle)).collect(),
        velocity: (0..count).map(|particle| of(&velocities, particle)).collect(),
        mass,
        density,
        ..Snapshot::default()
    };
    room.check_start(&snapshot)?;
    Ok(snapshot)
}
