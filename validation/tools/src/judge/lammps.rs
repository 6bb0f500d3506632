//! Dumps of LAMMPS as text: many pictures in one file.

use crate::input::{FieldError, TextTable};
use std::path::Path;

/// Start of every section.
const ITEM: &str = "ITEM: ";
/// First lines of a dump.
const STARTS: [&str; 3] = ["ITEM: TIMESTEP", "ITEM: TIME", "ITEM: UNITS"];

/// Whether a text is a dump.
pub(super) fn is_dump(bytes: &[u8]) -> bool {
    STARTS.iter().any(|start| bytes.starts_with(start.as_bytes()))
}

/// The pictures of a dump with their times `[s]`: its own where it tells them, else steps of a length `[s]`. Atoms are in the order of
/// their `id`, so that each is the same in all pictures.
///
/// # Errors
/// A section that is cut short, words where numbers should be, or no length of a step where it is needed.
pub(super) fn pictures(text: &str, step: Option<f64>, file: &Path) -> Result<Vec<(f64, TextTable)>, FieldError> {
    let wrong =
        |field: &str, value: &str, rule: &str, remedy: &str| FieldError::new(field, value, rule, remedy).in_file(file);
    let number = |line: Option<&str>, field: &str| {
        let word = line.unwrap_or_default().trim();
        word.parse::<f64>().map_err(|_| wrong(field, &format!("\"{word}\""), "a number", "write the dump again"))
    };
    let mut found = Vec::new();
    let (mut time, mut place, mut count) = (None, 0.0, 0);
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(item) = line.strip_prefix(ITEM) else { continue };
        match item.split_whitespace().next().unwrap_or_default() {
            "TIME" => time = Some(number(lines.next(), "ITEM: TIME")?),
            "TIMESTEP" => place = number(lines.next(), "ITEM: TIMESTEP")?,
            "NUMBER" => count = number(lines.next(), "ITEM: NUMBER OF ATOMS")? as usize,
            "ATOMS" => {
                let heading: Vec<&str> = item.split_whitespace().skip(1).collect();
                let rows: Vec<&str> = lines.by_ref().take(count).collect();
                if rows.len() < count {
                    let (value, rule) = (format!("{} atoms at step {place}", rows.len()), format!("{count} atoms"));
                    return Err(wrong("ITEM: ATOMS", &value, &rule, "the file was cut short: write it again"));
                }
                let mut table = TextTable::parse(&format!("{}\n{}\n", heading.join(" "), rows.join("\n")), file)?;
                sort_by_identity(&mut table);
                let needed = || {
                    let remedy = "give `time_step` [s], or dump with `dump_modify … time yes`";
                    wrong("particles.time_step", "missing", "given with a dump that tells steps only", remedy)
                };
                let at = time.take().map_or_else(|| step.map(|step| step * place).ok_or_else(needed), Ok)?;
                found.push((at, table));
            }
            _ => {}
        }
    }
    if found.is_empty() {
        return Err(wrong("ITEM: ATOMS", "missing", "given once at least", "dump atoms as text"));
    }
    let is_sorted = |(_, table): &(f64, TextTable)| table.headings.iter().any(|heading| heading == "id");
    if found.len() > 1 && !found.iter().all(is_sorted) {
        return Err(wrong("ITEM: ATOMS", "without `id`", "with the number of each atom", "dump the column id too"));
    }
    Ok(found)
}

fn sort_by_identity(table: &mut TextTable) {
    let Some(place) = table.headings.iter().position(|heading| heading == "id") else { return };
    let identities = table.columns[place].clone();
    let mut order: Vec<usize> = (0..identities.len()).collect();
    order.sort_by(|&a, &b| identities[a].total_cmp(&identities[b]));
    for column in &mut table.columns {
        *column = order.iter().map(|&row| column[row]).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DUMP: &str = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 1\n0 1\n\
        ITEM: ATOMS id x y\n2 0.3 0.4\n1 0.1 0.2\nITEM: TIMESTEP\n500\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n\
        0 1\n0 1\n0 1\nITEM: ATOMS id x y\n1 0.5 0.6\n2 0.7 0.8\n";

    #[test]
    fn pictures_have_their_times_and_atoms_their_order() {
        let seen = pictures(DUMP, Some(1e-3), Path::new("a.dump")).expect("a dump");
        assert_eq!(seen.iter().map(|(time, _)| *time).collect::<Vec<_>>(), [0.0, 0.5]);
        assert_eq!((&seen[0].1.headings[1], &seen[0].1.columns[1]), (&"x".to_owned(), &vec![0.1, 0.3]));
        let timed = DUMP.replace("ITEM: TIMESTEP\n0\n", "ITEM: TIME\n0.25\nITEM: TIMESTEP\n0\n");
        assert!(is_dump(timed.as_bytes()) && !is_dump(b"x y\n1 2\n"));
        assert_eq!(pictures(&timed, Some(1.0), Path::new("a.dump")).expect("a dump")[0].0, 0.25);
    }

    #[test]
    fn a_dump_that_is_cut_short_or_tells_no_time_is_refused() {
        let message = |text: &str, step| pictures(text, step, Path::new("a.dump")).expect_err("refused").to_string();
        assert!(message(DUMP, None).contains("`particles.time_step` is missing"), "{}", message(DUMP, None));
        let unnumbered = DUMP.replace("ATOMS id x y", "ATOMS n x y");
        assert!(message(&unnumbered, Some(1.0)).contains("without `id`"), "{}", message(&unnumbered, Some(1.0)));
        assert!(message("ITEM: TIMESTEP\n0\n", Some(1.0)).contains("`ITEM: ATOMS` is missing"));
        let short = DUMP.rsplit_once("2 0.7").expect("a row").0;
        assert!(
            message(short, Some(1.0)).contains("1 atoms at step 500, but must be 2 atoms"),
            "{}",
            message(short, Some(1.0))
        );
    }
}
