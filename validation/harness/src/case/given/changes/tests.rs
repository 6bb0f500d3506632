use super::*;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::parameter::not_negative;
use schemars::JsonSchema;
use serde::Deserialize;

fn resolve<P>(case: &str, defaults: &P, changes: &Changes<'_>) -> Result<P, ParameterError>
where
    P: Serialize + DeserializeOwned + JsonSchema + 'static,
{
    let table = checked(case, bagnold_solver::parameter::schema_of::<P>(), &table_of(defaults), changes, |_, _| {})?;
    typed(case, table).map_err(|error| changes.blamed(error))
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
struct LayerExample {
    depth: f64,
    rows: usize,
    angles: Vec<f64>,
    grains: GrainsExample,
    law: LawExample,
    material: MaterialExample,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
struct GrainsExample {
    diameter: f64,
    spread: Option<f64>,
    packing: Packing,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Packing {
    Lattice,
    Jittered,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum LawExample {
    Newtonian { viscosity: f64 },
    Bingham { viscosity: f64, yield_stress: f64 },
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
enum MaterialExample {
    Newtonian {
        #[schemars(transform = not_negative("give it in Pa·s"))]
        viscosity: f64,
    },
    MuI {
        static_friction: f64,
        limiting_friction: f64,
    },
}

fn layer() -> LayerExample {
    LayerExample {
        depth: 0.01,
        rows: 20,
        angles: vec![22.0, 24.0],
        grains: GrainsExample { diameter: 1e-3, spread: None, packing: Packing::Lattice },
        law: LawExample::Newtonian { viscosity: 1.0 },
        material: MaterialExample::MuI { static_friction: 0.4, limiting_friction: 0.6 },
    }
}

fn resolved(file: &str, settings: &[&str]) -> Result<LayerExample, String> {
    let settings: Vec<String> = settings.iter().map(|&text| text.to_owned()).collect();
    let fields = toml::from_str(file).expect("test TOML");
    let changes = Changes { file: Some((Path::new("layer.toml"), fields)), settings: &settings, ..Changes::default() };
    resolve("layer", &layer(), &changes).map_err(|error| error.to_string())
}

fn message(file: &str, settings: &[&str]) -> String {
    resolved(file, settings).expect_err("bad input must be refused")
}

#[test]
fn a_file_and_settings_change_only_what_they_name() {
    let changed = resolved(
        "angles = [20, 25]\ngrains.diameter = 2e-3\nlaw.bingham = { viscosity = 1, yield_stress = 2 }",
        &["rows=40", "grains.packing=jittered", "grains.spread=0.1", "angles[1]=30.0", "law.bingham.yield_stress=3"],
    )
    .expect("valid changes");
    let expected = LayerExample {
        depth: 0.01,
        rows: 40,
        angles: vec![20.0, 30.0],
        grains: GrainsExample { diameter: 2e-3, spread: Some(0.1), packing: Packing::Jittered },
        law: LawExample::Bingham { viscosity: 1.0, yield_stress: 3.0 },
        ..layer()
    };
    assert_eq!(changed, expected);
    let beyond = message("", &["angles[2]=30.0"]);
    assert!(beyond.starts_with("`--set angles[2]=30.0`: `angles[2]`: unknown field"), "{beyond}");
}

#[test]
fn unknown_fields_are_refused_with_the_nearest_name() {
    assert_eq!(
        message("dept = 0.02", &[]),
        "layer.toml: `dept`: unknown field; did you mean `depth`? `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("[grains]\ndiametre = 0.002", &[]),
        "layer.toml: `grains.diametre`: unknown field; did you mean `grains.diameter`? `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("", &["diameter=0.1"]),
        "`--set diameter=0.1`: `diameter`: unknown field; did you mean `grains.diameter`? `bagnold show layer` prints all fields"
    );
    assert_eq!(message("xyz = 1", &[]), "layer.toml: `xyz`: unknown field; `bagnold show layer` prints all fields");
}

#[test]
fn wrong_values_are_refused_with_the_type_they_should_have() {
    assert_eq!(
        message("depth = \"deep\"", &[]),
        "layer.toml: `depth` is \"deep\", but must be a number; `bagnold show layer` prints a valid value"
    );
    assert_eq!(
        message("", &["depth=3 mm"]),
        "`--set depth=3 mm`: `depth` is 3 mm, but must be a number without a unit; `bagnold show layer` prints a valid value"
    );
    assert_eq!(
        message("rows = -3", &[]),
        "layer.toml: `rows` is -3, but must be a whole number without sign, decimal point or exponent; `bagnold show layer` prints a valid value"
    );
    assert_eq!(
        message("grains.packing = \"latice\"", &[]),
        "layer.toml: `grains.packing` is \"latice\", but must be one of `lattice`, `jittered`; did you mean `lattice`?"
    );
    assert_eq!(
        message("law.bingham = { viscosity = 1, yield_stress = true }", &[]),
        "layer.toml: `law.bingham.yield_stress` is true, but must be a number; `bagnold show layer` prints a valid value"
    );
    assert_eq!(
        message("law.binghm.viscosity = 1", &[]),
        "layer.toml: `law.binghm` is { viscosity = 1 }, but must be one of `newtonian`, `bingham`; did you mean `bingham`?"
    );
    assert_eq!(
        message("law.bingham.viscosity = 1", &[]),
        "layer.toml: `law.bingham.yield_stress`: missing; `bagnold schema layer` tells what it is"
    );
    assert_eq!(
        message("law.bingham = {}", &[]),
        "layer.toml: `law.bingham.viscosity`: missing; add `viscosity`, `yield_stress`"
    );
}

#[test]
fn settings_of_a_wrong_form_path_or_type_are_refused() {
    assert_eq!(
        message("", &["depth"]),
        "`--set depth`: `path` is \"depth\", but must be the dotted path of a parameter, followed by `=` and a value; write it as in `angles=[22.0, 24.0]`"
    );
    assert_eq!(
        message("", &["grains.diametre=0.002"]),
        "`--set grains.diametre=0.002`: `grains.diametre`: unknown field; did you mean `grains.diameter`? `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("", &["depth.x=1"]),
        "`--set depth.x=1`: `depth.x`: unknown field; did you mean `depth`? `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("", &["rows=many"]),
        "`--set rows=many`: `rows` is many, but must be a whole number without sign, decimal point or exponent; `bagnold show layer` prints a valid value"
    );
    assert_eq!(
        message("", &["rows=1\ndepth=3"]),
        "`--set rows=1\\ndepth=3`: `rows` is 1\\ndepth=3, but must be a whole number without sign, decimal point or exponent; `bagnold show layer` prints a valid value"
    );
}

#[test]
fn a_field_that_is_set_twice_is_refused_by_its_name() {
    for (settings, field) in [
        (["rows=3", "rows=4"], "rows"),
        (["rows=3", "rows = 3"], "rows"),
        (["grains.diameter=1e-3", "grains={diameter=2e-3}"], "grains.diameter"),
        (["grains={diameter=2e-3}", "grains.diameter=1e-3"], "grains.diameter"),
        (["material={law=\"newtonian\"}", "material.law=newtonian"], "material.law"),
        (["grains.diameter=1e-3", "grains=3"], "grains"),
    ] {
        let expected = format!("`{field}`: given twice, first by `--set {}`; give each field once", settings[0]);
        let message = message("", &settings);
        assert!(message.starts_with("`--set ") && message.ends_with(&expected), "{message}");
    }
    // fields of one table may be given apart
    assert!(resolved("", &["material={law=\"newtonian\"}", "material.viscosity=2.0"]).is_ok());
    // a path through a value stays a path that does not exist
    assert!(message("", &["depth=1", "depth.x=2"]).contains("`depth.x`: unknown field"));
}

#[test]
fn a_setting_takes_the_blame_for_its_field_only() {
    let settings = ["grains.diameter=1".to_owned(), "angles=[1]".to_owned()];
    assert!(is_set(&settings, "grains.diameter"));
    assert!(is_set(&settings, "angles[0]"));
    assert!(!is_set(&settings, "grains"));
    assert!(!is_set(&settings, "depth"));
}

#[test]
fn another_law_takes_nothing_of_the_defaults_in_whatever_order_it_is_given() {
    let newtonian = LayerExample { material: MaterialExample::Newtonian { viscosity: 2.0 }, ..layer() };
    for settings in
        [["material.law=newtonian", "material.viscosity=2"], ["material.viscosity=2", "material.law=newtonian"]]
    {
        assert_eq!(resolved("", &settings).as_ref(), Ok(&newtonian));
    }
    assert_eq!(resolved("[material]\nlaw = \"newtonian\"", &["material.viscosity=2"]), Ok(newtonian));
    let steeper =
        LayerExample { material: MaterialExample::MuI { static_friction: 0.5, limiting_friction: 0.6 }, ..layer() };
    assert_eq!(resolved("material.static_friction = 0.5", &[]).as_ref(), Ok(&steeper));
    assert_eq!(resolved("", &["material.law=mu-i", "material.static_friction=0.5"]), Ok(steeper));
}

#[test]
fn a_friction_angle_stands_for_its_tangent_where_the_law_has_one() {
    let steeper = LayerExample {
        material: MaterialExample::MuI { static_friction: libm::tan(0.5), limiting_friction: 0.6 },
        ..layer()
    };
    let angle = 0.5_f64.to_degrees();
    assert_eq!(resolved(&format!("material.friction_angle = {angle:?}"), &[]).as_ref(), Ok(&steeper));
    assert_eq!(resolved("", &[&format!("material.friction_angle={angle:?}")]).as_ref(), Ok(&steeper));
    assert_eq!(
        message("", &["friction_angle=20"]),
        "`--set friction_angle=20`: `friction_angle`: unknown field; did you mean `material.friction_angle`? `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("material.friction_angle = \"27.5°\"", &[]),
        "layer.toml: `material.friction_angle` is \"27.5°\", but must be a number of degrees without its unit; write 27.5 for 27.5°"
    );
    assert_eq!(
        message("material = { friction_angle = 20, static_friction = 0.4 }", &[]),
        "layer.toml: `material.friction_angle`: given together with `static_friction` (0.4), the tangent of the angle; leave one of the two out"
    );
    assert_eq!(
        message("material = { law = \"newtonian\", viscosity = 1, friction_angle = 20 }", &[]),
        "layer.toml: `material.friction_angle`: unknown field; `bagnold show layer` prints all fields"
    );
}

#[test]
fn laws_that_do_not_exist_or_lack_a_parameter_are_refused() {
    assert_eq!(
        message("", &["material.law=newtonain"]),
        "`--set material.law=newtonain`: `material.law` is newtonain, but must be one of `newtonian`, `mu-i`; did you mean `newtonian`?"
    );
    assert_eq!(
        message("material.law = \"newtonian\"", &[]),
        "layer.toml: `material.viscosity`: missing; `bagnold schema layer` tells what it is"
    );
    assert_eq!(
        message("", &["material.law=newtonian", "material.viscosity=1", "material.static_friction=0.4"]),
        "`--set material.static_friction=0.4`: `material.static_friction`: unknown field; `bagnold show layer` prints all fields"
    );
    assert_eq!(
        message("", &["material.law=newtonian", "material.viscosity=-1"]),
        "`material.viscosity` is -1, but must be finite and not negative; give it in Pa·s"
    );
}

#[test]
fn a_law_that_nobody_knows_is_refused_at_its_key() {
    #[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
    struct BedExample {
        material: Rheology,
    }
    let defaults = BedExample { material: Rheology::Newtonian(Newtonian { viscosity: 1.0 }) };
    let settings = ["material.law=newtonain".to_owned()];
    let error = resolve("bed", &defaults, &Changes { settings: &settings, ..Changes::default() })
        .expect_err("refused")
        .to_string();
    assert!(
        error.starts_with("`--set material.law=newtonain`: `material.law` is newtonain, but must be one of "),
        "{error}"
    );
    assert!(error.contains("`mu-i`") && error.ends_with("did you mean `newtonian`?"), "{error}");
}

#[test]
fn what_the_maker_of_a_law_says_is_told_of_its_field() {
    let text = "`friction_growth` is -1, but must be positive; give it without a unit\n";
    assert_eq!(super::said(text), Some(("friction_growth", "-1", "positive", "give it without a unit")));
    assert_eq!(super::said("a law without words"), None);
}
