//! Grains that eddies also carry: two measured sheet flows and the slopes of the case, with the uncertain inputs varied.

use super::BedLoad1dRecord;
use super::parameters::check_cells;
use super::records::of;
use super::run::{BedLoad1dRun, LayerPurpose};
use super::suspension_inputs::{SuspendedFlow, SuspensionInput, SuspensionInputs};
use crate::case::{ParameterError, Run};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, quantities};
use crate::reference::bed_load::{MeasuredBedLoad, SHEET_FLOW_LOWEST_VELOCITY};
use crate::reference::one_dimension::bed_load::{Closures, LayerState, STEADY, Stream};

quantities! {
    shared pub(super)
    DUCT_VELOCITY_DIFFERENCE: validated(
        "duct_velocity_difference", "%",
        "√⟨(u_f − u_published)²⟩ over the largest published velocity, heights from the level below which grains rest",
    ),
    SETTLING_RATIO: verified(
        "settling_ratio", "-", "settling velocity of a grain over u_*: eddies carry grains up to about 1.25 (Bagnold 1966)",
    ),
    SUSPENDED_TRANSPORT: verified("suspended_transport", "-", "q* with eddies that carry grains over q* without them"),
}

/// Shields number and height of the largest velocity, over d, of the duct `[-]`.
const DUCT: (f64, f64) = (1.4, 22.0);

/// Speed of grains at the level below which they rest, and the range of it, over u_* `[-]`: the source states no level.
const RESTING: (f64, f64, f64) = (0.1, 0.03, 1.0);

/// Largest ratio of transports, above or below `[-]`.
const TRANSPORT_FACTOR: f64 = 1.5;

/// Plastic grains of 3 mm and density 1.27, as those of the duct are said to be.
fn duct() -> Stream {
    let (density, diameter) = (1270.0, 3e-3);
    Stream {
        slope: DUCT.0 * (density / 1000.0 - 1.0) / DUCT.1,
        flow_depth: DUCT.1 * diameter,
        // a shallower bed slides on its base
        bed_depth: 20.0 * diameter,
        grain_density: density,
        grain_diameter: diameter,
        ..MeasuredBedLoad::SheetFlow.stream()
    }
}

impl LayerPurpose {
    /// Flow and input of a suspended layer.
    fn suspended(self) -> Option<(SuspendedFlow, SuspensionInput)> {
        if let Self::Suspended(flow, input) = self { Some((flow, input)) } else { None }
    }
}

/// Refuses heights of a cell that do not divide the depths of the flows.
pub(super) fn check(inputs: &SuspensionInputs) -> Result<(), ParameterError> {
    let others = inputs.cell_heights.iter().enumerate();
    let others = others.map(|(place, height)| (format!("suspension.cell_heights[{place}]"), *height));
    let heights = [("suspension.cell_height".to_owned(), inputs.cell_height)].into_iter().chain(others);
    for (field, height) in heights {
        for flow in &inputs.flows {
            let stream = match flow {
                SuspendedFlow::SheetFlow => MeasuredBedLoad::SheetFlow.stream(),
                SuspendedFlow::Duct => duct(),
                // in the case's own cells
                SuspendedFlow::Slope => continue,
            };
            check_cells(&field, height, &[stream.flow_depth, stream.bed_depth])?;
        }
    }
    Ok(())
}

/// The sheet flows, each input varied alone, and the slopes of the case.
pub(super) fn runs(
    inputs: &SuspensionInputs,
    measured: &[MeasuredBedLoad],
    slopes: &[(Stream, f64)],
    closures: Closures,
) -> Vec<BedLoad1dRun> {
    let own = Closures { turbulent_schmidt: inputs.schmidt_number, ..closures };
    let new = |flow, input, stream: Stream, cell_height| {
        let (mut stream, mut closures, mut cell_height) = (stream, own, cell_height);
        match input {
            SuspensionInput::Own => {}
            SuspensionInput::NoEddies => closures.turbulent_schmidt = 0.0,
            SuspensionInput::SchmidtNumber(value) => closures.turbulent_schmidt = value,
            SuspensionInput::DragDiameter(value) => stream.drag_diameter = value,
            SuspensionInput::Karman(value) => closures.karman = value,
            SuspensionInput::CellHeight(value) => cell_height = value,
        }
        let purpose = LayerPurpose::Suspended(flow, input);
        BedLoad1dRun { purpose, stream, closures, cell_height, steady_change: STEADY }
    };
    let mut varied = vec![SuspensionInput::Own];
    varied.extend(inputs.schmidt_numbers.iter().map(|value| SuspensionInput::SchmidtNumber(*value)));
    varied.extend(inputs.drag_diameters.iter().map(|value| SuspensionInput::DragDiameter(*value)));
    varied.extend(inputs.karman_constants.iter().map(|value| SuspensionInput::Karman(*value)));
    varied.extend(inputs.cell_heights.iter().map(|value| SuspensionInput::CellHeight(*value)));
    if !measured.contains(&MeasuredBedLoad::SheetFlow) {
        return Vec::new();
    }
    let sheet = Stream { drag_diameter: inputs.drag_diameter, ..MeasuredBedLoad::SheetFlow.stream() };
    let mut runs = Vec::new();
    for &flow in &inputs.flows {
        match flow {
            SuspendedFlow::SheetFlow => {
                runs.extend(varied.iter().map(|input| new(flow, *input, sheet, inputs.cell_height)));
            }
            SuspendedFlow::Duct => {
                let schmidt_only = varied.iter().filter(|input| !matches!(input, SuspensionInput::DragDiameter(_)));
                let varied = schmidt_only.chain([&SuspensionInput::NoEddies]);
                runs.extend(varied.map(|input| new(flow, *input, duct(), inputs.cell_height)));
            }
            SuspendedFlow::Slope => {
                let own = |&(stream, height)| new(flow, SuspensionInput::Own, stream, height);
                runs.extend(slopes.iter().map(own));
            }
        }
    }
    runs
}

/// Suspended layers of a flow.
fn layers(
    records: &[BedLoad1dRecord],
    flow: SuspendedFlow,
) -> impl Iterator<Item = (SuspensionInput, &BedLoad1dRun, &LayerState)> {
    of(records, move |purpose| purpose.suspended().is_some_and(|(other, _)| other == flow))
        .filter_map(|(run, state)| Some((run.purpose.suspended()?.1, run, state)))
}

/// Standard uncertainties of a value from the inputs and from the height of a cell, with what they are.
///
/// The range of an input is the spread between its ends, taken for an even one.
pub(super) fn spread(
    records: &[BedLoad1dRecord],
    flow: SuspendedFlow,
    value: impl Fn(&BedLoad1dRun, &LayerState) -> f64,
) -> Option<(f64, f64, String)> {
    let own = layers(records, flow).find(|(input, ..)| *input == SuspensionInput::Own)?;
    let own = value(own.1, own.2);
    let mut ranges: Vec<(&str, f64, f64)> = Vec::new();
    let mut numerical = f64::NAN;
    for (input, run, state) in layers(records, flow) {
        let other = value(run, state);
        let name = match input {
            SuspensionInput::SchmidtNumber(_) => "Schmidt number",
            SuspensionInput::DragDiameter(_) => "diameter of drag",
            SuspensionInput::Karman(_) => "κ",
            SuspensionInput::CellHeight(_) => {
                numerical = (other - own).abs() / 3.0;
                continue;
            }
            SuspensionInput::Own | SuspensionInput::NoEddies => continue,
        };
        match ranges.iter_mut().find(|range| range.0 == name) {
            Some(range) => (range.1, range.2) = (range.1.min(other), range.2.max(other)),
            None => ranges.push((name, own.min(other), own.max(other))),
        }
    }
    let squares: f64 = ranges.iter().map(|(_, low, high)| (high - low) * (high - low) / 12.0).sum();
    let words: Vec<String> = ranges.iter().map(|(name, low, high)| format!("{name} {low:.3} to {high:.3}")).collect();
    Some((squares.sqrt(), numerical, format!("the value over the range of each input: {}", words.join(", "))))
}

/// A metric of a flow with the uncertainty of its inputs.
pub(super) fn with_spread(metric: Metric, spread: Option<(f64, f64, String)>) -> Metric {
    let Some((input, numerical, words)) = spread else { return metric };
    let numerical = numerical.is_finite().then_some(numerical);
    let metric = if input > 0.0 { metric.known_to(Origin::Input, Some(input), &words) } else { metric };
    metric.known_to(Origin::Numerical, numerical, "a third of the change with cells of twice the height: second order")
}

/// The limit of the transport of the suspended sheet flow, and why.
pub(super) fn transport_limit() -> (Limit, &'static str) {
    (
        Limit::Within(1.0 / TRANSPORT_FACTOR, TRANSPORT_FACTOR),
        "a factor of 1.5, set before the runs: formulas of the total load are usually judged by a factor of 2",
    )
}

/// Root mean square of u_f less theirs over their largest `[%]`, from the level where grains have a speed over u_*.
fn duct_difference(run: &BedLoad1dRun, state: &LayerState, resting: f64) -> f64 {
    let measured = &SHEET_FLOW_LOWEST_VELOCITY.points;
    let unit = run.stream.shear_velocity();
    let Some(level) = state.moves_above(resting * unit) else { return f64::NAN };
    let at = |height: f64| state.at(level + height * run.stream.grain_diameter).fluid_velocity / unit;
    let squares: f64 = measured.iter().map(|&(height, u)| (at(height) - u) * (at(height) - u)).sum();
    let largest = measured.iter().fold(0.0_f64, |most, point| most.max(point.1));
    100.0 * (squares / measured.len() as f64).sqrt() / largest
}

/// Velocity of the duct, transport of the slopes and of the varied inputs.
pub(super) fn metrics(records: &[BedLoad1dRecord], transport: Quantity) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
    for (input, run, state) in layers(records, SuspendedFlow::Duct) {
        let metric = DUCT_VELOCITY_DIFFERENCE
            .of(&run.variant(), duct_difference(run, state, RESTING.0))
            .against(Some(0.0), &measured.source, measured.confidence)
            .with_snapshot_tolerance(1e-3, 0.0);
        if input != SuspensionInput::Own {
            metrics.push(metric);
            continue;
        }
        let ends = [RESTING.1, RESTING.2].map(|speed| duct_difference(run, state, speed));
        let words = format!(
            "level where grains have {} to {} u_* instead of {}: {:.1} to {:.1} %",
            RESTING.1, RESTING.2, RESTING.0, ends[0], ends[1]
        );
        let spread = spread(records, SuspendedFlow::Duct, |run, state| duct_difference(run, state, RESTING.0));
        metrics.push(with_spread(metric, spread).known_to(
            Origin::Digitisation,
            Some((ends[0] - ends[1]).abs() / 12.0_f64.sqrt()),
            &words,
        ));
    }
    for (_, run, state) in layers(records, SuspendedFlow::Slope) {
        let contacts = of(records, |purpose| *purpose == LayerPurpose::Literature)
            .find(|(other, _)| other.stream.slope == run.stream.slope);
        if let Some((_, contacts)) = contacts {
            metrics.push(
                SUSPENDED_TRANSPORT
                    .of(&run.variant(), state.transport() / contacts.transport())
                    .against(Some(1.0), "the layer without suspension", Confidence::Exact)
                    .with_snapshot_tolerance(1e-3, 0.0),
            );
        }
    }
    for flow in [SuspendedFlow::SheetFlow, SuspendedFlow::Duct, SuspendedFlow::Slope] {
        for (_, run, _) in layers(records, flow).filter(|(input, ..)| *input == SuspensionInput::Own) {
            let ratio = run.stream.settling_ratio(run.closures.drag).unwrap_or(f64::NAN);
            metrics.push(SETTLING_RATIO.of(&run.variant(), ratio).with_snapshot_tolerance(1e-3, 0.0));
        }
    }
    for (input, run, state) in layers(records, SuspendedFlow::SheetFlow) {
        if input != SuspensionInput::Own {
            metrics.push(transport.of(&run.variant(), state.transport()).with_snapshot_tolerance(1e-3, 0.0));
        }
    }
    metrics
}

/// Profiles of both sheet flows with and without suspension, beside the measured points.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let own = |flow| layers(records, flow).find(|(input, ..)| *input == SuspensionInput::Own);
    let (_, _, suspended) = own(SuspendedFlow::SheetFlow)?;
    let contacts =
        of(records, |purpose| *purpose == LayerPurpose::Measured(MeasuredBedLoad::SheetFlow)).map(|(_, state)| state);
    let theirs = MeasuredBedLoad::SheetFlow.profiles();
    let points = |values: &[(f64, f64)]| values.iter().map(|&(z, value)| (value, 1e3 * z)).collect::<Vec<_>>();
    let height = || Axis { limits: Some((-20.0, 60.0)), ..Axis::linear("z [mm]") };
    let fractions = Axis { limits: Some((1e-3, 1.0)), ..Axis::logarithmic("φ [-]") };
    let mut fraction = Panel::new("Revil-Baudard et al. 2015, τ* 0.44", fractions, height());
    let mut velocity = Panel::new("", Axis::linear("velocity of the grains [m/s]"), height());
    fraction.series.push(Series::new("measured", Mark::Points, 0, points(&theirs.solid_fraction)));
    velocity.series.push(Series::new("measured", Mark::Points, 0, points(&theirs.grain_velocity)));
    let states = [(suspended, "with suspension", 1)].into_iter().chain(contacts.map(|state| (state, "without", 2)));
    for (state, label, slot) in states {
        let inside = |k: &usize| state.height[*k] > -0.02 && state.height[*k] < 0.06;
        let curve = |values: &[f64]| -> Vec<(f64, f64)> {
            (0..values.len()).filter(inside).map(|k| (values[k], 1e3 * state.height[k])).collect()
        };
        let visible = curve(&state.solid_fraction).into_iter().filter(|point| point.0 > 1e-3).collect();
        fraction.series.push(Series::new(label, Mark::Line, slot, visible));
        let top = 1e3 * state.top_of_grains();
        let moving = curve(&state.grain_velocity).into_iter().filter(|point| point.1 < top).collect();
        velocity.series.push(Series::new(label, Mark::Line, slot, moving));
    }
    let mut panels = vec![fraction, velocity];
    let mut duct = Panel::new(
        "Sumer et al. 1996, τ* 1.4",
        Axis::linear("u_f/u_* [-]"),
        Axis { limits: Some((0.0, 23.0)), ..Axis::linear("height above grains at rest, over d [-]") },
    );
    let measured = &SHEET_FLOW_LOWEST_VELOCITY.points;
    duct.series.push(Series::new("measured", Mark::Points, 0, measured.iter().map(|&(z, u)| (u, z)).collect()));
    for (input, run, state) in layers(records, SuspendedFlow::Duct) {
        let (label, slot) = match input {
            SuspensionInput::Own => ("with suspension", 1),
            SuspensionInput::NoEddies => ("without", 2),
            _ => continue,
        };
        let unit = run.stream.shear_velocity();
        let Some(level) = state.moves_above(RESTING.0 * unit) else { continue };
        let place = |k: usize| (state.fluid_velocity[k] / unit, (state.height[k] - level) / run.stream.grain_diameter);
        let curve = (0..state.height.len()).map(place).filter(|point| point.1 > 0.0 && point.1 < 23.0).collect();
        duct.series.push(Series::new(label, Mark::Line, slot, curve));
    }
    let ratio = |state: &LayerState| state.transport() / theirs.transport;
    let known =
        spread(records, SuspendedFlow::SheetFlow, |_, state| ratio(state)).map_or(f64::NAN, |(input, ..)| input);
    let above: Vec<f64> = theirs
        .grain_velocity
        .iter()
        .filter(|point| point.0 > 0.01 && point.0 < 0.06)
        .map(|&(z, u)| suspended.at(z).grain_velocity / u - 1.0)
        .collect();
    let faster = 100.0 * above.iter().sum::<f64>() / above.len() as f64;
    let mut caption = format!(
        "A sheet flow of plastic grains whose eddies carry grains: (a) solid fraction, (b) velocity. With suspension the layer carries {:.2} of the \
         measured transport; the inputs leave a standard uncertainty of {known:.2}. Above 10 mm its grains differ from the measured velocity by \
         {faster:+.0} % on average. The source states no uncertainty.",
        ratio(suspended)
    );
    if let Some(contacts) = of(records, |purpose| *purpose == LayerPurpose::Measured(MeasuredBedLoad::SheetFlow))
        .map(|(_, state)| state)
        .next()
    {
        caption += &format!(
            " Without suspension the grains end {:.0} mm above the bed and carry {:.2}.",
            1e3 * contacts.top_of_grains(),
            ratio(contacts)
        );
    }
    if duct.series.len() > 1 {
        panels.push(duct);
        caption += " (c): velocity of the water in a sheet flow three times as strong. Its heights start where grains have a tenth of \
                    u_*, as the source states no level. The upper half is met; near the bed the layer is slower than the measured water.";
    }
    Some(Figure::new("suspension", &caption, panels))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_duct_has_its_shields_number_and_its_depth() {
        let stream = duct();
        assert!((stream.shields_number() / DUCT.0 - 1.0).abs() < 1e-12);
        assert!((stream.flow_depth / stream.grain_diameter - DUCT.1).abs() < 1e-12);
        assert!(stream.slope < stream.sliding_slope(&Closures::default()));
    }

    #[test]
    fn cells_that_do_not_divide_a_depth_are_refused() {
        assert!(check(&SuspensionInputs::literature()).is_ok() && check(&SuspensionInputs::quick()).is_ok());
        let odd = SuspensionInputs { cell_heights: vec![3.7e-3], ..SuspensionInputs::quick() };
        let message = check(&odd).expect_err("refused").to_string();
        assert!(message.starts_with("`suspension.cell_heights[0]` is 0.0037, but must be such that"), "{message}");
    }

    #[test]
    fn every_input_is_varied_alone() {
        let runs = runs(&SuspensionInputs::literature(), &[MeasuredBedLoad::SheetFlow], &[], Closures::default());
        let own = runs.iter().find(|run| run.purpose.suspended().map(|(_, input)| input) == Some(SuspensionInput::Own));
        let own = own.expect("the layer of the own inputs");
        for run in
            runs.iter().filter(|run| run.purpose.suspended().is_some_and(|(flow, _)| flow == SuspendedFlow::SheetFlow))
        {
            let changes = [run.stream != own.stream, run.closures != own.closures, run.cell_height != own.cell_height];
            let expected = usize::from(run.purpose != own.purpose);
            assert_eq!(changes.into_iter().filter(|change| *change).count(), expected, "{:?}", run.purpose);
        }
    }
}
