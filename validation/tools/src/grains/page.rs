//! Tables, figure and summary of grains.

use super::fields::{POINT, RunFields};
use super::plan::GrainPlan;
use crate::figure::{self, Axis, Figure, FigureFormat, Panel};
use crate::number::{short_digits, two_digits};
use crate::output::{FileError, caution, write_whole};
use std::io;
use std::path::Path;

/// Change of the inertial number between points whose slope counts `[-]`.
const APART: f64 = 0.05;
/// Difference of the contacts' stress from the momentum balance that is told `[-]`.
const UNBALANCED: f64 = 0.05;

/// Relative uncertainty below which a value is exact but for rounding, such as the friction on a slope `[-]`.
const EXACT: f64 = 1e-9;
/// Inertial number above which no flow is dense `[-]`.
const FASTEST: f64 = 3.0;

/// Writes a table of fields for each run, the points of the law, and a figure.
///
/// # Errors
/// Files that cannot be written.
pub fn write(plan: &GrainPlan, runs: &[RunFields], folder: &Path, format: FigureFormat) -> Result<(), FileError> {
    let unwritable = |error: io::Error| FileError::unwritable(folder, &error);
    runs.iter().try_for_each(|run| run.table.write(folder)).map_err(unwritable)?;
    write_whole(&folder.join("points.csv"), points(plan, runs).as_bytes()).map_err(unwritable)?;
    let panel = |(k, label): (usize, &str)| {
        let mut panel = Panel::new("", Axis::linear("I [-]"), Axis::linear(label));
        for (slot, run) in runs.iter().enumerate() {
            let error = if k == POINT[1] { uncertainty(runs, run) } else { run.core[k].1 };
            panel.points(&run.name, slot, [(run.core[POINT[0]].0, run.core[k].0)]).error = vec![error];
        }
        panel
    };
    let panels = [(POINT[1], "μ [-]"), (POINT[2], "φ [-]")].map(panel);
    let caption =
        format!("{}: means over the core of each run, with standard uncertainties as in points.csv.", plan.title);
    let drawn = Figure::new("law", &caption, panels.into());
    let drawn = figure::write(&drawn, &folder.join("figures"), format);
    drawn.map(drop).map_err(|error| unwritable(io::Error::other(error.to_string())))
}

/// Points of the law.
fn points(plan: &GrainPlan, runs: &[RunFields]) -> String {
    let mut text = format!("# source: {}, grains\n", plan.title);
    text += "inertial_number [-],friction [-],friction uncertainty [-],solid_fraction [-],inertial_number scatter [-],run\n";
    for run in runs {
        let [(inertia, scatter), (friction, _), (solid, _)] = POINT.map(|k| run.core[k]);
        let sigma = uncertainty(runs, run);
        text += &format!("{inertia},{friction},{sigma},{solid},{scatter},\"{}\"\n", run.name);
    }
    text
}

/// Standard uncertainty of a run's friction. Where only the inertial number scatters, as on slopes, the line to the neighbours carries that
/// over to the friction.
fn uncertainty(runs: &[RunFields], run: &RunFields) -> f64 {
    let [(inertia, scatter), (friction, own), _] = POINT.map(|k| run.core[k]);
    // repeats on one slope have the same friction
    let is_other = |point: &(f64, f64)| (point.1 - friction).abs() > EXACT * friction.abs();
    let others = runs.iter().map(|run| (run.core[POINT[0]].0, run.core[POINT[1]].0)).filter(is_other);
    let below = others.clone().filter(|point| point.0 < inertia * (1.0 - APART)).max_by(|a, b| a.0.total_cmp(&b.0));
    let above = others.filter(|point| point.0 > inertia * (1.0 + APART)).min_by(|a, b| a.0.total_cmp(&b.0));
    let (low, high) = (below.unwrap_or((inertia, friction)), above.unwrap_or((inertia, friction)));
    let slope = if high.0 > low.0 { (high.1 - low.1) / (high.0 - low.0) } else { 0.0 };
    libm::hypot(own, slope * scatter)
}

/// Two lines for each run: its point, and the checks.
pub fn summary(runs: &[RunFields]) -> String {
    let line = |run: &RunFields| {
        let parts = ["I", "μ", "φ"].iter().zip(POINT.map(|k| run.core[k]));
        let part = |(name, (value, u)): (&&str, (f64, f64))| match u <= EXACT * value.abs() {
            true => format!("{name} = {}", short_digits(value, 4)),
            false => format!("{name} = {} ± {}", short_digits(value, 4), two_digits(u)),
        };
        let parts: Vec<String> = parts.map(part).collect();
        let [pressure, shear] = run.balance();
        if pressure.max(shear) - 1.0 > UNBALANCED || 1.0 - pressure.min(shear) > UNBALANCED {
            caution(&format!(
                "{}: contact stresses are not the momentum balance's; average over a longer time or, where their ratio is far from 1, \
                 correct density, `width`, `length` or the unit of forces",
                run.name
            ));
        }
        let (solid, [low, high]) = (run.core[POINT[2]].0, run.usual_solid_fraction);
        if !(low..=high).contains(&solid) {
            caution(&format!(
                "{}: the solid fraction {} is outside {low} to {high}, that of dense flows; check `length`, `width` and the radii",
                run.name,
                short_digits(solid, 2)
            ));
        }
        let (inertia, _) = run.core[POINT[0]];
        if inertia > FASTEST {
            caution(&format!(
                "{}: I = {} is above {FASTEST}, that of dense flows; check the units of velocity, radius and density",
                run.name,
                short_digits(inertia, 2)
            ));
        }
        let stress = if [pressure, shear] == [1.0, 1.0] {
            "stress by the momentum balance of the geometry".to_owned()
        } else {
            let bears =
                |ratio: f64| if ratio.is_finite() { short_digits(ratio, 3) } else { "an unknown part".to_owned() };
            let [pressure, shear] = [pressure, shear].map(bears);
            format!("contacts bear {pressure} of the pressure and {shear} of the shear stress of the momentum balance")
        };
        let [frames, grains, ..] = run.total;
        format!(
            "{}: {}\n  {frames} frames in {} windows, velocity within {} %; {grains} grains × frames; {stress}; mass and momentum of the \
             fields within {:.0e}\n",
            run.name,
            parts.join(", "),
            run.windows,
            short_digits(100.0 * run.unsteadiness, 2),
            run.defect
        )
    };
    runs.iter().map(line).collect()
}
