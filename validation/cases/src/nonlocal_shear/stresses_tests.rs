use super::*;
use crate::reference::grains::GLASS_BEADS;
use bagnold_solver::material::rheology::Rheology;

/// A heap under the local law, and its grain diameter `[m]`.
fn local_heap() -> (ExactShear, f64) {
    let material = Rheology::MuI(GLASS_BEADS.law);
    let flow = NonlocalShearFlow { drive: Drive::Heap, material, ..NonlocalShearFlow::default() };
    (flow.steady(&flow.nominal()).expect("it flows"), flow.diameter())
}

#[test]
fn a_heap_flows_down_to_the_depth_at_which_its_friction_and_its_walls_bear_its_weight() {
    let (exact, diameter) = local_heap();
    // tanθ = μ_s + μ_w h_f/W with W = 30 D
    let expected = (libm::tan(26.0_f64.to_radians()) - exact.shear.grains.static_friction) * 30.0 / 0.3;
    assert!((exact.yield_distance() / diameter - expected).abs() < 1e-12);
    let height = |depth: f64| (20.0 - depth) * diameter;
    assert!(exact.velocity(height(expected + 0.02)) == 0.0 && exact.velocity(height(expected - 0.02)) > 0.0);
    // next to it I = I_0 (μ − μ_s)/Δμ and p hardly vary: u = ½ γ̇′ (h_f − y)²
    let grains = &exact.shear.grains;
    let (pressure, friction) = exact.shear.stress.at(expected * diameter, exact.shear.thickness);
    assert!((friction - grains.static_friction).abs() < 1e-12);
    let inertia_per_depth =
        grains.reference_inertia * 0.01 / (grains.limiting_friction - grains.static_friction) / diameter;
    let rate_per_depth = inertia_per_depth * (pressure / grains.grain_density).sqrt() / grains.grain_diameter;
    let above = 0.3 * diameter;
    let start = 0.5 * rate_per_depth * above * above;
    let found = exact.velocity(height(expected) + above);
    assert!((found / start - 1.0).abs() < 0.02, "{found} for {start}");
}

/// The finite volumes of the nonlocal law without its length are the integral of the local one.
#[test]
fn a_heap_without_cooperation_is_that_of_the_local_law() {
    let (exact, _) = local_heap();
    let uncoupled = NonlocalShear { cooperativity: 0.0, ..exact.shear };
    let found = uncoupled.steady(CELLS).expect("a solution");
    assert!(
        (found.fastest / exact.profile.fastest - 1.0).abs() < 1e-6,
        "{} for {}",
        found.fastest,
        exact.profile.fastest
    );
}
