//! Files that the program wrote itself, damaged: results, sweeps, baselines, records of runs and kept states.

use crate::inputs::damage::read_damaged;
use crate::inputs::files::in_repository;
use bagnold_harness::case::{CaseFile, Changes, Limits, Silent, Tier, execute};
use bagnold_harness::checkpoint::StoredState;
use bagnold_harness::evaluation::{EvaluationRecord, MetricValue};
use bagnold_harness::metric::{Variant, Verdict};
use bagnold_harness::output::OutputFolder;
use bagnold_harness::store::{AllSpeeds, CodeOrigin, Store, StorePolicy};
use bagnold_report::{Baseline, ExpectedFailures, GateList, RemovedGates};
use bagnold_tools::calibration::CalibrationFolder;
use bagnold_tools::league::studies;
use bagnold_tools::sweep::slurm::{self, SlurmRequest};
use bagnold_tools::sweep::{SweepFolder, SweepPlan, gather};
use bagnold_validation::REGISTRY;
use bagnold_validation::cli::{self, Arguments};
use clap::Parser;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// Runs a command in this process.
fn bagnold(arguments: &[&str]) -> Result<(), String> {
    let arguments = ["bagnold", "--quiet"].iter().chain(arguments);
    let arguments = Arguments::try_parse_from(arguments).map_err(|error| error.to_string())?;
    cli::execute(&arguments, *REGISTRY, &mut Vec::new()).map(|_| ()).map_err(|error| error.to_string())
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// Writes some files, then damages each alone.
fn damage(files: &[PathBuf], contents: &[Vec<u8>], mut read: impl FnMut(usize)) {
    for (file, bytes) in files.iter().zip(contents) {
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("writable");
        std::fs::write(file, bytes).expect("writable");
    }
    read_damaged(contents, |which, wrong| {
        std::fs::write(&files[which], wrong).expect("writable");
        read(which);
        std::fs::write(&files[which], &contents[which]).expect("writable");
    });
}

#[test]
fn a_folder_of_results_is_compared_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let [own, out, store] = ["own", "out", "store"].map(|name| folder.path().join(name));
    let settings = ["resolution=6", "relaxation_times=0.1"].into_iter().flat_map(|setting| ["--set", setting]);
    let run: Vec<&str> =
        ["run", "film", "--out", text(&own), "--store", text(&store)].into_iter().chain(settings).collect();
    bagnold(&run).expect("a run");
    let mut names = vec![PathBuf::from("metrics.json"), PathBuf::from("case.toml")];
    let tables = std::fs::read_dir(own.join("tables")).expect("tables").flatten();
    names.extend(tables.map(|entry| Path::new("tables").join(entry.file_name())).take(2));
    let contents: Vec<Vec<u8>> = names.iter().map(|name| std::fs::read(own.join(name)).expect("written")).collect();
    let [alone, report] = ["alone", "report"].map(|name| folder.path().join(name));
    let files: Vec<PathBuf> = names.iter().map(|name| alone.join(name)).collect();
    let cases = report.join("cases/film");
    std::fs::create_dir_all(&cases).expect("writable");
    damage(&files, &contents, |_| {
        for name in &names[..2] {
            std::fs::copy(alone.join(name), cases.join(name)).expect("writable");
        }
        for other in [&alone, &report] {
            let _ = bagnold(&["compare", text(&own), text(other), "--out", text(&out)]);
        }
        let _ = Baseline::of_report(&report, &["film".to_owned()], Tier::Quick);
    });
}

#[test]
fn a_sweep_is_continued_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let (plan, sweep) = (folder.path().join("plan.toml"), folder.path().join("sweep"));
    let grid = "design = \"grid\"\n[[cases]]\ncase = \"film\"\nwith = { resolution = 10 }\n[[vary]]\n\
                path = \"slope_angle\"\nlower = 1.0\nupper = 20.0\nlevels = 2\n";
    std::fs::write(&plan, grid).expect("writable");
    let manifest = SweepPlan::read(&plan).and_then(|plan| plan.manifest(*REGISTRY, Limits::default()));
    let begun = SweepFolder::begin(&sweep, &manifest.expect("a plan")).expect("a sweep");
    let mut files = vec![sweep.join("manifest.json")];
    for (entry, value) in begun.manifest().entries.iter().zip([1.0, 2.0]) {
        let mut record = EvaluationRecord { failure: None, ..EvaluationRecord::failed(&entry.key, "film", "") };
        record.metrics.push(MetricValue {
            name: "velocity_l2".to_owned(),
            variant: Variant::default(),
            value,
            unit: "%".to_owned(),
            verdict: Verdict::Pass,
            remark: None,
        });
        files.push(begun.of(entry).join("record.postcard"));
        std::fs::create_dir_all(begun.of(entry)).expect("writable");
        record.write(&files[files.len() - 1]).expect("writable");
    }
    let mut contents: Vec<Vec<u8>> = files.iter().map(|file| std::fs::read(file).expect("written")).collect();
    let arrays = [("1".to_owned(), 0)].into();
    let request = SlurmRequest { throttle: Some(4), arrays, ..SlurmRequest::default() };
    files.push(sweep.join("slurm/request.json"));
    contents.push(serde_json::to_vec(&request).expect("JSON"));
    damage(&files, &contents, |_| {
        let Ok(opened) = SweepFolder::open(&sweep) else { return };
        let _ = (opened.missing(), opened.tally(), gather(&opened, *REGISTRY), slurm::last_request(&opened));
    });
}

/// Baselines, lists of gates and failures, and times.
#[test]
fn a_list_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let root = folder.path();
    let lists = [
        ("quick/film.snap", "tests/snapshots/quick/film.snap"),
        ("expected_failures.toml", "tests/snapshots/expected_failures.toml"),
        ("gates_removed.toml", "tests/snapshots/gates_removed.toml"),
        ("gates/quick.txt", "tests/snapshots/gates/quick.txt"),
        ("speeds.json", "validation/src/cli/speeds.json"),
        (".bagnold-output", "tests/inputs/study.sh"),
    ];
    let files = lists.map(|(name, _)| root.join(name));
    // the first lines tell as much as thousands
    let start = |text: String| text.split_inclusive('\n').take(200).collect::<String>().into_bytes();
    let mut contents = lists.map(|(_, name)| start(std::fs::read_to_string(in_repository(name)).expect("text")));
    contents[4] = [&b"{\"build\":"[..], &contents[4], b"}"].concat();
    contents[5] = b"Written by bagnold, which replaces these entries the next time:\nindex.html\nfigures\n".to_vec();
    let gates = GateList::default();
    damage(&files, &contents, |which| match which {
        0 => drop(Baseline::read(root, "film", Tier::Quick)),
        1 => drop(ExpectedFailures::read(&files[1])),
        2 => {
            drop(RemovedGates::read(root).map(|removed| gates.differences(Tier::Quick, &Baseline::default(), &removed)))
        }
        3 => drop(GateList::read(root, Tier::Quick)),
        4 => {
            let mut all = AllSpeeds::read(root);
            let speeds = all.of("build");
            let _ = (speeds.ratio("film", &Variant::default()), speeds.nominal("film"), speeds.beside("film", "run"));
        }
        _ => drop((OutputFolder::is_one(root), OutputFolder::claim(root))),
    });
}

/// What a blind league and a folder of a calibration hold.
#[test]
fn a_prediction_and_an_owner_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let root = folder.path();
    let tables = ["prediction", "measured", "friction", "law"].map(|name| format!("blind/results/{name}.csv"));
    let read = |name: &String| std::fs::read(in_repository(&format!("validation/league/{name}"))).expect("a table");
    let mut contents: Vec<Vec<u8>> = tables.iter().map(read).collect();
    let mut files: Vec<PathBuf> = tables.iter().map(|name| root.join("league").join(name)).collect();
    let (plan, fit) = (root.join("plan.toml"), root.join("fit"));
    std::fs::write(&plan, "a plan").expect("writable");
    let begin = || CalibrationFolder::begin(&fit, &plan, CodeOrigin::PACKAGE, true);
    drop(begin().expect("a folder"));
    files.push(fit.join("plan.json"));
    contents.push(std::fs::read(&files[4]).expect("written"));
    damage(&files, &contents, |which| match which {
        4 => drop(begin()),
        _ => drop(studies::read(&root.join("league"), studies::BLIND)),
    });
}

const LAYER: &str = "case = \"scene\"\nname = \"bed\"\ngravity = [0.0, -9.81]\nspacing = 0.01\nduration = 0.02\ninterval = 0.01\n\
    pictures = 2\nmeasured = []\n[sides]\nleft = { periodic = 0.0 }\nright = { periodic = 0.05 }\nbottom = \"none\"\ntop = \"none\"\n\
    [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.05, 0.03]\n\
    [[walls]]\nname = \"bed\"\npoints = [[-0.02, 0.0], [0.07, 0.0]]\n";

/// Files below a folder with an ending.
fn below(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("readable").flatten().map(|entry| entry.path());
    entries
        .flat_map(|path| if path.is_dir() { below(&path, ending) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|own| own == ending))
        .collect()
}

/// The layer simulated once: its stored run and its state near the end.
fn layer(folder: &Path) -> (PathBuf, [PathBuf; 2]) {
    let [scene, out, store] = ["layer.toml", "out", "store"].map(|name| folder.join(name));
    std::fs::write(&scene, LAYER).expect("writable");
    bagnold(&["run", text(&scene), "--out", text(&out), "--store", text(&store)]).expect("a run");
    let kept = ["postcard", "checkpoint"].map(|ending| below(&store, ending).swap_remove(0));
    (scene, kept)
}

/// A file of this head whose checksum over these contents fits again.
fn sealed(head: &[u8], contents: &[u8]) -> Vec<u8> {
    [head, Sha256::digest(contents).as_slice(), contents].concat()
}

/// The stored run of a scene, damaged before or after its checksum was taken: it is taken or simulated again.
#[test]
fn a_stored_run_is_read_or_simulated_again() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let (scene, [stored, _]) = layer(folder.path());
    let whole = std::fs::read(&stored).expect("stored");
    // title, version, length of the key, 64 digits
    let start = 15 + 4 + 8 + 64;
    let store = Store::at(&folder.path().join("store"), StorePolicy::Use);
    read_damaged(&[whole.clone(), whole[start + 32..].to_vec()], |which, wrong| {
        let wrong = if which == 0 { wrong.to_vec() } else { sealed(&whole[..start], wrong) };
        std::fs::write(&stored, wrong).expect("writable");
        let file = CaseFile::read(&scene).expect("a scene");
        let changes = Changes { file: Some((&scene, file.fields)), ..Changes::default() };
        let prepared = REGISTRY.find("scene").and_then(|case| case.prepare(Tier::Quick, &changes)).expect("a scene");
        execute(vec![prepared], &store, &Silent).expect("a run");
    });
}

/// The same of a state from which a run starts: it is taken or refused.
#[test]
fn a_kept_state_is_continued_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let (scene, [_, kept]) = layer(folder.path());
    let whole = std::fs::read(&kept).expect("kept");
    // title, version, length of the key, 64 digits
    let start = 19 + 4 + 8 + 64;
    let state = folder.path().join("state");
    read_damaged(&[whole.clone(), whole[start + 32..].to_vec()], |which, wrong| {
        let wrong = if which == 0 { wrong.to_vec() } else { sealed(&whole[..start], wrong) };
        std::fs::write(&state, wrong).expect("writable");
        let Ok(StoredState { digest, .. }) = StoredState::read(&state) else { return };
        let file = CaseFile::read(&scene).expect("a scene");
        let from = format!("from={{ file = {:?}, sha256 = \"{digest}\" }}", text(&state));
        let settings = [from, "duration=0.025".to_owned()];
        let changes = Changes { file: Some((&scene, file.fields)), settings: &settings, ..Changes::default() };
        if let Ok(prepared) = REGISTRY.find("scene").and_then(|case| case.prepare(Tier::Quick, &changes)) {
            let _ = execute(vec![prepared], &Store::open(StorePolicy::Bypass), &Silent);
        }
    });
}
