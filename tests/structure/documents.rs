//! Lists that follow from the registry: the folders of reference data, the contents of packages.

use crate::structure::source::workspace;
use bagnold_harness::evidence::shipped_tables;
use bagnold_validation::REGISTRY;

fn registered() -> Vec<&'static str> {
    REGISTRY.cases().map(|case| case.name()).collect()
}

fn text(path: &str) -> String {
    std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn every_case_has_a_folder_of_references_and_every_folder_a_case() {
    let entries = std::fs::read_dir(workspace().join("reference-data")).expect("reference-data");
    let entries = entries.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_dir());
    let mut folders: Vec<String> =
        entries.map(|path| path.file_name().unwrap_or_default().to_string_lossy().into_owned()).collect();
    folders.sort();
    // the papers are not a case, and few studies have tables
    let is_of_study = |folder: &&str| folders.iter().any(|own| own == folder);
    let studies = REGISTRY.studies().map(|study| study.name()).filter(is_of_study);
    let mut cases: Vec<&str> = registered().into_iter().chain(studies).chain(["papers"]).collect();
    cases.sort_unstable();
    assert_eq!(folders, cases);
    for case in cases {
        assert!(text(&format!("reference-data/{case}/README.md")).starts_with("# "), "{case}");
    }
}

#[test]
fn every_table_is_named_by_the_readme_beside_it() {
    for (name, _) in shipped_tables() {
        let (folder, file) = name.split_once('/').expect("a folder and a file");
        let readme = text(&format!("reference-data/{folder}/README.md"));
        assert!(readme.contains(&format!("`{file}`")), "reference-data/{folder}/README.md does not name {file}");
    }
}

#[test]
fn packages_hold_every_table_and_every_plan() {
    let listed = |package: &str| -> Vec<String> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let listed = std::process::Command::new(cargo)
            .args(["package", "--list", "--allow-dirty", "--offline", "-p", package])
            .current_dir(workspace())
            .output()
            .expect("cargo");
        assert!(listed.status.success(), "{}", String::from_utf8_lossy(&listed.stderr));
        String::from_utf8_lossy(&listed.stdout).lines().map(str::to_owned).collect()
    };
    let (harness, program) = (listed("bagnold-harness"), listed("bagnold-validation"));
    let is_packaged = |listed: &[String], name: &str| {
        assert!(listed.iter().any(|own| own == name), "{name} would not be packaged");
    };
    for (name, _) in shipped_tables() {
        is_packaged(&harness, &format!("reference-data/{name}"));
    }
    for case in registered() {
        is_packaged(&harness, &format!("snapshots/quick/{case}.snap"));
    }
    is_packaged(&harness, "snapshots/expected_failures.toml");
    for name in ["sweeps/bed-load-1d-map.toml", "README.md", "build/texts/embed.rs"] {
        is_packaged(&program, name);
    }
}
