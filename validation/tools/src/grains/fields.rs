//! From sums of windows to fields over the depth, and to a point (I, μ, φ) of the run.

use super::coarse::{Sums, Window};
use super::plan::GrainRun;
use crate::input::FieldError;
use crate::number::short_digits;
use crate::output::Table;
use crate::statistics::Mean;
use std::collections::BTreeMap;

/// Quantities of a bin with their units: nine of the flow, of which the last two follow from the momentum balance whatever contacts
/// bear, and the kinetic and contact stress, compression positive; xy is the momentum along the flow that crosses the depth.
const QUANTITIES: &str = "solid_fraction [-],velocity [m/s],shear_rate [1/s],pressure [Pa],shear_stress [Pa],friction [-],\
    inertial_number [-],balanced_pressure [Pa],balanced_shear_stress [Pa],kinetic_xx [Pa],kinetic_yy [Pa],kinetic_xy [Pa],\
    contact_xx [Pa],contact_yy [Pa],contact_xy [Pa],contact_yx [Pa]";
/// Places of inertial number, friction and solid fraction among them.
pub(super) const POINT: [usize; 3] = [6, 5, 0];
/// Mass below the core of the layer and below its upper end, over all of it `[-]`.
const CORE: std::ops::RangeInclusive<f64> = 0.2..=0.8;

/// Range of the contacts' stress over the momentum balance `[-]`; beyond it the plan does not describe the grains.
const BALANCED: std::ops::RangeInclusive<f64> = 0.7..=1.4;

/// Quantities of a bin, then its stress.
type Bin = [f64; 16];

/// Fields of a run.
#[derive(Debug, Clone)]
pub struct RunFields {
    /// Name of the run.
    pub name: String,
    /// The fields, a row a bin.
    pub table: Table,
    /// Means of the quantities over the core of the layer, with their standard uncertainties.
    pub core: [(f64, f64); 16],
    /// Range of the solid fraction of dense flows of spheres, or of discs `[-]`.
    pub usual_solid_fraction: [f64; 2],
    /// Number of windows.
    pub windows: usize,
    /// Frames, grains, mass and momentum.
    pub total: [f64; 4],
    /// Range of the root mean square velocity between windows over its mean `[-]`.
    pub unsteadiness: f64,
    /// Largest relative difference of mass and momentum of the fields from those of the grains `[-]`.
    pub defect: f64,
}

impl RunFields {
    /// Pressure and shear stress of the contacts over those of the momentum balance `[-]`; 1 without contacts.
    pub(super) fn balance(&self) -> [f64; 2] {
        [3, 4].map(|k| self.core[k].0 / self.core[k + 4].0)
    }

    /// Refuses contact stresses that are far from the momentum balance: a slope, load, density or unit of the plan is wrong.
    pub(super) fn check_balance(&self) -> Result<(), FieldError> {
        let forces = "check the unit of the forces, the density, and `gravity` or `pressure`; dump all contacts";
        let load = "check `slope_angle` or `shear_stress`, and dump the tangential forces too";
        let plans = [("contacts", "pressure", forces), ("slope_angle", "shear stress", load)];
        for ((field, name, remedy), ratio) in plans.into_iter().zip(self.balance()) {
            if ratio.is_finite() && !BALANCED.contains(&ratio) {
                let ratio = short_digits(ratio, 3);
                let defect =
                    format!("the contacts bear {ratio} of the {name} of the momentum balance, outside 0.7 to 1.4");
                return Err(FieldError::finding(field, defect, remedy));
            }
        }
        Ok(())
    }

    /// Refuses a layer on a slope that is fastest at its lower end: its height has the wrong sign.
    pub(super) fn check_direction(&self, run: &GrainRun) -> Result<(), FieldError> {
        let falls = self.core[2].0 * self.core[1].0 < 0.0;
        if run.slope_angle.is_none() || !falls {
            return Ok(());
        }
        let defect = "the layer is fastest at its lower end";
        let remedy = "let `y` be the height above the bed";
        Err(FieldError::finding("particles.columns.y", defect, remedy))
    }
}

impl GrainRun {
    /// Area `[m²]` of the layer from above; of discs per metre of width.
    pub(super) fn area(&self) -> f64 {
        self.length * self.width.unwrap_or(1.0)
    }

    /// All fields of the run at a place of the plan, of grains of a diameter and a density, in bins of a height.
    pub(super) fn fields(&self, place: usize, windows: &[Window], grains: [f64; 2], bin: f64) -> RunFields {
        let whole = Window::merged(windows);
        let of_windows: Vec<_> = windows.iter().map(|window| self.bins(window, grains, bin)).collect();
        let bins = self.bins(&whole, grains, bin);
        let (all, mut below) = (whole.bins.values().map(|sums| sums[0]).sum::<f64>(), 0.0);
        let mut is_core = |sums: &Sums| {
            below += sums[0];
            CORE.contains(&((below - 0.5 * sums[0]) / all))
        };
        let core: Vec<i64> = whole.bins.iter().filter(|(_, sums)| is_core(sums)).map(|(place, _)| *place).collect();
        let mean = |bins: &BTreeMap<i64, Bin>, k: usize| {
            let values: Vec<f64> = core.iter().filter_map(|place| bins.get(place)).map(|bin| bin[k]).collect();
            values.iter().sum::<f64>() / values.len() as f64
        };
        let row = |(place, values): (&i64, &Bin)| {
            let uncertain = |(k, value): (usize, &f64)| {
                [*value, uncertainty(of_windows.iter().filter_map(|own| Some(own.get(place)?[k])))]
            };
            [vec![(*place as f64 + 0.5) * bin], values.iter().enumerate().flat_map(uncertain).collect()].concat()
        };
        let heading = |name: &str| [name.to_owned(), name.replace(" [", " uncertainty [")];
        let speeds: Vec<f64> = windows.iter().map(speed).collect();
        let [low, high] = [f64::min, f64::max].map(|end| speeds.iter().copied().fold(speeds[0], end));
        let defect = |k: usize| whole.bins.values().map(|sums| sums[k]).sum::<f64>() / whole.total[2 + k] - 1.0;
        RunFields {
            name: self.name.clone(),
            table: Table {
                name: format!("fields-{}", place + 1),
                columns: [vec!["y [m]".to_owned()], QUANTITIES.split(',').flat_map(heading).collect()].concat(),
                rows: bins.iter().map(row).collect(),
            },
            core: std::array::from_fn(|k| (mean(&bins, k), uncertainty(of_windows.iter().map(|own| mean(own, k))))),
            usual_solid_fraction: if self.width.is_some() { [0.4, 0.7] } else { [0.6, 0.92] },
            windows: windows.len(),
            total: whole.total,
            unsteadiness: (high - low) / speed(&whole),
            defect: defect(0).abs().max(defect(1).abs()),
        }
    }

    /// Quantities of every bin, from the top.
    fn bins(&self, window: &Window, [diameter, density]: [f64; 2], bin: f64) -> BTreeMap<i64, Bin> {
        let per_area = 1.0 / (window.total[0] * self.area());
        let [sin, cos] = [libm::sin, libm::cos].map(|part| part(self.slope_angle.map_or(f64::NAN, f64::to_radians)));
        let mut above = 0.0;
        let of_bin = |(place, sums): (&i64, &Sums)| {
            let [mass, mvx, mvy, xx, yy, xy, my, myy, myx, contact @ ..] = *sums;
            above += mass * per_area;
            // bins that only the ends of branches reach hold no grains
            let [vx, vy, y] = [mvx, mvy, my].map(|sum| sum / mass);
            // the line through the velocities of the grains: what it explains is no fluctuation
            let variance = myy / mass - y * y;
            let rate = (myx / mass - y * vx) / variance;
            let explained = rate * rate * variance;
            let kinetic = [xx / mass - vx * vx - explained, yy / mass - vy * vy, xy / mass - vx * vy];
            let [kxx, kyy, kxy] = kinetic.map(|part| part * mass * per_area / bin);
            let [cxx, cyy, cxy, cyx] = contact.map(|part| part * per_area / bin);
            let weight = self.gravity.unwrap_or(9.81) * (above - 0.5 * mass * per_area);
            let (balanced, shear) = (self.pressure.unwrap_or(weight * cos), self.shear_stress.unwrap_or(weight * sin));
            let (pressure, shear_stress) =
                if self.contacts.is_some() { (kyy + cyy, -(kxy + cxy) * rate.signum()) } else { (balanced, shear) };
            let inertial_number = rate.abs() * diameter * (density / pressure).sqrt();
            let solid = mass * per_area / bin / density;
            let friction = shear_stress / pressure;
            let mut values = [0.0; 16];
            values[..7].copy_from_slice(&[solid, vx, rate, pressure, shear_stress, friction, inertial_number]);
            values[7..].copy_from_slice(&[balanced, shear, kxx, kyy, kxy, cxx, cyy, cxy, cyx]);
            (mass > 0.0).then_some((*place, values))
        };
        window.bins.iter().rev().filter_map(of_bin).collect()
    }
}

/// Standard uncertainty of the mean of windows.
fn uncertainty(values: impl Iterator<Item = f64>) -> f64 {
    Mean::of(0, &values.collect::<Vec<f64>>()).map_or(f64::NAN, |mean| mean.standard_error)
}

/// Root mean square velocity along the flow.
fn speed(window: &Window) -> f64 {
    let sum = |k: usize| window.bins.values().map(|sums| sums[k]).sum::<f64>();
    (sum(3) / sum(0)).sqrt()
}
