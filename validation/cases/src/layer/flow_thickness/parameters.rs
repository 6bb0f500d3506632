//! The case's parameters and their tiers.

use super::nonlocal::{NonlocalChoice, NonlocalLayers, NonlocalParameters};
use super::start_stop::{LayerAtSlope, StartStopRun};
use super::{FlowThicknessRun, SteadyRun};
use crate::case::{Flow, ParameterError, Parameters, RunList, Tier};
use crate::collapse::SlopeFlow;
use crate::layer::{PeriodicLayer, Preparation};
use crate::reference::grains::GLASS_BEADS_FLOW_RULE;
use crate::reference::one_dimension::NonlocalLayer;
use crate::setup::rules;
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::field::FieldBoundary;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, each, entry, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FlowThicknessParameters {
    /// The collapses whose thickness is followed; grains and numerics of the layers as well.
    pub collapse: SlopeFlow,
    /// Slopes of the collapses `[°]`; empty for none.
    #[schemars(transform = each(rules::slope_angle()))]
    #[schemars(transform = each(not_negative("the grains run down the slope: give its angle in degrees")))]
    pub slope_angles: Vec<f64>,
    /// Places at which the thickness is followed, from the back of the reservoir `[m]`.
    pub stations: Vec<f64>,
    /// Length scale L of the deposit law over the grain diameter `[-]`.
    #[schemars(transform = positive("1.65 for glass beads, 2.03 for sand"))]
    pub deposit_length: f64,
    /// Flow coefficient β of (42) `[-]`.
    #[schemars(transform = positive("0.136 for glass beads, 0.65 for sand"))]
    pub flow_coefficient: f64,
    /// Rows of particles over a layer.
    #[schemars(transform = rules::rows())]
    pub rows: usize,
    /// Columns of particles along its period.
    pub columns: usize,
    /// Thicknesses of the layers whose slope of arrest is sought `[m]`; empty for none.
    #[schemars(transform = each(positive("give it in metres, such as 0.01")))]
    pub stopping_thicknesses: Vec<f64>,
    /// Slopes between which it is sought `[°]`: layers stop at the first and flow at the second.
    #[schemars(transform = each(rules::slope_angle()))]
    pub stopping_bracket: (f64, f64),
    /// Width of the bracket that ends the search `[°]`.
    #[schemars(transform = between(1e-3, 90.0, "0.25° takes about six trials"))]
    pub stopping_tolerance: f64,
    /// Longest simulated time of a trial `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "10 s is enough for thin layers"))]
    pub stopping_duration: f64,
    /// Slope whose steady profile a trial starts with `[°]`.
    #[schemars(transform = rules::slope_angle())]
    pub start_angle: f64,
    /// Steady flows: (thickness `[m]`, slope `[°]`); empty for none.
    #[schemars(transform = each(entry(0, positive("give it in metres, such as 0.01"))))]
    pub steady_flows: Vec<(f64, f64)>,
    /// Simulated time of a steady flow `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "1 s shows a steady flow"))]
    pub steady_duration: f64,
    /// The same questions under the nonlocal law.
    pub nonlocal: NonlocalLayers,
}

impl Parameters for FlowThicknessParameters {
    type Run = FlowThicknessRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            collapse: RunList::<SlopeFlow>::of_tier(tier).base,
            slope_angles: Vec::new(),
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
            nonlocal: NonlocalLayers {
                cooperation: NonlocalParameters { cooperativity: 0.48, relaxation_time: 1e-4, seed: 1e-6 },
                surfaces: vec![FieldBoundary::Vanishing, FieldBoundary::NoFlux],
                rows: 12,
                vanishing_searches: vec![(0.005, 21.8, 22.1), (0.010, 21.05, 21.35)],
                no_flux_searches: vec![(0.005, 21.05, 21.35)],
                stopping_tolerance: 0.3,
                profiles: vec![1.5, 3.0],
                profile_arrangements: vec![Arrangement::Lattice, Arrangement::Jittered],
                profile_rows: 20,
                profile_angle: 24.0,
                profile_duration: 0.5,
            },
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper | Tier::Fine => Self {
                slope_angles: vec![22.0, 23.0, 24.0, 25.0],
                rows: 20,
                stopping_thicknesses: vec![0.003, 0.005, 0.010, 0.020, 0.040],
                // 40 mm are at rest at the lower end of the bracket only after more than 10 s
                stopping_duration: 20.0,
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
                nonlocal: NonlocalLayers {
                    rows: 20,
                    vanishing_searches: vec![
                        (0.0025, 24.05, 24.35),
                        (0.003, 23.25, 23.55),
                        (0.005, 21.8, 22.1),
                        (0.010, 21.05, 21.35),
                        (0.020, 20.8, 21.1),
                        (0.040, 20.75, 21.05),
                    ],
                    no_flux_searches: vec![
                        (0.0025, 21.8, 22.1),
                        (0.004, 21.2, 21.5),
                        (0.006, 20.95, 21.25),
                        (0.010, 20.8, 21.1),
                    ],
                    profiles: vec![1.5, 3.0, 10.0],
                    profile_rows: 40,
                    ..quick.nonlocal.clone()
                },
                ..quick
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let remedy = "the steady profiles that the layers start with are those of μ(I)";
        rules::only_mu_i("collapse.material", &self.collapse.material, remedy)?;
        // without a collapse there is no gate
        let gate_speed = if self.slope_angles.is_empty() { 0.0 } else { self.collapse.gate_speed };
        let collapse = SlopeFlow { gate_speed, ..self.collapse.clone() };
        collapse.check().map_err(|error| error.within("collapse"))?;
        for (index, &station) in self.stations.iter().enumerate() {
            let field = format!("stations[{index}]");
            let remedy = "a station lies in the channel, in metres from the back of the reservoir";
            rules::between(&field, station, 0.0, self.collapse.channel_length, remedy)?;
        }
        rules::columns("columns", self.columns, &self.collapse.numerics)?;
        let (lower, upper) = self.stopping_bracket;
        rules::between("stopping_bracket[1]", upper, lower, 89.0, "give the gentler slope first")?;
        for (list, searches) in [
            ("vanishing_searches", &self.nonlocal.vanishing_searches),
            ("no_flux_searches", &self.nonlocal.no_flux_searches),
        ] {
            for (index, &(_, stops, flows)) in searches.iter().enumerate() {
                let field = |entry: usize| format!("nonlocal.{list}[{index}][{entry}]");
                rules::between(&field(1), stops, -89.0, 89.0, "give a slope at which the layer stops")?;
                rules::between(&field(2), flows, stops, 89.0, "give the gentler slope first")?;
            }
        }
        Ok(())
    }

    fn check_runs(&self, runs: &[&FlowThicknessRun]) -> Result<(), ParameterError> {
        let Rheology::MuI(grains) = self.collapse.material else { return Ok(()) };
        let friction_angle = |friction: f64| libm::atan(friction).to_degrees();
        let (gentlest, steepest) = (friction_angle(grains.static_friction), friction_angle(grains.limiting_friction));
        if runs.iter().any(|run| matches!(run, FlowThicknessRun::StartStop(_))) {
            let remedy = "trials start with a steady flow, which is between arctan μ_s and arctan μ_2 only";
            rules::between("start_angle", self.start_angle, gentlest, steepest, remedy)?;
        }
        let is_run = |(thickness, angle): (f64, f64)| {
            let is_it =
                |steady: &SteadyRun| steady.layer.layer.layer_height == thickness && steady.slope_angle == angle;
            runs.iter().any(|run| matches!(run, FlowThicknessRun::Steady(steady) if is_it(steady)))
        };
        for (index, &(thickness, angle)) in self.steady_flows.iter().enumerate() {
            if !is_run((thickness, angle)) {
                continue;
            }
            let remedy = "a flow is steady between the friction angles arctan μ_s and arctan μ_2 only";
            rules::between(&format!("steady_flows[{index}][1]"), angle, gentlest, steepest, remedy)?;
        }
        Ok(())
    }

    fn runs(&self) -> Vec<FlowThicknessRun> {
        let collapse = &self.collapse;
        let Rheology::MuI(grains) = collapse.material else { return Vec::new() };
        let collapses = self.slope_angles.iter().map(|&slope_angle| SlopeFlow { slope_angle, ..collapse.clone() });
        let search = |&thickness: &f64| StartStopRun {
            layer: self.layer(grains, thickness, self.stopping_duration),
            bracket: self.stopping_bracket,
            tolerance: self.stopping_tolerance,
            start_angle: self.start_angle,
        };
        let flow = |&(thickness, slope_angle): &(f64, f64)| SteadyRun {
            layer: self.layer(grains, thickness, self.steady_duration),
            slope_angle,
        };
        let searches = self.stopping_thicknesses.iter().map(search).map(FlowThicknessRun::StartStop);
        let flows = self.steady_flows.iter().map(flow).map(FlowThicknessRun::Steady);
        let local = collapses.map(FlowThicknessRun::Collapse).chain(searches).chain(flows);
        local.chain(self.nonlocal_searches(grains)).chain(self.nonlocal_profiles(grains)).collect()
    }
}

impl FlowThicknessParameters {
    fn layer(&self, material: MuI, thickness: f64, duration: f64) -> LayerAtSlope {
        let SlopeFlow { gravity, jitter, seed, numerics, .. } = self.collapse;
        let layer = PeriodicLayer {
            layer_height: thickness,
            gravity,
            resolution: self.rows,
            columns: self.columns,
            jitter,
            seed,
            preparation: Preparation::Settled,
            numerics,
        };
        let solid_fraction = self.collapse.bulk.solid_fraction;
        LayerAtSlope { layer, solid_fraction, material, nonlocal: None, duration }
    }

    /// A layer under the nonlocal law.
    fn nonlocal_layer(&self, grains: MuI, thickness: f64, duration: f64, surface: FieldBoundary) -> LayerAtSlope {
        let mut layer = self.layer(grains, thickness, duration);
        layer.nonlocal = Some(NonlocalChoice { cooperation: self.nonlocal.cooperation, surface });
        layer
    }

    fn nonlocal_searches(&self, grains: MuI) -> impl Iterator<Item = FlowThicknessRun> {
        self.nonlocal.surfaces.iter().flat_map(move |&surface| {
            let searches = match surface {
                FieldBoundary::Vanishing => &self.nonlocal.vanishing_searches,
                FieldBoundary::NoFlux => &self.nonlocal.no_flux_searches,
            };
            searches.iter().map(move |&(thickness, stops, flows)| {
                let mut layer = self.nonlocal_layer(grains, thickness, self.stopping_duration, surface);
                layer.layer.resolution = self.nonlocal.rows;
                FlowThicknessRun::StartStop(StartStopRun {
                    layer,
                    bracket: (stops, flows),
                    tolerance: self.nonlocal.stopping_tolerance,
                    start_angle: self.start_angle,
                })
            })
        })
    }

    /// Steady flows, as thick as some h_stop; none on a slope without.
    fn nonlocal_profiles(&self, grains: MuI) -> impl Iterator<Item = FlowThicknessRun> {
        let (slope_angle, surface) = (self.nonlocal.profile_angle, FieldBoundary::Vanishing);
        let of_grain = self.layer(grains, grains.grain_diameter, 0.0).profile(slope_angle);
        let cooperativity = self.nonlocal.cooperation.cooperativity;
        let thinnest = NonlocalLayer { layer: of_grain, cooperativity, surface }.stopping_thickness();
        let is_asked_for = self.nonlocal.surfaces.contains(&surface);
        let thicknesses = self.nonlocal.profiles.iter().filter(move |_| is_asked_for);
        let jitter = self.collapse.jitter;
        // without displacements both starts are the lattice
        let different = if jitter > 0.0 { usize::MAX } else { 1 };
        let starts = move || self.nonlocal.profile_arrangements.iter().take(different);
        let flow = move |times: f64, start: Arrangement| {
            // to a tenth of a micrometre, so that its name is short
            let thickness = (thinnest? * times * 1e7).round() / 1e7;
            let mut layer = self.nonlocal_layer(grains, thickness, self.nonlocal.profile_duration, surface);
            layer.layer.resolution = self.nonlocal.profile_rows;
            layer.layer.jitter = start.displacement(jitter);
            // near h_stop the velocity goes with the thickness to the power of 2.7, so that the 0.2 % by which a settled layer sinks
            // are half a per cent of it
            layer.layer.preparation = Preparation::Raised;
            Some(FlowThicknessRun::Steady(SteadyRun { layer, slope_angle }))
        };
        thicknesses.flat_map(move |&times| starts().filter_map(move |&start| flow(times, start)))
    }
}
