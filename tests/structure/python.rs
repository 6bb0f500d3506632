//! The Python package is a workspace of its own, but its numbers are those of the program: it locks the same versions.

use crate::structure::source::workspace;
use std::collections::{BTreeMap, BTreeSet};

/// Versions of every package in a lock file.
fn locked(path: &str) -> BTreeMap<String, BTreeSet<String>> {
    let text = std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    let lock: toml::Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut versions: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for package in lock["package"].as_array().expect("packages") {
        let text = |key: &str| package[key].as_str().expect("text").to_owned();
        versions.entry(text("name")).or_default().insert(text("version"));
    }
    versions
}

#[test]
fn the_python_package_locks_what_the_program_locks() {
    let (program, python) = (locked("Cargo.lock"), locked("python/Cargo.lock"));
    for needed in ["bagnold-solver", "bagnold-validation", "libm", "nalgebra", "rayon"] {
        assert!(python.contains_key(needed), "python/Cargo.lock lacks {needed}");
    }
    for (name, versions) in python {
        if let Some(own) = program.get(&name) {
            // both build scripts and the bindings may need a further version beside, but never another one instead
            assert!(
                versions.is_superset(own) || versions.is_subset(own),
                "{name}: {versions:?}, but the program has {own:?}"
            );
        }
    }
}

#[test]
fn the_python_package_has_the_programs_version_and_types() {
    let text =
        |path: &str| std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    let manifest: toml::Table = toml::from_str(&text("python/Cargo.toml")).expect("TOML");
    assert_eq!(manifest["package"]["version"].as_str(), Some(bagnold_harness::store::version()));
    assert!(workspace().join("python/bagnold/py.typed").is_file());
    // what the package exports is documented
    let init = text("python/bagnold/__init__.py");
    let readme = text("python/README.md");
    for name in ["cases", "show", "run", "judge", "calibrate", "Refused", "DivergenceWarning"] {
        assert!(init.contains(&format!("\"{name}\"")), "{name} is not exported");
        assert!(readme.contains(&format!("bagnold.{name}")), "{name} is not in python/README.md");
    }
}

#[test]
fn profiles_name_packages_that_exist() {
    // a renamed package would be compiled without optimisation, and run slowly without a word
    for (path, lock) in [
        ("Cargo.toml", "Cargo.lock"),
        ("python/Cargo.toml", "python/Cargo.lock"),
        ("validation/src/cli/new/template/profile.template", "Cargo.lock"),
    ] {
        let text = std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        let manifest: toml::Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
        let known = locked(lock);
        for (profile, settings) in manifest["profile"].as_table().expect("profiles") {
            let packages = settings.get("package").and_then(toml::Value::as_table);
            for package in packages.into_iter().flat_map(toml::Table::keys).filter(|name| *name != "*") {
                assert!(known.contains_key(package), "{path}: profile.{profile} names {package}");
            }
        }
    }
}
