//! The case's figures.

use super::metrics::MARGIN;
use super::{Record, passage};
use crate::collapse::figures::{DrawnField, field_panel};
use crate::collapse::metrics::other_codes::Beside;
use crate::collapse::{BIN_WIDTH, SlopeCollapse, SlopeFlow};
use crate::evidence::shipped_table;
use crate::figure::{Animation, Axis, Figure, Mark, Panel};
use crate::observation::pictures::{View, animation};
use crate::observation::{Frame, Recorded};
use crate::reference::collapse::{CodeQuantity, RoughIncline, SLOPE_EXPERIMENT, slope_run_out};

/// Times at which thickness profiles are drawn `[s]`.
const PROFILES: [f64; 6] = [0.0, 0.2, 0.4, 0.6, 0.8, 1.2];
/// The paper's scale of viscosities `[Pa·s]`.
const PAPER_SCALE: (f64, f64) = (0.0, 1.5);

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    if records.is_empty() {
        return Vec::new();
    }
    let mut figures = vec![fronts(records), thickness(records), run_outs(records)];
    figures.extend(passage::figure(records));
    for record in records.iter().filter(|(run, _)| run.slope_angle > 15.0) {
        figures.extend([velocities(record), viscosities(record)]);
    }
    figures
}

/// The collapses in motion.
pub(super) fn animations(records: &[Record]) -> Vec<Animation> {
    let moving = |(run, record): &Record| {
        let caption = format!(
            "{}: collapse, coloured by speed. Dashed: thickness (volume per bin of 0.1 r0) and front (where the \
             thickness is 0.02 r0). The lift gate at 0.2 m is not drawn.",
            label(run)
        );
        let view = View {
            unit_length: 1.0,
            unit: "m",
            time_scale: (run.initial_height / run.gravity).sqrt(),
            spacing: run.spacing(),
            mirrored: false,
        };
        animation(&format!("collapse-{}", stem(run)), &caption, &record.data.collapse.motion, &view)
    };
    records.iter().map(moving).collect()
}

/// The label as a file name.
fn stem(run: &SlopeFlow) -> String {
    label(run).replace('°', "").replace([',', ' ', '/', '.'], "-").replace("--", "-")
}

fn label(run: &SlopeFlow) -> String {
    let gate = if run.gate_speed > 0.0 { format!("lift gate {} m/s", run.gate_speed) } else { "no gate".to_owned() };
    let law = if run.is_regularised() { ", regularised" } else { "" };
    format!("{}°, {gate}{law}", run.slope_angle)
}

fn fronts(records: &[Record]) -> Figure {
    let mut front = Panel::new("", Axis::linear("t [s]"), Axis::linear("front − lift gate [m]"));
    let mut energy = Panel::new("", Axis::linear("t [s]"), Axis::linear("kinetic energy [J/m]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let data = &record.data.collapse;
        let way = |front: &f64| (front - 1.0) * run.reservoir_length;
        let points = data.time.iter().copied().zip(data.front.iter().map(way));
        front.line(&label(run), slot, points);
        let points = data.time.iter().copied().zip(data.kinetic_energy.iter().copied());
        energy.line("", slot, points);
        if let Some(beside) = Beside::of_slope(run, data) {
            let (time_scale, scale) = (beside.time_scale, beside.energy_scale);
            beside.draw(&mut energy, CodeQuantity::KineticEnergy, slot, |(time, energy)| {
                (time * time_scale, energy * scale)
            });
        }
    }
    let points = if energy.series.iter().any(|series| series.mark == Mark::Points) {
        " Points: another code with the same law."
    } else {
        ""
    };
    let caption = format!(
        "Front position beyond the lift gate and kinetic energy over time. Above the friction angle of 20.9°, a run \
         ends when the first grain nears the end of the channel.{points}"
    );
    Figure::new("fronts", &caption, vec![front, energy])
}

fn thickness(records: &[Record]) -> Figure {
    let high = records.first().map_or(0.14, |(run, _)| run.initial_height);
    let index_at =
        |record: &Recorded<SlopeCollapse>, time: f64| record.data.collapse.time.iter().position(|t| *t >= time - 1e-9);
    // the paper states the thickness of one slope
    let stated = shipped_table("flow-thickness/statements.csv").ok();
    let stated =
        stated.and_then(|table| Some((table.numbers("slope angle").ok()?[0], table.numbers("thickness").ok()?[0])));
    let mut caption =
        "Thickness along the slope at successive times (volume per bin of 2 cm). The lift gate is at 0.2 m.".to_owned();
    let mut panels = Vec::new();
    for (run, record) in records {
        let y = Axis::linear("thickness [cm]").between(0.0, (100.0 * high).round() + 1.0);
        let mut panel = Panel::new(&label(run), Axis::linear("x [m]"), y);
        let r = run.reservoir_length;
        for (slot, time) in PROFILES.iter().enumerate() {
            // the first panel names the times of all
            let is_named = panels.is_empty() && records.iter().any(|(_, record)| index_at(record, *time).is_some());
            let entry = if is_named { format!("{time} s") } else { String::new() };
            let profile = index_at(record, *time).map_or(&[][..], |index| &record.data.thickness[index]);
            let end = profile.iter().rposition(|&thickness| thickness > 0.0).map_or(0, |last| last + 1);
            let place_of = |bin: usize| (bin as f64 + 0.5) * BIN_WIDTH * r;
            panel.line(&entry, slot, profile[..end].iter().enumerate().map(|(bin, h)| (place_of(bin), 100.0 * h * r)));
        }
        if let Some((angle, stated)) = stated.filter(|(angle, _)| *angle == run.slope_angle) {
            let law = RoughIncline::of_glass_beads().flow_thickness(run.initial_height, angle.to_radians());
            let far = record.data.collapse.front.iter().fold(1.0_f64, |far, front| far.max(*front)) * r;
            let law = 100.0 * law.unwrap_or(f64::NAN);
            panel.reference("largest thickness in the paper", [(0.0, stated), (far, stated)]);
            panel.reference("by (44), reconstructed", [(0.0, law), (far, law)]);
            caption += &format!(
                " At {angle}° the paper's largest thickness is about {stated} cm; its equation (44), reconstructed, gives {law:.2} cm."
            );
        }
        panels.push(panel);
    }
    Figure::new("thickness", &caption, panels).in_columns(2)
}

/// Final run-out over the slope, with the band of the experiments' fit.
fn run_outs(records: &[Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("θ [°]"), Axis::logarithmic("run-out from the lift gate [m]"));
    let Some((first, _)) = records.first() else { unreachable!("figures are drawn of records") };
    let friction = first.material.contact_friction();
    let curve = |friction: f64, k: f64| -> Vec<(f64, f64)> {
        let angles = (0..=110).map(|step| 0.2 * f64::from(step));
        let value = |angle: f64| slope_run_out(first.initial_height, angle.to_radians(), friction, k);
        angles.filter_map(|angle| Some((angle, value(angle)?))).filter(|(_, way)| *way < 6.0).collect()
    };
    let (lower, upper) = SLOPE_EXPERIMENT.run_out_coefficients;
    let (short, long) = (curve(friction, lower), curve(friction, upper));
    let judged = short.iter().zip(&long).map(|(a, b)| (a.0, (1.0 - MARGIN) * a.1, (1.0 + MARGIN) * b.1));
    panel.band(&format!("limits: {:.0} % beyond k = {lower} and {upper} with μ_s", 100.0 * MARGIN), judged);
    let experiment = libm::tan(SLOPE_EXPERIMENT.repose_angle.to_radians());
    for (friction, name) in [
        (friction, "tanδ = μ_s of the run".to_owned()),
        (experiment, format!("δ = {}° of the experiment", SLOPE_EXPERIMENT.repose_angle)),
    ] {
        for k in [lower, upper] {
            panel.reference(&format!("k = {lower} and {upper}, {name}"), curve(friction, k));
        }
    }
    let points: Vec<(f64, f64)> = records
        .iter()
        .filter(|(run, record)| !run.is_regularised() && record.data.collapse.rest_time().is_finite())
        .map(|(run, record)| (run.slope_angle, record.data.collapse.run_out() * run.reservoir_length))
        .collect();
    panel.points("at rest", 0, points);
    Figure::new(
        "run-out",
        "Run-out from the lift gate over the slope θ, with the experimental fit h_0 2k/(tanδ − tanθ) of Mangeney et \
         al. (2010), quoted from a later paper. The limits use tanδ = μ_s.",
        vec![panel],
    )
}

/// Times from which fields are drawn `[s]`: the paper's begin at 0.11 s.
const FIRST_FIELD: f64 = 0.1;
/// Decades of shear rates that the colours span.
const SHEAR_RATES: (f64, f64) = (-1.0, 2.0);

/// Velocity along the slope and shear rate in time: the paper's figure 4 and what it says beside figure 5.
fn velocities((run, record): &Record) -> Figure {
    let along = |frame: &Frame| -> Vec<f64> { frame.vector("velocity").iter().map(|v| v[0]).collect() };
    let fastest = fields_of(record).flat_map(along).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let caption = "velocity along the slope, and shear rate on a logarithmic scale; values beyond a scale have the colour of its end.";
    fields("velocities", caption, run, record, |frame| {
        let decades = frame.scalar("shear_rate").iter().map(|rate| libm::log10(rate.max(1e-3))).collect();
        [(along(frame), "u_x [m/s]", (0.0, fastest)), (decades, "log10 |γ̇| [1/s]", SHEAR_RATES)]
    })
}

/// The viscosity in time: the paper's figure 5.
fn viscosities((run, record): &Record) -> Figure {
    let caption = "apparent viscosity from 0 to 1.5 Pa·s (the paper's scale) and on a logarithmic scale to 10⁴ Pa·s; \
                   yellow: upper end of the scale or more.";
    fields("fields", caption, run, record, |frame| {
        let viscosity = frame.scalar("viscosity").to_vec();
        let decades = viscosity.iter().map(|v| libm::log10(v.max(1e-3))).collect();
        [(viscosity, "η [Pa·s]", PAPER_SCALE), (decades, "log10 η [Pa·s]", (-1.0, 4.0))]
    })
}

fn fields_of(record: &Recorded<SlopeCollapse>) -> impl Iterator<Item = &Frame> {
    record.frames.iter().filter(|frame| frame.time > FIRST_FIELD)
}

/// Panels below each other, those of one time together.
fn fields(
    name: &str,
    caption: &str,
    run: &SlopeFlow,
    record: &Recorded<SlopeCollapse>,
    drawn: impl Fn(&Frame) -> [DrawnField; 2],
) -> Figure {
    let high = run.initial_height;
    let far = fields_of(record).flat_map(|frame| &frame.position).map(|x| x[0]).fold(0.0, f64::max);
    let panels = fields_of(record).flat_map(|frame| {
        let axes = || [Axis::linear("x [m]").between(0.0, far), Axis::linear("y [m]").between(0.0, high)];
        let panel = |field| field_panel(frame, &format!("{:.2} s", frame.time), axes(), (1.0, run.spacing()), field);
        drawn(frame).map(panel)
    });
    Figure::new(&format!("{name}-{}", stem(run)), &format!("{}: {caption}", label(run)), panels.collect()).in_columns(1)
}
