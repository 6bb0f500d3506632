//! Front position of a material.

use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

/// Parts that a particle's volume is spread in over a spacing to either side.
const PARTS: usize = 8;

/// A line along which material reaches up to where less than a section stands across it.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontLine<const D: usize> {
    /// Its start `[m]`.
    pub from: Vector<D>,
    /// Its end `[m]`.
    pub to: Vector<D>,
    /// The section: in the plane a thickness `[m]`, in space an area `[m²]`.
    pub section: f64,
    /// The unit vector across it and gravity, and how far from it along that material counts `[m]`; none where all counts.
    pub strip: Option<(Vector<D>, f64)>,
}

impl<const D: usize> FrontLine<D> {
    /// The first place along it, from its start and where material stands on, with less than the section `[m]`: volumes of
    /// particles are spread over a `spacing` `[m]` to either side.
    pub fn reached(&self, spacing: f64, snapshot: &Snapshot<D>) -> f64 {
        let (bin, length) = (0.25 * spacing, (self.to - self.from).norm());
        let along = (self.to - self.from) / length;
        let bins = (length / bin).ceil() as usize;
        let shifts: [f64; PARTS] =
            std::array::from_fn(|part| (part as f64 - 0.5 * (PARTS as f64 - 1.0)) * 2.0 / PARTS as f64 * spacing);
        let mut shares = vec![[0.0; PARTS]; bins];
        for ((place, mass), density) in snapshot.position.iter().zip(&snapshot.mass).zip(&snapshot.density) {
            let way = place - self.from;
            if self.strip.is_some_and(|(across, half)| way.dot(&across).abs() >= half) {
                continue;
            }
            let (middle, volume) = (way.dot(&along), mass / density);
            for (part, shift) in shifts.iter().enumerate() {
                let place = middle + shift;
                if place >= 0.0
                    && place < length
                    && let Some(parts) = shares.get_mut((place / bin) as usize)
                {
                    parts[part] += volume;
                }
            }
        }
        let area: Vec<f64> = shares.iter().map(|parts| parts.iter().map(|part| part / PARTS as f64).sum()).collect();
        let stands = |area: &f64| *area >= self.section * bin;
        let Some(first) = area.iter().position(stands) else { return 0.0 };
        let gap = area[first..].iter().position(|area| !stands(area));
        gap.map_or(length, |gap| (first + gap) as f64 * bin)
    }
}

/// The first place at which a profile of (place, thickness) falls below a thickness, linear between its points; its end
/// where it does not.
pub fn end_of_profile(thickness: &[(f64, f64)], least: f64) -> f64 {
    for pair in thickness.windows(2) {
        let [(x0, h0), (x1, h1)] = [pair[0], pair[1]];
        if h0 >= least && h1 < least {
            return x0 + (x1 - x0) * (h0 - least) / (h0 - h1);
        }
    }
    thickness.last().map_or(0.0, |bin| bin.0)
}
