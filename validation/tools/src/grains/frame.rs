//! Grains of a frame: which flow, and refusals of what is no layer of one kind of grains.

use super::plan::GrainRun;
use crate::case::NamedColumns;
use crate::input::FieldError;
use crate::number::short_digits;
use std::f64::consts::PI;

/// Fewest grains of which a mean is taken, and fewest that move as one.
const FEWEST: [usize; 2] = [50, 3];
/// Most sizes of grains that are kinds, not a distribution, and the least ratio of two neighbouring sizes between two distributions.
const MOST_KINDS: usize = 5;
const GAP: f64 = 1.2;
/// Least depth of a layer in diameters, and the range of its solid fraction.
const LEAST_DEPTH: f64 = 4.0;
const SOLID: [f64; 2] = [0.05, 1.0];

/// The grains of a frame.
pub(super) struct Grains<'f> {
    pub(super) columns: &'f NamedColumns,
    /// Rows of layers that flow.
    pub(super) rows: Vec<usize>,
}

impl<'f> Grains<'f> {
    /// Grains, with the kinds of those that flow.
    pub(super) fn new(columns: &'f NamedColumns, kinds: &[f64]) -> Self {
        let all = Self { columns, rows: Vec::new() };
        let count = columns.values().next().map_or(0, Vec::len);
        let rows = (0..count).filter(|row| kinds.is_empty() || kinds.contains(&all.at("kind", *row))).collect();
        Self { rows, ..all }
    }

    /// The value of a column, 0 of one that is not given.
    pub(super) fn at(&self, name: &str, row: usize) -> f64 {
        self.columns.get(name).map_or(0.0, |column| column[row])
    }

    fn all(&self, name: &str) -> Vec<f64> {
        self.rows.iter().map(|&row| self.at(name, row)).collect()
    }

    /// Different values of a column.
    fn distinct(&self, name: &str) -> Vec<f64> {
        let mut values = self.all(name);
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * b.abs());
        values
    }

    /// Radii on both sides of a gap between two distributions, of which each has a twentieth of the grains at least.
    fn gap(&self) -> Option<[f64; 2]> {
        let mut radii = self.all("radius");
        radii.sort_by(f64::total_cmp);
        let few = radii.len() / 20 + 1;
        let inner = few.saturating_sub(1)..(radii.len() + 1).saturating_sub(few).max(few);
        let pairs = radii.get(inner).unwrap_or_default().windows(2);
        pairs.map(|pair| [pair[0], pair[1]]).find(|pair| pair[0] > 0.0 && pair[1] > GAP * pair[0])
    }

    /// Number of grains that move exactly as the most others do.
    pub(super) fn alike(&self) -> usize {
        let [vx, vy] = ["vx", "vy"].map(|name| &self.columns[name]);
        let mut velocities: Vec<[u64; 2]> = self.rows.iter().map(|&row| [vx[row], vy[row]].map(f64::to_bits)).collect();
        velocities.sort_unstable();
        velocities.chunk_by(|a, b| a == b).map(<[_]>::len).max().unwrap_or(0)
    }

    /// Mass of a sphere, or of a disc per metre of width.
    pub(super) fn mass(&self, run: &GrainRun, row: usize) -> f64 {
        let radius = self.at("radius", row);
        let depth = if run.width.is_some() { 4.0 / 3.0 * radius } else { 1.0 };
        self.at("density", row) * PI * radius * radius * depth
    }

    /// Diameter `[m]` and density `[kg/m³]` of a layer of one kind of grains.
    ///
    /// # Errors
    /// Several kinds, too few grains, radii in another unit than places, no depth.
    pub(super) fn layer(&self, run: &GrainRun) -> Result<[f64; 2], FieldError> {
        let wrong = |column: &str, value: String, rule: &str, remedy: &str| Err(refused(column, value, rule, remedy));
        for (name, most) in [("kind", usize::MAX), ("density", usize::MAX), ("radius", MOST_KINDS)] {
            let values = self.distinct(name);
            let is_chosen = name == "kind" && !run.kinds.is_empty() || name == "radius" && run.grain_diameter.is_some();
            let gap = self.gap().filter(|_| name == "radius");
            if ((2..=most).contains(&values.len()) || gap.is_some()) && !is_chosen {
                let listed: Vec<String> = values.iter().take(MOST_KINDS).map(f64::to_string).collect();
                let remedy = "choose one by `kinds`, or give `grain_diameter` for mixed sizes";
                let defect = match gap {
                    Some(gap) if values.len() > most => {
                        format!("two distributions, up to {} and from {} m", gap[0], gap[1])
                    }
                    _ => format!("{} different values, {}, where one is allowed", values.len(), listed.join(", ")),
                };
                return wrong(name, defect, "", remedy);
            }
        }
        let (count, heights, density) = (self.rows.len(), self.distinct("y"), self.distinct("density"));
        if count < FEWEST[0] || density[0] <= 0.0 || self.distinct("radius")[0] <= 0.0 {
            let defect = format!("{count} grains; needed are {} of positive radius and density", FEWEST[0]);
            return wrong("y", defect, "", "check `kinds` and the dump, or simulate more");
        }
        let mean = 2.0 * self.all("radius").iter().sum::<f64>() / count as f64;
        let depth = heights[heights.len() - 1] - heights[0];
        let mass = self.rows.iter().map(|&row| self.mass(run, row)).sum::<f64>();
        let solid = mass / (density[0] * run.area() * (depth + mean));
        if depth > 0.0 && !(SOLID[0]..=SOLID[1]).contains(&solid) {
            let (radius, solid) = (short_digits(0.5 * mean, 3), short_digits(solid, 2));
            let defect = format!("{radius} m gives a solid fraction of {solid}, outside 0.05 to 1");
            let remedy = "check its unit, such as \"radius [mm]\", and the periods";
            return wrong("radius", defect, "", remedy);
        }
        if depth < LEAST_DEPTH * mean {
            let depth = short_digits(depth / mean, 2);
            let defect = format!("the layer is {depth} diameters deep, less than {LEAST_DEPTH}");
            return wrong("y", defect, "", "let `y` name the column across the layer");
        }
        Ok([run.grain_diameter.unwrap_or(mean), density[0]])
    }
}

/// Refuses grains of which some move as one in each frame, or not at all.
pub(super) fn check_walls(alike: usize) -> Result<(), FieldError> {
    if alike < FEWEST[1] {
        return Ok(());
    }
    let remedy = "leave them out by `kinds`: they are probably a wall";
    Err(refused("vx", format!("{alike} grains have the same velocity in each frame"), "", remedy))
}

/// Refusal of a column of grains.
fn refused(column: &str, value: String, rule: &str, remedy: &str) -> FieldError {
    FieldError::new(&format!("particles.columns.{column}"), value, rule, remedy)
}
