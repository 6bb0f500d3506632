//! Time until a layer flows steadily.
//!
//! From rest a layer accelerates with g (sinθ − μ_s cosθ) at most, so that no time to the steady mean Ū of (37) is shorter than
//! T = Ū/(g (sinθ − μ_s cosθ)); how much longer it is depends on how far the slope is from both friction angles. The transient
//! solver is stepped by parts of T until its mean is there.

use super::{BagnoldProfile, LayerTransient};

/// Cells over the depth: the time is sought to a percent.
const CELLS: usize = 40;
/// Steps in the shortest time T.
const STEPS: f64 = 100.0;
/// Shortest times T after which the search ends.
const MOST: f64 = 100.0;

/// Time `[s]` after which a layer that starts at rest has a share `[-]` of its steady depth mean; none where it has no steady
/// flow, or takes a hundred times as long as its first acceleration would.
pub fn time_to_steadiness(layer: &BagnoldProfile, share: f64) -> Option<f64> {
    let steady = layer.depth_mean()?;
    let acceleration =
        layer.gravity * (libm::sin(layer.inclination) - layer.grains.static_friction * libm::cos(layer.inclination));
    let step = steady / acceleration / STEPS;
    let mut transient = LayerTransient::from_rest(*layer, CELLS, step).ok()?;
    for _ in 0..(MOST * STEPS) as usize {
        transient.step().ok()?;
        if transient.depth_mean() >= share * steady {
            return Some(transient.time());
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::rheology::MuI;

    fn layer(grains: [f64; 5], height: f64, solid_fraction: f64, slope: f64) -> BagnoldProfile {
        let [static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density] = grains;
        let law = MuI { static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density };
        BagnoldProfile::of(&law, height, solid_fraction, 9.81, slope)
    }

    #[test]
    fn the_time_is_that_of_the_resolved_transient() {
        let glass = [0.382, 0.643, 0.279, 0.5e-3, 2500.0];
        let others = [
            layer(glass, 0.01, 0.6, 22.0),
            layer(glass, 0.01, 0.6, 25.0),
            layer([0.359, 0.547, 0.637, 0.000_296, 2500.0], 0.0123, 0.587, 21.731),
            layer([0.591, 0.877, 0.153, 0.5e-3, 2500.0], 0.02, 0.6, 36.0),
        ];
        for layer in others {
            let time = time_to_steadiness(&layer, 0.99).expect("a steady flow");
            let mut fine = LayerTransient::from_rest(layer, 100, time / 4000.0).expect("a layer");
            let history = fine.run(2.0 * time, &[]).expect("a solution");
            let expected = history.rise_time(layer.depth_mean().expect("steady"), 0.99).expect("it rises");
            println!("{time} {:?} {expected}", time_to_steadiness(&layer, 0.999));
            assert!((time / expected - 1.0).abs() < 0.02, "{time} s, not {expected} s");
        }
    }

    #[test]
    fn a_layer_without_a_steady_flow_has_no_such_time() {
        let glass = [0.382, 0.643, 0.279, 0.5e-3, 2500.0];
        assert_eq!(time_to_steadiness(&layer(glass, 0.01, 0.6, 20.0), 0.99), None);
        assert_eq!(time_to_steadiness(&layer(glass, 0.01, 0.6, 34.0), 0.99), None);
    }
}
