//! The thickness of the flow in passing places of the slope, beside the paper's estimate.

use super::Record;
use super::metrics::LARGEST_THICKNESS;
use crate::case::Flow;
use crate::collapse::{SlopeCollapse, SlopeFlow};
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Confidence, Metric, Variant};
use crate::reference::collapse::RoughIncline;
use crate::reference::grains::GLASS_BEADS_FLOW_RULE;
use bagnold_solver::material::rheology::{MuI, Rheology};

/// Places at which the thickness is followed, from the back of the reservoir `[m]`.
const STATIONS: [f64; 3] = [0.5, 1.0, 1.5];
/// Speed of the paper's gate `[m/s]`.
const GATE_SPEED: f64 = 1.3;
/// Rows of particles over the estimate that tell a thickness `[-]`.
const RESOLVED: f64 = 7.0;

/// h_s of (44) `[m]`; none where there is no such flow, or too few particles to tell its thickness.
fn estimate(flow: &SlopeFlow) -> Option<f64> {
    let Rheology::MuI(MuI { static_friction, limiting_friction, grain_diameter, .. }) = flow.material else {
        return None;
    };
    let length_scale = GLASS_BEADS_FLOW_RULE.deposit_length * grain_diameter;
    let incline = RoughIncline { length_scale, static_friction, limiting_friction };
    let law = incline.flow_thickness(flow.initial_height, flow.slope_angle.to_radians())?;
    (flow.gate_speed == GATE_SPEED && law > RESOLVED * flow.spacing()).then_some(law)
}

/// Thickness at a station over time `[cm]`.
fn thickness(flow: &SlopeFlow, data: &SlopeCollapse, station: f64) -> Vec<f64> {
    let history = data.thickness_at(station / flow.reservoir_length);
    history.into_iter().map(|h| 100.0 * h * flow.reservoir_length).collect()
}

pub(super) fn metrics((flow, record): &Record) -> Vec<Metric> {
    let Some(law) = estimate(flow) else { return Vec::new() };
    let source = "h_s of (44) as reconstructed: the paper's estimate of the flow's thickness";
    let of_station = |station: f64| {
        let largest = thickness(flow, &record.data, station).into_iter().fold(0.0, f64::max);
        let variant = Variant::of("station", station).followed_by(&flow.variant());
        // 0 where the front did not come so far
        (largest != 0.0).then(|| {
            let metric = LARGEST_THICKNESS.of(&variant, largest).with_snapshot_tolerance(1e-3, 1e-3);
            metric.against(Some(100.0 * law), source, Confidence::Medium)
        })
    };
    STATIONS.into_iter().filter_map(of_station).collect()
}

/// Thickness at the stations over time, one panel per slope; none where no flow has an estimate.
pub(super) fn figure(records: &[Record]) -> Option<Figure> {
    let estimated = records.iter().filter_map(|record| Some((record, estimate(&record.0)?)));
    let panels = estimated.enumerate().map(|(place, ((flow, record), law))| {
        let y = Axis::linear("thickness [cm]").between(0.0, 6.0);
        let mut panel = Panel::new(&format!("{}°", flow.slope_angle), Axis::linear("t [s]"), y);
        let time = &record.data.collapse.time;
        for (slot, &station) in STATIONS.iter().enumerate() {
            let points = time.iter().copied().zip(thickness(flow, &record.data, station));
            let entry = if place == 0 { format!("x = {station} m") } else { String::new() };
            panel.line(&entry, slot, points);
        }
        let end = time.last().copied().unwrap_or_default();
        let entry = if place == 0 { "h_s of (44)" } else { "" };
        panel.reference(entry, [(0.0, 100.0 * law), (end, 100.0 * law)]);
        panel
    });
    let panels: Vec<Panel> = panels.collect();
    let drawn = Figure::new(
        "thickness-in-time",
        "Flow thickness at three places of the slope over time (volume per bin of 2 cm), with the paper's h_s (44), an order of \
         magnitude only: the flow passes as a wave without plateau.",
        panels,
    );
    (!drawn.panels.is_empty()).then(|| drawn.in_columns(2))
}
