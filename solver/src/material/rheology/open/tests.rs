use super::{OpenLaw, OpenLawError, OpenPlasticLaw, Parameters, RegistrationError, register, registered};
use crate::lanes::algebra::{load_tensor, store_tensor};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes};
use crate::material::rheology::field::FieldStep;
use crate::material::rheology::{ElasticModuli, MuI, PlasticLaw, Rheology, TrialStress, ViscousLaw};
use crate::vector::Tensor;
use serde::Deserialize;
use std::sync::Once;

/// A copy of μ(I) as a user's crate would have it.
#[derive(Debug, Deserialize)]
#[serde(transparent)]
struct Copied(MuI);

impl OpenPlasticLaw for Copied {
    fn admissible_shear_stress(&self, trial: &TrialStress<f64>) -> f64 {
        self.0.admissible_shear_stress(trial)
    }

    fn yield_stress(&self, pressure: f64) -> f64 {
        self.0.yield_stress(pressure)
    }

    fn contact_friction(&self) -> f64 {
        self.0.contact_friction()
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.0.viscosity(shear_rate, pressure)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plain {
    viscosity: f64,
}

impl ViscousLaw for Plain {
    fn viscosity(&self, _shear_rate: f64, _pressure: f64) -> f64 {
        self.viscosity
    }

    fn largest_viscosity(&self, _pressure: f64) -> f64 {
        self.viscosity
    }
}

fn plain(parameters: &Parameters) -> Result<OpenLaw, OpenLawError> {
    Ok(OpenLaw::viscous(parameters.read::<Plain>()?))
}

fn register_both() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        register("copied-mu-i", |parameters| Ok(OpenLaw::plastic(parameters.read::<Copied>()?))).expect("a new name");
        register("plain", plain).expect("a new name");
    });
}

const GLASS: [(&str, f64); 5] = [
    ("static_friction", 0.382),
    ("limiting_friction", 0.643),
    ("reference_inertia", 0.279),
    ("grain_diameter", 0.5e-3),
    ("grain_density", 2500.0),
];

/// The open copy and the built-in law.
fn pair() -> (Rheology, Rheology) {
    register_both();
    let built_in = Parameters::new(GLASS.map(|(name, value)| (name.to_owned(), value)).to_vec()).read::<MuI>();
    (Rheology::open("copied-mu-i", &GLASS).expect("a law"), Rheology::MuI(built_in.expect("its parameters")))
}

struct Update<'a> {
    law: &'a Rheology,
    stress: &'a mut [Tensor<3>],
    gradient: &'a Tensor<3>,
    pressures: &'a [f64; LANES],
    elasticity: &'a mut [f64; LANES],
}

impl LanePass for Update<'_> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let gradient = load_tensor::<V, 3>(&[*self.gradient; LANES]);
        let pressure = V::load(self.pressures);
        let stress = load_tensor::<V, 3>(self.stress);
        let none = FieldStep::alone(V::splat(0.0));
        let (stress, field) = self
            .law
            .updated_states(&stress, &gradient, pressure, &none, ElasticModuli { shear: 2e4, bulk: 0.0 }, 1e-3)
            .stress_and_field();
        *self.elasticity = self.law.elasticity(stress[0][1], pressure, &FieldStep::alone(field), 0.0).to_array();
        store_tensor(&stress, self.stress);
    }
}

#[test]
fn an_open_copy_gives_the_stress_of_the_built_in_law_to_the_last_bit() {
    let (open, built_in) = pair();
    let gradient = Tensor::<3>::new(0.5, 3.0, -1.0, 0.2, -0.4, 0.0, 1.0, 2.0, 0.1);
    let pressures = [-5.0, 0.0, 1e-3, 1.0, 20.0, 300.0, 4e3, f64::NAN];
    for set in InstructionSet::available() {
        let mut found = [[Tensor::<3>::zeros(); LANES]; 2];
        let mut elasticity = [[0.0; LANES]; 2];
        for (k, law) in [&open, &built_in].into_iter().enumerate() {
            for _ in 0..5 {
                let (stress, elasticity) = (&mut found[k][..], &mut elasticity[k]);
                set.run(Update { law, stress, gradient: &gradient, pressures: &pressures, elasticity });
            }
        }
        assert_eq!(found[0], found[1]);
        assert_eq!(elasticity[0].map(f64::to_bits), elasticity[1].map(f64::to_bits));
        assert!(found[0][5].norm() > 10.0);
    }
    assert_eq!(open.viscosity(3.0, 100.0), built_in.viscosity(3.0, 100.0));
    assert!(open.is_plastic() && open.largest_viscosity(1.0) == 0.0 && open.parameter_problem().is_none());
    assert_eq!(open.contact_friction(), 0.382);
}

#[test]
fn a_file_finds_it_by_name_and_writes_it_back() {
    let (open, built_in) = pair();
    for (law, name) in [(open, "copied-mu-i"), (built_in, "mu-i")] {
        let text = toml::to_string(&law).expect("a table");
        assert!(
            text.starts_with(&format!("law = \"{name}\"\n")) && text.contains("static_friction = 0.382\n"),
            "{text}"
        );
        assert_eq!(toml::from_str::<Rheology>(&text), Ok(law));
    }
    let read: Rheology = toml::from_str("viscosity = 3\nlaw = \"plain\"").expect("whole numbers are numbers");
    assert_eq!((read.viscosity(1.0, 0.0), read.is_plastic()), (3.0, false));
    assert_eq!(read, Rheology::open("plain", &[("viscosity", 3.0)]).expect("a law"));
    assert_ne!(read, Rheology::open("plain", &[("viscosity", 4.0)]).expect("a law"));
}

#[test]
fn defect_in_a_file_is_named() {
    register_both();
    let problem = |text: &str| toml::from_str::<Rheology>(text).expect_err("refused").message().to_owned();
    let unknown = problem("law = \"mu-j\"");
    assert!(unknown.starts_with("unknown variant `mu-j`, expected one of `newtonian`, `bingham`"), "{unknown}");
    assert!(
        unknown.contains("`mu-i`") && unknown.contains("`copied-mu-i`") && unknown.contains("`plain`"),
        "{unknown}"
    );
    assert_eq!(problem("viscosity = 1.0"), "missing field `law`");
    assert_eq!(problem("law = 3"), "`law` must be the name of a law");
    for law in ["newtonian", "plain"] {
        let of = |rest: &str| problem(&format!("law = \"{law}\"\n{rest}"));
        assert_eq!(of("viscocity = 1.0"), "unknown field `viscocity`, expected `viscosity`");
        assert_eq!(of(""), "missing field `viscosity`");
    }
    let text = problem("law = \"plain\"\nviscosity = \"thick\"");
    assert_eq!(text, "invalid type: string \"thick\", expected a number for `viscosity`");
}

#[test]
fn a_name_is_given_once() {
    register_both();
    for name in ["mu-i", "plain"] {
        assert_eq!(register(name, plain), Err(RegistrationError { name }));
    }
    assert!(registered().contains(&"plain"));
}
