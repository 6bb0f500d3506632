//! Fields of grains over the depth of a steady layer, and points of a friction law: `bagnold grains`.

mod coarse;
mod fields;
mod frame;
mod page;
mod plan;

pub use fields::RunFields;
pub use page::{summary, write};
pub use plan::{GrainPlan, GrainRun};

use crate::input::FieldError;
use crate::number::short_digits;
use crate::{ToolError, judge};
use coarse::Window;
use frame::{Grains, check_walls};
use std::collections::HashMap;
use std::path::Path;

/// Windows of time, each of one frame at least.
const WINDOWS: usize = 5;
/// Bins on a diameter.
const BINS: f64 = 2.0;

/// Schema of a plan.
pub fn schema() -> &'static serde_json::Value {
    bagnold_solver::parameter::schema_of::<GrainPlan>()
}

/// Averages all runs of a plan.
///
/// # Errors
/// Files that cannot be read, and runs that are no steady layer of one kind of grains.
pub fn average(plan: &GrainPlan) -> Result<Vec<RunFields>, ToolError> {
    (0..plan.runs.len()).map(|place| average_run(plan, place)).collect()
}

/// Averages one run; the frames are read one after the other.
fn average_run(plan: &GrainPlan, place: usize) -> Result<RunFields, ToolError> {
    let (run, field) = (&plan.runs[place], &format!("run[{place}]"));
    let folder = plan.path.parent().unwrap_or(Path::new(""));
    let file = folder.join(&run.particles.files[0]);
    let at_run = |error: FieldError| ToolError::from(error.within(field).in_file(&file));
    let assigned = |files: &judge::ParticleFiles, known, name: &str| {
        judge::plan(&files.columns, known, None, &format!("{field}.{name}")).map_err(|error| error.in_file(&plan.path))
    };
    let columns = assigned(&run.particles, plan::GRAINS, "particles")?;
    let of_contacts = |files| assigned(files, plan::CONTACTS, "contacts");
    let contact_columns = run.contacts.as_ref().map(of_contacts).transpose()?;
    let both = run.contacts.as_ref().zip(contact_columns.as_ref());
    let mut contacts = both.map(|(files, columns)| judge::frames(files, columns, folder)).transpose()?;
    let (mut layer, mut alike, mut frames) = (None, usize::MAX, Vec::new());
    for frame in judge::frames(&run.particles, &columns, folder)? {
        let frame = frame?;
        let grains = Grains::new(&frame.columns, &run.kinds);
        let [diameter, _] = match layer {
            Some(layer) => layer,
            None => *layer.insert(grains.layer(run).map_err(at_run)?),
        };
        let bin = diameter / BINS;
        let mut window = Window::default();
        window.total[0] = 1.0;
        let [y, vx, vy] = ["y", "vx", "vy"].map(|name| &frame.columns[name]);
        for &row in &grains.rows {
            window.add_grain(bin, grains.mass(run, row), y[row], [vx[row], vy[row]]);
        }
        alike = alike.min(grains.alike());
        if let Some(contacts) = &mut contacts {
            let is_same = |time: f64| (time - frame.time).abs() <= 1e-9 * frame.time.abs();
            let own = contacts.next().transpose()?.filter(|own| is_same(own.time)).ok_or_else(|| {
                let defect = format!("no frame at {} s, where the grains have one", frame.time);
                at_run(FieldError::finding("contacts.files", defect, "dump both at the same steps"))
            })?;
            add_contacts(&mut window, bin, run.length, [&grains, &Grains::new(&own.columns, &[])]).map_err(at_run)?;
        }
        frames.push(window);
    }
    let Some([diameter, density]) = layer.filter(|_| frames.len() >= WINDOWS) else {
        let defect = format!("frames in the files: {}, needed: {WINDOWS} or more", frames.len());
        let remedy = "dump a steady flow at several times, with some seconds of shear between them";
        return Err(at_run(FieldError::finding("particles.files", defect, remedy)));
    };
    check_walls(alike).map_err(at_run)?;
    let end = |k: usize| k * frames.len() / WINDOWS;
    let windows: Vec<Window> = (0..WINDOWS).map(|k| Window::merged(&frames[end(k)..end(k + 1)])).collect();
    let fields = run.fields(place, &windows, [diameter, density], diameter / BINS);
    fields.check_balance().map_err(at_run)?;
    let limit = plan.steady_within.unwrap_or(0.1);
    if fields.unsteadiness <= limit {
        fields.check_direction(run).map_err(at_run)?;
        let is_repeated = (1..frames.len()).any(|k| frames[..k].iter().any(|other| other.bins == frames[k].bins));
        let repeated =
            || FieldError::finding("particles.files", "two frames hold the same grains", "dump at several times");
        return if is_repeated { Err(at_run(repeated())) } else { Ok(fields) };
    }
    let [change, limit] = [fields.unsteadiness, limit].map(|part| short_digits(100.0 * part, 2));
    let defect = format!("the velocity changes by {change} %, above the limit of {limit} % (`steady_within`)");
    let remedy = "dump later, or leave the run out";
    Err(at_run(FieldError::finding("particles.files", defect, remedy)))
}

/// Adds the contacts of a frame of which one grain flows at least.
fn add_contacts(
    window: &mut Window,
    bin: f64,
    length: f64,
    [grains, contacts]: [&Grains; 2],
) -> Result<(), FieldError> {
    let places: HashMap<u64, usize> =
        grains.columns["id"].iter().enumerate().map(|(row, id)| (id.to_bits(), row)).collect();
    let mut work = 0.0;
    for &row in &contacts.rows {
        let pair = ["first", "second"].map(|name| places.get(&contacts.at(name, row).to_bits()).copied());
        let [Some(first), Some(second)] = pair else {
            let value = format!("{} and {}", contacts.at("first", row), contacts.at("second", row));
            let remedy = "dump all grains, walls included, with their `id`";
            let rule = "ids of two grains of the frame";
            return Err(FieldError::new("contacts.columns.first", value, rule, remedy));
        };
        if [first, second].iter().all(|row| grains.rows.binary_search(row).is_err()) {
            continue;
        }
        let [along, over] = ["x", "y"].map(|name| grains.at(name, first) - grains.at(name, second));
        let branch = [along - length * (along / length).round(), over];
        let force =
            [["fx", "tx"], ["fy", "ty"]].map(|parts| parts.iter().map(|name| contacts.at(name, row)).sum::<f64>());
        work += branch[0] * force[0] + branch[1] * force[1];
        window.add_contact(bin, grains.at("y", first), branch, force);
    }
    if work < 0.0 {
        let remedy = "exchange `first` and `second`: `fx` is the force on `first`";
        return Err(FieldError::finding("contacts.columns.fx", "grains attract each other on average", remedy));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
