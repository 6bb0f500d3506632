//! Dumps of LAMMPS as text: many pictures in one file.

use crate::input::{FieldError, TextTable};
use std::io::{self, BufRead};
use std::path::PathBuf;

/// Start of every section.
const ITEM: &str = "ITEM: ";
/// First lines of a dump.
const STARTS: [&str; 3] = ["ITEM: TIMESTEP", "ITEM: TIME", "ITEM: UNITS"];

/// Whether a text is a dump.
pub(super) fn is_dump(bytes: &[u8]) -> bool {
    STARTS.iter().any(|start| bytes.starts_with(start.as_bytes()))
}

/// The pictures of a dump with their times `[s]`, one after the other: its own times where it tells them, else steps of a length `[s]`.
/// Atoms are in the order of their `id`, so that each is the same in all pictures; rows of pairs stay as they are.
///
/// # Errors
/// A section that is cut short, words where numbers should be, or no length of a step where it is needed.
pub(super) fn pictures(
    mut reader: impl BufRead,
    step: Option<f64>,
    file: PathBuf,
) -> impl Iterator<Item = Result<(f64, TextTable), FieldError>> {
    let (mut time, mut place, mut count, mut found, mut is_numbered) = (None, 0.0, 0, 0, true);
    let mut next = move || {
        let wrong = |field: &str, value: &str, rule: &str, remedy: &str| {
            FieldError::new(field, value, rule, remedy).in_file(&file)
        };
        let mut lines = |most: usize| {
            let read = read_lines(&mut reader, most);
            read.map_err(|error| FieldError::finding("file", error, "try again, or copy the file").in_file(&file))
        };
        let number = |(line, _): (String, usize), field: &str| {
            let word = line.trim();
            word.parse::<f64>().map_err(|_| wrong(field, &format!("\"{word}\""), "a number", "write the dump again"))
        };
        while let (line, 1) = lines(1)? {
            let Some(item) = line.strip_prefix(ITEM) else { continue };
            let heading: Vec<&str> = item.split_whitespace().skip(1).collect();
            match item.split_whitespace().next().unwrap_or_default() {
                "TIME" => time = Some(number(lines(1)?, "ITEM: TIME")?),
                "TIMESTEP" => place = number(lines(1)?, "ITEM: TIMESTEP")?,
                "NUMBER" => count = number(lines(1)?, "ITEM: NUMBER OF ATOMS")? as usize,
                kind @ ("ATOMS" | "ENTRIES") => {
                    let (rows, read) = lines(count)?;
                    if read < count {
                        let defect = format!("{read} atoms instead of {count} at step {place}");
                        return Err(wrong("ITEM: ATOMS", &defect, "", "write the dump again: the file is truncated"));
                    }
                    let mut table = TextTable::parse(&format!("{}\n{rows}", heading.join(" ")), &file)?;
                    sort_by_identity(&mut table);
                    let needed = || {
                        let remedy = "give `time_step` [s], or dump with `dump_modify … time yes`";
                        wrong("particles.time_step", "missing", "given with a dump that contains steps only", remedy)
                    };
                    let at = time.take().map_or_else(|| step.map(|step| step * place).ok_or_else(needed), Ok)?;
                    found += 1;
                    is_numbered &= kind == "ENTRIES" || heading.contains(&"id");
                    if found > 1 && !is_numbered {
                        return Err(wrong("ITEM: ATOMS", "no column `id`", "", "dump the column id too"));
                    }
                    return Ok(Some((at, table)));
                }
                _ => {}
            }
        }
        if found == 0 {
            return Err(wrong("ITEM: ATOMS", "missing", "", "dump atoms as text"));
        }
        Ok(None)
    };
    std::iter::from_fn(move || next().transpose())
}

/// At most N lines as one text, with their number.
fn read_lines(reader: &mut impl BufRead, most: usize) -> io::Result<(String, usize)> {
    let (mut bytes, mut read) = (Vec::new(), 0);
    while read < most && reader.read_until(b'\n', &mut bytes)? > 0 {
        read += 1;
    }
    Ok((String::from_utf8_lossy(&bytes).into_owned(), read))
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

    fn all(text: &str, step: Option<f64>) -> Result<Vec<(f64, TextTable)>, FieldError> {
        pictures(text.as_bytes(), step, "a.dump".into()).collect()
    }

    #[test]
    fn pictures_have_their_times_and_atoms_their_order() {
        let seen = all(DUMP, Some(1e-3)).expect("a dump");
        assert_eq!(seen.iter().map(|(time, _)| *time).collect::<Vec<_>>(), [0.0, 0.5]);
        assert_eq!((&seen[0].1.headings[1], &seen[0].1.columns[1]), (&"x".to_owned(), &vec![0.1, 0.3]));
        let timed = DUMP.replace("ITEM: TIMESTEP\n0\n", "ITEM: TIME\n0.25\nITEM: TIMESTEP\n0\n");
        assert!(is_dump(timed.as_bytes()) && !is_dump(b"x y\n1 2\n"));
        assert_eq!(all(&timed, Some(1.0)).expect("a dump")[0].0, 0.25);
    }

    #[test]
    fn a_dump_that_is_cut_short_or_tells_no_time_is_refused() {
        let message = |text: &str, step| all(text, step).expect_err("refused").to_string();
        assert!(message(DUMP, None).contains("`particles.time_step` is missing"), "{}", message(DUMP, None));
        let unnumbered = DUMP.replace("ATOMS id x y", "ATOMS n x y");
        assert!(message(&unnumbered, Some(1.0)).contains("no column `id`"), "{}", message(&unnumbered, Some(1.0)));
        assert!(message("ITEM: TIMESTEP\n0\n", Some(1.0)).contains("`ITEM: ATOMS`: missing"));
        let short = DUMP.rsplit_once("2 0.7").expect("a row").0;
        assert!(
            message(short, Some(1.0)).contains("1 atoms instead of 2 at step 500"),
            "{}",
            message(short, Some(1.0))
        );
    }
}
