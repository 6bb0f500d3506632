//! Files that lead back to themselves: what one takes of another, through whatever its folder passes on.

use crate::structure::imports::{Import, imports, passed_on};
use crate::structure::source::{Source, sources};
use std::collections::{BTreeMap, BTreeSet};

/// Modules by their paths, each with the items that it passes on of its children: name → where it stands.
struct Modules {
    passed_on: BTreeMap<Vec<String>, BTreeMap<String, Vec<String>>>,
}

impl Modules {
    fn of(all: &[Source]) -> Self {
        let known: BTreeSet<Vec<String>> = all.iter().map(|source| source.module.clone()).collect();
        let items = |source: &Source| {
            let of_children = passed_on(source).into_iter().filter_map(|Import { path, .. }| {
                let child = path.get(..=source.module.len())?.to_vec();
                known.contains(&child).then(|| (path.last().cloned().unwrap_or_default(), path))
            });
            of_children.collect()
        };
        Self { passed_on: all.iter().map(|source| (source.module.clone(), items(source))).collect() }
    }

    /// The file in which what a path names stands; none for what is of another crate.
    fn file(&self, path: &[String]) -> Option<Vec<String>> {
        let mut path = path.to_vec();
        // an item may be passed on by folder after folder
        for _ in 0..8 {
            let length = (1..=path.len()).rev().find(|length| self.passed_on.contains_key(&path[..*length]))?;
            let module = path[..length].to_vec();
            let item = path.get(length);
            match item.and_then(|item| self.passed_on[&module].get(item)) {
                Some(there) => path.clone_from(there),
                None => return Some(module),
            }
        }
        None
    }
}

/// Files of which each leads to each other, by the paths of their modules, and the lines by which they do.
#[derive(Debug, PartialEq)]
struct Circle {
    files: BTreeSet<String>,
    lines: Vec<String>,
}

/// Imports of a file itself: all that it names of `crate` and `super`, and of its own children what its code names, not what it
/// only passes on.
fn taken(source: &Source, modules: &Modules) -> Vec<Import> {
    let mut found = imports(source);
    let rest = without_uses(&source.code);
    let is_child = |import: &Import| {
        import.path.get(..=source.module.len()).is_some_and(|child| modules.passed_on.contains_key(child))
    };
    let is_named = |import: &Import| import.path.last().is_some_and(|item| words(&rest).any(|(_, word)| word == item));
    found.extend(passed_on(source).into_iter().filter(|import| is_child(import) && is_named(import)));
    for (start, word) in words(&rest) {
        let Some((_, item)) = rest[start + word.len()..].strip_prefix("::").and_then(|rest| words(rest).next()) else {
            continue;
        };
        let path = source.module.iter().cloned().chain([word.to_owned(), item.to_owned()]).collect();
        let import = Import { path, line: source.line(start) };
        if !rest[..start].ends_with(':') && is_child(&import) {
            found.push(import);
        }
    }
    found
}

/// Code with its `use` items blanked.
fn without_uses(code: &str) -> String {
    let mut rest = code.to_owned();
    for (start, _) in words(code).filter(|(_, word)| *word == "use") {
        let end = code[start..].find(';').map_or(code.len(), |length| start + length);
        let blank: String =
            code[start..end].chars().map(|c| if c == '\n' { "\n".into() } else { " ".repeat(c.len_utf8()) }).collect();
        rest.replace_range(start..end, &blank);
    }
    rest
}

/// The words of a text, each with its position.
fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter_map(|word| {
        let place = word.as_ptr() as usize - text.as_ptr() as usize;
        (!word.is_empty()).then_some((place, word))
    })
}

/// All circles. A folder's own file (`mod.rs`) is a member by what it defines, not by what it passes on, and what a file takes of the
/// folders that it is in does not count.
fn circles(all: &[Source]) -> Vec<Circle> {
    let modules = Modules::of(all);
    let name = |module: &[String]| module.join("::");
    let files: BTreeMap<String, &Source> = all.iter().map(|source| (name(&source.module), source)).collect();
    // the first line by which a file takes something of another
    let uses: BTreeMap<&String, BTreeMap<String, String>> = files
        .iter()
        .map(|(own, source)| {
            let mut others = BTreeMap::new();
            for import in taken(source, &modules) {
                let Some(module) = modules.file(&import.path) else { continue };
                let other = name(&module);
                if !source.module.starts_with(&module) && files.contains_key(&other) {
                    let item = import.path.last().map_or("", String::as_str);
                    others.entry(other).or_insert_with(|| format!("{}:{} takes {item}", source.path, import.line));
                }
            }
            (own, others)
        })
        .collect();
    let reached = |from: &String| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from.clone()];
        while let Some(file) = open.pop() {
            for next in uses.get(&file).into_iter().flat_map(BTreeMap::keys) {
                if seen.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        seen
    };
    let reach: BTreeMap<&String, BTreeSet<String>> = files.keys().map(|file| (file, reached(file))).collect();
    let mut found: Vec<Circle> = Vec::new();
    for (file, there) in &reach {
        let leads_back = |other: &&String| reach.get(other).is_some_and(|back| back.contains(*file));
        let files: BTreeSet<String> = there.iter().filter(leads_back).cloned().collect();
        if files.len() > 1 && !found.iter().any(|circle| circle.files == files) {
            let inside = files.iter().flat_map(|file| uses.get(file).into_iter().flatten());
            let lines = inside
                .filter(|(other, _)| files.contains(*other))
                .map(|(other, line)| format!("  {line} of {other}"))
                .collect();
            found.push(Circle { files, lines });
        }
    }
    found
}

#[test]
fn no_file_leads_back_to_itself() {
    let mut found = Vec::new();
    let packages = ["inference", "figure", "harness", "report", "reference", "cases", "scenes", "tools", "dev"];
    let packages = packages.map(|package| format!("validation/{package}/src"));
    for crate_src in ["solver/src", "validation/src"].into_iter().chain(packages.iter().map(String::as_str)) {
        found.extend(circles(&sources(crate_src)).into_iter().map(|Circle { files, lines }| {
            let files: Vec<String> = files.into_iter().collect();
            format!("{crate_src}: {}\n{}", files.join(" ↔ "), lines.join("\n"))
        }));
    }
    assert!(found.is_empty(), "{} circles of files:\n{}", found.len(), found.join("\n"));
}

fn source(path: &str, module: &[&str], code: &str) -> Source {
    Source {
        path: format!("src/{path}"),
        module: module.iter().map(|&part| part.to_owned()).collect(),
        code: code.to_owned(),
    }
}

#[test]
fn a_circle_through_what_a_folder_passes_on_is_found() {
    let of = |b: &str| {
        circles(&[
            source("lib.rs", &[], ""),
            source("m/mod.rs", &["m"], "mod a;\nmod b;\npub use a::{A, C};\npub use b::B;\nstruct Own;\n"),
            source("m/a.rs", &["m", "a"], "use super::B;\nuse super::Own;\n"),
            source("m/b.rs", &["m", "b"], b),
        ])
    };
    assert!(of("use super::Own;\n").is_empty());
    let found = of("use crate::m::C;\n");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].files, BTreeSet::from(["m::a".to_owned(), "m::b".to_owned()]));
    assert_eq!(found[0].lines, ["  src/m/a.rs:1 takes B of m::b", "  src/m/b.rs:1 takes C of m::a"]);
}

#[test]
fn a_circle_through_what_a_folder_defines_itself_is_found() {
    let of = |folder: &str| {
        circles(&[
            source("m/mod.rs", &["m"], folder),
            source("m/a.rs", &["m", "a"], "use super::Own;\nuse crate::n::N;\nstruct A;\n"),
            source("n.rs", &["n"], "use crate::m::Own;\n"),
        ])
    };
    assert!(of("mod a;\npub use a::A;\nstruct Own;\n").is_empty());
    for folder in ["mod a;\nuse a::{A, B};\nstruct Own(A);\n", "mod a;\n\nstruct Own(a::A);\n"] {
        let found = of(folder);
        assert_eq!(found.len(), 1, "{folder}");
        assert_eq!(found[0].files, ["m", "m::a", "n"].map(str::to_owned).into());
        assert!(found[0].lines[0].ends_with(" takes A of m::a"), "{}", found[0].lines[0]);
    }
}
