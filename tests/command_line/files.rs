//! Files that a run and a report write, without loss.

use crate::command_line::program::{CHEAP, Place, document, path};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Every file below a folder with its contents.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(folder).expect("readable").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(contents(&path));
        } else {
            let bytes = std::fs::read(&path).expect("readable");
            files.insert(path, bytes);
        }
    }
    files
}

/// The files with this ending, which must be there and not empty, as text.
fn texts(files: &BTreeMap<PathBuf, Vec<u8>>, ending: &str) -> Vec<String> {
    let found: Vec<String> = files
        .iter()
        .filter(|(path, _)| path.extension().is_some_and(|extension| extension == ending))
        .map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned())
        .collect();
    assert!(!found.is_empty() && found.iter().all(|text| !text.is_empty()), "{ending}: {:?}", files.keys());
    found
}

#[test]
fn a_run_writes_every_kind_of_file() {
    let place = Place::new();
    place.run(CHEAP).code(0);
    let files = contents(&place.path("out"));
    assert!(files.values().all(|bytes| !bytes.is_empty()));
    for name in ["case.toml", "metrics.json", "provenance.json"] {
        assert!(files.contains_key(&place.path("out").join(name)), "{name}");
    }
    for text in texts(&files, "csv") {
        let mut lines = text.lines();
        let columns = lines.next().expect("a heading").split(',').count();
        assert!(columns > 1 && text.lines().count() > 2, "{text}");
        assert!(lines.all(|line| line.split(',').count() == columns && !line.contains("NaN")));
    }
    for text in texts(&files, "pvd") {
        // every snapshot that the collection names is there
        let names: Vec<&str> = text.split("file=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert!(
            !names.is_empty() && names.iter().all(|name| place.path("out/snapshots").join(name).is_file()),
            "{text}"
        );
    }
    assert!(texts(&files, "vtu").iter().all(|text| text.contains("<VTKFile") && text.contains("</VTKFile>")));
    assert!(texts(&files, "svg").iter().all(|text| text.contains("<svg") && text.contains("</svg>")));
    assert!(texts(&files, "png").iter().all(|text| text.contains("PNG")));
}

#[test]
fn the_written_case_runs_again_to_the_same_state() {
    let place = Place::new();
    let first = document(&place.run(&[CHEAP, &["--json"]].concat()).code(0));
    let case = place.path("out/case.toml").display().to_string();
    let again = ["run", &case, "--out", "again", "--json", "--fresh", "--threads", "1"];
    let second = document(&place.bagnold(&again).assert().code(0));
    assert_eq!(second.provenance.runs_from_store, 0);
    assert_eq!((first.state_hash, first.metrics), (second.state_hash, second.metrics));
    let text = |folder: &str| std::fs::read_to_string(place.path(folder).join("case.toml")).expect("written");
    assert_eq!(text("out"), text("again"));
}

#[test]
fn a_failed_run_leaves_the_old_results_as_they_were() {
    let place = Place::new();
    place.run(CHEAP).code(0);
    place.file("out/notes.txt", "mine");
    let before = contents(&place.path("out"));
    place.run(&[CHEAP, &["--set", "slope_angle=90"]].concat()).code(2);
    assert_eq!(contents(&place.path("out")), before);
    // a run that succeeds replaces its own files only
    place.run(&[CHEAP, &["--set", "seed=2"]].concat()).code(0);
    assert_eq!(std::fs::read_to_string(place.path("out/notes.txt")).expect("still there"), "mine");
    assert_ne!(contents(&place.path("out")), before);
}

#[test]
fn a_killed_run_leaves_the_old_results_and_the_next_one_cleans_up() {
    let place = Place::new();
    place.run(CHEAP).code(0);
    let out = place.path("out");
    let before = contents(&out);
    let names = || {
        let entries = std::fs::read_dir(&out).expect("readable").flatten();
        entries.map(|entry| entry.file_name()).collect::<std::collections::BTreeSet<_>>()
    };
    let old_names = names();
    let mut run = std::process::Command::new(path())
        .args(["run", "bagnold", "--tier", "fine", "--out", "out"])
        .current_dir(place.path(""))
        .env("BAGNOLD_STORE", place.path("store"))
        .spawn()
        .expect("started");
    let begin = Instant::now();
    while names() == old_names && begin.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let claimed = names() != old_names;
    run.kill().expect("killed");
    run.wait().expect("ended");
    assert!(claimed, "the run claims its folder at once");
    let after = contents(&out);
    for (path, bytes) in &before {
        assert_eq!(after.get(path), Some(bytes), "{}", path.display());
    }
    place.run(CHEAP).code(0);
    assert_eq!(names(), old_names, "nothing of the killed run stays behind");
}

#[test]
fn a_report_has_the_verdicts_and_is_self_contained() {
    let place = Place::new();
    let finished = place.sharing(&["report", "--cases", "film", "--out", "report"]).assert();
    let code = finished.get_output().status.code();
    assert!(matches!(code, Some(0 | 1)), "{finished}");
    let page = std::fs::read_to_string(place.path("report/index.html")).expect("a page");
    for word in ["film", "exact solutions and other codes", "against measurements", "moved", "pass"] {
        assert!(page.contains(word), "the page lacks {word:?}");
    }
    assert_eq!(code == Some(1), page.contains("class=\"banner fail\""), "the page and the exit code agree");
    for page in ["report/index.html", "report/gates.html", "report/papers.html", "report/cases/film/index.html"] {
        let folder = place.path(page).parent().expect("in a folder").to_owned();
        let page = std::fs::read_to_string(place.path(page)).expect(page);
        for outside in ["src=\"http", "href=\"http", "url(http", "@import"] {
            assert!(!page.contains(outside), "the page must be self-contained: {outside}");
        }
        // every picture that the page shows is in the folder
        for name in page.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            assert!(name.starts_with("data:") || folder.join(name).is_file(), "{name}");
        }
    }
}

/// The name of a film's run has no viscosity: the varied one is a label of its runs, numbers, tables and figures.
#[test]
fn runs_of_one_name_are_labelled_by_what_is_varied() {
    let place = Place::new();
    let arguments =
        ["run", "film", "--vary", "resolution=10,12", "--vary", "material.viscosity=0.5,1.0", "--out", "films"];
    place.bagnold(&arguments).assert().success();
    let document = std::fs::read_to_string(place.path("films/metrics.json")).expect("written");
    for variant in ["resolution=10,viscosity=0.5", "resolution=12,viscosity=1", "resolution=10_12,viscosity=1"] {
        assert!(document.contains(&format!("fluid=newtonian,particles=jittered,{variant}\"")), "{variant}: {document}");
    }
    assert!(place.path("films/figures/velocity-profile-viscosity-0.5.svg").is_file());
    let profile = "films/tables/profile-fluid-newtonian-particles-jittered-resolution-12-viscosity-1.csv";
    assert!(place.path(profile).is_file());
    let chosen = place
        .bagnold(&[&arguments[..6], &["--only", "resolution=12,viscosity=0.5", "--out", "one"]].concat())
        .assert()
        .code(0);
    let said = String::from_utf8_lossy(&chosen.get_output().stdout).into_owned();
    assert!(said.starts_with("film, quick tier, runs: 1 "), "{said}");
    // laws have no name in a variant: they are numbered
    let laws = "numerics=[{ artificial_viscosity = 0.1 }, { artificial_viscosity = 0.2 }]";
    let mut numbered =
        place.bagnold(&["run", "film", "-v", "--vary", laws, "--vary", "resolution=10", "--out", "numbered"]);
    let said = numbered.assert().code(0);
    let said = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
    assert!(["1", "2"].iter().all(|law| said.contains(&format!("resolution=10,numerics={law}\n"))), "{said}");
}

/// A store that cannot be written has one reason, and is warned of once.
#[test]
fn a_store_that_cannot_be_written_is_warned_of_once() {
    let place = Place::new();
    place.file("file", "");
    let arguments = ["film", "--vary", "resolution=10,12", "--store", "file/store"];
    let finished = place.run(&arguments);
    let said = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
    let warnings: Vec<&str> = said.lines().filter(|line| line.contains("not kept")).collect();
    assert!(warnings.len() == 1 && warnings[0].ends_with("; further warnings of this kind are not shown"), "{said}");
}

#[test]
fn a_time_or_size_that_is_negative_is_refused_by_its_rule() {
    let place = Place::new();
    for (arguments, value, option) in [
        (&["store", "prune", "--days", "-3"][..], "-3", "--days <DAYS>"),
        (&["store", "prune", "--size", "-0.5"], "-0.5", "--size <GIB>"),
        (&["run", "film", "--most-memory", "-1"], "-1", "--most-memory <GIB>"),
        (&["run", "film", "--most-hours", "-1e3"], "-1e3", "--most-hours <HOURS>"),
    ] {
        let refused = place.bagnold(arguments).assert().code(2).stdout("");
        let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        let begin =
            format!("error: invalid value '{value}' for '{option}': must be a positive number, such as 30 or 0.5\n");
        assert!(said.starts_with(&begin), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_is_no_output_folder() {
    let place = Place::new();
    std::os::unix::fs::symlink("gone/away", place.path("out")).expect("a link");
    let plan = "design = \"grid\"\n[[cases]]\ncase = \"film\"\n[[vary]]\npath = \"slope_angle\"\nvalues = [20.0]\n";
    place.file("plan.toml", plan);
    for (command, out) in
        [(&["run", "film"][..], "out"), (&["run", "film"], "out/below"), (&["sweep", "plan.toml"], "out")]
    {
        let arguments = [command, &["-q", "--out", out]].concat();
        place.bagnold(&arguments).assert().code(2).stdout("").stderr(format!(
            "error: {out}: cannot be written (file exists); choose a folder that you may write to with --out\n"
        ));
    }
}

#[test]
fn a_report_that_nothing_has_changed_says_again_what_it_said() {
    let place = Place::new();
    let report = |more: &[&str]| {
        let arguments = [&["report", "--cases", "water-film", "--out", "report"][..], more].concat();
        let finished = place.bagnold(&arguments).assert().code(0);
        let output = finished.get_output();
        [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    };
    let page = place.path("report/cases/water-film/index.html");
    let unchanged = "nothing has changed since this report was written";
    let [first, told] = report(&[]);
    assert!(!told.contains(unchanged), "{told}");
    let [second, told] = report(&[]);
    assert!(told.contains(unchanged), "{told}");
    assert_eq!(first, second);
    // another command, and a page that is gone, make it anew
    let [_, told] = report(&["--deny", "moved"]);
    assert!(!told.contains(unchanged), "{told}");
    std::fs::remove_file(&page).expect("a page");
    let [_, told] = report(&["--deny", "moved"]);
    assert!(!told.contains(unchanged) && page.is_file(), "{told}");
    // and so does a page with other words of the same length
    let text = std::fs::read_to_string(&page).expect("a page");
    std::fs::write(&page, text.replacen("water", "wader", 1)).expect("writable");
    let [_, told] = report(&["--deny", "moved"]);
    assert!(!told.contains(unchanged), "{told}");
}

#[test]
fn a_setting_of_a_report_changes_the_cases_that_have_its_field_and_says_so() {
    let place = Place::new();
    let arguments =
        ["report", "--cases", "water-film,water-column,scene", "--set", "material.viscosity=2", "--out", "out"];
    let estimate = place.bagnold(&["run", "water-film", "--estimate"]).assert().code(0);
    let estimate = String::from_utf8_lossy(&estimate.get_output().stdout).into_owned();
    assert!(["particles", "B of memory", "core hours"].iter().all(|word| estimate.contains(word)), "{estimate}");
    assert!(!place.path("store").exists());
    let refused = place.bagnold(&arguments).assert().code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(text.contains("`material.viscosity`: no case of this report has this field"), "{text}");
    let arguments = ["report", "--cases", "water-film,scene", "--set", "spacing=0.04", "--out", "out", "-q"];
    let done = place.bagnold(&arguments).assert();
    let text = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    assert!(text.contains("with --set spacing=0.04: 1 of 2 cases (scene)"), "{text}");
    let rows = std::fs::read_to_string(place.path("out/metrics.csv")).expect("metrics.csv");
    assert!(rows.lines().any(|row| row.starts_with("water-film,")) && rows.contains(",pass,"), "{rows}");
    let page = std::fs::read_to_string(place.path("out/index.html")).expect("a page");
    assert!(page.contains("Bagnold validation report with --set spacing=0.04"), "{}", &page[..2000]);
}
