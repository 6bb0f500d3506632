//! Grains that eddies also carry: two measured sheet flows and the slopes of the case, with the uncertain inputs varied.

use super::BedLoad1dRecord;
use super::parameters::check_cells;
use super::quantities::{DUCT_VELOCITY_DIFFERENCE, SETTLING_RATIO, SUSPENDED_TRANSPORT};
use super::records::{InputSpread, of, on_slope};
use super::run::{BedLoad1dRun, LayerPurpose};
use super::suspension_inputs::{SuspendedFlow, SuspensionInput, SuspensionInputs};
use crate::case::{ParameterError, Run};
use crate::figure::{Axis, Mark, Panel, Series};
use crate::metric::{Metric, Origin};
use crate::reference::bed_load::{MeasuredBedLoad, SHEET_FLOW_LOWEST_VELOCITY};
use crate::reference::one_dimension::bed_load::{Closures, LayerState, STEADY, Stream};

/// Shields number and height of the largest velocity, over d, of the duct `[-]`.
const DUCT: (f64, f64) = (1.4, 22.0);

/// Speed of grains at the level below which they rest, and the range of it, over u_* `[-]`: the source states no level.
const RESTING: (f64, f64, f64) = (0.1, 0.03, 1.0);

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
pub(super) fn layers(
    records: &[BedLoad1dRecord],
    flow: SuspendedFlow,
) -> impl Iterator<Item = (SuspensionInput, &BedLoad1dRun, &LayerState)> {
    of(records, move |purpose| purpose.suspended().is_some_and(|(other, _)| other == flow))
        .filter_map(|(run, state)| Some((run.purpose.suspended()?.1, run, state)))
}

/// What a value of a flow is over the ranges of its inputs, and its standard uncertainty by the height of a cell.
fn spread(
    records: &[BedLoad1dRecord],
    flow: SuspendedFlow,
    value: impl Fn(&BedLoad1dRun, &LayerState) -> f64,
) -> (InputSpread, Option<f64>) {
    let (mut spread, mut numerical) = (InputSpread::default(), None);
    let own = layers(records, flow).find(|(input, ..)| *input == SuspensionInput::Own);
    let own = own.map_or(f64::NAN, |(_, run, state)| value(run, state));
    for (input, run, state) in layers(records, flow) {
        let other = value(run, state);
        match input {
            SuspensionInput::SchmidtNumber(_) => spread.add("Schmidt number", own, other),
            SuspensionInput::DragDiameter(_) => spread.add("diameter of drag", own, other),
            SuspensionInput::Karman(_) => spread.add("κ", own, other),
            SuspensionInput::CellHeight(_) => numerical = Some((other - own).abs() / 3.0),
            SuspensionInput::Own | SuspensionInput::NoEddies => {}
        }
    }
    (spread, numerical)
}

/// A metric of a flow with the uncertainty of its inputs and of its cells.
pub(super) fn with_spread(
    metric: Metric,
    records: &[BedLoad1dRecord],
    flow: SuspendedFlow,
    value: impl Fn(&BedLoad1dRun, &LayerState) -> f64,
) -> Metric {
    let (spread, numerical) = spread(records, flow, value);
    metric.known_to(Origin::Input, Some(spread.standard()), &spread.words()).known_to(
        Origin::Numerical,
        numerical,
        "a third of the change with cells of twice the height: second order",
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

/// Velocity of the duct, transport of the slopes, and how fast grains settle.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
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
        let value = |run: &BedLoad1dRun, state: &LayerState| duct_difference(run, state, RESTING.0);
        metrics.push(with_spread(metric, records, SuspendedFlow::Duct, value).known_to(
            Origin::Digitisation,
            Some((ends[0] - ends[1]).abs() / 12.0_f64.sqrt()),
            &words,
        ));
    }
    for (_, run, state) in layers(records, SuspendedFlow::Slope) {
        let contacts = on_slope(records, run, |purpose| *purpose == LayerPurpose::Literature).next();
        metrics.extend(contacts.map(|(_, contacts)| {
            let ratio = SUSPENDED_TRANSPORT.of(&run.variant(), state.transport() / contacts.transport());
            ratio.exactly(1.0, "the layer without suspension").with_snapshot_tolerance(1e-3, 0.0)
        }));
    }
    for flow in [SuspendedFlow::SheetFlow, SuspendedFlow::Duct, SuspendedFlow::Slope] {
        for (_, run, _) in layers(records, flow).filter(|(input, ..)| *input == SuspensionInput::Own) {
            let ratio = run.stream.settling_ratio(run.closures.drag).unwrap_or(f64::NAN);
            metrics.push(SETTLING_RATIO.of(&run.variant(), ratio).with_snapshot_tolerance(1e-3, 0.0));
        }
    }
    metrics
}

/// The water of the duct beside the measured points; none without the layers.
pub(super) fn duct_panel(records: &[BedLoad1dRecord]) -> Option<Panel> {
    let mut duct = Panel::new(
        "Sumer et al. 1996, τ* 1.4",
        Axis::linear("u_f/u_* [-]"),
        Axis { limits: Some((0.0, 23.0)), ..Axis::linear("height above grains at rest, over d [-]") },
    );
    let measured = &SHEET_FLOW_LOWEST_VELOCITY.points;
    duct.points("measured", 0, measured.iter().map(|&(z, u)| (u, z)));
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
    (duct.series.len() > 1).then_some(duct)
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
