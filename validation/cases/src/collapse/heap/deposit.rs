//! What is measured of a spreading heap: thickness, front, heights, centroid and energies.

use super::fronts::{FRONT_THICKNESS, Fronts, ROW_THICKNESS};
use super::toe::Toe;
use crate::observation::{EnergyBook, MotionSequence};
use crate::setup::front::end_of_profile;
use crate::statistics::linear_fit;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::Snapshot;
use serde::{Deserialize, Serialize};

/// Width of a bin over the initial half width `[-]`: the same at every resolution.
pub const BIN_WIDTH: f64 = 0.1;
/// Points a horizontal direction over which a particle's volume is spread, in the plane and in space.
const SUB_POINTS: [usize; 2] = [8, 4];
/// Kinetic over released potential energy below which a deposit rests `[-]`.
pub(crate) const AT_REST: f64 = 5e-7;
/// Time series and final deposit; lengths over the half width r_0, times in `[s]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Collapse {
    /// Times `[s]`.
    pub time: Vec<f64>,
    /// Front x_f/r_0 `[-]`.
    pub front: Vec<f64>,
    /// Front at a thickness that a row of particles has, over r_0 `[-]`.
    pub rows_front: Vec<f64>,
    /// Thickness at the symmetry plane, by volume, over r_0 `[-]`.
    pub height: Vec<f64>,
    /// Kinetic energy `[J/m]` of a planar column, `[J]` of a quarter of a round one.
    pub kinetic_energy: Vec<f64>,
    /// Potential energy above the bed, in the same unit.
    pub potential_energy: Vec<f64>,
    /// (x/r_0, thickness/r_0) of the deposit, bin by bin `[-]`.
    pub deposit: Vec<(f64, f64)>,
    /// Fronts of the deposit; none where no particles are known of it.
    pub deposit_fronts: Option<Fronts>,
    /// Highest particle beside the symmetry plane, half a spacing added, over r_0 `[-]`.
    pub top: f64,
    /// Centroid of the deposit x/r_0 `[-]`.
    pub centroid: f64,
    /// 96 % and 99 % quantiles of the mass x/r_0 `[-]`.
    pub quantiles: (f64, f64),
    /// Particles below the bed, behind the symmetry plane, beyond the bed's end, or not a number.
    pub lost: usize,
    /// Largest momentum that neither gravity nor walls, mirrors, gate and contacts gave, over M g t `[-]`.
    pub momentum_residual: f64,
    /// The energy ledger.
    pub energy: EnergyBook,
    /// Positions and speeds for the animation.
    pub motion: MotionSequence,
}

/// Measures snapshots of one column: half a planar one in two dimensions, a quarter of a round one in three. The
/// vertical axis is the second one; radii are distances from the symmetry plane or axis.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Surveyor {
    /// Half width r_0 `[m]`.
    pub half_width: f64,
    /// Particle spacing `[m]`.
    pub spacing: f64,
    /// Gravity along the bed and across it `[m/s²]`.
    pub gravity: [f64; 2],
    /// End of the bed `[m]`.
    pub bed_end: f64,
    /// Measurements so far.
    pub collapse: Collapse,
}

impl Surveyor {
    /// Adds a point to the time series and gives the thickness, both over r_0.
    pub(crate) fn observe<const D: usize>(&mut self, snapshot: &Snapshot<D>) -> Vec<(f64, f64)> {
        let thickness = self.thickness(snapshot);
        let fronts = self.fronts(snapshot, &thickness);
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for ((mass, position), velocity) in snapshot.mass.iter().zip(&snapshot.position).zip(&snapshot.velocity) {
            kinetic += 0.5 * mass * velocity.norm_squared();
            potential -= mass * (self.gravity[0] * position[0] + self.gravity[1] * position[1]);
        }
        let residual = self.momentum_residual(snapshot);
        let collapse = &mut self.collapse;
        collapse.momentum_residual = collapse.momentum_residual.max(residual);
        collapse.time.push(snapshot.time);
        collapse.front.push(fronts.thin);
        collapse.rows_front.push(end_of_profile(&thickness, ROW_THICKNESS));
        collapse.height.push(thickness.first().map_or(0.0, |bin| bin.1));
        if let Some(account) = &snapshot.energy {
            collapse.energy.enter(snapshot.time, account, 0.0);
        }
        collapse.kinetic_energy.push(kinetic);
        collapse.potential_energy.push(potential);
        thickness
    }

    /// |Σ m v − Σ support impulses − M g t| over M g t `[-]`: the columns start at rest.
    fn momentum_residual<const D: usize>(&self, snapshot: &Snapshot<D>) -> f64 {
        let mass: f64 = snapshot.mass.iter().sum();
        let mut gravity = Vector::<D>::zeros();
        (gravity[0], gravity[1]) = (self.gravity[0], self.gravity[1]);
        let given = gravity * (mass * snapshot.time);
        let mut residual = -given;
        for ((mass, velocity), support) in snapshot.mass.iter().zip(&snapshot.velocity).zip(&snapshot.support_impulse) {
            residual += velocity * *mass - support;
        }
        if snapshot.time > 0.0 { residual.norm() / given.norm() } else { 0.0 }
    }

    /// Measures the deposit and ends the survey.
    pub(crate) fn finish<const D: usize>(mut self, end: &Snapshot<D>) -> Collapse {
        let r = self.half_width;
        self.collapse.deposit = self.thickness(end);
        self.collapse.deposit_fronts = Some(self.fronts(end, &self.collapse.deposit));
        let beside = end.position.iter().filter(|x| radius(x) < BIN_WIDTH * r);
        self.collapse.top = (beside.fold(0.0_f64, |top, x| top.max(x[1])) + 0.5 * self.spacing) / r;
        let total: f64 = end.mass.iter().sum();
        self.collapse.centroid =
            end.mass.iter().zip(&end.position).map(|(m, x)| m * radius(x)).sum::<f64>() / (total * r);
        let mut order: Vec<(f64, f64)> = end.position.iter().map(radius).zip(end.mass.iter().copied()).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let quantile = |share: f64| {
            let mut sum = 0.0;
            order.iter().find(|(_, mass)| {
                sum += mass;
                sum >= share * total
            })
        };
        let place = |share| quantile(share).map_or(f64::NAN, |(x, _)| x / r);
        self.collapse.quantiles = (place(0.96), place(0.99));
        // A particle squeezed through a symmetry plane is exchanged for its image at the next neighbour search, which
        // comes before it has moved by half the list's skin.
        let tolerance = 0.25 * self.spacing;
        let inside = |x: &Vector<D>| {
            let above = x[1] >= 0.0 && x.iter().all(|&x| x >= -tolerance && x.is_finite());
            above && radius(x) <= self.bed_end
        };
        self.collapse.lost = end.position.iter().filter(|x| !inside(x)).count();
        self.collapse
    }

    /// The fronts beyond the thickest bin of a thickness over r_0.
    pub(crate) fn fronts<const D: usize>(&self, snapshot: &Snapshot<D>, thickness: &[(f64, f64)]) -> Fronts {
        let r = self.half_width;
        let thickest = thickness.iter().copied().fold((0.5 * BIN_WIDTH, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        let start = (thickest.0 - 0.5 * BIN_WIDTH).max(0.0) * r;
        Fronts::of(&Toe::of(snapshot, start, thickest.1 * r, self.bed_end), r)
    }

    /// (x, ΣV over the bin's width or quarter ring), both over r_0. A particle's volume is spread evenly over a spacing
    /// to either side, mirrored at the symmetry planes: counted at points, bins of two spacings would jump by whole
    /// particles.
    pub(crate) fn thickness<const D: usize>(&self, snapshot: &Snapshot<D>) -> Vec<(f64, f64)> {
        let r = self.half_width;
        let width = BIN_WIDTH * r;
        let bins = (self.bed_end / width).ceil() as usize;
        let mut volume = vec![0.0; bins.max(1)];
        let points_along = SUB_POINTS[D - 2];
        let offsets: Vec<f64> = (0..points_along)
            .map(|step| (2.0 * (step as f64 + 0.5) / points_along as f64 - 1.0) * self.spacing)
            .collect();
        // plain coordinates: this is done for every particle at every picture
        let mut add = |distance: f64, share: f64| {
            if let Some(slot) = volume.get_mut((distance / width) as usize) {
                *slot += share;
            }
        };
        for ((position, mass), density) in snapshot.position.iter().zip(&snapshot.mass).zip(&snapshot.density) {
            let share = mass / density / points_along.pow(D as u32 - 1) as f64;
            let coordinates: &[f64] = position.as_slice();
            if D == 2 {
                for offset in &offsets {
                    add((coordinates[0] + offset).abs(), share);
                }
                continue;
            }
            for beside in &offsets {
                let z = (coordinates[2] + beside).abs();
                for offset in &offsets {
                    let x = (coordinates[0] + offset).abs();
                    add((x * x + z * z).sqrt(), share);
                }
            }
        }
        let area = |bin: usize| {
            let bin = bin as f64;
            if D == 2 { width } else { std::f64::consts::FRAC_PI_4 * width * width * (2.0 * bin + 1.0) }
        };
        let centre = |bin: usize| (bin as f64 + 0.5) * BIN_WIDTH;
        volume.iter().enumerate().map(|(bin, volume)| (centre(bin), volume / (area(bin) * r))).collect()
    }
}

/// Distance from the symmetry plane or axis.
pub(crate) fn radius<const D: usize>(position: &Vector<D>) -> f64 {
    if D == 2 { position[0] } else { (position[0] * position[0] + position[2] * position[2]).sqrt() }
}

impl Collapse {
    /// Largest root mean square of the speed over the collapse `[m/s]`, of a mass in the energies' unit.
    pub(crate) fn fastest(&self, mass: f64) -> f64 {
        (2.0 * self.kinetic_energy.iter().copied().fold(0.0, f64::max) / mass).sqrt()
    }

    /// Index of the observation nearest to a time `[s]`; none without observations.
    pub(crate) fn nearest(&self, time: f64) -> Option<usize> {
        let off = |index: usize| (self.time[index] - time).abs();
        (0..self.time.len()).min_by(|&a, &b| off(a).total_cmp(&off(b)))
    }

    /// Front x_f/r_0 of the deposit `[-]`: of its particles, else where its profile falls below [`FRONT_THICKNESS`], else the
    /// last of the series.
    pub fn deposit_front(&self) -> f64 {
        match self.deposit_fronts {
            Some(fronts) => fronts.thin,
            None if self.deposit.is_empty() => self.front.last().copied().unwrap_or(f64::NAN),
            None => end_of_profile(&self.deposit, FRONT_THICKNESS),
        }
    }

    /// (x_f − r_0)/r_0 of the deposit `[-]`.
    pub fn run_out(&self) -> f64 {
        self.deposit_front() - 1.0
    }

    /// The same with the front at 0.05 r_0 by thickness in bins, which a row of particles has from 20 over r_0 on `[-]`;
    /// not a number without a deposit, as where another code gave its front alone.
    pub fn run_out_of_rows(&self) -> f64 {
        if self.deposit.is_empty() { f64::NAN } else { end_of_profile(&self.deposit, ROW_THICKNESS) - 1.0 }
    }

    /// Standard uncertainty of a front over r_0 from the spacing, where no study of the resolution tells it `[-]`: the
    /// thickness at the toe is known to a share of a row.
    pub fn front_uncertainty(&self) -> Option<f64> {
        self.deposit_fronts.map(Fronts::uncertainty)
    }

    /// The deposit's bins up to the last that holds grains.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let end = self.deposit.iter().rposition(|bin| bin.1 > 0.0).map_or(0, |last| last + 1);
        self.deposit[..end].iter().copied()
    }

    /// Thickness of the deposit at the symmetry plane, by volume, over r_0 `[-]`.
    pub fn final_height(&self) -> f64 {
        self.deposit.first().map_or(f64::NAN, |bin| bin.1)
    }

    /// Kinetic energy over the potential energy released so far `[-]`.
    pub fn agitation(&self) -> f64 {
        match (self.kinetic_energy.last(), self.potential_energy.first(), self.potential_energy.last()) {
            (Some(kinetic), Some(first), Some(last)) if first > last => kinetic / (first - last),
            _ => f64::INFINITY,
        }
    }

    /// Time at which the grains had come to rest `[s]`; infinite where they had not when the run ended.
    pub fn rest_time(&self) -> f64 {
        self.time.last().copied().filter(|_| self.agitation() < AT_REST).unwrap_or(f64::INFINITY)
    }

    /// Time at which the front of a row's thickness has covered 99 % of its way `[s]`, linear between two observations.
    pub fn stopping_time(&self) -> f64 {
        let front = &self.rows_front;
        let (Some(&start), Some(&end)) = (front.first(), front.last()) else { return f64::NAN };
        let mark = start + 0.99 * (end - start);
        match front.iter().position(|&front| front >= mark) {
            None => f64::NAN,
            Some(0) => self.time[0],
            Some(after) => {
                let (x0, x1) = (front[after - 1], front[after]);
                let (t0, t1) = (self.time[after - 1], self.time[after]);
                t0 + (t1 - t0) * (mark - x0) / (x1 - x0)
            }
        }
    }

    /// Inclination of the deposit's surface `[°]`: a line through the thickness over 20–80 % of the front's distance.
    pub fn slope_angle(&self) -> f64 {
        linear_fit(&self.flank()).map_or(f64::NAN, |fit| libm::atan(-fit.slope).to_degrees())
    }

    /// Share of the variance of the flank's thickness that a straight line explains `[-]`: 1 for a cone or a wedge.
    pub fn flank_r_squared(&self) -> f64 {
        linear_fit(&self.flank()).map_or(f64::NAN, |line| line.r_squared)
    }

    /// The deposit from 20 to 80 % of the way to its front.
    fn flank(&self) -> Vec<(f64, f64)> {
        let front = self.deposit_front();
        self.deposit.iter().copied().filter(|(x, _)| (0.2..=0.8).contains(&(x / front))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_has_its_own_thickness_and_keeps_its_volume() {
        let spacing = 0.05;
        let place = |cell: usize| (cell as f64 + 0.5) * spacing;
        let particles = 20 * 16;
        let snapshot = Snapshot {
            position: (0..particles).map(|k| Vector::<2>::new(place(k % 20), place(k / 20))).collect(),
            mass: vec![2.0 * spacing * spacing; particles],
            density: vec![2.0; particles],
            ..Snapshot::default()
        };
        let surveyor =
            Surveyor { half_width: 1.0, spacing, gravity: [0.0, -9.81], bed_end: 2.0, collapse: Collapse::default() };
        let thickness = surveyor.thickness(&snapshot);
        assert!(thickness[..9].iter().all(|bin| (bin.1 - 0.8).abs() < 1e-12), "{thickness:?}");
        assert!((thickness.iter().map(|bin| bin.1 * BIN_WIDTH).sum::<f64>() - 0.8).abs() < 1e-12);
        let fronts = surveyor.fronts(&snapshot, &thickness);
        assert!((fronts.thin - 1.0).abs() < 1e-9, "{fronts:?}");
    }

    #[test]
    fn a_wedge_has_the_front_that_geometry_gives() {
        // thickness 1 − x/3, which is FRONT_THICKNESS at x = 2.94
        let deposit: Vec<(f64, f64)> =
            (0..60).map(|k| (k as f64 + 0.5) * BIN_WIDTH).map(|x| (x, (1.0 - x / 3.0).max(0.0))).collect();
        let collapse = Collapse { deposit, ..Collapse::default() };
        assert!((collapse.deposit_front() - 2.94).abs() < 0.05, "{}", collapse.deposit_front());
        assert!((collapse.run_out() - 1.94).abs() < 0.05);
        assert!((collapse.slope_angle() - libm::atan(1.0 / 3.0).to_degrees()).abs() < 1e-9);
    }

    #[test]
    fn grains_beyond_a_gap_do_not_move_the_front() {
        let deposit = vec![(0.05, 1.0), (0.15, 0.5), (0.25, 0.0), (0.35, 0.01), (0.45, 0.3)];
        let collapse = Collapse { deposit, ..Collapse::default() };
        assert!((collapse.deposit_front() - (0.15 + 0.1 * 0.48 / 0.5)).abs() < 1e-12);
    }
}
