//! Reads what a submission names: files of particles, series and profiles → columns in SI units.

use super::lammps;
use super::submission::{ForeignRun, ParticleFiles, TableFile, rising};
use super::vtk::{self, NamedArrays, PLACES, PointArrays};
use crate::case::{
    ExternalColumn, ExternalData, ExternalSchema, NamedColumns, ParameterError, ParticleFrame, RunScales,
};
use crate::input::{self, FieldError, TextTable, did_you_mean, name_and_unit, nearest, of_repeats, renamed, unit};
use crate::measured::ColumnSource;
use crate::output::FileError;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

/// Largest file that is read `[bytes]`.
const LARGEST_FILE: u64 = 1 << 30;
/// Most pictures of a run.
const MOST_PICTURES: usize = 10_000;

/// Columns of a part with their meaning, ready to be taken from files.
pub(crate) type ColumnAssignments = Vec<(&'static ExternalColumn, ColumnSource, f64, String)>;

/// Reads all that is given of a run; paths are relative to `folder`.
///
/// # Errors
/// Files that cannot be read, columns that are unknown or missing, units of another kind, numbers that are not finite, times
/// that do not rise.
pub(super) fn read(
    run: &ForeignRun,
    (form, scales): (&ExternalSchema, Option<RunScales>),
    field: &str,
    folder: &Path,
) -> Result<ExternalData, ParameterError> {
    let plan = |texts: &_, items, field: &str| plan(texts, items, scales, field);
    let columns = |table: &TableFile, items, field: &str| -> Result<NamedColumns, ParameterError> {
        let file = folder.join(&table.file);
        let mut read = read_text_table(&file)?;
        let columns = if table.columns.is_empty() {
            by_headings(&read, items).map_err(|error| error.within(field))?
        } else {
            of_lists(&mut read, &table.columns).map_err(|error| error.within(field))?
        };
        Ok(of_table(&read, &plan(&columns, items, field)?, &file)?)
    };
    let mut given = ExternalData::default();
    if let Some(files) = &run.particles {
        let plan = plan(&files.columns, form.particles, &format!("{field}.particles"))?;
        given.pictures = frames(files, &plan, folder)?.collect::<Result<_, _>>()?;
    }
    if let Some(table) = &run.series {
        given.series = columns(table, form.series, &format!("{field}.series"))?;
        let names =
            ["time", "relative_time"].into_iter().filter(|name| form.series.iter().any(|item| item.name == *name));
        let Some(name) = names.clone().find(|name| !given.series(name).is_empty()) else {
            let name = format!("{field}.series.columns.time");
            let rule =
                format!("given{} with every series", if names.count() > 1 { ", or `relative_time`," } else { "" });
            return Err(FieldError::new(&name, "missing", &rule, "name the column of the times").into());
        };
        in_order(given.series(name), &format!("{field}.series.columns.{name}"), &folder.join(&table.file))?;
    }
    if let Some(table) = &run.profile {
        given.profile = columns(table, form.profile, &format!("{field}.profile"))?;
        if let Some(first) = form.profile.first() {
            let field = format!("{field}.profile.columns.{}", first.name);
            in_order(given.profile(first.name), &field, &folder.join(&table.file))?;
        }
    }
    Ok(given)
}

fn in_order(numbers: &[f64], field: &str, file: &Path) -> Result<(), FieldError> {
    rising(numbers).map_or(Ok(()), |number| {
        let rule = "larger than the number before";
        Err(FieldError::new(field, number, rule, "sort the rows, and remove duplicate ones").in_file(file))
    })
}

/// Assignment of a part's columns to quantities, each with its factor to SI and its field.
pub(crate) fn plan(
    texts: &BTreeMap<String, toml::Value>,
    items: &'static [ExternalColumn],
    scales: Option<RunScales>,
    field: &str,
) -> Result<ColumnAssignments, FieldError> {
    let group = format!("{field}.columns");
    if texts.is_empty() {
        return Err(FieldError::finding(&group, "empty", "assign columns to quantities: NAME = \"HEADING [UNIT]\""));
    }
    texts
        .iter()
        .map(|(name, value)| {
            let field = format!("{group}.{name}");
            let source = ColumnSource::parse(value, &field)?;
            let item = ExternalSchema::find(items, &group, name)?;
            let factor = source.factor(item, &field, scales)?;
            Ok((item, source, factor, field))
        })
        .collect()
}

/// The same columns where a list names those of repeats, which then have one heading in the table: it gives their mean.
fn of_lists(
    table: &mut TextTable,
    columns: &BTreeMap<String, toml::Value>,
) -> Result<BTreeMap<String, toml::Value>, FieldError> {
    let mut columns = columns.clone();
    for (name, value) in columns.iter_mut().filter(|(_, value)| value.is_array()) {
        let own = BTreeMap::from([(name.clone(), value.clone())]);
        let given: Vec<&str> = table.headings.iter().map(String::as_str).collect();
        let meant = renamed(&given, &own)?;
        let headings: BTreeSet<&String> = meant.iter().filter(|heading| !heading.is_empty()).collect();
        let (Some(heading), 1) = (headings.first(), headings.len()) else {
            return Err(FieldError::new(
                &format!("columns.{name}"),
                value,
                "headings of one unit",
                "convert the columns",
            ));
        };
        // no column of the file has this heading
        let heading = format!("\u{1}{heading}");
        *value = heading.as_str().into();
        table
            .headings
            .iter_mut()
            .zip(&meant)
            .filter(|(_, new)| !new.is_empty())
            .for_each(|(own, _)| own.clone_from(&heading));
    }
    Ok(columns)
}

/// Columns that a file's headings name, with the first as what the others are given over.
fn by_headings(table: &TextTable, items: &[ExternalColumn]) -> Result<BTreeMap<String, toml::Value>, FieldError> {
    let of_heading = |(place, heading): (usize, &String)| {
        let heading = of_repeats(heading);
        let (name, unit) = name_and_unit(&heading)?;
        let is_over = |item: &&ExternalColumn| place == 0 && unit::factor(unit, item.unit).is_some();
        let item = items.iter().find(|item| item.name == name).or_else(|| items.iter().find(is_over))?;
        Some((item.name.to_owned(), heading.clone().into()))
    };
    let columns: BTreeMap<_, _> = table.headings.iter().enumerate().filter_map(of_heading).collect();
    if columns.len() > 1 {
        return Ok(columns);
    }
    let names: Vec<String> = items.iter().map(|item| format!("{} [{}]", item.name, item.unit)).collect();
    let defect = format!("missing, and the headings {} are not known", table.headings.join(", "));
    let remedy = format!("rename two to {}, or give columns = {{ NAME = \"HEADING [UNIT]\" }}", names.join(", "));
    Err(FieldError::finding("columns", defect, &remedy))
}

/// Files that another one names, unless one of them is missing.
fn there(named: Vec<(f64, PathBuf)>, by: &Path) -> Result<Vec<(f64, PathBuf)>, FieldError> {
    named.iter().find(|(_, file)| !file.exists()).map_or(Ok(()), |(_, file)| {
        let beside = by.parent().and_then(|folder| file.strip_prefix(folder).ok()).unwrap_or(file);
        let remedy = "copy it there: paths are relative to the file that names them";
        Err(FieldError::finding("file", format!("{beside:?} does not exist"), remedy).in_file(by))
    })?;
    Ok(named)
}

/// Particles at successive times.
pub(crate) type Frames<'f> = Box<dyn Iterator<Item = Result<ParticleFrame, ParameterError>> + 'f>;

/// The frames of files of particles, each read when it is asked for; paths are relative to `folder`.
///
/// # Errors
/// Files that are not there or of another kind; what the frames themselves lack is their own error.
pub(crate) fn frames<'f>(
    files: &ParticleFiles,
    plan: &'f ColumnAssignments,
    folder: &Path,
) -> Result<Frames<'f>, ParameterError> {
    let named: Vec<(f64, PathBuf)> = if files.is_collection() {
        let file = folder.join(&files.files[0]);
        let unreadable = |error| FileError::unreadable(&file, &error);
        let mut reader = BufReader::new(input::open_file(&file).map_err(unreadable)?);
        let is_dump = lammps::is_dump(reader.fill_buf().map_err(unreadable)?);
        if ["dump", "lammpstrj"].contains(&ending(&file).as_str()) && !is_dump {
            let remedy = "write it with `dump custom` and a name that does not end in .bin or .gz";
            return Err(FieldError::finding("file", "not a text dump", remedy).in_file(&file).into());
        }
        if is_dump {
            let mut before = f64::NEG_INFINITY;
            let pictures = lammps::pictures(reader, files.time_step, file.clone());
            return Ok(Box::new(pictures.map(move |picture| {
                let (time, table) = picture?;
                in_order(&[before, time][usize::from(before == f64::NEG_INFINITY)..], "ITEM: TIMESTEP", &file)?;
                before = time;
                Ok(ParticleFrame { time, columns: of_table(&table, plan, &file)? })
            })));
        }
        there(vtk::collection(&String::from_utf8_lossy(&read_bytes(&file)?), &file)?, &file)?
    } else {
        files.times.iter().copied().zip(files.files.iter().map(|file| folder.join(file))).collect()
    };
    if named.len() > MOST_PICTURES {
        let defect = format!("{} times, above the limit of {MOST_PICTURES}", named.len());
        return Err(FieldError::finding("particles.files", defect, "give fewer times").into());
    }
    let mut pieces = in_pieces(named)?.into_iter().peekable();
    Ok(Box::new(std::iter::from_fn(move || {
        let (time, file) = pieces.next()?;
        let rest = std::iter::from_fn(|| pieces.next_if(|(other, _)| *other == time));
        Some(std::iter::once((time, file)).chain(rest).try_fold(
            ParticleFrame { time, ..ParticleFrame::default() },
            |mut frame, (_, file)| {
                let more = columns(&file, plan)?.into_iter();
                more.for_each(|(name, more)| frame.columns.entry(name).or_default().extend(more));
                Ok(frame)
            },
        ))
    })))
}

/// Columns of a file of VTK or of a table.
fn columns(file: &Path, plan: &ColumnAssignments) -> Result<NamedColumns, ParameterError> {
    Ok(if vtk::ENDINGS.contains(&ending(file).as_str()) {
        of_points(&PointArrays::parse(&read_bytes(file)?, file)?, plan, file)?
    } else {
        of_table(&read_text_table(file)?, plan, file)?
    })
}

fn ending(file: &Path) -> String {
    file.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase()
}

/// Files with those that only name pieces replaced by the pieces.
fn in_pieces(named: Vec<(f64, PathBuf)>) -> Result<Vec<(f64, PathBuf)>, ParameterError> {
    let mut files = Vec::new();
    for (time, file) in named {
        if vtk::PARALLEL.contains(&ending(&file).as_str()) {
            let text = String::from_utf8_lossy(&read_bytes(&file)?).into_owned();
            let pieces = vtk::pieces(&text, &file)?.into_iter().map(|piece| (time, piece)).collect();
            files.extend(there(pieces, &file)?);
        } else {
            files.push((time, file));
        }
    }
    Ok(files)
}

fn read_bytes(file: &Path) -> Result<Vec<u8>, ParameterError> {
    Ok(input::read_bytes(file, LARGEST_FILE).map_err(|error| FileError::unreadable(file, &error))?)
}

fn read_text_table(file: &Path) -> Result<TextTable, ParameterError> {
    let bytes = read_bytes(file)?;
    Ok(TextTable::parse(&String::from_utf8_lossy(&bytes), file)?)
}

fn of_table(table: &TextTable, plan: &ColumnAssignments, file: &Path) -> Result<NamedColumns, FieldError> {
    let rows = table.columns.first().map_or(0, Vec::len);
    let column = |source: &ColumnSource, field: &str| match source {
        ColumnSource::Heading { text, name, .. } => {
            // the heading may hold its unit itself
            let heading =
                if table.headings.iter().any(|own| own == text || of_repeats(own) == *text) { text } else { name };
            table.column(heading, field, file)
        }
        ColumnSource::Constant { value, .. } => Ok(vec![*value; rows]),
    };
    in_si(plan, file, column)
}

fn of_points(points: &PointArrays, plan: &ColumnAssignments, file: &Path) -> Result<NamedColumns, FieldError> {
    let is_found = |arrays: &NamedArrays, source: &ColumnSource| match source {
        ColumnSource::Heading { text, name, .. } => array(arrays, text, name).is_some(),
        ColumnSource::Constant { .. } => true,
    };
    let has_all = |arrays: &NamedArrays| plan.iter().all(|(_, source, ..)| is_found(arrays, source));
    let at_cells = !has_all(&points.arrays) && has_all(&points.cells);
    let arrays = if at_cells { &points.cells } else { &points.arrays };
    let count = arrays.get(&format!("{PLACES}:0")).map_or(0, Vec::len);
    let column = |source: &ColumnSource, field: &str| match source {
        ColumnSource::Heading { text, name, .. } => array(arrays, text, name).cloned().ok_or_else(|| {
            let guess = did_you_mean(&nearest(name, arrays.keys().map(String::as_str)));
            let names = |arrays: &NamedArrays| arrays.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
            let of_cells = || format!("; at its cells {}", names(&points.cells));
            let at_cells = if points.cells.is_empty() { String::new() } else { of_cells() };
            let rule = format!("an array of {}: {}{at_cells}", file.display(), names(arrays));
            let remedy = format!("{guess}name coordinates Points:0, Points:1, Points:2, parts of a vector NAME:0, …");
            FieldError::new(field, format!("\"{text}\""), &rule, &remedy)
        }),
        ColumnSource::Constant { value, .. } => Ok(vec![*value; count]),
    };
    in_si(plan, file, column)
}

/// The array that a heading names, whose name may hold its unit.
fn array<'arrays>(arrays: &'arrays NamedArrays, text: &str, name: &str) -> Option<&'arrays Vec<f64>> {
    // `velocity [m/s]:0` is the first component of an array whose name holds its unit
    let component = name.rsplit_once(':').filter(|(_, number)| number.parse::<u8>().is_ok());
    let unit = text.trim().rsplit_once('[').map_or("", |(_, unit)| unit);
    let with_unit = component.map(|(name, number)| format!("{name} [{unit}:{number}"));
    arrays.get(text).or_else(|| arrays.get(name)).or_else(|| arrays.get(&with_unit?))
}

/// All columns of a plan in SI units; every number must be finite.
fn in_si(
    plan: &ColumnAssignments,
    file: &Path,
    column: impl Fn(&ColumnSource, &str) -> Result<Vec<f64>, FieldError>,
) -> Result<NamedColumns, FieldError> {
    plan.iter()
        .map(|(item, source, factor, field)| {
            let mut values = column(source, field)?;
            if let Some(row) = values.iter().position(|value| !value.is_finite()) {
                let name = format!("{field}, row {}", row + 1);
                let remedy = "correct the output, or leave the column out";
                return Err(FieldError::new(&name, values[row], "a finite number", remedy).in_file(file));
            }
            for value in &mut values {
                *value *= factor;
            }
            Ok((item.name.to_owned(), values))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_repeats_count_by_their_mean_if_they_have_one_unit() {
        let read = |list: &str| -> Result<Vec<f64>, FieldError> {
            let mut table =
                TextTable::parse("t [s],run 1 (cm),run 2 (cm)\n0,1,3\n1,2,6\n", Path::new("a.csv")).expect("a table");
            let columns = toml::from_str(&format!("front = {list}")).expect("TOML");
            let columns = of_lists(&mut table, &columns)?;
            table.column(columns["front"].as_str().expect("a heading"), "columns.front", Path::new("a.csv"))
        };
        assert_eq!(read("[\"run 1 (cm) [cm]\", \"run 2 (cm) [cm]\"]"), Ok(vec![2.0, 4.0]));
        let units = read("[\"run 1 (cm) [cm]\", \"run 2 (cm) [mm]\"]").expect_err("cm and mm").to_string();
        assert!(units.contains("but must be the unit that the heading states"), "{units}");
        let unknown = read("[\"run 3 [cm]\"]").expect_err("no such column").to_string();
        assert!(unknown.contains("a heading of each file with its unit: t [s], run 1 (cm), run 2 (cm)"), "{unknown}");
    }

    /// OpenFOAM's `foamToVTK` names a grid by blocks; the boundary is no part of the flow.
    #[test]
    fn blocks_with_data_at_cells_are_read_at_the_centres_of_cells() {
        let folder = tempfile::tempdir().expect("a folder");
        let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
        put(
            "case.vtm",
            "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet name=\"internal\" file=\"internal.vtu\"/>\
             <Block name=\"boundary\"><DataSet file=\"wall.vtp\"/></Block></vtkMultiBlockDataSet></VTKFile>",
        );
        put(
            "internal.vtu",
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><PointData>\
             <DataArray type=\"Float64\" Name=\"pressure\" format=\"ascii\">1 2 3</DataArray></PointData><CellData>\
             <DataArray type=\"Float64\" Name=\"area [cm^2]\" format=\"ascii\">1</DataArray></CellData><Points><DataArray \
             type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 3 0 0 0 6 0</DataArray></Points><Cells>\
             <DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int32\" \
             Name=\"offsets\" format=\"ascii\">3</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
        );
        const COLUMNS: &[ExternalColumn] =
            &[ExternalColumn::new("y", "m", "height"), ExternalColumn::new("area", "m^2", "area")];
        let read = |area: &str| {
            let text = format!(
                "files = [\"case.vtm\"]\ntimes = [0.0]\ncolumns = {{ y = \"Points:1 [m]\", area = \"{area}\" }}\n"
            );
            let files: ParticleFiles = toml::from_str(&text).expect("files");
            let plan = plan(&files.columns, COLUMNS, None, "particles").expect("columns");
            frames(&files, &plan, folder.path()).and_then(Iterator::collect::<Result<Vec<_>, _>>)
        };
        let seen = read("area [cm^2]").expect("a picture");
        assert_eq!((&seen[0].columns["y"][..], &seen[0].columns["area"][..]), (&[2.0][..], &[1e-4][..]));
        let message = read("volume [m^2]").expect_err("no such array").to_string();
        assert!(message.contains("pressure; at its cells Points:0"), "{message}");
    }
}
