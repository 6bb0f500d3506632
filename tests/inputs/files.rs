//! Plans, tables and case files with random mistakes in them: an error or a plan, never a panic.

use crate::judge::{count, runner};
use bagnold_harness::case::{AnyCase, CaseFile, Limits, Tier};
use bagnold_harness::evidence::MeasuredData;
use bagnold_harness::measured::Measurements;
use bagnold_scenes::study::Study;
use bagnold_tools::calibration::CalibrationPlan;
use bagnold_tools::judge::CaseSubmissions;
use bagnold_tools::sweep::SweepPlan;
use bagnold_validation::REGISTRY;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::strategy::ValueTree;
use std::path::Path;
use std::time::Duration;

/// Texts that a typing mistake inserts.
const SLIPS: [&str; 24] = [
    "",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    "#",
    "\n",
    "nan",
    "inf",
    "-",
    "1e308",
    "9223372036854775808",
    "\u{0}",
    "ä",
    "[[",
    "../../x",
    "\r",
    "'''",
    "0x",
    "true",
    "  ",
];

/// A place, how many characters go, and what comes instead.
type Slip = (Index, usize, Index);

fn slips() -> impl Strategy<Value = (Index, Vec<Slip>)> {
    (any::<Index>(), prop::collection::vec((any::<Index>(), 0..6_usize, any::<Index>()), 1..=4))
}

fn with_slips(text: &str, slips: &[Slip]) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    for (place, gone, slip) in slips {
        let start = place.index(letters.len() + 1);
        let end = (start + gone).min(letters.len());
        letters.splice(start..end, SLIPS[slip.index(SLIPS.len())].chars());
    }
    letters.into_iter().collect()
}

fn bytes_with_slips(bytes: &[u8], slips: &[Slip]) -> Vec<u8> {
    let mut wrong = bytes.to_vec();
    for (place, gone, slip) in slips {
        let start = place.index(wrong.len() + 1);
        let end = (start + gone).min(wrong.len());
        wrong.splice(start..end, SLIPS[slip.index(SLIPS.len())].bytes());
    }
    wrong
}

/// Texts in the repository with one of these endings.
fn shipped(folder: &str, ending: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder);
    let mut paths: Vec<_> =
        std::fs::read_dir(root).expect("in the repository").flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|own| own == ending));
    paths.sort();
    paths.into_iter().map(|path| std::fs::read_to_string(path).expect("text")).collect()
}

/// Files of other programs with this ending, byte by byte.
fn foreign(folder: &str) -> Vec<(String, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<_> =
        std::fs::read_dir(root).expect("in the repository").flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|own| ["vtu", "vtp", "vtk"].iter().any(|known| own == *known)));
    paths.sort();
    let name = |path: &Path| path.file_name().expect("a name").to_string_lossy().into_owned();
    paths.into_iter().map(|path| (name(&path), std::fs::read(path).expect("bytes"))).collect()
}

/// Processor time that reading a file may take.
const SOON: Duration = Duration::from_secs(5);

/// Processor time of this thread, which no load of the machine lengthens; zero where the system does not tell it.
fn processor_time() -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    Duration::from_nanos(told.split(' ').next().and_then(|nanoseconds| nanoseconds.parse().ok()).unwrap_or_default())
}

/// Mistakes in each of some texts; the reader must come back with whatever it likes, soon.
fn read_with_slips(texts: &[String], mut read: impl FnMut(&str)) {
    let mut runner = runner();
    for _ in 0..count() {
        let (which, slips) = slips().new_tree(&mut runner).expect("slips").current();
        let text = with_slips(&texts[which.index(texts.len())], &slips);
        let begun = processor_time();
        read(&text);
        let taken = processor_time() - begun;
        assert!(taken < SOON, "took {taken:?}:\n{text}");
    }
}

#[test]
fn a_case_file_is_read_or_refused() {
    let texts: Vec<String> = REGISTRY.cases().map(|case| case.show(Tier::Quick)).collect();
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("case.toml");
    read_with_slips(&texts, |text| {
        std::fs::write(&path, text).expect("writable");
        if let Ok(file) = CaseFile::read(&path)
            && let Ok(case) = REGISTRY.find(&file.case)
        {
            let changes = bagnold_harness::case::Changes { file: Some((&path, file.fields)), ..Default::default() };
            if let Err(error) = AnyCase::prepare(case, Tier::Quick, &changes) {
                assert!(error.to_string().contains("case.toml"), "{error}");
            }
        }
    });
}

#[test]
fn a_sweep_plan_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("plan.toml");
    let mut texts = shipped("validation/sweeps", "toml");
    texts.push(
        "design = \"grid\"\n[[cases]]\ncase = \"film\"\nwith = { resolution = 10 }\n[[parameters]]\npath = \"slope_angle\"\n\
         lower = 1.0\nupper = 20.0\nlevels = 3\n"
            .to_owned(),
    );
    read_with_slips(&texts, |text| {
        std::fs::write(&path, text).expect("writable");
        if let Ok(plan) = SweepPlan::read(&path) {
            // what the cases refuse is an error too
            let _ = plan.manifest(*REGISTRY, Limits::default());
        }
    });
}

#[test]
fn a_calibration_plan_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("plan.toml");
    read_with_slips(&shipped("validation/calibrations", "toml"), |text| {
        std::fs::write(&path, text).expect("writable");
        let _ = CalibrationPlan::read(&path, *REGISTRY, Limits::default());
    });
}

#[test]
fn a_table_of_measurements_is_read_or_refused() {
    let texts = [shipped("reference-data/settling", "csv"), shipped("validation/calibrations", "csv")].concat();
    read_with_slips(&texts, |text| {
        let _ = MeasuredData::parse("table.csv", text);
    });
}

/// Pictures of a code in every form: VTK's files, collections, a dump and tables, with bytes that are wrong, gone or doubled.
#[test]
fn a_picture_of_another_code_is_read_or_refused() {
    let mut files = foreign("foreign/vtk");
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff pp\n0 1\n0 1\n0 1\n\
                ITEM: ATOMS id x y radius\n1 0.1 0.1 0.01\n2 0.2 0.1 0.01\n";
    let pvd = "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0.5\" file=\"vtk-ascii.vtu\"/></Collection></VTKFile>";
    let table = "x,y,vx,vy,area\n0.1,0.1,0,0,1e-4\n0.2,0.1,0,0,1e-4\n";
    let blocks = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet index=\"0\" file=\"vtk-ascii.vtu\"/>\
                  </vtkMultiBlockDataSet></VTKFile>";
    let set = "# x y U\n0.1 0.1 (1 0 0)\n0.2 0.1 (1 0 0)\n";
    for (name, text) in [
        ("a.dump", dump),
        ("a.pvd", pvd),
        ("a.csv", table),
        ("a.series", "{\"files\":[]}"),
        ("a.vtm", blocks),
        ("a.xy", set),
    ] {
        files.push((name.to_owned(), text.as_bytes().to_vec()));
    }
    let folder = tempfile::tempdir().expect("temporary folder");
    for (name, bytes) in &files {
        std::fs::write(folder.path().join(name), bytes).expect("writable");
    }
    let mut runner = runner();
    for _ in 0..count() {
        let (which, slips) = slips().new_tree(&mut runner).expect("slips").current();
        let (name, bytes) = &files[which.index(files.len())];
        let wrong = bytes_with_slips(bytes, &slips);
        let (file, submission) = (folder.path().join(format!("wrong-{name}")), folder.path().join("submission.toml"));
        std::fs::write(&file, &wrong).expect("writable");
        let text = format!(
            "case = \"column-planar\"\n[code]\nname = \"a\"\n[[run]]\nvariant = \"material=lagree,aspect_ratio=1\"\n\
             [run.particles]\nfiles = [\"wrong-{name}\"]\ntimes = [0.5]\ntime_step = 0.1\n\
             columns = {{ x = \"x [m]\", y = \"y [m]\", area = {{ value = 1e-4, unit = \"m^2\" }} }}\n"
        );
        std::fs::write(&submission, text).expect("writable");
        let begun = processor_time();
        if let Err(error) = CaseSubmissions::read(&[submission], *REGISTRY) {
            assert!(error.to_string().contains("submission.toml") || error.to_string().contains(name), "{error}");
        }
        let taken = processor_time() - begun;
        assert!(taken < SOON, "{name} took {taken:?}");
    }
}

#[test]
fn an_overlay_and_a_study_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("overlay.csv");
    read_with_slips(&shipped("validation/examples/studies", "csv"), |text| {
        std::fs::write(&path, text).expect("writable");
        let _ = Measurements::read(&path);
    });
    let path = folder.path().join("study.toml");
    let mut studies = shipped("validation/examples/studies", "toml");
    studies.retain(|text| text.contains("[[checks]]"));
    read_with_slips(&studies, |text| {
        std::fs::write(&path, text).expect("writable");
        let _ = Study::read(&path, *REGISTRY);
    });
}

/// A mesh of a wall as text and as bytes, damaged: the scene that names it is prepared or refused by the name of its file.
#[test]
fn a_mesh_is_read_or_refused() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/scenes");
    let text = std::fs::read(examples.join("funnel.stl")).expect("in the repository");
    let folder = tempfile::tempdir().expect("temporary folder");
    let scene = folder.path().join("funnel.toml");
    std::fs::copy(examples.join("funnel.toml"), &scene).expect("writable");
    let corners: Vec<f32> = String::from_utf8_lossy(&text)
        .lines()
        .filter_map(|line| line.trim().strip_prefix("vertex "))
        .flat_map(|line| line.split_whitespace().map(|number| number.parse().expect("a number")).collect::<Vec<f32>>())
        .collect();
    let mut binary = vec![0; 80];
    binary.extend(u32::try_from(corners.len() / 9).expect("few").to_le_bytes());
    for triangle in corners.chunks(9) {
        binary.extend([0; 12]);
        binary.extend(triangle.iter().flat_map(|number| number.to_le_bytes()));
        binary.extend([0; 2]);
    }
    let files = [text, binary];
    let mut runner = runner();
    for _ in 0..count() {
        let (which, slips) = slips().new_tree(&mut runner).expect("slips").current();
        let wrong = bytes_with_slips(&files[which.index(files.len())], &slips);
        std::fs::write(folder.path().join("funnel.stl"), &wrong).expect("writable");
        let begun = processor_time();
        let prepared = CaseFile::read(&scene).and_then(|file| {
            let case = REGISTRY.find(&file.case).expect("a case");
            let changes = bagnold_harness::case::Changes { file: Some((&scene, file.fields)), ..Default::default() };
            AnyCase::prepare(case, Tier::Quick, &changes).map(|_| ())
        });
        if let Err(error) = prepared {
            assert!(error.to_string().contains("funnel."), "{error}");
        }
        let taken = processor_time() - begun;
        assert!(taken < SOON, "took {taken:?}: {}", String::from_utf8_lossy(&wrong));
    }
}
