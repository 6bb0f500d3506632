//! Parameters and tiers.

use super::sensitivities::Sensitivities;
use crate::case::{ParameterError, Tier};
use crate::cases::rules;
use crate::reference::bed_load_layer::{Closures, Stream};
use serde::{Deserialize, Serialize};

/// The water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// Depth h above the bed `[m]`.
    pub depth: f64,
    /// Density ρ_f `[kg/m³]`.
    pub density: f64,
    /// Kinematic viscosity ν `[m²/s]`.
    pub kinematic_viscosity: f64,
}

/// The grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grain {
    /// Depth of the bed `[m]`.
    pub bed_depth: f64,
    /// Depth of the lowest part of the bed, whose grains are held `[m]`.
    pub held_depth: f64,
    /// Density ρ_s `[kg/m³]`.
    pub density: f64,
    /// Diameter d `[m]`.
    pub diameter: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedLoad1dParameters {
    /// Slopes tanθ `[-]`.
    pub slopes: Vec<f64>,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Height of a cell `[m]`.
    pub cell_height: f64,
    /// Speed of the second start `[m/s]`; 0 for none.
    pub fast_start: f64,
    /// Heights of cells for the order with dilation `[m]`, each half the one before; empty for none.
    pub dilating_cell_heights: Vec<f64>,
    /// The same with a given solid fraction.
    pub frozen_cell_heights: Vec<f64>,
    /// The water.
    pub water: Water,
    /// The grains.
    pub grains: Grain,
    /// Closures.
    pub closures: Closures,
    /// Other closures, one at a time.
    pub sensitivities: Sensitivities,
}

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("slopes", "tanθ [-]"),
    ("gravity", "[m/s²]"),
    ("cell_height", "[m]"),
    ("fast_start", "[m/s], speed of the water and the upper grains in a second start; 0 for none"),
    ("dilating_cell_heights", "[m], three or more, each half the one before, for the order; empty for none"),
    ("frozen_cell_heights", "[m], the same with a given solid fraction"),
    ("water.depth", "h [m]"),
    ("water.density", "ρ_f [kg/m³]"),
    ("water.kinematic_viscosity", "ν [m²/s]"),
    ("grains.bed_depth", "[m]"),
    ("grains.held_depth", "[m], lowest part of the bed, whose grains are held while water seeps through"),
    ("grains.density", "ρ_s [kg/m³]"),
    ("grains.diameter", "d [m]"),
    ("closures.static_friction", "μ_s [-]"),
    ("closures.limiting_friction", "μ_2 [-]"),
    ("closures.reference_inertia", "I_0 [-]"),
    ("closures.regularisation_rate", "γ_r [1/s], below it friction falls to zero"),
    ("closures.largest_fraction", "φ_max [-]"),
    ("closures.dilation", "B [-] in φ = φ_max/(1 + B I)"),
    (
        "closures.drag",
        "\"di-felice\", \"wen-yu\", \"ergun\", \"schiller-naumann\" or \"morsi-alexander\"; \"gidaspow\" jumps at φ = 0.2 and gives no steady state",
    ),
    ("closures.mixing_length", "\"integral\", \"root\", \"linear\" or \"none\""),
    ("closures.karman", "κ [-]"),
    ("sensitivities.drag", "laws to be compared"),
];

impl BedLoad1dParameters {
    pub(super) fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            slopes: vec![0.02, 0.03, 0.05],
            gravity: 9.81,
            cell_height: 2.5e-4,
            fast_start: 2.0,
            dilating_cell_heights: vec![1e-3, 5e-4, 2.5e-4],
            frozen_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4],
            water: Water { depth: 0.046, density: 1000.0, kinematic_viscosity: 1e-6 },
            grains: Grain { bed_depth: 0.04, held_depth: 0.0, density: 2600.0, diameter: 5e-3 },
            closures: Closures::default(),
            sensitivities: Sensitivities::none(),
        };
        let paper = Self {
            dilating_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4, 6.25e-5],
            frozen_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4, 6.25e-5],
            sensitivities: Sensitivities::literature(),
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { cell_height: 6.25e-5, ..paper },
        }
    }

    /// The stream on a slope tanθ.
    pub(super) fn stream(&self, slope: f64) -> Stream {
        Stream {
            slope,
            flow_depth: self.water.depth,
            bed_depth: self.grains.bed_depth,
            held_depth: self.grains.held_depth,
            gravity: self.gravity,
            fluid_density: self.water.density,
            kinematic_viscosity: self.water.kinematic_viscosity,
            grain_density: self.grains.density,
            grain_diameter: self.grains.diameter,
        }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        for (index, &slope) in self.slopes.iter().enumerate() {
            let field = format!("slopes[{index}]");
            rules::positive(&field, slope, "give tanθ, such as 0.03; without a slope nothing flows")?;
            rules::between(&field, slope, 0.0, 0.2, "on steeper slopes the bed itself would slide")?;
        }
        rules::positive("gravity", self.gravity, "give it in m/s², such as 9.81")?;
        let Water { depth, density, kinematic_viscosity } = self.water;
        rules::positive("water.depth", depth, "give it in metres, such as 0.046")?;
        rules::positive("water.density", density, "give it in kg/m³, such as 1000")?;
        rules::positive("water.kinematic_viscosity", kinematic_viscosity, "give it in m²/s, 1e-6 for water")?;
        let grains = &self.grains;
        rules::positive("grains.bed_depth", grains.bed_depth, "give it in metres, such as 0.04")?;
        let remedy = "hold less than the whole bed, or 0 for none";
        rules::between("grains.held_depth", grains.held_depth, 0.0, 0.9 * grains.bed_depth, remedy)?;
        rules::positive("grains.diameter", grains.diameter, "give it in metres; 0.005 for 5 mm")?;
        rules::positive("grains.density", grains.density, "give it in kg/m³, such as 2600")?;
        if grains.density <= density {
            let rule = "greater than the density of the water";
            let remedy = "grains that float are no bed load";
            return Err(ParameterError::field("grains.density", grains.density, rule, remedy));
        }
        rules::between("fast_start", self.fast_start, 0.0, 100.0, "give it in m/s, or 0 for no second start")?;
        closures("closures", &self.closures)?;
        self.cells("cell_height", self.cell_height)?;
        for (name, heights) in
            [("dilating_cell_heights", &self.dilating_cell_heights), ("frozen_cell_heights", &self.frozen_cell_heights)]
        {
            for (index, &height) in heights.iter().enumerate() {
                let field = format!("{name}[{index}]");
                self.cells(&field, height)?;
                if index > 0 && (heights[index - 1] / height - 2.0).abs() > 1e-6 {
                    let remedy = "the order compares means over two cells with one";
                    return Err(ParameterError::field(&field, height, "half the height before it", remedy));
                }
            }
        }
        self.sensitivities.check(self)
    }

    /// A height of cells that divides all depths.
    pub(super) fn cells(&self, field: &str, height: f64) -> Result<(), ParameterError> {
        rules::positive(field, height, "give it in metres, such as 2.5e-4")?;
        let depths = [self.water.depth, self.grains.bed_depth, self.grains.held_depth];
        let fits = |depth: &f64| (depth / height - (depth / height).round()).abs() < 1e-6;
        if depths.iter().all(fits) && depths[0] / height >= 10.0 && (depths[0] + depths[1]) / height <= 1e5 {
            return Ok(());
        }
        let rule = "such that the depths of water, bed and held grains are whole multiples of it, at most 1e5 in all";
        Err(ParameterError::field(
            field,
            height,
            rule,
            "2.5e-4 divides all depths that are given in quarters of a millimetre",
        ))
    }
}

/// Rules of the closures.
pub(in crate::cases) fn closures(path: &str, closures: &Closures) -> Result<(), ParameterError> {
    let field = |name: &str| format!("{path}.{name}");
    rules::positive(&field("static_friction"), closures.static_friction, "give μ_s, such as 0.35")?;
    rules::positive(&field("limiting_friction"), closures.limiting_friction, "give μ_2, such as 0.97")?;
    if closures.limiting_friction <= closures.static_friction {
        let rule = "greater than the static friction";
        let remedy = "friction grows from μ_s at rest to μ_2 in fast shear";
        return Err(ParameterError::field(&field("limiting_friction"), closures.limiting_friction, rule, remedy));
    }
    rules::positive(&field("reference_inertia"), closures.reference_inertia, "give I_0, such as 0.69")?;
    rules::positive(&field("regularisation_rate"), closures.regularisation_rate, "give it in 1/s, such as 5e-3")?;
    let remedy = "grains at rest fill 0.5 to 0.64 of the space";
    rules::between(&field("largest_fraction"), closures.largest_fraction, 0.1, 0.74, remedy)?;
    let remedy = "grains loosen in shear: give B, such as 0.31, or 0 for grains that do not";
    rules::between(&field("dilation"), closures.dilation, 0.0, 100.0, remedy)?;
    rules::law(&field("suspension_viscosity"), closures.suspension_viscosity.parameter_problem())?;
    rules::positive(&field("karman"), closures.karman, "give κ, 0.41")
}
