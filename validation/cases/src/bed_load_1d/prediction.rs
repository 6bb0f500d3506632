//! Bed load of a flume: the layer with closures drawn from their ranges, times the scatter of measured runs.

use super::draws::{drawn_closures, steady};
use super::flow::{BedLoad1dFlow, GrainUnits, LayerStream, SimilarStream};
use crate::case::ParameterError;
use crate::reference::bed_load::{Flume, TransportFormula, measured_grains, measured_rates_about, measured_scatter};
use crate::reference::one_dimension::bed_load::{Closures, LayerState, Stream};
use crate::reference::points::MeasuredBand;
use crate::statistics::percentile;
use bagnold_number::four_digits;

/// Cells over a grain and depth of the bed in grains, as those of the case on its slopes.
const CELLS_PER_DIAMETER: f64 = 20.0;
const BED: f64 = 8.0;
/// Change of a step at which a layer counts as steady: as those of the case with drawn closures.
const STEADY: f64 = 1e-6;
/// Rounds in which the velocity and the bed's part of the shear stress follow from each other.
const ROUNDS: usize = 4;

/// A flume and its grains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BedLoadFlume {
    /// Grain diameter d `[m]`.
    pub grain_diameter: f64,
    /// Grain density ρ_s `[kg/m³]`.
    pub grain_density: f64,
    /// Slope S of the energy line `[-]`.
    pub slope: f64,
    /// Depth h of the water `[m]`.
    pub depth: f64,
    /// Width b `[m]`; none without side walls.
    pub width: Option<f64>,
}

/// The transport of a flume.
#[derive(Debug, Clone, PartialEq)]
pub struct TransportPrediction {
    /// The stream over the bed, under the bed's part of the shear stress.
    pub stream: Stream,
    /// Mean velocity of the water `[m/s]`.
    pub velocity: f64,
    /// Part of the shear stress ρ g h S that the bed has `[-]`.
    pub bed_share: f64,
    /// The same with walls as smooth as the bed `[-]`.
    pub smooth_bed_share: f64,
    /// q* with the usual closures `[-]`.
    pub transport: f64,
    /// Range that contains 95 % of the draws of the closures `[-]`.
    pub by_closures: (f64, f64),
    /// Draws that have a steady state, and all.
    pub draws: (usize, usize),
    /// Between these lie 95 % of the draws, each times the ratio of each measured run to their median: of the runs at about this Shields
    /// number, or without them of all well above the threshold `[-]`.
    pub interval: (f64, f64),
    /// q* of Wong & Parker's formula `[-]`.
    pub formula: f64,
    /// Measured runs at about this Shields number.
    pub rates: Option<MeasuredBand>,
    /// Quantities outside of what was compared with measurements, with their ranges.
    pub outside: Vec<String>,
}

impl BedLoadFlume {
    /// The layer under a part of the shear stress `[-]`.
    fn layer(&self, share: f64, closures: Closures) -> BedLoad1dFlow {
        let usual = BedLoad1dFlow::default();
        let relative_depth = (CELLS_PER_DIAMETER * self.depth / self.grain_diameter).round() / CELLS_PER_DIAMETER;
        let lengths = GrainUnits { relative_depth, relative_bed_depth: BED, cells_per_diameter: CELLS_PER_DIAMETER };
        let excess = self.grain_density / usual.fluid_density - 1.0;
        let shields_number = share * self.slope * self.depth / (excess * self.grain_diameter);
        BedLoad1dFlow {
            stream: LayerStream::ShieldsNumber(SimilarStream { shields_number, lengths }),
            grain_density: self.grain_density,
            grain_diameter: self.grain_diameter,
            closures,
            steady_change: STEADY,
            ..usual
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let refused = |field, value: f64, rule: &str, remedy| Err(ParameterError::field(field, value, rule, remedy));
        if !(2.0..=1000.0).contains(&(self.depth / self.grain_diameter)) {
            return refused("depth", self.depth, "2 to 1000 grain diameters", "give both in metres: 0.002 for 2 mm");
        }
        if let Some(width) = self.width.filter(|width| *width < self.depth) {
            let remedy = "widen the flume or reduce the depth: otherwise the walls carry most of the stress";
            return refused("width", width, "at least the depth of the water", remedy);
        }
        let layer = self.layer(1.0, Closures::default());
        let limit = layer.stream().sliding_slope(&layer.closures);
        if self.grain_density > layer.fluid_density && self.slope >= limit {
            let rule = format!("below {}, where more than {BED} grain diameters of the bed move", four_digits(limit));
            let remedy = "reduce it or the depth: deeper sheet flow is not modelled";
            return refused("slope", self.slope, &rule, remedy);
        }
        layer.checked()
    }

    /// Transport over a number of draws of the closures.
    ///
    /// # Errors
    /// A flume that breaks a rule of the layer, a layer without a steady state, and an interruption.
    pub fn predict(&self, draws: usize) -> Result<TransportPrediction, ParameterError> {
        self.check()?;
        let (mut bed_share, mut smooth_bed_share) = (1.0, 1.0);
        let usual = Closures::default();
        let mut state = steady(&self.layer(bed_share, usual))?;
        for _ in 0..self.width.map_or(0, |_| ROUNDS) {
            let velocity = state.as_ref().map_or(f64::NAN, LayerState::mean_fluid_velocity);
            let width = self.width.unwrap_or(f64::INFINITY);
            let flume = Flume { width, depth: self.depth, velocity, slope: self.slope };
            let BedLoad1dFlow { gravity, kinematic_viscosity, .. } = self.layer(1.0, usual);
            (bed_share, smooth_bed_share) = (flume.bed_share(gravity, kinematic_viscosity), flume.smooth_bed_share());
            state = steady(&self.layer(bed_share, usual))?;
        }
        let own = self.layer(bed_share, usual);
        let Some(state) = state else {
            let remedy = "reduce the depth, or give another slope";
            return Err(ParameterError::field("slope", self.slope, "a slope on which the flow becomes steady", remedy));
        };
        let mut drawn = Vec::new();
        for closures in drawn_closures(&usual, draws) {
            drawn.extend(steady(&self.layer(bed_share, closures))?.map(|state| state.transport()));
        }
        drawn.sort_by(f64::total_cmp);
        let stream = own.stream();
        let shields_number = stream.shields_number();
        let rates = measured_rates_about(shields_number);
        let mut ratios = measured_scatter(shields_number);
        ratios.sort_by(f64::total_cmp);
        let median = percentile(&ratios, 0.5);
        let scattered = drawn.iter().flat_map(|transport| ratios.iter().map(move |ratio| transport * ratio / median));
        let mut scattered: Vec<f64> = scattered.collect();
        scattered.sort_by(f64::total_cmp);
        Ok(TransportPrediction {
            velocity: state.mean_fluid_velocity(),
            bed_share,
            smooth_bed_share,
            transport: state.transport(),
            by_closures: (percentile(&drawn, 0.025), percentile(&drawn, 0.975)),
            draws: (drawn.len(), draws),
            interval: (percentile(&scattered, 0.025), percentile(&scattered, 0.975)),
            formula: TransportFormula::WongParker.transport(shields_number),
            outside: self.outside(&stream, rates.is_some()),
            rates,
            stream,
        })
    }

    /// Quantities outside of what was compared with measurements, and those for which the layer is not one of bed load.
    fn outside(&self, stream: &Stream, has_rates: bool) -> Vec<String> {
        let beyond = |name: &str, value: f64, (least, most): (f64, f64)| {
            let digits = [value, least, most].map(four_digits);
            let is_outside = value < least || value > most;
            is_outside.then(|| format!("{name} {} is outside of {} to {}", digits[0], digits[1], digits[2]))
        };
        let layer = stream.outside_bed_load();
        let [diameters, slopes] = measured_grains();
        let shields = stream.shields_number();
        [
            layer.and_then(|own| beyond(&format!("bed load: {}", own.quantity), own.value, (own.least, own.most))),
            beyond("measurements: grain diameter [m]", self.grain_diameter, diameters),
            beyond("measurements: slope [-]", self.slope, slopes),
            (!has_rates)
                .then(|| format!("measurements: fewer than ten runs near Shields number {}", four_digits(shields))),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The case's own layers on these slopes, in cells of the same size but counted in metres, come to the same transport.
    #[test]
    fn a_flume_without_walls_carries_what_the_case_carries() {
        for slope in [0.02, 0.05] {
            let flume = BedLoadFlume { grain_diameter: 5e-3, grain_density: 2600.0, slope, depth: 0.046, width: None };
            let own = flume.predict(8).expect("a flume");
            let mut flow = BedLoad1dFlow::default();
            if let LayerStream::Slope(stream) = &mut flow.stream {
                stream.slope = slope;
            }
            let case = steady(&flow).expect("runs").expect("steady").transport();
            assert!((own.transport / case - 1.0).abs() < 0.005, "{slope}: {} for {case}", own.transport);
            assert!(own.interval.0 < own.by_closures.0 && own.by_closures.1 < own.interval.1, "{own:?}");
        }
    }
}
