//! Ranges of the laws' parameters.

use crate::material::rheology::{
    Bingham, HerschelBulkley, MuI, Newtonian, NonlocalMuI, RegularisedMuI, Rheology, SofteningDruckerPrager,
};
use serde::{Deserialize, de::value::MapDeserializer};

const GLASS: MuI = MuI {
    static_friction: 0.382,
    limiting_friction: 0.643,
    reference_inertia: 0.279,
    grain_diameter: 0.5e-3,
    grain_density: 2500.0,
};

fn refused_field(law: Rheology) -> Option<String> {
    law.parameter_problem().map(|problem| problem.field)
}

#[test]
fn sound_parameters_pass() {
    assert_eq!(refused_field(Rheology::MuI(GLASS)), None);
    assert_eq!(refused_field(Rheology::MuI(MuI { limiting_friction: 0.382, ..GLASS })), None);
    assert_eq!(refused_field(Rheology::Newtonian(Newtonian { viscosity: 0.0 })), None);
    let film = HerschelBulkley { yield_stress: 0.0, consistency: 1.0, flow_index: 2.0, regularisation_rate: 0.01 };
    assert_eq!(refused_field(Rheology::HerschelBulkley(film)), None);
}

#[test]
fn each_bad_parameter_is_named() {
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(
            refused_field(Rheology::MuI(MuI { static_friction: bad, ..GLASS })),
            Some("static_friction".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::MuI(MuI { limiting_friction: bad, ..GLASS })),
            Some("limiting_friction".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::MuI(MuI { reference_inertia: bad, ..GLASS })),
            Some("reference_inertia".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::MuI(MuI { grain_diameter: bad, ..GLASS })),
            Some("grain_diameter".to_owned())
        );
        assert_eq!(refused_field(Rheology::MuI(MuI { grain_density: bad, ..GLASS })), Some("grain_density".to_owned()));
        assert_eq!(refused_field(Rheology::Newtonian(Newtonian { viscosity: bad })), Some("viscosity".to_owned()));
        let regularised = RegularisedMuI { regularisation_rate: bad, ..GLASS.regularised(0.01) };
        assert_eq!(refused_field(Rheology::RegularisedMuI(regularised)), Some("regularisation_rate".to_owned()));
        let mud = Bingham { yield_stress: 1.0, plastic_viscosity: 1.0, regularisation_rate: 0.01 };
        assert_eq!(
            refused_field(Rheology::Bingham(Bingham { yield_stress: bad, ..mud })),
            Some("yield_stress".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::Bingham(Bingham { plastic_viscosity: bad, ..mud })),
            Some("plastic_viscosity".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::Bingham(Bingham { regularisation_rate: bad, ..mud })),
            Some("regularisation_rate".to_owned())
        );
        let clay = HerschelBulkley { yield_stress: 1.0, consistency: 1.0, flow_index: 0.5, regularisation_rate: 0.01 };
        assert_eq!(
            refused_field(Rheology::HerschelBulkley(HerschelBulkley { flow_index: bad, ..clay })),
            Some("flow_index".to_owned())
        );
        assert_eq!(
            refused_field(Rheology::HerschelBulkley(HerschelBulkley { consistency: bad, ..clay })),
            Some("consistency".to_owned())
        );
    }
    let clay = HerschelBulkley { yield_stress: 1.0, consistency: 1.0, flow_index: 2.1, regularisation_rate: 0.01 };
    assert_eq!(refused_field(Rheology::HerschelBulkley(clay)), Some("flow_index".to_owned()));
}

#[test]
fn friction_that_falls_with_rate_is_refused_and_explained() {
    let problem = Rheology::MuI(MuI { limiting_friction: 0.3, ..GLASS }).parameter_problem().expect("refused");
    assert_eq!((problem.field.as_str(), problem.value.as_str()), ("limiting_friction", "0.3"));
    assert!(problem.rule.contains("static_friction") && !problem.remedy.is_empty());
}

#[test]
fn friction_of_fast_flow_is_bounded() {
    for (static_friction, limiting_friction) in [(0.4, f64::INFINITY), (f64::INFINITY, f64::INFINITY), (0.4, f64::NAN)]
    {
        let problem = super::rising_friction(static_friction, limiting_friction).expect("refused");
        assert_eq!(problem.field, "limiting_friction");
    }
    assert!(super::rising_friction(0.4, 0.4).is_none() && super::rising_friction(0.4, 0.7).is_none());
}

#[test]
fn a_misspelt_parameter_is_not_read() {
    let read = |fields: &[(&'static str, f64)]| {
        Newtonian::deserialize(MapDeserializer::<_, serde::de::value::Error>::new(fields.iter().copied()))
    };
    assert_eq!(read(&[("viscosity", 1.5)]), Ok(Newtonian { viscosity: 1.5 }));
    assert!(read(&[("viscosity", 1.5), ("viscocity", 2.0)]).is_err());
    assert!(read(&[]).is_err());
}

#[test]
fn only_laws_that_carry_their_stress_along_have_a_strength_at_rest() {
    let soil = SofteningDruckerPrager { peak_friction: 0.6, peak_cohesion: 20.0, ..GLASS.into() };
    assert_eq!(Rheology::SofteningDruckerPrager(soil).strength_at_rest(100.0), Some(80.0));
    for law in [Rheology::MuI(GLASS), Rheology::NonlocalMuI(NonlocalMuI::of(GLASS))] {
        assert_eq!(law.strength_at_rest(100.0), Some(38.2), "{law:?}");
    }
    let regularised = Rheology::RegularisedMuI(GLASS.regularised(0.01));
    for law in [regularised, Rheology::Newtonian(Newtonian { viscosity: 1.0 })] {
        assert_eq!(law.strength_at_rest(100.0), None, "{law:?}");
    }
}
