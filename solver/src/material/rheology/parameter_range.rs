//! The ranges that parameters of a law have to lie in. NaN lies in none of them.

use super::ParameterProblem;

/// Refuses what is not a finite number above zero.
pub(super) fn positive(field: &'static str, value: f64, remedy: &'static str) -> Option<ParameterProblem> {
    (!(value > 0.0 && value.is_finite())).then_some((field, value, "finite and greater than 0", remedy))
}

/// Refuses what is not a finite number of at least zero.
pub(super) fn not_negative(field: &'static str, value: f64, remedy: &'static str) -> Option<ParameterProblem> {
    (!(value >= 0.0 && value.is_finite())).then_some((field, value, "finite and not negative", remedy))
}

/// Refuses the friction parameters of μ(I) (31), (32) that give no law: 0 < μ_s ≤ μ_2, I_0, D, ρ_s > 0.
pub(super) fn friction(
    static_friction: f64,
    limiting_friction: f64,
    reference_inertia: f64,
    grain_diameter: f64,
    grain_density: f64,
) -> Option<ParameterProblem> {
    positive(
        "static_friction",
        static_friction,
        "give the tangent of the angle at which grains stop; 0.382 for glass beads",
    )
    .or_else(|| {
        let above_static = limiting_friction >= static_friction && limiting_friction.is_finite();
        (!above_static).then_some((
            "limiting_friction",
            limiting_friction,
            "finite and at least static_friction",
            "give the friction of fast flow, or static_friction itself for a law without rate dependence",
        ))
    })
    .or_else(|| {
        positive(
            "reference_inertia",
            reference_inertia,
            "give the inertial number where friction is midway; 0.279 for glass beads",
        )
    })
    .or_else(|| positive("grain_diameter", grain_diameter, "give the diameter in metres; 0.0005 for 0.5 mm"))
    .or_else(|| {
        positive(
            "grain_density",
            grain_density,
            "give the density of a grain in kg/m³, not of the bulk; 2500 for glass",
        )
    })
}

#[cfg(test)]
mod tests {
    use crate::material::rheology::{Bingham, HerschelBulkley, MuI, Newtonian, RegularisedMuI, Rheology};
    use serde::{Deserialize, de::value::MapDeserializer};

    const GLASS: MuI = MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };

    fn refused_field(law: Rheology) -> Option<&'static str> {
        law.parameter_problem().map(|(field, ..)| field)
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
            assert_eq!(refused_field(Rheology::MuI(MuI { static_friction: bad, ..GLASS })), Some("static_friction"));
            assert_eq!(
                refused_field(Rheology::MuI(MuI { limiting_friction: bad, ..GLASS })),
                Some("limiting_friction")
            );
            assert_eq!(
                refused_field(Rheology::MuI(MuI { reference_inertia: bad, ..GLASS })),
                Some("reference_inertia")
            );
            assert_eq!(refused_field(Rheology::MuI(MuI { grain_diameter: bad, ..GLASS })), Some("grain_diameter"));
            assert_eq!(refused_field(Rheology::MuI(MuI { grain_density: bad, ..GLASS })), Some("grain_density"));
            assert_eq!(refused_field(Rheology::Newtonian(Newtonian { viscosity: bad })), Some("viscosity"));
            let regularised = RegularisedMuI { regularisation_rate: bad, ..GLASS.regularised(0.01) };
            assert_eq!(refused_field(Rheology::RegularisedMuI(regularised)), Some("regularisation_rate"));
            let mud = Bingham { yield_stress: 1.0, plastic_viscosity: 1.0, regularisation_rate: 0.01 };
            assert_eq!(refused_field(Rheology::Bingham(Bingham { yield_stress: bad, ..mud })), Some("yield_stress"));
            assert_eq!(
                refused_field(Rheology::Bingham(Bingham { plastic_viscosity: bad, ..mud })),
                Some("plastic_viscosity")
            );
            assert_eq!(
                refused_field(Rheology::Bingham(Bingham { regularisation_rate: bad, ..mud })),
                Some("regularisation_rate")
            );
            let clay =
                HerschelBulkley { yield_stress: 1.0, consistency: 1.0, flow_index: 0.5, regularisation_rate: 0.01 };
            assert_eq!(
                refused_field(Rheology::HerschelBulkley(HerschelBulkley { flow_index: bad, ..clay })),
                Some("flow_index")
            );
            assert_eq!(
                refused_field(Rheology::HerschelBulkley(HerschelBulkley { consistency: bad, ..clay })),
                Some("consistency")
            );
        }
        let clay = HerschelBulkley { yield_stress: 1.0, consistency: 1.0, flow_index: 2.1, regularisation_rate: 0.01 };
        assert_eq!(refused_field(Rheology::HerschelBulkley(clay)), Some("flow_index"));
    }

    #[test]
    fn friction_that_falls_with_rate_is_refused_and_explained() {
        let (field, value, rule, remedy) =
            Rheology::MuI(MuI { limiting_friction: 0.3, ..GLASS }).parameter_problem().expect("refused");
        assert_eq!((field, value), ("limiting_friction", 0.3));
        assert!(rule.contains("static_friction") && !remedy.is_empty());
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
}
