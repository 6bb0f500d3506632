//! The parameters that every form of μ(I) has, and the shear rate that follows from them.

/// Shear rate γ̇_0 = I_0 √(p/ρ_s)/D `[1/s]` at which the inertial number (32) is the reference I_0 `[-]`.
#[inline]
pub(super) fn reference_rate(reference_inertia: f64, grain_diameter: f64, grain_density: f64, pressure: f64) -> f64 {
    reference_inertia * (pressure / grain_density).sqrt() / grain_diameter
}

/// Declares a law with the parameters of μ(I), and more after them.
macro_rules! law_of_grains {
    ($(#[$about:meta])+ pub struct $law:ident { $($more:tt)* }) => {
        $(#[$about])+
        #[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct $law {
            /// Friction coefficient μ_s `[-]` of slow flow; in files `friction_angle` `[°]`, its arctangent, may stand in its place.
            /// An angle of repose lies some degrees below it. A triaxial test's angle φ of failure gives μ_s = sin φ in plane flow: the
            /// largest shear stress over the mean stress in the plane.
            #[schemars(
                transform = above(0.0, "give the tangent of the angle at which grains stop; 0.382 for glass beads")
            )]
            pub static_friction: f64,
            /// Friction coefficient μ_2 `[-]` that fast flow tends to, ≥ μ_s.
            pub limiting_friction: f64,
            /// Inertial number I_0 `[-]` at which friction is midway between μ_s and μ_2.
            #[schemars(
                transform = above(0.0, "give the inertial number where friction is midway; 0.279 for glass beads")
            )]
            pub reference_inertia: f64,
            /// Grain diameter D `[m]`.
            #[schemars(transform = above(0.0, "give the diameter in metres; 0.0005 for 0.5 mm"))]
            pub grain_diameter: f64,
            /// Density ρ_s `[kg/m³]` of a grain, not of the bulk.
            #[schemars(transform = above(0.0, "give the density of a grain in kg/m³, not of the bulk; 2500 for glass"))]
            pub grain_density: f64,
            $($more)*
        }

        impl $law {
            pub(super) fn friction_problem(&self) -> Option<ParameterProblem> {
                rising_friction(self.static_friction, self.limiting_friction)
            }
        }
    };
}
pub(super) use law_of_grains;
