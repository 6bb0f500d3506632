//! Layer of grains under a viscous liquid on a slope, without particles: the onset and the motion of a submerged avalanche.
//!
//! Friction and dilatancy over the viscous number I = η γ̇/p′ (Pailha & Pouliquen 2009): τ = (μ_c + K1 I + tanψ) p′,
//! tanψ = K3 (φ − φ_c + K2 I), ∂φ/∂t = −φ D with D = γ̇ tanψ. Under given τ and p′ the shear rate is linear in p′:
//! γ̇ = [τ − (μ_c + K3 (φ − φ_c)) p′]₊/(η (K1 + K2 K3)).
//!
//! z is normal to the floor. Inertia is left out: τ = P tanθ, P = (ρ_s − ρ_f) g cosθ ∫_z φ dz, and grains that dilate draw water
//! in, p′ = P − p_f. ∂_z(k/η ∂_z p_f) = D(p′) + S ∂p_f/∂t with k by Kozeny and Carman; the surface drains (p_f = 0), the floor
//! does not. Cells keep their grains and swell. φ takes the midpoint rule; finite volumes, Newton's method for p_f.
//!
//! The constants are published; no number is fitted to avalanches. The study `submerged-slope` has its references from here.

#[path = "../../validation/reference/src/one_dimension/tridiagonal.rs"]
mod tridiagonal;

use tridiagonal::solve;

/// Coefficient of the permeability by Kozeny and Carman `[-]`.
const PERMEABILITY: f64 = 1.0 / 180.0;
/// Length of a stage over the step, 1 − 1/√2: two stages of it are of second order for stored water, and damp what is stiff.
const STAGE: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Shortest step `[s]`.
const SHORTEST_STEP: f64 = 1e-9;
/// Smallest effective pressure over the overburden `[-]`: the law has no meaning where grains lose contact.
const LEAST_EFFECTIVE: f64 = 1e-3;
/// Part of the effective pressure that one iteration leaves at least `[-]`.
const LEAST_LEFT: f64 = 0.05;
/// Change of an iteration, over the overburden of the lowest cell, below which the pressure has converged `[-]`.
const CONVERGED: f64 = 1e-9;
const LARGEST_ITERATIONS: usize = 60;

/// A submerged layer and how it is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SubmergedLayer {
    /// Slope angle θ `[°]`.
    slope_angle: f64,
    /// Gravity `[m/s²]`.
    gravity: f64,
    /// Depth h at the start `[m]`.
    depth: f64,
    /// Diameter d of the grains `[m]`.
    grain_diameter: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    grain_density: f64,
    /// Density ρ_f of the liquid `[kg/m³]`.
    liquid_density: f64,
    /// Viscosity η of the liquid `[Pa·s]`.
    viscosity: f64,
    /// Friction coefficient μ_c at rest `[-]`.
    critical_friction: f64,
    /// Rise K1 of the friction coefficient with I `[-]`.
    friction_slope: f64,
    /// Equilibrium solid fraction φ_c at rest `[-]`.
    critical_fraction: f64,
    /// Fall K2 of the equilibrium solid fraction with I `[-]`.
    fraction_slope: f64,
    /// Dilatancy K3: tanψ per difference of solid fraction from equilibrium `[-]`.
    dilatancy: f64,
    /// Compressibility S of the skeleton, above 0 `[1/Pa]`.
    compressibility: f64,
    /// Number of cells over the depth.
    cells: usize,
    /// Largest change of the solid fraction in a step `[-]`.
    largest_fraction_change: f64,
    /// Longest step `[s]`.
    longest_step: f64,
}

/// Shear and dilation of grains.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct GrainFlow {
    /// Shear rate γ̇ `[1/s]`.
    shear_rate: f64,
    /// Dilation rate D = γ̇ tanψ `[1/s]`.
    dilation_rate: f64,
    /// Derivative ∂D/∂p′ under the same stress `[1/(Pa s)]`.
    dilation_slope: f64,
}

impl SubmergedLayer {
    /// Glass beads on 25° as in the experiment of Pailha, Nicolas & Pouliquen (2008), in a liquid thirty times as thin.
    pub(super) const GLASS_BEADS: Self = Self {
        slope_angle: 25.0,
        gravity: 9.81,
        depth: 4.9e-3,
        grain_diameter: 160e-6,
        grain_density: 2500.0,
        liquid_density: 1041.0,
        viscosity: 0.096 / 30.0,
        critical_friction: 0.415,
        friction_slope: 90.5,
        critical_fraction: 0.582,
        fraction_slope: 25.0,
        dilatancy: 4.09,
        compressibility: 2.5e-4,
        cells: 40,
        largest_fraction_change: 5e-5,
        longest_step: 0.5 / 30.0,
    };

    /// Permeability k = d² (1 − φ)³/(180 φ²) at a solid fraction `[m²]`.
    fn permeability(&self, fraction: f64) -> f64 {
        let pores = 1.0 - fraction;
        let grain = self.grain_diameter / fraction;
        PERMEABILITY * grain * grain * pores * pores * pores
    }

    /// Pressure P at the floor under the buoyant weight (ρ_s − ρ_f) g cosθ, from the solid fraction at the start `[Pa]`.
    pub(super) fn floor_overburden(&self, fraction: f64) -> f64 {
        let along_z = self.gravity * libm::cos(self.slope_angle.to_radians());
        (self.grain_density - self.liquid_density) * along_z * fraction * self.depth
    }

    /// Flow under a shear stress `[Pa]` and an effective pressure `[Pa]`; rest below the yield stress.
    fn flow(&self, stress: f64, effective_pressure: f64, solid_fraction: f64) -> GrainFlow {
        // grains that are too loose to hold have none
        let looseness = self.dilatancy * (solid_fraction - self.critical_fraction);
        let yield_friction = (self.critical_friction + looseness).max(0.0);
        let excess = stress - yield_friction * effective_pressure;
        if excess <= 0.0 {
            return GrainFlow::default();
        }
        let widening = self.dilatancy * self.fraction_slope;
        let resistance = self.viscosity * (self.friction_slope + widening);
        let (shear_rate, rate_slope) = (excess / resistance, -yield_friction / resistance);
        let viscous_number = self.viscosity * shear_rate / effective_pressure;
        let number_slope = (self.viscosity * rate_slope - viscous_number) / effective_pressure;
        let tangent = looseness + widening * viscous_number;
        GrainFlow {
            shear_rate,
            dilation_rate: shear_rate * tangent,
            dilation_slope: rate_slope * tangent + shear_rate * widening * number_slope,
        }
    }
}

/// A column in motion; arrays of cells from the floor upwards.
#[derive(Debug, Clone)]
pub(super) struct SubmergedColumn {
    layer: SubmergedLayer,
    /// Volume of the grains of a cell over its base `[m]`.
    grains: f64,
    /// Overburden P `[Pa]`.
    overburden: Vec<f64>,
    /// Solid fraction φ `[-]`.
    fraction: Vec<f64>,
    /// Excess pore pressure p_f `[Pa]`.
    pub(super) pore_pressure: Vec<f64>,
    flow: Vec<GrainFlow>,
    /// Time since the tilt `[s]`.
    pub(super) time: f64,
}

impl SubmergedColumn {
    /// A column of a uniform solid fraction and a uniform pore pressure `[Pa]`, tilted at once.
    pub(super) fn new(layer: &SubmergedLayer, solid_fraction: f64, pore_pressure: f64) -> Self {
        let cells = layer.cells;
        let share = |k: usize| (cells as f64 - k as f64 - 0.5) / cells as f64;
        let mut column = Self {
            layer: *layer,
            grains: solid_fraction * layer.depth / cells as f64,
            overburden: (0..cells).map(|k| share(k) * layer.floor_overburden(solid_fraction)).collect(),
            fraction: vec![solid_fraction; cells],
            pore_pressure: vec![pore_pressure; cells],
            flow: Vec::new(),
            time: 0.0,
        };
        column.flow = column.grain_flow(&column.fraction, &column.pore_pressure);
        column
    }

    /// Velocity of the surface `[m/s]`.
    pub(super) fn surface_velocity(&self) -> f64 {
        self.flow.iter().zip(&self.fraction).map(|(flow, fraction)| flow.shear_rate * self.grains / fraction).sum()
    }

    /// Motion until a time `[s]`; none where the pore pressure of a step does not converge.
    pub(super) fn advance_to(&mut self, time: f64) -> Option<()> {
        while self.time < time {
            let changes = self.flow.iter().zip(&self.fraction).map(|(flow, own)| (own * flow.dilation_rate).abs());
            let step = self.layer.largest_fraction_change / changes.fold(0.0, f64::max);
            let step = step.min(self.layer.longest_step).max(SHORTEST_STEP);
            let end = if step < time - self.time { self.time + step } else { time };
            self.step(end - self.time)?;
            self.time = end;
        }
        Some(())
    }

    /// One step: φ by the midpoint rule, the pore pressure in balance with it.
    fn step(&mut self, step: f64) -> Option<()> {
        let dilated = |flow: &[GrainFlow], step: f64| -> Vec<f64> {
            let pairs = self.fraction.iter().zip(flow);
            pairs.map(|(fraction, flow)| fraction * libm::exp(-step * flow.dilation_rate)).collect()
        };
        let (_, flow) = self.balanced(&dilated(&self.flow, 0.5 * step), &self.pore_pressure, 0.5 * step)?;
        let fraction = dilated(&flow, step);
        let (first, _) = self.balanced(&dilated(&flow, STAGE * step), &self.pore_pressure, STAGE * step)?;
        let pairs = self.pore_pressure.iter().zip(first);
        let carried: Vec<f64> = pairs.map(|(start, first)| start + (1.0 - STAGE) / STAGE * (first - start)).collect();
        (self.pore_pressure, self.flow) = self.balanced(&fraction, &carried, STAGE * step)?;
        self.fraction = fraction;
        Some(())
    }

    /// Flow of the grains at a pore pressure.
    fn grain_flow(&self, fraction: &[f64], pore_pressure: &[f64]) -> Vec<GrainFlow> {
        let slope = libm::tan(self.layer.slope_angle.to_radians());
        let of_cell = |(k, overburden): (usize, &f64)| {
            let effective = (overburden - pore_pressure[k]).max(LEAST_EFFECTIVE * overburden);
            self.layer.flow(slope * overburden, effective, fraction[k])
        };
        self.overburden.iter().enumerate().map(of_cell).collect()
    }

    /// Pore pressure in balance with the dilation that it causes and with water stored over a time `[s]` since a former
    /// pressure, which is the first guess as well; with the flow of the grains.
    fn balanced(&self, fraction: &[f64], before: &[f64], time: f64) -> Option<(Vec<f64>, Vec<GrainFlow>)> {
        let (cells, storage) = (fraction.len(), self.layer.compressibility / time);
        let height: Vec<f64> = fraction.iter().map(|fraction| self.grains / fraction).collect();
        let resistance = |k: usize| 0.5 * height[k] * self.layer.viscosity / self.layer.permeability(fraction[k]);
        let upper = |k: usize| 1.0 / (resistance(k) + if k + 1 < cells { resistance(k + 1) } else { 0.0 });
        let upper: Vec<f64> = (0..cells).map(upper).collect();
        let lower: Vec<f64> = std::iter::once(0.0).chain(upper.iter().copied()).take(cells).collect();
        let mut pressure = before.to_vec();
        for _ in 0..LARGEST_ITERATIONS {
            let flow = self.grain_flow(fraction, &pressure);
            let residual = |k: usize| {
                let own = pressure[k];
                let inflow = upper[k] * (pressure.get(k + 1).unwrap_or(&0.0) - own)
                    - lower[k] * (own - pressure[k.saturating_sub(1)]);
                (flow[k].dilation_rate + storage * (own - before[k])) * height[k] - inflow
            };
            let diagonal = |k: usize| (flow[k].dilation_slope - storage) * height[k] - upper[k] - lower[k];
            let (diagonal, residual): (Vec<f64>, Vec<f64>) = (0..cells).map(|k| (diagonal(k), residual(k))).unzip();
            let change = solve(&lower, &diagonal, &upper, &residual);
            let share = |k: usize| (1.0 - LEAST_LEFT) * (self.overburden[k] - pressure[k]) / change[k];
            let part = (0..cells).map(share).filter(|share| *share > 0.0).fold(1.0, f64::min);
            pressure.iter_mut().zip(&change).for_each(|(pressure, change)| *pressure += part * change);
            if change.iter().all(|change| change.abs() < CONVERGED * self.overburden[0]) {
                let flow = self.grain_flow(fraction, &pressure);
                return Some((pressure, flow));
            }
        }
        None
    }
}

const BEADS: SubmergedLayer = SubmergedLayer::GLASS_BEADS;

fn after(layer: &SubmergedLayer, solid_fraction: f64, time: f64) -> SubmergedColumn {
    let mut column = SubmergedColumn::new(layer, solid_fraction, 0.0);
    column.advance_to(time).expect("converges");
    column
}

/// tanψ = 0 and τ/p′ = tanθ in every cell: one viscous number, one fraction and a linear shear rate.
#[test]
fn a_layer_flows_steadily_at_the_equilibrium_fraction() {
    let viscous_number = (libm::tan(25_f64.to_radians()) - BEADS.critical_friction) / BEADS.friction_slope;
    let fraction = BEADS.critical_fraction - BEADS.fraction_slope * viscous_number;
    let depth = BEADS.depth * 0.578 / fraction;
    let velocity = 0.5 * viscous_number * BEADS.floor_overburden(0.578) * depth / BEADS.viscosity;
    let column = after(&BEADS, 0.578, 130.0);
    assert!((column.surface_velocity() / velocity - 1.0).abs() < 1e-4);
    assert!(column.fraction.iter().all(|own| (own - fraction).abs() < 1e-4), "{:?}", column.fraction);
    let mean = column.fraction.len() as f64 / column.fraction.iter().map(|own| 1.0 / own).sum::<f64>();
    assert!((mean - fraction).abs() < 1e-5);
    assert!(column.pore_pressure[0].abs() < 1e-2);
}

#[test]
fn loose_grains_push_water_out_and_dense_grains_draw_it_in() {
    assert!(after(&BEADS, 0.562, 0.03).pore_pressure[0] > 1.0);
    assert!(after(&BEADS, 0.584, 0.03).pore_pressure[0] < -1.0);
}

/// Terzaghi: a uniform pressure in a layer at rest, with a drained surface and an undrained floor, at T = c_v t/h² = 0.2.
#[test]
fn pore_pressure_of_a_layer_at_rest_drains_as_terzaghi_has_it() {
    let error = |cells| {
        let layer = SubmergedLayer { slope_angle: 0.0, cells, ..BEADS };
        let diffusivity = layer.permeability(0.578) / (layer.viscosity * layer.compressibility);
        let time = 0.2 * layer.depth * layer.depth / diffusivity;
        let start = 0.1 * layer.floor_overburden(0.578) / (2.0 * cells as f64);
        let mut column = SubmergedColumn::new(&SubmergedLayer { longest_step: time / 200.0, ..layer }, 0.578, start);
        column.advance_to(time).expect("converges");
        let term = |odd: f64| {
            let wave = 0.5 * odd * std::f64::consts::PI;
            2.0 / wave * libm::sin(wave) * libm::cos(wave * 0.5 / cells as f64) * libm::exp(-0.2 * wave * wave)
        };
        let exact = [1.0, 3.0, 5.0, 7.0].map(term).iter().sum::<f64>();
        column.pore_pressure[0] / start / exact - 1.0
    };
    let [coarse, fine] = [20, 40].map(|cells| error(cells).abs());
    assert!(fine < 1e-3, "{fine}");
    assert!((libm::log2(coarse / fine) - 2.0).abs() < 0.2, "{coarse} {fine}");
}

#[test]
fn steps_are_of_second_order_in_their_length() {
    let velocity = |longest_step| {
        let layer = SubmergedLayer { largest_fraction_change: 1.0, longest_step, ..BEADS };
        after(&layer, 0.578, 64.0 / 30.0).surface_velocity()
    };
    // the jump of the pore pressure at the start takes many short steps
    let [coarse, middle, fine] = [4.0, 2.0, 1.0].map(|step| velocity(step / 3840.0));
    let order = libm::log2((coarse - middle) / (middle - fine));
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn a_layer_without_a_solution_has_none() {
    let mut weightless = SubmergedColumn::new(&SubmergedLayer { gravity: 0.0, ..BEADS }, 0.58, 0.0);
    assert!(weightless.advance_to(1.0).is_none());
}

#[test]
fn the_flow_under_a_stress_has_this_stress_by_the_law() {
    for (pressure, fraction) in [(20.0, 0.56), (24.0, 0.585), (18.0, 0.6)] {
        let flow = BEADS.flow(11.0, pressure, fraction);
        let viscous_number = BEADS.viscosity * flow.shear_rate / pressure;
        let equilibrium = BEADS.critical_fraction - BEADS.fraction_slope * viscous_number;
        let tangent = BEADS.dilatancy * (fraction - equilibrium);
        let friction = BEADS.critical_friction + BEADS.friction_slope * viscous_number + tangent;
        assert!(flow.shear_rate > 0.0);
        assert!((friction * pressure - 11.0).abs() < 1e-12);
        assert!((flow.dilation_rate / (flow.shear_rate * tangent) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_slope_of_the_dilation_rate_is_its_finite_difference() {
    let rate = |pressure: f64| BEADS.flow(11.0, pressure, 0.585);
    let difference = (rate(22.0 + 1e-4).dilation_rate - rate(22.0 - 1e-4).dilation_rate) / 2e-4;
    assert!((difference / rate(22.0).dilation_slope - 1.0).abs() < 1e-6);
}

#[test]
fn grains_rest_below_the_yield_stress_and_keep_the_equilibrium_fraction_above() {
    assert_eq!(BEADS.flow(9.0, 22.0, 0.585), GrainFlow::default());
    let viscous_number = (0.5 - BEADS.critical_friction) / BEADS.friction_slope;
    let flow = BEADS.flow(11.0, 22.0, BEADS.critical_fraction - BEADS.fraction_slope * viscous_number);
    assert!((BEADS.viscosity * flow.shear_rate / 22.0 / viscous_number - 1.0).abs() < 1e-12);
    assert!((flow.dilation_rate / flow.shear_rate).abs() < 1e-12);
}
