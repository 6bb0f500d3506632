use super::*;
use crate::sampling::Random;
use std::fmt::Write as _;

/// Depth and period of the layer `[m]`, radius `[m]`, density `[kg/m^3]`.
const LAYER: [f64; 4] = [0.04, 0.05, 0.0005, 2500.0];
/// Mean of the velocity's fluctuation along and across `[m/s]`.
const FLUCTUATION: [f64; 2] = [0.05, 0.03];

/// Discs without contacts drawn from a velocity 20 y + 300 y² with fluctuations that are correlated by −0.8, and an even density.
fn drawn(folder: &Path, frames: usize, grains: usize, seed: u64) -> f64 {
    let mut random = Random::new(seed);
    let mut text = String::new();
    for frame in 0..frames {
        let _ = write!(
            text,
            "ITEM: TIME\n{frame}\nITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{grains}\nITEM: ATOMS id type y vx vy radius\n"
        );
        for id in 1..=grains {
            let y = LAYER[0] * (id as f64 - 1.0 + random.uniform()) / grains as f64;
            let (a, b) = (random.normal(), random.normal());
            let vx = 20.0 * y + 300.0 * y * y + FLUCTUATION[0] * a;
            let vy = FLUCTUATION[1] * (-0.8 * a + 0.6 * b);
            let radius = LAYER[2] * (0.8 + 0.4 * random.uniform());
            let _ = writeln!(text, "{id} 1 {y} {vx} {vy} {radius}");
        }
    }
    std::fs::write(folder.join("grains.dump"), text).expect("written");
    let squares = 1.0 + 0.16 / 12.0; // of radii between 0.8 and 1.2
    grains as f64 * std::f64::consts::PI * LAYER[2] * LAYER[2] * squares / (LAYER[0] * LAYER[1])
}

fn plan(folder: &Path, more: &str) -> GrainPlan {
    let text = format!(
        "title = \"drawn\"\n[[run]]\nname = \"a\"\nlength = {}\n{more}\n[run.particles]\nfiles = [\"grains.dump\"]\n\
         columns = {{ y = \"y [m]\", vx = \"vx [m/s]\", vy = \"vy [m/s]\", radius = \"radius [m]\", kind = \"type [-]\", density = \
         {{ value = {}, unit = \"kg/m^3\" }} }}\n",
        LAYER[1], LAYER[3]
    );
    std::fs::write(folder.join("plan.toml"), text).expect("written");
    GrainPlan::read(&folder.join("plan.toml")).expect("a plan")
}

/// 10⁴ grains × frames in the core and more: density, velocity, shear rate and kinetic stress within 1 %.
#[test]
fn grains_drawn_from_a_field_give_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let solid = drawn(folder.path(), 30, 1500, 3);
    let plan = plan(folder.path(), "slope_angle = 20.0");
    let run = average(&plan).expect("averaged").remove(0);
    assert!(run.defect < 1e-12, "{}", run.defect);
    let mut sums = [[0.0; 2]; 7];
    let core = run.table.rows.iter().filter(|row| row[0] > 0.1 * LAYER[0] && row[0] < 0.9 * LAYER[0]);
    for row in core {
        let y = row[0];
        let density = solid * LAYER[3];
        let above = density * (LAYER[0] - y);
        let exact = [
            solid,
            20.0 * y + 300.0 * y * y,
            20.0 + 600.0 * y,
            9.81 * libm::cos(20f64.to_radians()) * above,
            density * FLUCTUATION[0] * FLUCTUATION[0],
            density * FLUCTUATION[1] * FLUCTUATION[1],
            -0.8 * density * FLUCTUATION[0] * FLUCTUATION[1],
        ];
        let found = [row[1], row[3], row[5], row[7], row[19], row[21], row[23]];
        for (sum, (found, exact)) in sums.iter_mut().zip(found.into_iter().zip(exact)) {
            *sum = [sum[0] + found, sum[1] + exact];
        }
        assert!(
            (row[1] / solid - 1.0).abs() < 0.05 && (row[11] / 20f64.to_radians().tan() - 1.0).abs() < 1e-12,
            "{row:?}"
        );
    }
    for [found, exact] in sums {
        assert!((found / exact - 1.0).abs() < 0.01, "{found} is not {exact}");
    }
}

#[test]
fn grains_of_a_cell_have_its_stress_and_rough_walls_are_no_grains() {
    let folder = tempfile::tempdir().expect("a folder");
    drawn(folder.path(), 8, 1500, 4);
    let mut plan = plan(folder.path(), "pressure = 100.0\nshear_stress = 40.0\nkinds = [1]");
    let run = average(&plan).expect("averaged").remove(0);
    assert!((run.core[5].0 - 0.4).abs() < 1e-12);
    let message = |plan: &GrainPlan| average(plan).expect_err("refused").to_string();
    plan.steady_within = Some(1e-6);
    assert!(message(&plan).contains("above the limit of 0.0001 % (`steady_within`); dump later"), "{}", message(&plan));
    let text = std::fs::read_to_string(folder.path().join("grains.dump")).expect("written");
    let put = |text: &str| std::fs::write(folder.path().join("grains.dump"), text).expect("written");
    // the first grains stand still
    let still = |line: &str| match line.split_once(' ').map(|(id, _)| id.parse::<usize>()) {
        Some(Ok(id)) if id < 20 && line.len() > 8 => {
            let words: Vec<&str> = line.split(' ').collect();
            format!("{} {} {} 0 0 {}\n", words[0], words[1], words[2], words[5])
        }
        _ => format!("{line}\n"),
    };
    put(&text.lines().map(still).collect::<String>());
    assert!(message(&plan).contains("19 grains have the same velocity in each frame"), "{}", message(&plan));
    put(text.split("ITEM: TIME\n1\n").next().expect("a frame"));
    assert!(message(&plan).contains("frames in the files: 1, needed: 5 or more"), "{}", message(&plan));
}

/// Profiles that LAMMPS itself has averaged over the frames of its dump: bins of one diameter, stresses by atom.
#[test]
fn slope_of_lammps_has_the_values_of_its_own_computes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/grains");
    let own = tempfile::tempdir().expect("a folder");
    // LAMMPS' profiles begin after the first frame
    for name in ["slope-24.dump", "contacts-24.dump"] {
        let text = std::fs::read_to_string(folder.join(name)).expect("a dump");
        let later = text.match_indices("ITEM: TIME\n").nth(1).expect("frames").0;
        std::fs::write(own.path().join(name), &text[later..]).expect("written");
    }
    let mut plan = GrainPlan::read(&folder.join("slopes.toml")).expect("a plan");
    plan.path = own.path().join("slopes.toml");
    plan.runs.retain(|run| run.contacts.is_some());
    let mut steeper = plan.clone();
    steeper.runs[0].slope_angle = Some(34.0);
    let refused = average(&steeper).expect_err("another slope").to_string();
    assert!(refused.contains("`run[0].slope_angle`: the contacts bear 0.6"), "{refused}");
    let run = average(&plan).expect("averaged").remove(0);
    let at = |y: f64, column: usize| {
        let after = run.table.rows.partition_point(|row| row[0] < y);
        let (low, high) = (&run.table.rows[after - 1], &run.table.rows[after]);
        low[column] + (high[column] - low[column]) * (y - low[0]) / (high[0] - low[0])
    };
    let text = std::fs::read_to_string(folder.join("profile-24.txt")).expect("a profile");
    let rows = text.lines().map(|line| line.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN)).collect());
    let mut sums = [[0.0; 2]; 4];
    for row in rows.filter(|row: &Vec<f64>| row.len() == 7 && row[1] > 0.006 && row[1] < 0.026) {
        let [_, y, count, density, velocity, yy, xy] = row[..] else { unreachable!() };
        let per_volume = count / (plan.runs[0].length * 0.002);
        let theirs = [density / 2500.0, velocity, -yy * per_volume, -xy * per_volume];
        // contact_yy and contact_yx
        let own = [at(y, 1), at(y, 3), at(y, 27), at(y, 31)];
        for (sum, (own, theirs)) in sums.iter_mut().zip(own.into_iter().zip(theirs)) {
            *sum = [sum[0] + own, sum[1] + theirs];
        }
    }
    for [own, theirs] in sums {
        assert!((own / theirs - 1.0).abs() < 0.02, "{own} is not {theirs}");
    }
}

/// A slope that YADE wrote as VTU with contacts and as legacy VTK (`tests/foreign/yade`), beside YADE's own sums over its grains and contacts.
#[test]
fn slope_of_yade_has_its_own_sums_in_both_formats() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/foreign/yade");
    let runs = average(&GrainPlan::read(&folder.join("slope.toml")).expect("a plan")).expect("averaged");
    let text = std::fs::read_to_string(folder.join("sums.csv")).expect("sums");
    let rows = text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap_or(f64::NAN)).collect());
    let rows: Vec<Vec<f64>> = rows.collect();
    let theirs = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / rows.len() as f64;
    for run in &runs {
        assert_eq!((run.total[0], run.windows), (5.0, 5));
        assert!((run.total[2] / 5.0 / theirs(1) - 1.0).abs() < 1e-5, "mass {:?}", run.total);
        assert!((run.total[3] / 5.0 / theirs(2) - 1.0).abs() < 1e-5, "momentum {:?}", run.total);
    }
    let [vtu, vtk] = [0, 1].map(|run| &runs[run].core);
    for k in [0, 1, 7, 8] {
        assert!((vtu[k].0 / vtk[k].0 - 1.0).abs() < 1e-4, "quantity {k}: {:?}, {:?}", vtu[k], vtk[k]);
    }
    // YADE counts tension positive; bins without grains leave out the ends of branches
    let table = &runs[0].table.rows;
    let volume = (table[1][0] - table[0][0]).abs() * 0.012 * 0.008;
    for (column, own) in [(27, -theirs(3)), (29, -theirs(4))] {
        let sum = table.iter().map(|row| row[column]).filter(|value| value.is_finite()).sum::<f64>() * volume;
        assert!((sum / own - 1.0).abs() < 0.01, "column {column}: {sum} is not {own}");
    }
}

#[test]
fn layers_upside_down_repeated_and_of_two_sizes_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    drawn(folder.path(), 6, 1500, 5);
    let plan = plan(folder.path(), "slope_angle = 20.0");
    let file = folder.path().join("grains.dump");
    let text = std::fs::read_to_string(&file).expect("written");
    // rows `id type y vx vy radius`
    let changed = |change: &dyn Fn(&mut [f64])| -> String {
        let of_line = |line: &str| {
            let values: Option<Vec<f64>> = line.split(' ').map(|word| word.parse().ok()).collect();
            values.filter(|values| values.len() == 6).map_or_else(
                || format!("{line}\n"),
                |mut values| {
                    change(&mut values);
                    values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ") + "\n"
                },
            )
        };
        text.lines().map(of_line).collect()
    };
    let message = |text: &str| {
        std::fs::write(&file, text).expect("written");
        average(&plan).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(message(&changed(&|_| {})), Ok(()));
    let fault = |change: &dyn Fn(&mut [f64])| message(&changed(change)).expect_err("refused");
    assert!(fault(&|row| row[2] = LAYER[0] - row[2]).contains("the layer is fastest at its lower end"));
    assert!(
        fault(&|row| (row[2], row[3]) = (LAYER[0] - row[2], -row[3])).contains("let `y` be the height above the bed")
    );
    // the mirrored flow is the same one
    assert_eq!(message(&changed(&|row| row[3] = -row[3])), Ok(()));
    let of_two = fault(&|row| row[5] *= if row[0] % 2.0 == 0.0 { 1.0 } else { 2.0 });
    assert!(of_two.contains("two distributions, up to 0.0005") && of_two.contains("give `grain_diameter`"), "{of_two}");
    // the grains of the second frame again in the third
    let frames: Vec<&str> = text.split("ITEM: TIME\n").collect();
    let [rows, other] = [2, 3].map(|k| frames[k].split_once("ITEM: ATOMS").expect("a frame"));
    let again = [frames[0], frames[1], frames[2], &[other.0, "ITEM: ATOMS", rows.1].concat()].join("ITEM: TIME\n");
    let rest: String = frames[4..].iter().map(|frame| format!("ITEM: TIME\n{frame}")).collect();
    let repeated = message(&(again + &rest)).expect_err("refused");
    assert!(repeated.contains("two frames hold the same grains"), "{repeated}");
}

/// Two runs of one slope have one friction: the chord to the other slope carries their scatter over.
#[test]
fn repeats_on_one_slope_have_an_uncertainty() {
    let folder = tempfile::tempdir().expect("a folder");
    drawn(folder.path(), 6, 1500, 6);
    let plan = plan(folder.path(), "slope_angle = 20.0");
    let one = average(&plan).expect("averaged").remove(0);
    let run = |inertia: f64, friction: f64| {
        let mut run = one.clone();
        (run.core[6], run.core[5]) = ((inertia, 0.01), (friction, 0.0));
        run
    };
    write(&plan, &[run(0.1, 0.3), run(0.12, 0.3), run(0.2, 0.4)], folder.path(), crate::figure::FigureFormat::SCREEN)
        .expect("written");
    let points = std::fs::read_to_string(folder.path().join("points.csv")).expect("written");
    let sigma = |row: &str| row.split(',').nth(2).and_then(|word| word.parse::<f64>().ok()).expect("a number");
    let sigmas: Vec<f64> = points.lines().skip(2).map(sigma).collect();
    for (own, exact) in sigmas.iter().zip([0.01, 0.0125, 0.0125]) {
        assert!((own - exact).abs() < 1e-12, "{sigmas:?}");
    }
}
