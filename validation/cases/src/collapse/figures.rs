//! The case's figures.

use super::interior::{self, energies, stations, velocity_profile, wedge};
use super::metrics::{convergence, measured, scaling, stress_updates};
use crate::case::Flow;
use crate::collapse::column::{PICTURES, pile_of};
use crate::collapse::metrics::other_codes::Beside;
use crate::collapse::metrics::{Measure, bands, laws_among};
use crate::collapse::{Collapse, CollapseRecord, ColumnFlow, ExperimentGrains, FRONT_THICKNESS, Material};
use crate::figure::{Animation, Axis, Field, Figure, Mark, Panel};
use crate::observation::pictures::{View, animation, halves};
use crate::observation::{Frame, Recorded, energy};
use crate::reference::collapse::{
    CodeQuantity, CollapseLaw, CollapseLawSource, PLANAR_COLLAPSE, ROUND_COLLAPSE, ROUND_COLUMN_RUN_OUTS,
};
use crate::shared::distinct;

pub(crate) fn all<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Figure> {
    let laws = laws_among(records);
    let mut figures = Vec::new();
    // bars of another friction belong to the pile's own figure
    let columns = laws.iter().copied().filter(|(run, _)| run.grains != ExperimentGrains::Bars || is_shown(run));
    let columns: Vec<&CollapseRecord<D>> = columns.collect();
    if !columns.is_empty() {
        figures.push(scaling_figure(&columns));
    }
    for material in distinct(laws.iter().map(|(run, _)| run.made_of())) {
        let own: Vec<&CollapseRecord<D>> = laws.iter().copied().filter(|(run, _)| run.made_of() == material).collect();
        if is_shown(&own[0].0) {
            figures.extend([deposits(&own), histories(&own), energy_budget(&own), wedges(&own)]);
        }
    }
    figures.extend(measured::pile_figure(&laws));
    figures.extend(convergence::figure(records));
    figures.extend(stress_updates::figure(records));
    for (run, record) in laws.iter().filter(|(run, _)| is_shown(run)).map(|record| (&record.0, &record.1)) {
        if run.aspect_ratio <= TALLEST_IN_PICTURES {
            figures.push(pictures(run, &record.frames));
        }
        figures.extend(shown(run, &record.frames));
        figures.extend(velocity_profiles(run, record));
    }
    figures
}

/// Aspect ratio of columns above which an animation alone shows the flow `[-]`: their pictures are strips.
const TALLEST_IN_PICTURES: f64 = 3.0;

/// A name with the material of its columns.
fn of_material<const D: usize>(name: &str, records: &[&CollapseRecord<D>]) -> String {
    records.first().map_or(name.to_owned(), |(run, _)| format!("{name}-{}", run.made_of()))
}

/// Whether a column gets pictures of its own: variants of the grains look like their originals.
fn is_shown<const D: usize>(run: &ColumnFlow<D>) -> bool {
    run.made_of().is_published()
}

/// Run-out and height over the aspect ratio, with every published law of the geometry.
fn scaling_figure<const D: usize>(records: &[&CollapseRecord<D>]) -> Figure {
    let round = D == 3;
    let (own, other) =
        if round { (&*ROUND_COLLAPSE, &*PLANAR_COLLAPSE) } else { (&*PLANAR_COLLAPSE, &*ROUND_COLLAPSE) };
    // the laws of the geometry, and Lube's of the other one: the paper compared planar runs with the round law
    let run_out_laws: Vec<&CollapseLaw> =
        own.run_out.iter().chain([CollapseLawSource::Lube.law(&other.run_out)]).collect();
    let lube_of_planar = round.then(|| CollapseLawSource::Lube.law(&other.height));
    let height_laws: Vec<&CollapseLaw> = own.height.iter().chain(lube_of_planar).collect();
    // a source keeps its colour from panel to panel and from figure to figure
    let round_run_out = CollapseLawSource::Lube.law(&ROUND_COLLAPSE.run_out);
    let sources: Vec<&CollapseLaw> = PLANAR_COLLAPSE.run_out.iter().chain([round_run_out]).collect();
    let measured = &*ROUND_COLUMN_RUN_OUTS;
    let mut fits = 0;
    let mut panel = |label: &str, laws: &[&CollapseLaw], measure: Measure, legend: bool| {
        let mut panel = Panel::new("", Axis::logarithmic("h0/r0 [-]"), Axis::logarithmic(label));
        for law in laws {
            let known = sources.iter().position(|other| other.source.split(',').next() == law.source.split(',').next());
            let slot = known.unwrap_or(sources.len());
            // the laws that the collapse paper prints, and those that the panel beside does not name
            let number = match (law.source.as_str(), legend) {
                (source, true) if source == round_run_out.source => " (45)",
                (source, false) if source == CollapseLawSource::Lube.law(&PLANAR_COLLAPSE.height).source => " (46)",
                _ => "",
            };
            let is_named = legend || !number.is_empty() || !run_out_laws.iter().any(|other| other.source == law.source);
            for (part, curve) in law.curves().into_iter().enumerate() {
                let entry = if is_named && part == 0 { format!("{}{number}", law.source) } else { String::new() };
                panel.line(&entry, slot + 3, curve);
            }
        }
        if round && legend {
            let bars = measured.points.iter().map(|(_, run_out)| 2.0 * measured.scatter * run_out).collect();
            panel.draw("measured", Mark::OpenPoints, 13, measured.points.iter().copied()).error = bars;
            panel.draw("measured, doubtful", Mark::OpenPoints, 9, measured.doubtful.iter().copied());
        }
        for pile in records.iter().filter_map(|(run, _)| pile_of(run)).take(1) {
            let (front, row) = (pile.front(FRONT_THICKNESS * pile.length) - pile.length, pile.surface[0].1);
            let (value, reading) = if legend { (front, pile.front_reading()) } else { (row, pile.reading) };
            let point = (pile.height / pile.length, value / pile.length);
            let entry = if legend { "measured, bars" } else { "" };
            panel.draw(entry, Mark::OpenPoints, 13, [point]).error = vec![2.0 * reading / pile.length];
        }
        let gate = |run: &ColumnFlow<D>| if legend { bands::run_out(run, false) } else { bands::height(run) };
        for (run, _) in records {
            if let Some(((low, high), _)) = gate(run) {
                let entry = if legend && panel.bands.is_empty() { "limits of the gates" } else { "" };
                panel.band(entry, [0.93, 1.07].map(|part| (part * run.initial_height(), low, high)));
            }
        }
        let kinds = distinct(records.iter().map(|(run, _)| (run.made_of(), run.resolution)));
        for (slot, (material, resolution)) in kinds.into_iter().enumerate() {
            let own = || records.iter().filter(|(run, _)| (run.made_of(), run.resolution) == (material, resolution));
            let holds = |run: &ColumnFlow<D>, value: f64| {
                gate(run).is_none_or(|((low, high), _)| (low..=high).contains(&value))
            };
            let title = own().next().map_or(String::new(), |(run, _)| run.made_of().title_with(&run.material));
            // short, so that two stand on a line of the legend
            let title = title.replace(" of Table 2", "").replace("grains of ", "").replace(" et al.", "");
            for (mark, inside) in [(Mark::Points, true), (Mark::OpenPoints, false)] {
                let points: Vec<(f64, f64)> = own()
                    .map(|(run, record)| (run, measure(&record.data)))
                    .filter(|(run, value)| holds(run, *value) == inside)
                    .map(|(run, value)| (run.initial_height(), value))
                    .collect();
                let entry = match (inside, legend) {
                    (true, true) => format!("{title}, r0/{resolution}"),
                    _ => String::new(),
                };
                if inside || !points.is_empty() {
                    panel.draw(&entry, mark, slot, points);
                }
            }
        }
        for material in distinct(records.iter().map(|(run, _)| run.made_of())) {
            if let Some(found) = scaling::fit(records, material, measure) {
                let ends = [found.range.0, found.range.1];
                let curve = ends.map(|a| (a, found.law.coefficient * libm::pow(a, found.law.value)));
                let exponent = format!("fit: {:.2} ± {:.2}", found.law.value, found.half_width);
                panel.reference(&exponent, curve.to_vec());
                fits += 1;
            }
        }
        panel
    };
    let panels = vec![
        panel("run-out (r∞ − r0)/r0 [-]", &run_out_laws, Collapse::run_out, true),
        panel("final height h∞/r0 [-]", &height_laws, Collapse::final_height, false),
    ];
    let mut caption = "Run-out and final height over the aspect ratio, with published laws, whose sources state no \
                       scatter. Open marks fail their gate."
        .to_owned();
    if fits > 0 {
        caption += " Fits: power laws; exponents with 95 % interval.";
    }
    if records.iter().any(|(run, _)| pile_of(run).is_some()) {
        caption += " Bars: Bui et al. 2008, ± twice the reading.";
    }
    if round {
        let percent = 200.0 * measured.scatter;
        caption += &format!(" Error bars of measured points: twice their scatter, ± {percent:.0} %.");
    }
    Figure::new("scaling", &caption, panels)
}

fn label<const D: usize>(run: &ColumnFlow<D>) -> String {
    let material = match run.made_of() {
        own if own.title() != own.title_with(&run.material) => own.title_with(&run.material),
        Material::LAGREE => "Lagrée".to_owned(),
        published if published.is_published() => published.to_string(),
        altered => altered.title(),
    };
    format!("{material}, a = {}", run.aspect_ratio)
}

fn deposits<const D: usize>(records: &[&CollapseRecord<D>]) -> Figure {
    let [x, thickness] = [("x/r0 [-]", "x"), ("thickness/r0 [-]", "thickness")]
        .map(|(label, name)| Axis::linear(label).over(name, "m", records.iter().map(|(run, _)| run.half_width)));
    let mut panel = Panel::new("", x, thickness);
    for (slot, (run, record)) in records.iter().enumerate() {
        panel.line(&label(run), slot, record.data.drawn());
    }
    Figure::new(
        &of_material("deposits", records),
        "Thickness of the deposits (volume per bin of 0.1 r0). The run-out is read at a thickness of 0.02 r0; a toe of \
         fewer than four particle rows counts as a wedge of equal volume.",
        vec![panel],
    )
}

fn histories<const D: usize>(records: &[&CollapseRecord<D>]) -> Figure {
    let time = || Axis::linear("t/√(h0/g) [-]").over("t", "s", records.iter().map(|(run, _)| run.time_scale()));
    let heights = records.iter().map(|(run, _)| run.initial_height() * run.half_width);
    let way = Axis::linear("(front − r0)/(a r0) [-]").over("front − r0", "m", heights);
    let mut front = Panel::new("", time(), way);
    let mut energy = Panel::new("", time(), Axis::linear("kinetic/initial potential energy [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let (data, a, scale) = (&record.data, run.initial_height(), run.time_scale());
        let time = || data.time.iter().map(|t| t / scale);
        let way = time().zip(data.rows_front.iter().map(|front| (front - 1.0) / a));
        let initial = data.potential_energy.first().copied().unwrap_or(f64::NAN);
        let share = time().zip(data.kinetic_energy.iter().map(|kinetic| kinetic / initial));
        front.line(&label(run), slot, way);
        energy.line("", slot, share);
        if let Some(beside) = Beside::of_column(run, data) {
            beside.draw(&mut front, CodeQuantity::Front, slot, |(time, front)| (time, (front - 1.0) / a));
            beside.draw(&mut energy, CodeQuantity::KineticEnergy, slot, |point| point);
        }
    }
    let has_points =
        [&front, &energy].iter().any(|panel| panel.series.iter().any(|series| series.mark == Mark::Points));
    let points = if has_points {
        "Points: other codes with the same law; error bars: twice their uncertainty."
    } else {
        "No front over time is published for these columns."
    };
    let caption = format!(
        "Front displacement at a thickness of 0.05 r0, divided by the aspect ratio, and kinetic energy, divided by \
         the initial potential energy, over time in units of √(h0/g). {points}"
    );
    Figure::new(&of_material("histories", records), &caption, vec![front, energy])
}

/// The values of a run's variant as a file name: `sand-0.9-20`.
fn stem<const D: usize>(run: &ColumnFlow<D>) -> String {
    run.variant().file_name_of_values()
}

fn view<const D: usize>(run: &ColumnFlow<D>) -> View {
    View {
        unit_length: run.half_width,
        unit: "r0",
        time_scale: run.time_scale(),
        spacing: run.spacing(),
        mirrored: true,
    }
}

/// The animation of every run.
pub(crate) fn animations<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Animation> {
    let moving = |(run, record): &CollapseRecord<D>| {
        let section = if D == 3 { " Shown: section next to a symmetry plane." } else { "" };
        let caption = format!(
            "{}: collapse, coloured by speed. Dashed: thickness (volume per bin of 0.1 r0) and front (where the \
             thickness is 0.02 r0). The left half mirrors the simulated right half.{section}",
            label(run)
        );
        animation(&format!("collapse-{}", stem(run)), &caption, &record.data.motion, &view(run))
    };
    laws_among(records).into_iter().filter(|(run, _)| is_shown(run)).map(moving).collect()
}

/// The paper's pictures: speed and pressure at absolute times.
fn shown<const D: usize>(run: &ColumnFlow<D>, frames: &[Frame]) -> Option<Figure> {
    let shown: Vec<&Frame> = run.shown_times().iter().filter_map(|&time| Frame::nearest(frames, time)).collect();
    let source = match run.aspect_ratio {
        0.9 => "figure 7 (captioned glass beads) and text",
        2.75 => "figure 8",
        _ => "figure 9",
    };
    let caption = format!(
        "{}, {}: speed (left) and pressure (right) at the times of the collapse paper's {source}. The left half \
         mirrors the simulated right half.",
        label(run),
        run.made_of().title()
    );
    (!shown.is_empty()).then(|| halves(&format!("halves-{}", stem(run)), &caption, &shown, &view(run)))
}

fn energy_budget<const D: usize>(records: &[&CollapseRecord<D>]) -> Figure {
    let runs: Vec<_> =
        records.iter().map(|(run, record)| (label(run), run.time_scale(), energies(&record.data))).collect();
    energy::figure(
        &of_material("energy-budget", records),
        "Released potential energy, kinetic energy, and their difference, which is dissipated except for less than 1 \
         % of elastic energy. All are relative to the potential energy released by the end.",
        &runs,
    )
}

fn velocity_profiles<const D: usize>(run: &ColumnFlow<D>, record: &Recorded<Collapse>) -> Option<Figure> {
    let stations = stations(run, record);
    let caption = format!(
        "{}: horizontal velocity over the depth at 1.5 √(h0/g), averaged over 0.1 r0. Left: linear fit to the \
         flowing layer (above 35 % of the largest velocity) with R². Right: exponential fit below this layer.",
        label(run)
    );
    let name = format!("velocity-{}", stem(run));
    (!stations.is_empty()).then(|| velocity_profile::figure(&name, &caption, &stations, (run.half_width, "r0")))
}

fn wedges<const D: usize>(records: &[&CollapseRecord<D>]) -> Figure {
    let panels = records.iter().filter_map(|(run, record)| {
        let wedge = interior::wedge_of(run, &record.frames)?;
        Some(wedge::panel(&label(run), run, record.frames.last()?, &wedge))
    });
    Figure::new(
        &of_material("wedges", records),
        "Deposits coloured by the displacement d since the start; grey particles moved by less than a spacing. \
         Dashed: initial column. Solid: line through the surface of the undisturbed part.",
        panels.collect(),
    )
    .in_columns(2)
}

/// Speed and pressure at the pictures' times; of a round column the slice beside a symmetry plane.
fn pictures<const D: usize>(run: &ColumnFlow<D>, frames: &[Frame]) -> Figure {
    let r = run.half_width;
    let times = PICTURES.iter().map(|time| time * run.time_scale());
    let mut frames: Vec<&Frame> = times.filter_map(|time| Frame::nearest(frames, time)).chain(frames.last()).collect();
    // a run that ended early has no more than its deposit to show
    frames.dedup_by(|a, b| a.time == b.time);
    let far = frames.iter().flat_map(|frame| &frame.position).map(|x| x[0] / r).fold(1.0, f64::max);
    let high = frames.iter().flat_map(|frame| &frame.position).map(|x| x[1] / r).fold(0.0, f64::max);
    let largest = |values: fn(&Frame) -> Vec<f64>| {
        frames.iter().flat_map(|frame| values(frame)).fold(0.0, f64::max).max(f64::MIN_POSITIVE)
    };
    let (fastest, deepest) = (largest(Frame::speeds), largest(Frame::pressures));
    let panels = frames.into_iter().flat_map(|frame| {
        let time = format!("{:.2} √(h0/g)", frame.time / run.time_scale());
        let drawn = [(frame.speeds(), "|v| [m/s]", (0.0, fastest)), (frame.pressures(), "p [kPa]", (0.0, deepest))];
        drawn.map(|drawn| {
            let x = Axis::linear("x/r0 [-]").between(0.0, far);
            field_panel(frame, &time, [x, Axis::linear("y/r0 [-]").between(0.0, high)], (r, run.spacing()), drawn)
        })
    });
    let caption = format!("{}: speed (left) and pressure (right) during the collapse and in the deposit.", label(run));
    Figure::new(&format!("pictures-{}", stem(run)), &caption, panels.collect()).in_columns(2)
}

/// Field drawn in a picture: values, label, limits.
pub(crate) type DrawnField = (Vec<f64>, &'static str, (f64, f64));

/// Particles of a picture in the colours of a field, of a round heap the slice beside a symmetry plane, in a unit of length `[m]`.
pub(crate) fn field_panel(
    frame: &Frame,
    time: &str,
    [x, y]: [Axis; 2],
    (unit, spacing): (f64, f64),
    (values, label, limits): DrawnField,
) -> Panel {
    let mut panel = Panel::new(&format!("t = {time}, {}", label.split(" [").next().unwrap_or_default()), x, y);
    let seen = || frame.position.iter().zip(&values).filter(|(x, _)| x[2] < spacing);
    let points = seen().map(|(x, _)| (x[0] / unit, x[1] / unit));
    panel.field = Some(Field::new(label, spacing / unit, limits, points, seen().map(|(_, value)| *value)));
    panel
}
