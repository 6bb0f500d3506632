//! The case's parameters and their tiers.

use super::start_stop::{LayerAtSlope, StartStopRun};
use super::{FlowThicknessRun, SteadyRun};
use crate::case::{ParameterError, Tier};
use crate::cases::incline_collapse::InclineCollapseParameters;
use crate::cases::rules;
use crate::reference::GLASS_BEADS_FLOW_RULE;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowThicknessParameters {
    /// The collapses whose thickness is followed; grains and numerics of the layers as well.
    pub collapse: InclineCollapseParameters,
    /// Places at which the thickness is followed, from the back of the reservoir `[m]`.
    pub stations: Vec<f64>,
    /// Length scale L of the deposit law over the grain diameter `[-]`.
    pub deposit_length: f64,
    /// Flow coefficient β of (42) `[-]`.
    pub flow_coefficient: f64,
    /// Rows of particles over a layer.
    pub rows: usize,
    /// Columns of particles along its period.
    pub columns: usize,
    /// Thicknesses of the layers whose slope of arrest is sought `[m]`; empty for none.
    pub stopping_thicknesses: Vec<f64>,
    /// Slopes between which it is sought `[°]`.
    pub stopping_bracket: (f64, f64),
    /// Width of the bracket that ends the search `[°]`.
    pub stopping_tolerance: f64,
    /// Longest simulated time of a trial `[s]`.
    pub stopping_duration: f64,
    /// Slope whose steady profile a trial starts with `[°]`.
    pub start_angle: f64,
    /// Steady flows: (thickness `[m]`, slope `[°]`); empty for none.
    pub steady_flows: Vec<(f64, f64)>,
    /// Simulated time of a steady flow `[s]`.
    pub steady_duration: f64,
}

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("stations", "[m], from the back of the reservoir"),
    ("deposit_length", "L/D [-]"),
    ("flow_coefficient", "β [-]"),
    ("rows", "particles over the thickness of a layer"),
    ("columns", "particles along the period of a layer"),
    ("stopping_thicknesses", "[m], layers whose slope of arrest is sought; empty for none"),
    ("stopping_bracket", "[°], must stop at the first slope and flow at the second"),
    ("stopping_tolerance", "[°], width of the final bracket"),
    ("stopping_duration", "[s], longest time of a trial"),
    ("start_angle", "[°], its steady profile starts every trial"),
    ("steady_flows", "[m] and [°], thickness and slope; empty for none"),
    ("steady_duration", "[s]"),
];

impl FlowThicknessParameters {
    pub(super) fn of_tier(tier: Tier) -> Self {
        let collapse = InclineCollapseParameters {
            slope_angles: if tier == Tier::Quick { vec![24.0] } else { vec![22.0, 23.0, 24.0, 25.0] },
            other_gate_speeds: Vec::new(),
            regularised_slope_angles: Vec::new(),
            ..InclineCollapseParameters::of_tier(tier)
        };
        let quick = Self {
            collapse,
            stations: vec![0.5, 1.0, 1.5],
            deposit_length: GLASS_BEADS_FLOW_RULE.deposit_length,
            flow_coefficient: GLASS_BEADS_FLOW_RULE.flow_coefficient,
            rows: 12,
            columns: 10,
            stopping_thicknesses: vec![0.005],
            stopping_bracket: (20.0, 24.0),
            stopping_tolerance: 0.5,
            stopping_duration: 10.0,
            start_angle: 22.5,
            steady_flows: vec![(0.010, 23.0), (0.010, 25.0), (0.005, 24.0)],
            steady_duration: 0.5,
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper | Tier::Fine => Self {
                rows: 20,
                stopping_thicknesses: vec![0.003, 0.005, 0.010, 0.020],
                stopping_tolerance: 0.25,
                steady_flows: vec![
                    (0.010, 22.0),
                    (0.010, 23.0),
                    (0.010, 24.0),
                    (0.010, 25.0),
                    (0.005, 24.0),
                    (0.020, 24.0),
                ],
                steady_duration: 1.0,
                ..quick
            },
        }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        self.collapse.check().map_err(|error| error.within("collapse"))?;
        for (index, &station) in self.stations.iter().enumerate() {
            let field = format!("stations[{index}]");
            let remedy = "a station lies in the channel, in metres from the back of the reservoir";
            rules::between(&field, station, 0.0, self.collapse.channel_length, remedy)?;
        }
        rules::positive("deposit_length", self.deposit_length, "1.65 for glass beads, 2.03 for sand")?;
        rules::positive("flow_coefficient", self.flow_coefficient, "0.136 for glass beads, 0.65 for sand")?;
        rules::rows("rows", self.rows)?;
        rules::columns("columns", self.columns, &self.collapse.numerics)?;
        for (index, &thickness) in self.stopping_thicknesses.iter().enumerate() {
            rules::positive(&format!("stopping_thicknesses[{index}]"), thickness, "give it in metres, such as 0.01")?;
        }
        let (lower, upper) = self.stopping_bracket;
        rules::slope_angle("stopping_bracket[0]", lower)?;
        rules::between("stopping_bracket[1]", upper, lower, 89.0, "give the gentler slope first")?;
        rules::between("stopping_tolerance", self.stopping_tolerance, 1e-3, 90.0, "0.25° takes about six trials")?;
        rules::between("stopping_duration", self.stopping_duration, 0.01, 1000.0, "10 s is enough for thin layers")?;
        rules::slope_angle("start_angle", self.start_angle)?;
        let friction_angle = |friction: f64| libm::atan(friction).to_degrees();
        let grains = &self.collapse.material;
        let (gentlest, steepest) = (friction_angle(grains.static_friction), friction_angle(grains.limiting_friction));
        if !self.stopping_thicknesses.is_empty() {
            let remedy = "trials start with a steady flow, which is between arctan μ_s and arctan μ_2 only";
            rules::between("start_angle", self.start_angle, gentlest, steepest, remedy)?;
        }
        for (index, &(thickness, angle)) in self.steady_flows.iter().enumerate() {
            rules::positive(&format!("steady_flows[{index}][0]"), thickness, "give it in metres, such as 0.01")?;
            let remedy = "a flow is steady between the friction angles arctan μ_s and arctan μ_2 only";
            rules::between(&format!("steady_flows[{index}][1]"), angle, gentlest, steepest, remedy)?;
        }
        rules::between("steady_duration", self.steady_duration, 0.01, 1000.0, "1 s shows a steady flow")
    }

    fn layer(&self, thickness: f64, duration: f64) -> LayerAtSlope {
        let collapse = &self.collapse;
        LayerAtSlope {
            thickness,
            rows: self.rows,
            columns: self.columns,
            gravity: collapse.gravity,
            solid_fraction: collapse.solid_fraction,
            material: collapse.material,
            jitter: collapse.jitter,
            seed: collapse.seed,
            duration,
            numerics: collapse.numerics,
        }
    }
}

pub(super) fn runs(parameters: &FlowThicknessParameters) -> Vec<FlowThicknessRun> {
    let collapse = &parameters.collapse;
    let collapses =
        collapse.slope_angles.iter().map(|&angle| FlowThicknessRun::Collapse(collapse.run(angle, collapse.gate_speed)));
    let searches = parameters.stopping_thicknesses.iter().map(|&thickness| {
        FlowThicknessRun::StartStop(StartStopRun {
            layer: parameters.layer(thickness, parameters.stopping_duration),
            bracket: parameters.stopping_bracket,
            tolerance: parameters.stopping_tolerance,
            start_angle: parameters.start_angle,
        })
    });
    let flows = parameters.steady_flows.iter().map(|&(thickness, slope_angle)| {
        FlowThicknessRun::Steady(SteadyRun {
            layer: parameters.layer(thickness, parameters.steady_duration),
            slope_angle,
        })
    });
    collapses.chain(searches).chain(flows).collect()
}
