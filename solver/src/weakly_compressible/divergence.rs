//! Quantities that can leave their range in a weakly compressible run, and the rules.

/// A speed beyond this many sound speeds is a divergence `[-]`: weak compressibility has long been lost.
pub(crate) const LARGEST_MACH_NUMBER: f64 = 3.0;
/// Range of ρ/ρ0 beyond which a run has diverged `[-]`: dry grains may fly apart, nothing may be crushed.
pub(crate) const DENSITY_RANGE: (f64, f64) = (0.02, 2.0);

/// The quantity that left its range.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Speed above three sound speeds `[m/s]`, or not a number.
    Speed {
        /// Three sound speeds `[m/s]`.
        limit: f64,
    },
    /// Density below 0.02 or above 2 reference densities, or not a number.
    Density {
        /// Smallest and largest that are allowed `[kg/m³]`.
        limits: (f64, f64),
    },
    /// More neighbours than a list row can hold.
    Neighbours {
        /// As many as it can hold.
        limit: usize,
    },
    /// Distance from a wall of facets, negative behind it `[m]`.
    Penetration {
        /// Name of the wall.
        wall: String,
    },
    /// Travel of a wall under a load `[m]`, or angle of one that turns `[rad]`.
    DrivenWall {
        /// Which of both, and its unit.
        measure: (&'static str, &'static str),
        /// The wall and the end of its way.
        end: String,
    },
    /// Pressure before the rows of an inlet `[Pa]`.
    InflowPressure {
        /// Name of the inlet.
        inlet: String,
        /// Largest that is allowed `[Pa]`.
        limit: f64,
    },
    /// Particles in the arrays.
    Particles {
        /// Name of the inlet that adds some.
        inlet: String,
    },
    /// Residual of an implicit viscous step over its start; the particle is the one with the largest.
    ViscousResidual {
        /// `viscous_tolerance` `[-]`.
        tolerance: f64,
        /// Iterations after which a solve is given up.
        most_iterations: usize,
    },
}

impl Quantity {
    /// Name in messages, its unit or what is counted, and the rule that it broke, as it follows the value in a message.
    #[must_use]
    pub fn texts(&self) -> (&'static str, &'static str, String) {
        match self {
            Self::Speed { limit } => {
                ("speed", "m/s", format!(", above the {limit:.4e} m/s (three sound speeds) that the model allows"))
            }
            Self::Density { limits: (lower, upper) } => {
                ("density", "kg/m³", format!(", outside the {lower:.4e} to {upper:.4e} kg/m³ that the model allows"))
            }
            Self::Neighbours { limit } => {
                ("number of neighbours", "or more", format!(", above the {limit} that a neighbour list row can hold"))
            }
            Self::Penetration { wall } => ("distance", "m", format!(" before the wall `{wall}`: it has passed it")),
            Self::DrivenWall { measure: (name, unit), end } => (name, unit, format!(": {end}")),
            Self::InflowPressure { inlet, limit } => {
                let rule = format!(
                    ", above the {limit:.4e} Pa that compress the material by a tenth: the inlet `{inlet}` is blocked, since the \
                     material before it does not give way"
                );
                ("pressure", "Pa", rule)
            }
            Self::Particles { inlet } => {
                let rule = format!(", and the inlet `{inlet}` adds some: more than the neighbour list can address");
                ("number of particles", "in all", rule)
            }
            Self::ViscousResidual { tolerance, most_iterations: most } => {
                let rule =
                    format!(" after at most {most} iterations, above the {tolerance:.1e} of `viscous_tolerance`");
                ("viscous step", "(residual over its start)", rule)
            }
        }
    }
}

/// What a check of a range lets through.
pub(crate) type InRange<T> = Result<T, OutOfRange>;

/// A particle with a quantity out of its range.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OutOfRange {
    /// Storage index of the particle.
    pub(crate) index: usize,
    /// Identity of the particle, or of the one that is to take its place.
    pub(crate) identity: u32,
    /// Quantity and rule.
    pub(crate) quantity: Quantity,
    /// Value in the quantity's unit.
    pub(crate) value: f64,
}
