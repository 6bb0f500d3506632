//! `bagnold predict`: a quantity of a user's own flow with its interval, and whether it lies inside the range compared with measurements.

use super::arguments::{BedLoadArguments, CollapseArguments, PredictAction, PredictArguments};
use super::simulation::simulate_announced;
use super::{Exit, ProgramError, Session, in_pool};
use crate::league::studies::GrainComparison;
use crate::metric::{COVERAGE, Metric};
use crate::output::{FileError, csv_text, write_whole};
use crate::prediction::PredictionPlan;
use bagnold_cases::bed_load_1d::{BedLoadFlume, TransportPrediction};
use bagnold_number::{four_digits, in_unit, two_digits};
use std::io::Error;
use std::path::Path;

/// q* from which grains count as moving `[-]`.
const LEAST_TRANSPORT: f64 = 1e-4;

/// Predicts.
///
/// # Errors
/// A flow that breaks a rule, named by its option.
pub(super) fn predict(command: &PredictArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    match &command.action {
        PredictAction::BedLoad(own) => bed_load(own, session),
        PredictAction::ColumnPlanar(own) => in_pool(own.work.threads, || collapse("column-planar", own, session)),
        PredictAction::InclineCollapse(own) => in_pool(own.work.threads, || collapse("incline-collapse", own, session)),
    }
}

/// Predicts a collapse by a fitted law, and judges it where it was measured.
fn collapse(case: &str, command: &CollapseArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let (case, settings, &CollapseArguments { resolution, draws, .. }) =
        (case.to_owned(), command.settings.clone(), command);
    let plan = PredictionPlan { case, settings, resolution, draws, ..PredictionPlan::default() };
    let (plan, runs) = plan.prepare(&command.law, session.registry, command.allowance.limits())?;
    let measured = command.measured.as_ref().map(|file| plan.measured(file, session.registry)).transpose()?;
    let folder = command.out.clone().unwrap_or_else(|| Path::new("reports/predictions").join(&plan.case));
    let (plan, _lock) = plan.claim(&folder)?;
    let store = command.work.open_store();
    let results = simulate_announced("predict", runs, &store, session.quiet)?;
    let predicted = plan.evaluate(&results, &measured.unwrap_or_default())?;
    let lines: String = predicted.iter().map(|(own, metric)| lines(own, metric, &plan)).collect();
    let text = format!("plan {} at Unix time {} s\n{lines}", plan.digest, plan.unix_time);
    let stem = command.measured.as_ref().and_then(|file| Some(file.file_stem()?.to_string_lossy()));
    let name = stem.map_or_else(|| "summary.txt".to_owned(), |stem| format!("verdict-{stem}.txt"));
    let rows = csv_text(predicted.iter().map(|(own, _)| own)).map_err(Error::from);
    let written = rows.and_then(|rows| write_whole(&folder.join("prediction.csv"), rows.as_bytes()));
    let written = written.and_then(|()| write_whole(&folder.join(name), text.as_bytes()));
    written.map_err(|error| FileError::unwritable(&folder, &error))?;
    session.say(&text);
    Ok(Exit::Held)
}

/// A predicted quantity in lines.
fn lines(own: &GrainComparison, metric: &Metric, plan: &PredictionPlan) -> String {
    let PredictionPlan { resolution, draws, .. } = plan;
    let within = |value: f64, u: f64| in_unit(&format!("{} ± {}", four_digits(value), two_digits(u)), &metric.unit);
    let ends = |low: f64, high: f64| format!("{} … {}", four_digits(low), four_digits(high));
    let (value, u, fine) = (own.value, own.u_input.hypot(own.u_numerical), 2 * u32::from(*resolution));
    let [u_input, u_numerical] = [own.u_input, own.u_numerical].map(two_digits);
    let mut text = format!("{}  {}: u_input {u_input} of {draws} draws, ", own.quantity, within(value, u));
    text += &format!("u_numerical {u_numerical} by resolutions {resolution} and {fine}\n");
    text += &format!("  95 % by law and resolution: {}\n", ends(value - COVERAGE * u, value + COVERAGE * u));
    if let Some(interval) = &metric.prediction {
        let (both, count) = (ends(interval.lower, interval.upper), interval.comparisons);
        text += &format!("  95 % by the errors of {count} comparisons of the model: {both}\n");
        text.extend(interval.warnings.iter().map(|warning| format!("  less certain: {warning}\n")));
    }
    if let (Some(error), Some(u_measured)) = (own.error(), own.u_measured) {
        let (measured, [e, u_val]) = (within(value - error, u_measured), [error, own.uncertainty().0].map(two_digits));
        text += &format!("  measured {measured}: E = {e}, u_val = {u_val}: {}\n", own.verdict());
    }
    text
}

/// Acceleration of gravity `[m/s²]`.
const GRAVITY: f64 = 9.81;

/// Predicts the bed load of a flume.
fn bed_load(own: &BedLoadArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let BedLoadArguments { grain_diameter, grain_density, slope, depth, width, draws, measured } = *own;
    let flume = BedLoadFlume { grain_diameter, grain_density, slope, depth, width };
    let prediction = flume.predict(usize::from(draws))?;
    session.say(&text(&flume, &prediction, measured));
    Ok(Exit::Held)
}

/// The prediction in lines.
fn text(flume: &BedLoadFlume, own: &TransportPrediction, by_user: Option<f64>) -> String {
    let of = |value: f64| four_digits(value);
    let unit = flume.grain_density * own.stream.transport_unit();
    let within = |(low, high): (f64, f64), unit: f64| format!("{} … {}", of(low * unit), of(high * unit));
    let both = |unit: f64| (of(own.transport * unit), within(own.interval, unit));
    let ((rate, interval), (dimensionless, own_interval)) = (both(unit), both(1.0));
    let mut text = String::new();
    if own.transport < LEAST_TRANSPORT {
        text +=
            &format!("bed load      none: q* = {dimensionless} is below {LEAST_TRANSPORT}, the threshold of motion; ");
        text += "such values are creep of the regularised friction\n";
    } else {
        text += &format!(
            "bed load      {rate} kg/(m s); 95 % interval from closures and the scatter of measurements: {interval}\n"
        );
        text += &format!("              q* = {dimensionless} ({own_interval})\n");
        if let Some(width) = flume.width {
            let (rate, interval) = both(unit * width);
            text += &format!("in the flume  {rate} kg/s ({interval}) over {} m\n", of(width));
        }
        let ((steady, all), by_closures) = (own.draws, within(own.by_closures, unit));
        text += &format!(
            "closures      95 % interval of {steady} steady layers from {all} draws: {by_closures} kg/(m s)\n"
        );
    }
    if let Some(rate) = by_user {
        let is_inside = (own.interval.0 * unit..=own.interval.1 * unit).contains(&rate);
        let place = if is_inside { "inside of" } else { "outside of" };
        let share = of(own.transport * unit / rate);
        let verdict = match own.transport < LEAST_TRANSPORT {
            true => "none is predicted".to_owned(),
            false => format!("{place} the 95 % interval; predicted over yours: {share}"),
        };
        text += &format!("yours         {} kg/(m s), {verdict}\n", of(rate));
    }
    text += &match &own.rates {
        Some(rates) => {
            let (median, number) = (of(rates.median * own.formula * unit), rates.number);
            format!("measured      {median} kg/(m s), median of {number} runs near this Shields number\n")
        }
        None => "measured      fewer than ten runs near this Shields number: the scatter of all above 0.1 counts\n"
            .to_owned(),
    };
    let formula = of(own.formula * unit);
    text += &format!("formula       {formula} kg/(m s) by Wong & Parker (2006), exponent 1.6\n");
    let (shields, velocity) = (of(own.stream.shields_number()), of(own.velocity));
    text += &format!("Shields number {shields} at a mean velocity of {velocity} m/s\n");
    if flume.width.is_some() {
        let (bed, smooth) = (of(own.bed_share), of(own.smooth_bed_share));
        text += &format!("side walls    the bed carries {bed} of ρ g h S (Vanoni & Brooks 1957, smooth walls); ");
        text += &format!("with a smooth bed, {smooth} (Guo & Julien 2005)\n");
    }
    if own.transport >= LEAST_TRANSPORT {
        let froude_number = own.velocity / (GRAVITY * flume.depth).sqrt();
        let forms = if froude_number > 1.0 { "antidunes" } else { "dunes" };
        text += &format!(
            "not computed  bed forms (Froude number {}: {forms}), mixed sizes, suspension\n",
            of(froude_number)
        );
    }
    if own.outside.is_empty() {
        text += "inside the range compared with measurements\n";
    }
    text.extend(own.outside.iter().map(|part| format!("reservation   {part}\n")));
    text
}
