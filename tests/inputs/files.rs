//! Plans, tables and case files with random mistakes in them: an error or a plan, never a panic.

use crate::inputs::damage::read_damaged;
use bagnold_harness::case::{AnyCase, CaseFile, Changes, Limits, ParameterError, Tier};
use bagnold_harness::evidence::MeasuredData;
use bagnold_harness::input::MeasuredFiles;
use bagnold_harness::measured::{Measurements, WantedColumns};
use bagnold_scenes::study::{Suite, is_study};
use bagnold_tools::calibration::CalibrationPlan;
use bagnold_tools::judge::CaseSubmissions;
use bagnold_tools::prediction::PredictionPlan;
use bagnold_tools::sweep::SweepPlan;
use bagnold_validation::REGISTRY;
use std::path::{Path, PathBuf};

/// A folder of the repository.
pub(crate) fn in_repository(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder)
}

/// Files of a folder with one of some endings, by their names.
fn shipped(folder: &str, endings: &[&str]) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(in_repository(folder)).expect("in the repository").flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|own| endings.iter().any(|ending| own == *ending)));
    paths.sort();
    let name = |path: &Path| path.file_name().expect("a name").to_string_lossy().into_owned();
    paths.into_iter().map(|path| (name(&path), std::fs::read(path).expect("bytes"))).collect()
}

fn texts(folder: &str, ending: &str) -> Vec<Vec<u8>> {
    shipped(folder, &[ending]).into_iter().map(|(_, text)| text).collect()
}

/// The case of a file with its parameters.
fn prepare(path: &Path) -> Result<(), ParameterError> {
    let file = CaseFile::read(path)?;
    // an unknown case is for the list of cases to refuse
    let Ok(case) = REGISTRY.find(&file.case) else { return Ok(()) };
    let changes = Changes { file: Some((path, file.fields)), ..Changes::default() };
    AnyCase::prepare(case, Tier::Quick, &changes).map(|_| ())
}

#[test]
fn a_case_file_is_read_or_refused() {
    let cases: Vec<String> = REGISTRY.cases().map(|case| case.show(Tier::Quick)).collect();
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("case.toml");
    read_damaged(&cases, |_, text| {
        std::fs::write(&path, text).expect("writable");
        if let Err(error) = prepare(&path) {
            assert!(error.to_string().contains("case.toml"), "{error}");
        }
    });
}

#[test]
fn a_scene_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mesh = in_repository("validation/examples/scenes/funnel.stl");
    std::fs::copy(mesh, folder.path().join("funnel.stl")).expect("writable");
    let path = folder.path().join("scene.toml");
    read_damaged(&texts("validation/examples/scenes", "toml"), |_, text| {
        std::fs::write(&path, text).expect("writable");
        if let Err(error) = prepare(&path) {
            let message = error.to_string();
            assert!(message.contains("scene.toml") || message.contains("funnel.stl"), "{message}");
        }
    });
}

#[test]
fn a_table_of_an_inlet_is_read_or_refused() {
    let scene = std::fs::read_to_string(in_repository("validation/examples/scenes/fed-slope.toml")).expect("text");
    let rates = "rates = [[0.0, 2.476], [0.9, 2.476], [1.0, 0.0]]";
    assert!(scene.contains(rates));
    let folder = tempfile::tempdir().expect("temporary folder");
    let (path, table) = (folder.path().join("fed.toml"), folder.path().join("feed.csv"));
    std::fs::write(&path, scene.replace(rates, "table = \"feed.csv\"")).expect("writable");
    let tables =
        ["time [s],rate [kg/(m s)]\n0.0,2.476\n0.9,2.476\n1.0,0\n", "t;q [g/(s cm)]\r\n# a note\r\n0;1\r\n2;3,5\r\n"];
    read_damaged(&tables, |_, text| {
        std::fs::write(&table, text).expect("writable");
        if let Err(error) = prepare(&path) {
            let message = error.to_string();
            assert!(message.contains("feed.csv") || message.contains("fed.toml"), "{message}");
        }
    });
}

/// A mesh of a wall as text and as bytes.
#[test]
fn a_mesh_is_read_or_refused() {
    let examples = in_repository("validation/examples/scenes");
    let [scene, text] = ["funnel.toml", "funnel.stl"].map(|name| std::fs::read(examples.join(name)).expect("bytes"));
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("funnel.toml");
    std::fs::write(&path, scene).expect("writable");
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
    read_damaged(&[text, binary], |_, wrong| {
        std::fs::write(folder.path().join("funnel.stl"), wrong).expect("writable");
        if let Err(error) = prepare(&path) {
            assert!(error.to_string().contains("funnel."), "{error}");
        }
    });
}

#[test]
fn a_sweep_plan_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("plan.toml");
    // sixteen runs in place of four hundred
    let fewer = |plan: Vec<u8>| String::from_utf8(plan).expect("text").replace("levels = 20", "levels = 4");
    let mut plans: Vec<String> = texts("validation/sweeps", "toml").into_iter().map(fewer).collect();
    let grid = "design = \"grid\"\n[[cases]]\ncase = \"film\"\nwith = { resolution = 10 }\n[[vary]]\npath = \"slope_angle\"\n\
                lower = 1.0\nupper = 20.0\nlevels = 3\n";
    plans.push(grid.into());
    read_damaged(&plans, |_, text| {
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
    for (name, table) in shipped("validation/calibrations", &["csv"]) {
        std::fs::write(folder.path().join(name), table).expect("writable");
    }
    let path = folder.path().join("plan.toml");
    read_damaged(&texts("validation/calibrations", "toml"), |_, text| {
        std::fs::write(&path, text).expect("writable");
        let _ = CalibrationPlan::read(&path, *REGISTRY, Limits::default());
    });
}

/// A law with its draws, then what was measured of the predicted column.
#[test]
fn a_law_and_a_measured_collapse_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("given");
    let law = shipped("tests/bad", &["toml"]).into_iter().find(|(name, _)| name == "predict-from-a-law.toml");
    let measured = "run_out [-],run_out uncertainty [-],final_height #1 [-],final_height #2 [-]\n1.9,0.1,0.6,0.7\n";
    read_damaged(&[law.expect("a law").1, measured.into()], |which, text| {
        std::fs::write(&path, text).expect("writable");
        let plan = PredictionPlan { case: "column-planar".to_owned(), resolution: 4, draws: 2, ..Default::default() };
        let refused = match which {
            0 => plan.prepare(&path, *REGISTRY, Limits::default()).err(),
            _ => plan.measured(&path, *REGISTRY).err(),
        };
        assert!(refused.is_none_or(|error| error.to_string().contains("given")));
    });
}

#[test]
fn a_table_of_measurements_is_read_or_refused() {
    let tables = [texts("reference-data/settling", "csv"), texts("validation/calibrations", "csv")].concat();
    read_damaged(&tables, |_, text| {
        let _ = MeasuredData::parse(Path::new("table.csv"), &String::from_utf8_lossy(text));
    });
}

#[test]
fn an_overlay_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = folder.path().join("overlay.csv");
    read_damaged(&texts("validation/examples/studies", "csv"), |_, text| {
        std::fs::write(&path, text).expect("writable");
        let _ = Measurements::read(&MeasuredFiles::One(path.clone()), WantedColumns::default());
    });
}

/// A study alone in its folder, as a suite.
#[test]
fn a_study_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    for (name, table) in shipped("validation/examples/studies", &["csv"]) {
        std::fs::write(folder.path().join(name), table).expect("writable");
    }
    let path = folder.path().join("study.toml");
    let mut studies = texts("validation/examples/studies", "toml");
    studies.retain(|text| String::from_utf8_lossy(text).contains("[[checks]]"));
    read_damaged(&studies, |_, text| {
        std::fs::write(&path, text).expect("writable");
        let _ = is_study(&path);
        if let Ok(suite) = Suite::read(folder.path(), *REGISTRY) {
            let _ = suite.prepare(*REGISTRY, None, Limits::default());
        }
    });
}

/// Damages pictures of a code that a submission names, beside which the good ones lie.
fn read_pictures(files: &[(String, Vec<u8>)]) {
    let folder = tempfile::tempdir().expect("temporary folder");
    for (name, bytes) in shipped("tests/foreign/vtk", &["vtu", "vtk"]).iter().chain(files) {
        std::fs::write(folder.path().join(name), bytes).expect("writable");
    }
    let submission = folder.path().join("submission.toml");
    let bytes: Vec<&Vec<u8>> = files.iter().map(|(_, bytes)| bytes).collect();
    read_damaged(&bytes, |which, wrong| {
        let name = &files[which].0;
        std::fs::write(folder.path().join(format!("wrong-{name}")), wrong).expect("writable");
        let text = format!(
            "case = \"column-planar\"\n[code]\nname = \"a\"\n[[run]]\nvariant = \"material=lagree,aspect_ratio=1\"\n\
             [run.particles]\nfiles = [\"wrong-{name}\"]\ntimes = [0.5]\ntime_step = 0.1\n\
             columns = {{ x = \"x [m]\", y = \"y [m]\", area = {{ value = 1e-4, unit = \"m^2\" }} }}\n"
        );
        std::fs::write(&submission, text).expect("writable");
        if let Err(error) = CaseSubmissions::read(std::slice::from_ref(&submission), *REGISTRY) {
            assert!(error.to_string().contains("submission.toml") || error.to_string().contains(name), "{error}");
        }
    });
}

#[test]
fn a_picture_of_vtk_is_read_or_refused() {
    read_pictures(&shipped("tests/foreign/vtk", &["vtu", "vtp", "vtk"]));
}

/// Collections of pictures, dumps and tables.
#[test]
fn a_picture_of_another_form_is_read_or_refused() {
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff pp\n0 1\n0 1\n0 1\n\
                ITEM: ATOMS id x y radius\n1 0.1 0.1 0.01\n2 0.2 0.1 0.01\n";
    let pvd = "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0.5\" file=\"vtk-ascii.vtu\"/></Collection></VTKFile>";
    let table = "x,y,vx,vy,area\n0.1,0.1,0,0,1e-4\n0.2,0.1,0,0,1e-4\n";
    let blocks = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet index=\"0\" file=\"vtk-ascii.vtu\"/>\
                  </vtkMultiBlockDataSet></VTKFile>";
    let set = "# x y U\n0.1 0.1 (1 0 0)\n0.2 0.1 (1 0 0)\n";
    let series = "{\"file-series-version\":\"1.0\",\"files\":[{\"name\":\"vtk-ascii.vtu\",\"time\":0.5}]}";
    let forms =
        [("a.dump", dump), ("a.pvd", pvd), ("a.csv", table), ("a.series", series), ("a.vtm", blocks), ("a.xy", set)];
    read_pictures(&forms.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())));
}

/// Submissions of the league beside their tables.
#[test]
fn a_submission_is_read_or_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let all =
        ["dualsphysics/water-film", "gerris/bagnold", "lammps/column-planar", "newton/column-planar", "openfoam/film"];
    let mut submissions = Vec::new();
    for (place, name) in all.into_iter().enumerate() {
        let own = format!("validation/league/{name}");
        let copy = folder.path().join(place.to_string());
        for below in ["", "results"] {
            std::fs::create_dir_all(copy.join(below)).expect("writable");
            for (name, bytes) in shipped(&format!("{own}/{below}"), &["csv", "xy", "toml"]) {
                std::fs::write(copy.join(below).join(name), bytes).expect("writable");
            }
        }
        submissions.push(std::fs::read(copy.join("submission.toml")).expect("a submission"));
    }
    read_damaged(&submissions, |which, text| {
        let path = folder.path().join(which.to_string()).join("submission.toml");
        std::fs::write(&path, text).expect("writable");
        let _ = CaseSubmissions::read(&[path], *REGISTRY);
    });
}
