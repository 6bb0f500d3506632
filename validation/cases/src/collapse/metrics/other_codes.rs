//! Collapses beside other codes under the same law, over time. The kinetic energy tells how much friction rises with the rate; fronts at rest do
//! not.

use super::bands::{SAME_LAW, band};
use super::quantities::*;
use crate::collapse::{Collapse, ColumnFlow, Material, SlopeFlow};
use crate::figure::Panel;
use crate::metric::{Limit, Metric, MetricKind, Origin, Quantity, Variant};
use crate::reference::collapse::{AT_REST, CodeQuantity, OtherCodes, PLANAR_CODES, ROUND_CODES, SLOPE_CODES};
use crate::reference::grains::GLASS_BEADS;
use crate::statistics::{Extrapolation, interpolated};
use bagnold_solver::material::rheology::Rheology;

const REASON: &str = "15 %: twice the standard deviation of four codes' run-outs for one column of these grains";

/// Largest distance of a deposit's centroid from the mean of two other methods under the same law `[-]`.
const SAME_CENTROID: f64 = 0.077;
const CENTROID_REASON: &str = "7.7 %: twice the standard deviation of one code from the mean of two others";

/// Time at which columns are compared, over √(h_0/g) `[-]`: later the other codes are known less well, earlier laws differ by less.
pub(crate) const MID_COLLAPSE: f64 = 2.0;
/// Half width of the columns in the tables `[m]`: with the grains' diameter it sets their inertial number.
const HALF_WIDTH: f64 = 0.1;
/// Speed of the gate `[m/s]`, height and length of the reservoir in the table `[m]`.
const RELEASE: (f64, f64, f64) = (1.3, 0.14, 0.2);

/// A collapse that a table has, with the scales of its times and energies.
pub(crate) struct Beside<'a> {
    codes: &'a OtherCodes,
    /// Aspect ratio `[-]` or slope `[°]`, as the table has it.
    flow: f64,
    /// √(h_0/g) `[s]`.
    pub(crate) time_scale: f64,
    /// ½ M g h_0, in the unit of the energies.
    pub(crate) energy_scale: f64,
    collapse: &'a Collapse,
}

impl<'a> Beside<'a> {
    /// A column of Lagrée's grains with the width of the tables; none for other columns.
    pub(crate) fn of_column<const D: usize>(run: &ColumnFlow<D>, collapse: &'a Collapse) -> Option<Self> {
        let codes = if D == 2 { &*PLANAR_CODES } else { &*ROUND_CODES };
        let energy_scale = *collapse.potential_energy.first()?;
        let is_of_them = run.made_of() == Material::LAGREE && run.has_published_law() && run.half_width == HALF_WIDTH;
        is_of_them.then_some(Self {
            codes,
            flow: run.aspect_ratio,
            time_scale: run.time_scale(),
            energy_scale,
            collapse,
        })
    }

    /// Glass beads behind gate and in the reservoir of the table; none for others.
    pub(crate) fn of_slope(run: &SlopeFlow, collapse: &'a Collapse) -> Option<Self> {
        let SlopeFlow { gate_speed, initial_height, reservoir_length, gravity, .. } = *run;
        let is_of_them =
            (gate_speed, initial_height, reservoir_length) == RELEASE && run.material == Rheology::MuI(GLASS_BEADS.law);
        is_of_them.then_some(Self {
            codes: &SLOPE_CODES,
            flow: run.slope_angle,
            time_scale: (initial_height / gravity).sqrt(),
            energy_scale: 0.5 * run.density() * gravity * reservoir_length * initial_height * initial_height,
            collapse,
        })
    }

    /// A series of the collapse at a time over √(h_0/g); none for a run that is shorter.
    fn own(&self, values: &[f64], time: f64) -> Option<f64> {
        let points: Vec<(f64, f64)> = self.collapse.time.iter().copied().zip(values.iter().copied()).collect();
        interpolated(&points, time * self.time_scale, (Extrapolation::Nothing, Extrapolation::Nothing))
    }

    /// Kinetic energy and front at a time over √(h_0/g), beside those of the codes that tell them.
    pub(crate) fn metrics(&self, variant: &Variant, time: f64) -> Vec<Metric> {
        let variant = Variant::of("free_fall_times", time).followed_by(variant);
        let beside = |quantity: Quantity, values: &[f64], scale: f64, of_codes: CodeQuantity, start: f64| {
            let (mean, uncertainty) = self.codes.at(self.flow, of_codes, time)?;
            let width = SAME_LAW * (mean - start);
            let metric = quantity.of(&variant, self.own(values, time)? / scale).of_kind(MetricKind::Verification);
            let source = "the other codes: their spacing and step, and how far they are apart";
            Some(
                metric
                    .against(Some(mean), &self.codes.source, self.codes.confidence)
                    .known_to(Origin::Numerical, Some(uncertainty), source)
                    .with_snapshot_tolerance(1e-2, 1e-3)
                    .gated(Limit::Within(mean - width, mean + width), REASON),
            )
        };
        let energy =
            beside(KINETIC_ENERGY, &self.collapse.kinetic_energy, self.energy_scale, CodeQuantity::KineticEnergy, 0.0);
        let front = beside(FRONT, &self.collapse.rows_front, 1.0, CodeQuantity::Front, 1.0);
        energy.into_iter().chain(front).collect()
    }

    /// Run-out of the deposit beside that of the codes; unchanged where no code gives it.
    pub(crate) fn deposit(&self, metric: Metric, of_codes: CodeQuantity) -> Metric {
        let Some((mean, uncertainty)) = self.codes.at(self.flow, of_codes, AT_REST) else { return metric };
        let (share, reason) = match of_codes {
            CodeQuantity::CentroidAtRest => (SAME_CENTROID, CENTROID_REASON),
            _ => (SAME_LAW, REASON),
        };
        metric
            .of_kind(MetricKind::Verification)
            .against(Some(mean), &self.codes.source, self.codes.confidence)
            .known_to(Origin::Numerical, Some(uncertainty), "half of the difference between the other codes")
            .gated(band(mean, share), reason)
    }

    /// The codes' points in a panel over t/√(h_0/g), each changed by a linear function; an error bar is twice the code's uncertainty.
    pub(crate) fn draw(
        &self,
        panel: &mut Panel,
        quantity: CodeQuantity,
        slot: usize,
        change: impl Fn((f64, f64)) -> (f64, f64),
    ) {
        for (place, series) in self.codes.of(self.flow, quantity).enumerate() {
            let points: Vec<(f64, f64)> = series.points.iter().map(|&(time, value, _)| change((time, value))).collect();
            let bar = |&(time, value, standard): &(f64, f64, f64)| {
                change((time, value + 2.0 * standard)).1 - change((time, value)).1
            };
            panel.points(&series.code, slot + 4 * place, points).error = series.points.iter().map(bar).collect();
        }
    }
}
