//! `bagnold predict`: a quantity of a user's own flow with its interval, and whether it lies inside of what was compared with measurements.

use super::arguments::{BedLoadArguments, PredictAction, PredictArguments};
use super::{Exit, ProgramError, Session};
use bagnold_cases::bed_load_1d::{BedLoadFlume, TransportPrediction};
use bagnold_number::four_digits;

/// q* from which grains count as moving `[-]`.
const LEAST_TRANSPORT: f64 = 1e-4;

/// Predicts.
///
/// # Errors
/// A flow that breaks a rule, named by its option.
pub(super) fn predict(command: &PredictArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let PredictAction::BedLoad(own) = &command.action;
    let BedLoadArguments { grain_diameter, grain_density, slope, depth, width, draws } = *own;
    let flume = BedLoadFlume { grain_diameter, grain_density, slope, depth, width };
    let prediction = flume.predict(usize::from(draws))?;
    session.say(&text(&flume, &prediction));
    Ok(Exit::Held)
}

/// The prediction in lines.
fn text(flume: &BedLoadFlume, own: &TransportPrediction) -> String {
    let of = |value: f64| four_digits(value);
    let unit = flume.grain_density * own.stream.transport_unit();
    let within = |(low, high): (f64, f64), unit: f64| format!("{} … {}", of(low * unit), of(high * unit));
    let mut lines = vec![
        format!(
            "bed load      {} kg/(m s); 95 % by closures and the scatter of measurements: {}",
            of(own.transport * unit),
            within(own.interval, unit)
        ),
        format!("              q* = {} ({})", of(own.transport), within(own.interval, 1.0)),
    ];
    if let Some(width) = flume.width {
        let unit = unit * width;
        lines.push(format!(
            "in the flume  {} kg/s ({}) over {} m",
            of(own.transport * unit),
            within(own.interval, unit),
            of(width)
        ));
    }
    let (steady, all) = own.draws;
    lines.push(format!(
        "closures      95 % of {steady} steady layers of {all} draws: {} kg/(m s)",
        within(own.by_closures, unit)
    ));
    let formula = of(own.formula * unit);
    lines.push(match &own.rates {
        Some(rates) => format!(
            "measured      {} kg/(m s), median of {} runs at about this Shields number; formula of Wong & Parker {formula} kg/(m s)",
            of(rates.median * own.formula * unit),
            rates.number
        ),
        None => format!("measured      fewer than ten runs at about this Shields number, so the scatter is that of all above 0.1; formula of Wong & Parker {formula} kg/(m s)"),
    });
    lines.push(format!(
        "Shields number {} at a mean velocity of {} m/s",
        of(own.stream.shields_number()),
        of(own.velocity)
    ));
    if flume.width.is_some() {
        lines.push(format!(
            "side walls    the bed bears {} of ρ g h S (Vanoni & Brooks 1957, smooth walls); if the bed were as smooth, {} (Guo & Julien 2005)",
            of(own.bed_share),
            of(own.smooth_bed_share)
        ));
    }
    if own.transport < LEAST_TRANSPORT {
        lines.push(format!("no motion     q* is below {LEAST_TRANSPORT}, where motion begins: a bed at rest creeps by its regularisation"));
    }
    if own.outside.is_empty() {
        lines.push("inside of what was compared with measurements".to_owned());
    }
    lines.extend(own.outside.iter().map(|part| format!("outside of what was compared with measurements: {part}")));
    lines.join("\n") + "\n"
}
