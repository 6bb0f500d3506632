//! Bed load as another code gives it: profiles of water and grains, and the history of the transport.

use super::flow::BedLoadFlow;
use super::metrics::*;
use super::observation::{BedLoadObservation, Carried};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::channel::{self, BlockProfile, ProfilePoint};
use crate::input::FieldError;
use crate::metric::Quantity;
use crate::statistics::BLOCKS;

/// Possible data of a run.
pub(super) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[],
    series: &[
        ExternalColumn::new("time", "s", "time since the start"),
        ExternalColumn::new(
            "transport",
            "m^2/s",
            "volume of grains that passes a section, per time and width, without pores",
        ),
        ExternalColumn::new("mean_velocity", "m/s", "mean of the water's velocity above the top of the bed at rest"),
    ],
    profile: &[
        ExternalColumn::new("height", "m", "height above the top of the bed at rest, rising; negative inside it"),
        ExternalColumn::new(
            "velocity",
            "m/s",
            "velocity of the water there, a mean over a time in which the flow is stationary",
        ),
        ExternalColumn::new(
            "grain_velocity",
            "m/s",
            "velocity of the grains there, likewise; not a number where there are none",
        ),
    ],
    description: "transport is q* = q_s/√((s − 1) g d³), a mean over the last quarter of the series with the standard error of its blocks; \
        transport_ratio is that over the 1-D layer of the same closures, predicted_transport compares it with Wong and Parker's \
        formula. fluid_velocity_rms and grain_velocity_rms are root mean squares of the velocities less the 1-D layer's at the \
        heights given (water: 0.5 mm to 0.9 h; grains: where those of the layer are faster than 1 cm/s), over u_*. \
        semi_log_slope is the slope of u over ln(z + z_0) in a range of heights, over u_*/κ; deficits are differences to clear \
        water's logarithmic law, over u_*.",
};

/// Metrics that the water's profile suffices for.
const OF_WATER: [&[Quantity]; 2] = [
    &[FLUID_VELOCITY_RMS, FLUID_VELOCITY_MEAN, NEAR_BED_DEFICIT, OUTER_DEFICIT, RELATIVE_DEFICIT],
    &[SEMI_LOG_SLOPE, LAYER_SLOPE_RATIO, NUMBER_OF_LAYERS],
];
/// Metrics that the grains' profile suffices for.
const OF_GRAINS: [&[Quantity]; 2] =
    [&[GRAIN_VELOCITY_RMS, DECAY_LENGTH, MOVES_ABOVE], &[GRAIN_CURVATURE_ABOVE, GRAIN_CURVATURE_BELOW]];
/// Metrics that the history of the transport suffices for.
const OF_TRANSPORT: [&[Quantity]; 1] = [&[TRANSPORT, PREDICTED_TRANSPORT, TRANSPORT_RATIO, TRANSPORT_GROWTH]];

fn names(groups: &[&[Quantity]]) -> impl Iterator<Item = &'static str> {
    groups.concat().into_iter().map(|quantity| quantity.name)
}

/// The observation from what another code gives.
///
/// # Errors
/// A 1-D layer to compare with that cannot be computed.
pub(super) fn observe(
    run: &BedLoadFlow,
    given: &ExternalData,
) -> Result<ExternalObservation<BedLoadObservation>, FieldError> {
    let water = channel::foreign::observe(given)?.observation;
    let mut measured = Vec::new();
    let (height, velocity) = (given.profile("height"), given.profile("grain_velocity"));
    let point =
        |(&height, &velocity): (&f64, &f64)| ProfilePoint { height, velocity, pressure: f64::NAN, samples: 1.0 };
    let moving = height.iter().zip(velocity).filter(|(_, velocity)| velocity.is_finite());
    let sediment = BlockProfile::known(moving.map(point));
    if !height.is_empty() && !given.profile("velocity").is_empty() {
        measured.extend(names(&OF_WATER));
    }
    if !sediment.sums.is_empty() {
        measured.extend(names(&OF_GRAINS));
    }
    let unit = run.stream().transport_unit();
    if !given.series("transport").is_empty() {
        measured.extend(names(&OF_TRANSPORT));
    }
    if !given.series("mean_velocity").is_empty() {
        measured.push(STREAM_VELOCITY.name);
    }
    let layer = run.formulation.is_continuum().then(|| run.layer()).transpose().map_err(|error| {
        FieldError::finding("runs", format!("no 1-D layer for this run ({error})"), "leave the run out")
    })?;
    let observation = BedLoadObservation {
        transport: given.full_series("transport").iter().map(|rate| rate / unit).collect(),
        stream_velocity: given.full_series("mean_velocity"),
        carried: vec![vec![Carried::default(); BLOCKS]; sediment.sums.len()],
        sediment,
        length: f64::NAN,
        layer,
        channel: water,
    };
    Ok(ExternalObservation { observation, measured })
}

#[cfg(test)]
mod tests {
    use super::super::flow::BedLoadFormulation;
    use super::super::metrics;
    use super::*;
    use crate::case::NamedColumns;
    use crate::metric::Verdict;

    fn dilating() -> BedLoadFlow {
        BedLoadFlow { formulation: BedLoadFormulation::Dilating, ..BedLoadFlow::default() }
    }

    /// The layer itself, sampled as another code would give it, agrees with the layer.
    #[test]
    fn the_layer_as_given_by_another_code_is_the_layer() {
        let run = dilating();
        let layer = run.layer().expect("a layer");
        let heights: Vec<f64> = (-30..45).map(|k| 1e-3 * (f64::from(k) + 0.5)).collect();
        let of = |pick: fn(&crate::reference::one_dimension::bed_load::LayerState, f64) -> f64| -> Vec<f64> {
            heights.iter().map(|&z| pick(&layer, z)).collect()
        };
        let profile: NamedColumns = [
            ("height", heights.clone()),
            ("velocity", of(|layer, z| layer.at(z).fluid_velocity)),
            ("grain_velocity", of(|layer, z| layer.at(z).grain_velocity)),
        ]
        .map(|(name, values)| (name.to_owned(), values))
        .into();
        let time: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
        let rate = layer.transport() * run.stream().transport_unit();
        let series: NamedColumns = [
            ("transport", vec![rate; time.len()]),
            ("mean_velocity", vec![layer.mean_fluid_velocity(); time.len()]),
            ("time", time),
        ]
        .map(|(name, values)| (name.to_owned(), values))
        .into();
        let given = ExternalData { profile, series, ..ExternalData::default() };
        let seen = observe(&run, &given).expect("complete");
        let record = given.record(seen.observation);
        let found = metrics::all(&[(run, record)]);
        let value = |name: &str| found.iter().find(|metric| metric.name == name).unwrap_or_else(|| panic!("{name}"));
        assert!((value("transport_ratio").value - 1.0).abs() < 1e-12);
        assert!(value("fluid_velocity_rms").value < 1e-12 && value("grain_velocity_rms").value < 1e-12);
        for name in ["transport_ratio", "fluid_velocity_rms", "fluid_velocity_mean"] {
            assert!(seen.measured.contains(&name) && value(name).verdict() != Verdict::Fail, "{name}");
        }
        assert!(!seen.measured.contains(&"drag_peak_height") && !seen.measured.contains(&"particles_lost"));
    }

    #[test]
    fn a_history_alone_measures_no_profile() {
        let series: NamedColumns = [("time", vec![0.0, 1.0]), ("transport", vec![1e-4, 1e-4])]
            .map(|(name, values)| (name.to_owned(), values))
            .into();
        let seen = observe(&dilating(), &ExternalData { series, ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, names(&OF_TRANSPORT).collect::<Vec<_>>());
    }
}
