//! Lines of code and of TOML by package, by the rule of `tests/counts.sh`: no package has more than `lines.toml` says.

use crate::structure::commit::git;
use crate::structure::source::workspace;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Lines by package, of Rust and of TOML; beside them what README's two commands cost.
#[derive(Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Lines {
    rust: BTreeMap<String, usize>,
    toml: BTreeMap<String, usize>,
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    seconds: toml::Table,
}

const TABLE: &str = "tests/structure/lines.toml";

const HEAD: &str = "# Lines by package at most, as `bash tests/counts.sh` counts them. A number rises only by hand, in a commit whose body says
# what the lines buy. To lower all to what is there: BAGNOLD_LOWER=1 cargo test -p bagnold-tests --test suite structure::lines
# Seconds: processor time of README's two commands from empty caches, builds included, by `bash tests/fresh.sh` on the named machine. A
# commit that changes one by more than a twentieth renews it and says why.
";

/// Files below a folder that are counted, and the folders of its packages, with `/`.
fn files(root: &Path) -> (Vec<String>, BTreeSet<String>) {
    let (mut files, mut packages, mut open) = (Vec::new(), BTreeSet::new(), vec![PathBuf::new()]);
    while let Some(folder) = open.pop() {
        let slashes = |path: &Path| path.to_string_lossy().replace('\\', "/");
        for entry in std::fs::read_dir(root.join(&folder)).expect("a folder").flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            // not through a link, whose files stand elsewhere
            let (path, is_folder) = (folder.join(&name), entry.file_type().is_ok_and(|kind| kind.is_dir()));
            // what is built, and what a user keeps in a checkout
            let is_foreign = name.starts_with('.') || name == "target" || path == Path::new("examples");
            if is_folder && !is_foreign && !["tests", "benches"].contains(&name.as_str()) {
                open.push(path.clone());
            }
            if name == "Cargo.toml" {
                packages.insert(slashes(&folder));
            }
            let is_list = folder.iter().any(|part| part == "runs" || part == "studies") && name.ends_with(".toml");
            if !is_folder && (is_list || name.ends_with(".rs") && !name.ends_with("_tests.rs")) {
                files.push(slashes(&path));
            }
        }
    }
    (files, packages)
}

/// (lines, modules behind `#[cfg(test)]`: their files, or folders with a `/` at the end) of a file of Rust.
fn lines_of_rust(path: &str, text: &str) -> (usize, Vec<String>) {
    enum Place {
        Code,
        Attributes,
        Body,
    }
    let (folder, name) = path.rsplit_once('/').map_or(("", path), |(folder, name)| (folder, name));
    let own = if ["mod.rs", "lib.rs", "main.rs"].contains(&name) { folder } else { path.trim_end_matches(".rs") };
    let below = |folder: &str, rest: &str| if folder.is_empty() { rest.to_owned() } else { format!("{folder}/{rest}") };
    let (mut count, mut modules, mut place, mut is_comment) = (0, Vec::new(), Place::Code, false);
    let (mut margin, mut renamed) = (0, None);
    for line in text.lines() {
        let code = line.trim_start_matches([' ', '\t']);
        let indent = line.len() - code.len();
        if is_comment || code.starts_with("/*") {
            is_comment = !code.contains("*/");
            continue;
        }
        if code.is_empty() || code.starts_with("//") {
            continue;
        }
        match place {
            Place::Code if code.starts_with("#[cfg(test)]") => {
                (place, margin, renamed) = (Place::Attributes, indent, None);
            }
            Place::Code => count += 1,
            Place::Attributes if code.starts_with("#[path") => renamed = code.split('"').nth(1),
            Place::Attributes if code.starts_with("#[") => {}
            Place::Attributes => {
                let item = code.split_once(';').map_or("", |(item, _)| item);
                match (item.rsplit_once("mod "), renamed) {
                    (Some(_), Some(path)) => modules.push(below(folder, path)),
                    (Some((_, name)), None) => {
                        modules.extend([".rs", "/"].map(|end| below(own, &format!("{name}{end}"))))
                    }
                    (None, _) => {}
                }
                place = if code.ends_with([';', ',', '}']) { Place::Code } else { Place::Body };
            }
            Place::Body if indent == margin && (code.ends_with(';') || code.starts_with(['}', ')', ']'])) => {
                place = Place::Code;
            }
            Place::Body => {}
        }
    }
    (count, modules)
}

/// Lines of all packages of a workspace.
fn count(root: &Path) -> Lines {
    let (files, packages) = files(root);
    let read =
        |path: &String| std::fs::read_to_string(root.join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut rust = BTreeMap::new();
    let mut tests = Vec::new();
    let mut lines = Lines::default();
    let package = |path: &str| {
        let folders = path.rmatch_indices('/').map(|(end, _)| &path[..end]);
        folders.into_iter().find(|folder| packages.contains(*folder)).unwrap_or(".").to_owned()
    };
    for path in &files {
        if path.ends_with(".toml") {
            let is_counted = |line: &&str| !line.trim_start().is_empty() && !line.trim_start().starts_with('#');
            *lines.toml.entry(package(path)).or_default() += read(path).lines().filter(is_counted).count();
        } else {
            let (count, modules) = lines_of_rust(path, &read(path));
            rust.insert(path, count);
            tests.extend(modules);
        }
    }
    let is_test = |path: &str| tests.iter().any(|test| path == test || test.ends_with('/') && path.starts_with(test));
    for (path, count) in rust.into_iter().filter(|(path, count)| *count > 0 && !is_test(path)) {
        *lines.rust.entry(package(path)).or_default() += count;
    }
    lines
}

/// One message for each package that has more lines than it may.
fn excesses(lines: &Lines, most: &Lines) -> Vec<String> {
    let of = |kind: &str, lines: &BTreeMap<String, usize>, most: &BTreeMap<String, usize>| {
        let over = lines.iter().map(|(package, count)| (package, count, most.get(package).copied().unwrap_or(0)));
        let over = over.filter(|(_, count, most)| *count > most);
        over.map(|(package, count, most)| format!("{package}: {count} lines of {kind}, {most} at most")).collect()
    };
    let found: [Vec<String>; 2] = [of("Rust", &lines.rust, &most.rust), of("TOML", &lines.toml, &most.toml)];
    found.concat()
}

#[test]
fn no_package_has_more_lines_than_its_table_says() {
    let path = workspace().join(TABLE);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{TABLE}: {error}"));
    let most: Lines = toml::from_str(&text).unwrap_or_else(|error| panic!("{TABLE}: {error}"));
    let lines = count(&workspace());
    let over = excesses(&lines, &most);
    assert!(
        over.is_empty(),
        "{}\n{TABLE}: a number rises only in a commit whose body says what the lines buy",
        over.join("\n")
    );
    if std::env::var_os("BAGNOLD_LOWER").is_some() {
        let lowered = Lines { seconds: most.seconds, ..lines };
        std::fs::write(&path, format!("{HEAD}\n{}", toml::to_string(&lowered).expect("TOML"))).expect("writable");
    }
}

#[test]
fn a_package_with_a_line_too_many_is_named_with_both_numbers() {
    let lines = |rust: &[(&str, usize)], toml: &[(&str, usize)]| {
        let table =
            |entries: &[(&str, usize)]| entries.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect();
        Lines { rust: table(rust), toml: table(toml), ..Lines::default() }
    };
    let most = lines(&[("a", 3), ("b", 5), ("gone", 7)], &[("a", 1)]);
    assert!(excesses(&lines(&[("a", 3), ("b", 2)], &[("a", 1)]), &most).is_empty());
    let found = excesses(&lines(&[("a", 4), ("b", 5), ("new", 1)], &[("a", 2)]), &most);
    assert_eq!(
        found,
        ["a: 4 lines of Rust, 3 at most", "new: 1 lines of Rust, 0 at most", "a: 2 lines of TOML, 1 at most"]
    );
}

/// A workspace in which every part of the rule is met.
const SAMPLE: [(&str, &str); 14] = [
    ("Cargo.toml", ""),
    ("validation/Cargo.toml", ""),
    ("validation/inner/Cargo.toml", ""),
    ("build.rs", "fn main() {}\n"),
    ("validation/src/cli/mod.rs", "//! Text.\n\n/* a\nb */\nstruct A;\n/* one */\nstruct B { // c\n    d: u8,\n}\n"),
    (
        "validation/src/lib.rs",
        "mod cli;\n#[cfg(test)]\nmod hidden;\n#[cfg(test)]\n#[path = \"odd/name.rs\"]\nmod other;\n\
         impl A {\n    #[cfg(test)]\n    fn f() {\n        g();\n    }\n    #[cfg(test)]\n    const B: u8 = 1;\n}\n\
         #[cfg(test)]\nuse a::{\n    b,\n};\n#[cfg(test)]\nmod tests {\n    /* in\n    tests */\n    fn h() {}\n}\nmod inner;",
    ),
    ("validation/src/hidden.rs", "struct C;\n"),
    ("validation/src/hidden/deep.rs", "struct D;\n"),
    ("validation/src/odd/name.rs", "struct E;\n"),
    ("validation/src/inner.rs", "#[cfg(test)]\nmod checks;\nstruct F;\n"),
    ("validation/src/inner/checks.rs", "struct G;\n"),
    ("validation/src/some_tests.rs", "struct H;\n"),
    ("validation/tests/all.rs", "struct I;\n"),
    ("validation/inner/runs/deep/a.toml", "# text\n\na = 1\nb = 2 # text\n  # text\n"),
];

#[test]
fn every_part_of_the_rule_is_met_and_the_script_counts_the_sample_alike() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    for (path, text) in SAMPLE {
        std::fs::create_dir_all(root.join(path).parent().expect("a folder")).expect("writable");
        std::fs::write(root.join(path), text).expect("writable");
    }
    let lines = count(root);
    let expected = "[rust]\n\".\" = 1\nvalidation = 9\n\n[toml]\n\"validation/inner\" = 2\n";
    assert_eq!(toml::to_string(&lines).expect("TOML"), expected);
    // the script needs GNU tools
    if !cfg!(target_os = "linux") || git(root, &["init", "--quiet"]).is_none() {
        return;
    }
    std::fs::create_dir(root.join("tests")).expect("writable");
    std::fs::copy(workspace().join("tests/counts.sh"), root.join("tests/counts.sh")).expect("the script");
    git(root, &["add", "."]);
    git(root, &["commit", "--quiet", "-m", "sample"]);
    let output = Command::new("bash").arg("tests/counts.sh").current_dir(root).output().expect("bash");
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut printed = Lines::default();
    for line in table.lines().filter(|line| line.starts_with("| ") && !line.starts_with("|     ")) {
        let mut cells = line.trim_matches('|').split('|').map(str::trim);
        let package = cells.next().expect("a package").to_owned();
        let numbers: Vec<usize> = cells.filter_map(|cell| cell.parse().ok()).collect();
        if let ([rust, toml], true) = (numbers.as_slice(), package != "all") {
            let insert = |table: &mut BTreeMap<String, usize>, count: usize| {
                (count > 0).then(|| table.insert(package.clone(), count))
            };
            insert(&mut printed.rust, *rust);
            insert(&mut printed.toml, *toml);
        }
    }
    assert_eq!(printed, lines, "{table}{}", String::from_utf8_lossy(&output.stderr));
}
