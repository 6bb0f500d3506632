//! State of a scene before it runs: settled bodies rest when they are released, and the stated cost is the cost that is
//! taken.

use crate::threads::alone;
use bagnold_harness::case::{CaseResult, Changes, Silent, Tier, execute};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_reference::one_dimension::{BagnoldProfile, LayerTransient};
use bagnold_solver::material::rheology::MuI;
use bagnold_validation::REGISTRY;

/// A scene from the text of its file, and the particle-steps that are expected of it.
fn result_of(text: &str) -> (CaseResult, f64) {
    let mut fields: toml::Table = text.parse().expect("TOML");
    let case = fields.remove("case").expect("a case");
    let changes = Changes { file: Some((std::path::Path::new("scene.toml"), fields)), ..Changes::default() };
    let case = REGISTRY.find(case.as_str().expect("a name")).expect("a case");
    let prepared = case.prepare(Tier::Quick, &changes).unwrap_or_else(|error| panic!("{error}"));
    let expected = prepared.estimate_of_all().particle_steps;
    alone();
    let mut results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent).expect("a result");
    (results.remove(0), expected)
}

/// The value of a metric of the only run, or of its only gauge.
fn metric(result: &CaseResult, name: &str) -> f64 {
    result.metrics.iter().find(|metric| metric.name == name).unwrap_or_else(|| panic!("no {name}")).value
}

/// Beads, 50 mm deep on a bed that is inclined by 10°, without end along it; their angle of repose is 20.9°.
fn slab(space: bool, preparation: &str) -> String {
    let (case, sides, lower, upper, bed, at, gravity, spacing) = if space {
        (
            "scene-space",
            "front = { periodic = 0.0 }\nback = { periodic = 0.04 }",
            "[0.0, 0.0, 0.0]",
            "[0.04, 0.04, 0.05]",
            "quads = [[[-0.02, -0.02, 0.0], [0.06, -0.02, 0.0], [0.06, 0.06, 0.0], [-0.02, 0.06, 0.0]]]",
            "at = [0.02, 0.02, 0.0]\ndirection = [0.0, 0.0, 1.0]",
            "[1.7035, 0.0, -9.6610]",
            0.005,
        )
    } else {
        (
            "scene",
            "",
            "[0.0, 0.0]",
            "[0.04, 0.05]",
            "points = [[-0.02, 0.0], [0.06, 0.0]]",
            "at = [0.02, 0.0]\ndirection = [0.0, 1.0]",
            "[1.7035, -9.6610]",
            0.0025,
        )
    };
    format!(
        "case = \"{case}\"\nname = \"slab\"\ngravity = {gravity}\nspacing = {spacing}\nduration = 0.3\ninterval = 0.01\n\
         pictures = 10\njitter = 0.1\npreparation = \"{preparation}\"\n\
         [sides]\nleft = {{ periodic = 0.0 }}\nright = {{ periodic = 0.04 }}\n{sides}\nbottom = \"none\"\ntop = \"none\"\n\
         [[bodies]]\nshape = \"box\"\nlower = {lower}\nupper = {upper}\n\
         [[walls]]\nname = \"bed\"\n{bed}\n\
         [[gauges]]\nkind = \"depth\"\nname = \"height\"\n{at}\nwidth = 0.03\n"
    )
}

/// Root mean square of the speed `[m/s]` in each picture, and twice the mean height of the particles there `[m]`: the layer's
/// height, where it is evenly filled.
fn pictures(result: &CaseResult) -> Vec<(f64, f64)> {
    let up = if result.name == "scene" { 1 } else { 2 };
    let of_picture = |frame: &bagnold_harness::observation::Frame| {
        let count = frame.position.len() as f64;
        let (_, _, velocity) = frame.vectors.iter().find(|(name, ..)| name == "velocity").expect("velocities");
        let squares: f64 = velocity.iter().flatten().map(|part| part * part).sum();
        ((squares / count).sqrt(), 2.0 * frame.position.iter().map(|place| place[up]).sum::<f64>() / count)
    };
    result.frames[0].iter().map(of_picture).collect()
}

#[test]
fn a_prepared_slab_on_a_slope_below_its_angle_of_repose_rests_from_the_start() {
    for space in [false, true] {
        for preparation in ["settled", "stressed"] {
            let (prepared, _) = result_of(&slab(space, preparation));
            let seen = pictures(&prepared);
            let (fastest, heights) = (seen.iter().map(|one| one.0).fold(0.0, f64::max), seen.iter().map(|one| one.1));
            println!("{}, {preparation}: at most {fastest:.1e} m/s, {seen:?}", prepared.name);
            // the places of a liquid are closer, and its pressure is not quite that of the depth
            let (most, sunk) = if preparation == "settled" { (2e-4, 0.005) } else { (5e-4, 0.01) };
            assert!(seen.len() >= 10 && fastest < most, "{}: {fastest} m/s", prepared.name);
            // the lattice's height, which the densities belong to
            for height in heights {
                assert!((height / 0.05 - 1.0).abs() < sunk, "{}: {height} m", prepared.name);
            }
            assert!(metric(&prepared, "energy_residual").abs() < 1.0);
            assert_eq!(prepared.failures().count(), 0);
            // the clock starts at the release
            assert_eq!(prepared.tables[0].rows[0][0], 0.0);
        }
        let (released, _) = result_of(&slab(space, "none"));
        let unsettled = pictures(&released).iter().map(|one| one.0).fold(0.0, f64::max);
        println!("{}: at most {unsettled:.1e} m/s without the preparation", released.name);
        assert!(unsettled > 5e-3, "{unsettled} m/s: a slab that is released at once moves");
    }
}

/// A slope `[°]` beyond the friction of a layer of 10 mm.
struct Release {
    grains: MuI,
    solid_fraction: f64,
    slope: f64,
    stress_diffusion: f64,
}

impl Release {
    const HEIGHT: f64 = 0.01;
    const DURATION: f64 = 0.1;

    /// Mean way of the layer without particles `[m]`.
    fn way(&self) -> f64 {
        let layer = BagnoldProfile::of(&self.grains, Self::HEIGHT, self.solid_fraction, 9.81, self.slope);
        let step = 5e-4;
        let mut layer = LayerTransient::from_rest(layer, 50, step).expect("a layer");
        let steps = (Self::DURATION / step).round() as usize;
        let means = (0..steps).map(|_| {
            layer.step().expect("converges");
            layer.depth_mean()
        });
        means.sum::<f64>() * step
    }

    /// Mean way of the particles `[m]`: the mass that has crossed a line, over the mass of a length.
    fn way_of_particles(&self, preparation: &str) -> f64 {
        let Self { grains, solid_fraction, slope, stress_diffusion } = self;
        let (sin, cos) = slope.to_radians().sin_cos();
        let text = format!(
            "case = \"scene\"\nname = \"release\"\ngravity = [{}, {}]\nspacing = 0.00025\nduration = {}\ninterval = 0.005\n\
             jitter = 0.1\npreparation = \"{preparation}\"\n\
             [material]\nlaw = \"mu-i\"\nstatic_friction = {}\nlimiting_friction = {}\nreference_inertia = {}\n\
             grain_diameter = {}\ngrain_density = {}\n[bulk]\nsolid_fraction = {solid_fraction}\n\
             [numerics]\nstress_diffusion = {stress_diffusion}\n\
             [sides]\nleft = {{ periodic = 0.0 }}\nright = {{ periodic = 0.003 }}\nbottom = \"none\"\ntop = \"none\"\n\
             [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.003, {}]\n\
             [[walls]]\nname = \"floor\"\npoints = [[-0.01, 0.0], [0.013, 0.0]]\n\
             [[gauges]]\nkind = \"flux\"\nname = \"q\"\nfrom = [0.0015, 0.015]\nto = [0.0015, -0.00025]\n",
            9.81 * sin,
            -9.81 * cos,
            Self::DURATION,
            grains.static_friction,
            grains.limiting_friction,
            grains.reference_inertia,
            grains.grain_diameter,
            grains.grain_density,
            Self::HEIGHT,
        );
        let crossed = metric(&result_of(&text).0, "mass_crossed");
        crossed / (solid_fraction * grains.grain_density * Self::HEIGHT)
    }
}

#[test]
fn a_layer_that_starts_with_its_stress_goes_as_far_as_one_without_particles() {
    let law = |static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density| MuI {
        static_friction,
        limiting_friction,
        reference_inertia,
        grain_diameter,
        grain_density,
    };
    let glass = law(0.382, 0.643, 0.279, 5e-4, 2500.0);
    // steeper layers are weaker than their law with the usual diffusion of stress
    let sand = law(0.589, 1.248, 2.65, 3.2e-4, 2600.0);
    let releases = [
        Release { grains: glass, solid_fraction: 0.6, slope: 24.0, stress_diffusion: 0.1 },
        Release { grains: sand, solid_fraction: 0.62, slope: 32.3, stress_diffusion: 0.5 },
    ];
    for release in releases {
        let exact = release.way();
        let [stressed, released] =
            ["stressed", "none"].map(|preparation| release.way_of_particles(preparation) / exact - 1.0);
        println!("{}°: {exact} m, {stressed:+.3} with stress, {released:+.3} without", release.slope);
        assert!(stressed.abs() < 0.05 && released > 0.3, "{stressed}, {released}");
    }
}

#[test]
fn the_expected_cost_is_what_the_solver_takes() {
    let head = |name: &str, spacing: f64, duration: f64| {
        format!(
            "case = \"scene\"\nname = \"{name}\"\nspacing = {spacing}\nduration = {duration}\ninterval = {}\n",
            0.1 * duration
        )
    };
    let liquid = |viscosity: f64| {
        format!(
            "[material]\nlaw = \"newtonian\"\nviscosity = {viscosity}\n[bulk]\nsolid_fraction = 1.0\nbulk_density = 1000.0\n"
        )
    };
    let tank = "[[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.05]\n\
                [[walls]]\nname = \"tank\"\npoints = [[0.0, 0.2], [0.0, 0.0], [0.1, 0.0], [0.1, 0.2]]\n";
    let column = "[sides]\nleft = { mirror = 0.0 }\nright = \"none\"\nbottom = { open = -0.1 }\ntop = \"none\"\n\
                  [[bodies]]\nshape = \"polygon\"\npoints = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]\n\
                  [[walls]]\nname = \"floor\"\npoints = [[0.0, 0.0], [0.5, 0.0]]\n";
    let plunger = "[[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.05]\n\
                   [[walls]]\nname = \"tank\"\npoints = [[0.0, 0.1], [0.0, 0.0], [0.3, 0.0]]\n\
                   [[walls]]\nname = \"plunger\"\npoints = [[0.11, 0.0], [0.11, 0.1]]\nboth_sides = true\n\
                   motion = [[0.0, 0.0, 0.0], [0.05, 0.5, 0.0]]\n";
    let explicit = "[numerics]\nviscous_step = \"explicit\"\n";
    let scenes = [
        ("water", format!("{}stiffness = 200.0\n{}{tank}", head("water", 0.005, 0.1), liquid(1e-3))),
        ("grains", head("grains", 0.005, 0.2) + column),
        ("syrup", format!("{}{}{tank}{explicit}", head("syrup", 0.01, 0.02), liquid(500.0))),
        ("plunger", head("plunger", 0.01, 0.05) + plunger),
    ];
    for (name, text) in scenes {
        let (result, expected) = result_of(&text);
        let taken = result.runs[0].particle_steps();
        println!("{name}: {expected:.3e} particle-steps expected, {taken:.3e} taken");
        assert!((1.0 / 1.5..1.5).contains(&(expected / taken)), "{name}: {expected:.3e} for {taken:.3e}");
    }
}
