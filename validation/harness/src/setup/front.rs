//! Front position of a material.

use crate::output::ABSENT;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

/// Parts that a particle's volume is spread in over a spacing to either side.
const PARTS: usize = 8;
/// Length of a bin along a line, in spacings `[-]`.
const BIN: f64 = 0.25;
/// Cosine between a line and a direction, of unit length across it, below which it has no side there `[-]`.
const PARALLEL: f64 = 1e-3;

/// A line along which material reaches up to where less than a section stands across it.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontLine<const D: usize> {
    /// Start `[m]`.
    pub from: Vector<D>,
    /// End `[m]`.
    pub to: Vector<D>,
    /// The section: in the plane a thickness `[m]`, in space an area `[m²]`.
    pub section: f64,
    /// The unit vector across it and gravity, and how far from it along that material counts `[m]`; none where all counts.
    pub strip: Option<(Vector<D>, f64)>,
    /// Unit vector normal to the line, towards the side whose material counts; `None` if both sides count.
    pub side: Option<Vector<D>>,
}

impl<const D: usize> FrontLine<D> {
    /// The first place along it, from its start and where material stands on, with less than the section `[m]`: volumes of
    /// particles are spread over a `spacing` `[m]` to either side. [`ABSENT`] where nowhere along it stands as much.
    pub fn reached(&self, spacing: f64, snapshot: &Snapshot<D>) -> f64 {
        self.first_below([self.section], spacing, snapshot)[0]
    }

    /// The same, and its places for half a row of particles more and less than the section `[m]`: where a layer is about as thick as the
    /// section, the front jumps between them, because a layer consists of whole rows.
    pub fn interval(&self, spacing: f64, snapshot: &Snapshot<D>) -> [f64; 3] {
        let half_a_row = 0.5 * spacing * self.strip.map_or(1.0, |(_, half)| 2.0 * half);
        // less than nothing would stand everywhere
        let less = (self.section - half_a_row).max(f64::MIN_POSITIVE);
        self.first_below([self.section, self.section + half_a_row, less], spacing, snapshot)
    }

    /// The line for the material on one side of it; none where it runs along that direction.
    pub fn on_side(&self, direction: &Vector<D>) -> Option<Self> {
        let along = (self.to - self.from).normalize();
        let across = (direction - along * direction.dot(&along)).try_normalize(PARALLEL)?;
        Some(Self { side: Some(across), ..self.clone() })
    }

    /// Whether material of at least the section covers more than half of the line.
    pub fn is_covered(&self, spacing: f64, snapshot: &Snapshot<D>) -> bool {
        let areas = self.areas(spacing, snapshot);
        let covered = areas.iter().filter(|area| **area >= self.section * BIN * spacing);
        2 * covered.count() > areas.len()
    }

    /// Volumes of the material along it `[m^D]`, in bins.
    fn areas(&self, spacing: f64, snapshot: &Snapshot<D>) -> Vec<f64> {
        let (bin, length) = (BIN * spacing, (self.to - self.from).norm());
        let along = (self.to - self.from) / length;
        let bins = (length / bin).ceil() as usize;
        let shifts: [f64; PARTS] =
            std::array::from_fn(|part| (part as f64 - 0.5 * (PARTS as f64 - 1.0)) * 2.0 / PARTS as f64 * spacing);
        let mut shares = vec![[0.0; PARTS]; bins];
        for ((place, mass), density) in snapshot.position.iter().zip(&snapshot.mass).zip(&snapshot.density) {
            let way = place - self.from;
            let is_beside = self.strip.is_some_and(|(across, half)| way.dot(&across).abs() >= half);
            if is_beside || self.side.is_some_and(|side| way.dot(&side) < 0.0) {
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
        shares.iter().map(|parts| parts.iter().map(|part| part / PARTS as f64).sum()).collect()
    }

    fn first_below<const N: usize>(&self, sections: [f64; N], spacing: f64, snapshot: &Snapshot<D>) -> [f64; N] {
        let (bin, length) = (BIN * spacing, (self.to - self.from).norm());
        let area = self.areas(spacing, snapshot);
        sections.map(|section| {
            let stands = |area: &f64| *area >= section * bin;
            let Some(first) = area.iter().position(stands) else { return ABSENT };
            let gap = area[first..].iter().position(|area| !stands(area));
            gap.map_or(length, |gap| (first + gap) as f64 * bin)
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Front and interval of a layer of so many rows in a length of cells of 1 m, and of one row in as many more with a gap in the middle
    /// of them.
    fn fronts(section: f64, gap: f64) -> [f64; 3] {
        let thick = (0..10).flat_map(|k| (0..4).map(move |row| [f64::from(k) + 0.5, f64::from(row) + 0.5]));
        let thin = (10..20).map(|k| [f64::from(k) + 0.5 + if k < 15 { 0.0 } else { gap }, 0.5]);
        let position: Vec<Vector<2>> = thick.chain(thin).map(Vector::from).collect();
        let ones = vec![1.0; position.len()];
        let snapshot = Snapshot { mass: ones.clone(), density: ones, position, ..Snapshot::default() };
        let line =
            FrontLine { from: Vector::<2>::zeros(), to: Vector::<2>::new(40.0, 0.0), section, strip: None, side: None };
        line.interval(1.0, &snapshot)
    }

    #[test]
    fn a_front_that_jumps_along_a_thin_layer_stays_in_its_interval() {
        // a gap of a tenth of a spacing takes the front from the end of the row to its middle
        let ([whole, ..], [parted, least, most]) = (fronts(0.95, 0.0), fronts(0.95, 0.2));
        assert!((whole - 20.0).abs() < 1.0 && (parted - 15.0).abs() < 1.5, "{whole} and {parted}");
        assert!(least <= parted && whole <= most + 0.5, "{whole} and {parted} from {least} to {most}");
        assert!((least - 10.0).abs() < 1.0, "four rows end at {least}");
        // a steep front has a narrow interval
        let [front, least, most] = fronts(2.0, 0.0);
        assert!(most - least < 1.0 && (front - 10.0).abs() < 1.0, "{least} to {most}");
    }
}
