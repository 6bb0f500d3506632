//! Velocity and viscosity inside a collapse on a slope: where grains are fast, and what the viscosity goes with.

use crate::collapse::{BIN_WIDTH, SlopeCollapse, SlopeFlow};
use crate::observation::{Frame, Recorded};
use crate::statistics::{mean, rank_correlation};

/// Share of the grains that count as the fastest `[-]`.
const FASTEST: f64 = 0.05;
/// Part of the local thickness that is the surface, or the bed `[-]`.
const FIFTH: f64 = 0.2;
/// How far behind the front its viscosity is taken, over the reservoir's length `[-]`.
const BEHIND_FRONT: f64 = 0.1;
/// Largest difference in time `[s]` at which a picture still counts as one of that time.
pub(super) const NEAR: f64 = 0.02;

/// Quantities of one picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inside {
    /// Mean depth of the fastest grains along the slope, over the local thickness `[-]`.
    pub(super) fastest_depth: f64,
    /// Rank correlation of the apparent viscosity with the depth below the surface `[-]`.
    pub(super) viscosity_and_depth: Option<f64>,
    /// Correlation with the pressure `[-]`.
    pub(super) viscosity_and_pressure: Option<f64>,
    /// Correlation with the shear rate `[-]`.
    pub(super) viscosity_and_shear_rate: Option<f64>,
    /// Median of the apparent viscosity just behind the front `[Pa·s]`.
    pub(super) front_viscosity: Option<f64>,
    /// Medians of it in the uppermost and in the lowest fifth of the local thickness `[Pa·s]`.
    pub(super) surface_and_bed_viscosity: (Option<f64>, Option<f64>),
    /// Mean depth of the grains that are sheared fastest, over the local thickness `[-]`.
    pub(super) sheared_depth: f64,
    /// Range between the quartiles of the inertial number among the faster half of the grains over that among the slower `[-]`.
    pub(super) inertia_contrast: Option<f64>,
}

impl Inside {
    /// Picture at a time `[s]`; `None` where no picture was taken then.
    pub(super) fn at(time: f64, run: &SlopeFlow, record: &Recorded<SlopeCollapse>) -> Option<Self> {
        let frame = Frame::nearest(&record.frames, time).filter(|frame| (frame.time - time).abs() <= NEAR)?;
        let index = record.data.collapse.nearest(time)?;
        let (unit, front) = (run.reservoir_length, record.data.collapse.front[index]);
        let thickness: Vec<f64> = record.data.thickness[index].iter().map(|thickness| thickness * unit).collect();
        Self::of(frame, &thickness, BIN_WIDTH * unit, (front * unit, BEHIND_FRONT * unit))
    }

    /// Of a picture, with the thickness in bins of a width, place of the front and how far behind it is still the front `[m]`.
    fn of(frame: &Frame, thickness: &[f64], bin: f64, (front, behind): (f64, f64)) -> Option<Self> {
        let surface = |x: f64| surface(thickness, bin, x);
        let depths: Vec<f64> = frame.position.iter().map(|x| surface(x[0]) - x[1]).collect();
        let (viscosity, pressure) = (frame.scalar("viscosity"), frame.scalar("pressure"));
        let velocity = frame.vector("velocity");
        let known = [viscosity.len(), velocity.len(), pressure.len(), frame.scalar("shear_rate").len()];
        if depths.is_empty() || known.iter().any(|&number| number != depths.len()) {
            return None;
        }
        let all = || (0..depths.len()).collect::<Vec<usize>>();
        let relative = |k: usize| (depths[k] / surface(frame.position[k][0]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let order = |by: &dyn Fn(usize) -> f64| {
            let mut order = all();
            order.sort_by(|&a, &b| by(b).total_cmp(&by(a)).then(a.cmp(&b)));
            order
        };
        let most = ((FASTEST * depths.len() as f64) as usize).max(1);
        let depth_of_most =
            |by: &dyn Fn(usize) -> f64| mean(&order(by)[..most].iter().map(|&k| relative(k)).collect::<Vec<f64>>());
        let by_speed = order(&|k| velocity[k][0]);
        let shear_rate = frame.scalar("shear_rate");
        let median = |inside: &dyn Fn(usize) -> bool| {
            quartiles(all().into_iter().filter(|&k| inside(k)).map(|k| viscosity[k]).collect()).map(|found| found[1])
        };
        // I over D √ρ_s, which a ratio does not need; grains without pressure fly
        let inertia = |grains: &[usize]| {
            let pressed = grains.iter().filter(|&&k| pressure[k] > 0.0);
            let [low, _, high] = quartiles(pressed.map(|&k| shear_rate[k] / pressure[k].sqrt()).collect())?;
            Some(high - low)
        };
        let (fast, slow) = by_speed.split_at(by_speed.len() / 2);
        let with = |other: &[f64]| {
            let pairs: Vec<(f64, f64)> = viscosity.iter().copied().zip(other.iter().copied()).collect();
            rank_correlation(&pairs)
        };
        let mut at_front: Vec<f64> = (0..depths.len())
            .filter(|&k| (front - behind..=front).contains(&frame.position[k][0]))
            .map(|k| viscosity[k])
            .collect();
        at_front.sort_by(f64::total_cmp);
        Some(Self {
            fastest_depth: depth_of_most(&|k| velocity[k][0]),
            viscosity_and_depth: with(&depths),
            viscosity_and_pressure: with(pressure),
            viscosity_and_shear_rate: with(frame.scalar("shear_rate")),
            front_viscosity: at_front.get(at_front.len() / 2).copied(),
            surface_and_bed_viscosity: (median(&|k| relative(k) < FIFTH), median(&|k| relative(k) > 1.0 - FIFTH)),
            sheared_depth: depth_of_most(&|k| shear_rate[k]),
            inertia_contrast: inertia(fast).zip(inertia(slow)).map(|(fast, slow)| fast / slow),
        })
    }
}

/// Lower quartile, median and upper quartile; none for fewer than four values.
fn quartiles(mut values: Vec<f64>) -> Option<[f64; 3]> {
    values.sort_by(f64::total_cmp);
    let at = |quarters: usize| values[(quarters * (values.len() - 1) + 2) / 4];
    (values.len() >= 4).then(|| [at(1), at(2), at(3)])
}

/// Height of the surface at a place, linear between the centres of bins `[m]`.
fn surface(thickness: &[f64], bin: f64, x: f64) -> f64 {
    let position = (x / bin - 0.5).max(0.0);
    let (index, share) = (position as usize, position.fract());
    let at = |index: usize| thickness.get(index).copied().unwrap_or(0.0);
    (1.0 - share) * at(index) + share * at(index + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A layer of unit thickness whose velocity rises with the height and whose viscosity with the depth.
    fn sheared() -> Frame {
        let position: Vec<[f64; 3]> =
            (0..400).map(|k| [(f64::from(k % 20) + 0.5) / 20.0, (f64::from(k / 20) + 0.5) / 20.0, 0.0]).collect();
        let depth = |x: &[f64; 3]| 1.0 - x[1];
        let scalar = |name: &str, of: fn(f64) -> f64| {
            (name.to_owned(), String::new(), position.iter().map(|x| of(depth(x))).collect::<Vec<f64>>())
        };
        Frame {
            time: 0.0,
            scalars: vec![
                scalar("viscosity", |depth| depth * depth),
                scalar("pressure", |depth| 3.0 * depth),
                scalar("shear_rate", |depth| 1.0 - depth),
            ],
            vectors: vec![(
                "velocity".to_owned(),
                String::new(),
                position.iter().map(|x| [x[1], 0.0, 0.0]).collect::<Vec<_>>(),
            )],
            position,
        }
    }

    #[test]
    fn a_sheared_layer_is_fast_on_top_and_viscous_below() {
        let inside = Inside::of(&sheared(), &[1.0; 20], 0.1, (1.0, 0.1)).expect("particles");
        assert!((inside.fastest_depth - 0.025).abs() < 1e-12, "{inside:?}");
        assert!((inside.viscosity_and_depth.expect("a value") - 1.0).abs() < 1e-12);
        assert!((inside.viscosity_and_pressure.expect("a value") - 1.0).abs() < 1e-12);
        assert!((inside.viscosity_and_shear_rate.expect("a value") + 1.0).abs() < 1e-12);
        // the fastest sheared row is the uppermost; fifths of twenty rows are four, whose middle depths lie 0.125 from an end
        assert!((inside.sheared_depth - 0.025).abs() < 1e-12, "{inside:?}");
        let (surface, bed) = inside.surface_and_bed_viscosity;
        let near = |value: Option<f64>, depth: f64| (value.expect("a value").sqrt() - depth).abs() < 0.03;
        assert!(near(surface, 0.1) && near(bed, 0.9), "{inside:?}");
        // (1 − x)/√(3x) varies much more in the upper half, which is the faster
        assert!(inside.inertia_contrast.expect("a value") > 2.0, "{inside:?}");
        // two columns of twenty grains lie behind the front; the median depth of twenty rows is 0.525 from above
        assert!((inside.front_viscosity.expect("a value") - 0.525 * 0.525).abs() < 1e-12, "{inside:?}");
    }

    #[test]
    fn quartiles_are_those_of_the_sorted_values() {
        assert_eq!(quartiles(vec![5.0, 1.0, 3.0, 2.0, 4.0]), Some([2.0, 3.0, 4.0]));
        assert_eq!(quartiles(vec![1.0; 3]), None);
    }

    #[test]
    fn the_surface_is_linear_between_bins() {
        let thickness = [1.0, 0.5];
        assert_eq!(surface(&thickness, 0.1, 0.0), 1.0);
        assert!((surface(&thickness, 0.1, 0.1) - 0.75).abs() < 1e-12);
        assert_eq!(surface(&thickness, 0.1, 0.9), 0.0);
    }
}
