//! Scenes of a user's own: those that are shipped run, and write what their gauges measured.

use crate::program::Place;
use std::path::{Path, PathBuf};

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/scenes");
    let entries = std::fs::read_dir(folder).expect("validation/scenes").flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.sort();
    files
}

#[test]
fn every_shipped_scene_runs_and_closes_its_balances() {
    let files = shipped();
    assert!(files.len() >= 6, "{files:?}");
    for file in files {
        let place = Place::new();
        let path = file.display().to_string();
        // a few steps; what is measured later cannot be compared with them
        let short = ["--set", "duration=0.1", "--set", "interval=0.02", "--set", "measured=[]", "--quiet"];
        place.run(&[&[path.as_str()][..], &short].concat()).code(0);
        let name = file.file_stem().expect("a name").to_string_lossy().into_owned();
        let folder = place.path("out");
        let tables = walk(&folder).into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "csv"));
        let texts: Vec<String> = tables.map(|path| std::fs::read_to_string(path).expect("text")).collect();
        let series = texts.iter().find(|text| text.starts_with("t [s],mass in the scene [kg/m],")).expect("a series");
        assert!(series.lines().count() >= 6, "{name}: {series}");
        let heading = series.lines().next().unwrap_or_default();
        assert!(heading.split(',').all(|column| column.ends_with(']')), "{name}: every column has a unit: {heading}");
    }
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("readable").flatten();
    entries.flat_map(|entry| if entry.path().is_dir() { walk(&entry.path()) } else { vec![entry.path()] }).collect()
}
