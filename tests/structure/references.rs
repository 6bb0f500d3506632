//! Every work that `reference-data` names with its authors and year stands in `references.bib`.

use crate::structure::source::workspace;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// First authors, as text without accents and commands of TeX in lower case, with the year of each entry.
fn entries(bibliography: &str) -> BTreeSet<(String, String)> {
    let field = |entry: &str, name: &str| {
        let (_, rest) = entry.split_once(&format!("{name} = {{"))?;
        Some(rest.split_once("}, ").map_or(rest, |(value, _)| value).trim_end_matches('}').to_owned())
    };
    let entries = bibliography.lines().filter(|line| line.starts_with('@'));
    entries
        .filter_map(|entry| {
            let author = field(entry, "author")?;
            let family = author.split(',').next().unwrap_or_default().to_owned();
            Some((plain(&family), field(entry, "year")?))
        })
        .collect()
}

/// Letters of a family name without accents, in lower case, of the last word of several.
fn plain(name: &str) -> String {
    let letter = |letter: char| match letter {
        'é' | 'è' => 'e',
        'ü' => 'u',
        'ö' | 'ë' => 'o',
        other => other,
    };
    let name: String = name.replace("{\\'e}", "e").replace("{\\\"u}", "u").replace("{\\\"o}", "o");
    let last = name.split_whitespace().last().unwrap_or_default();
    last.chars().map(letter).flat_map(char::to_lowercase).collect()
}

/// Works that a text names: the first family name and the year of "Lube et al. 2005" or "Wen & Yu 1966".
fn named(text: &str) -> BTreeSet<(String, String)> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let mut named = BTreeSet::new();
    for (place, word) in words.iter().enumerate() {
        let year: String = word.trim_start_matches('(').chars().take_while(char::is_ascii_digit).collect();
        let is_year = year.len() == 4 && (1850..2030).contains(&year.parse::<u32>().unwrap_or(0));
        let begins = |word: &str| word.chars().next().is_some_and(char::is_uppercase);
        if !is_year || place == 0 {
            continue;
        }
        // backwards over "et al.", "& Yu" and "Grace & Weber" to the first name
        let mut first = place - 1;
        if words[first] == "al." && first >= 2 {
            first -= 2;
        } else if first >= 2 && begins(words[first]) {
            if words[first - 1] == "van" && first >= 3 {
                first -= 1;
            }
            if words[first - 1] == "&" {
                first -= 2;
                while first > 0 && words[first - 1].ends_with(',') && begins(words[first - 1]) {
                    first -= 1;
                }
            }
        }
        let name = words[first].trim_start_matches('(').trim_end_matches(',');
        if begins(name) && name.chars().all(|letter| letter.is_alphabetic() || letter == '-') {
            named.insert((plain(name), year));
        }
    }
    named
}

fn texts(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("reference-data").flatten() {
        let path = entry.path();
        if path.is_dir() {
            texts(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "md" || ending == "csv") {
            found.push(path);
        }
    }
}

#[test]
fn every_work_that_reference_data_names_is_in_the_bibliography() {
    let bibliography = std::fs::read_to_string(workspace().join("references.bib")).expect("references.bib");
    let entries = entries(&bibliography);
    let mut files = Vec::new();
    texts(&workspace().join("reference-data"), &mut files);
    let mut all = BTreeSet::new();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("readable");
        for work in named(&text) {
            assert!(entries.contains(&work), "{} names {work:?}, which references.bib lacks", file.display());
            all.insert(work);
        }
    }
    assert!(all.len() > 25, "{all:?}");
}

#[test]
fn names_and_years_are_found_in_a_sentence() {
    let text = "fits of Clift, Grace & Weber 1978 (table 5.2), Fernandez Luque & van Beek 1976: and Lagrée et al. (2011), \
                Di Felice 1994; in 2020 nothing, Table 1 of Wen & Yu 1966.";
    let expected = [("clift", "1978"), ("luque", "1976"), ("lagree", "2011"), ("felice", "1994"), ("wen", "1966")];
    let expected: BTreeSet<(String, String)> =
        expected.into_iter().map(|(name, year)| (name.to_owned(), year.to_owned())).collect();
    assert_eq!(named(text), expected);
    let entry = "@article{difelice1994, author = {Di Felice, R.}, year = {1994}}\n@article{l, author = {Lagr{\\'e}e, P.-Y. and Staron, L.}, title = {x}, year = {2011}}";
    let expected = [("felice", "1994"), ("lagree", "2011")].map(|(name, year)| (name.to_owned(), year.to_owned()));
    assert_eq!(entries(entry), BTreeSet::from(expected));
}
