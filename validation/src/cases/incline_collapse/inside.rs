//! Velocity and viscosity inside a collapse on a slope: where grains are fast, and what the viscosity goes with.

use crate::cases::collapse::{BIN_WIDTH, SlopeCollapse, SlopeRun};
use crate::observation::{Frame, Recorded};
use crate::statistics::{mean, rank_correlation};

/// Share of the grains that count as the fastest `[-]`.
const FASTEST: f64 = 0.05;
/// How far behind the front its viscosity is taken, over the reservoir's length `[-]`.
const BEHIND_FRONT: f64 = 0.1;
/// A picture that is later or earlier by more is none of the time `[s]`.
pub(super) const NEAR: f64 = 0.02;

/// What one picture shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inside {
    /// Mean depth of the fastest grains along the slope, over the local thickness `[-]`.
    pub(super) fastest_depth: f64,
    /// Rank correlation of the apparent viscosity with the depth below the surface `[-]`.
    pub(super) viscosity_and_depth: Option<f64>,
    /// With the pressure `[-]`.
    pub(super) viscosity_and_pressure: Option<f64>,
    /// With the shear rate `[-]`.
    pub(super) viscosity_and_shear_rate: Option<f64>,
    /// Median of the apparent viscosity just behind the front `[Pa·s]`.
    pub(super) front_viscosity: Option<f64>,
}

impl Inside {
    /// Of the picture at a time `[s]`; `None` where none was taken then.
    pub(super) fn at(time: f64, run: &SlopeRun, record: &Recorded<SlopeCollapse>) -> Option<Self> {
        let frame = Frame::nearest(&record.frames, time).filter(|frame| (frame.time - time).abs() <= NEAR)?;
        let times = &record.data.collapse.time;
        let index = (0..times.len()).min_by(|&a, &b| (times[a] - time).abs().total_cmp(&(times[b] - time).abs()))?;
        let (unit, front) = (run.reservoir.reservoir_length, record.data.collapse.front[index]);
        let thickness: Vec<f64> = record.data.thickness[index].iter().map(|thickness| thickness * unit).collect();
        Self::of(frame, &thickness, BIN_WIDTH * unit, (front * unit, BEHIND_FRONT * unit))
    }

    /// Of a picture, with the thickness in bins of a width, place of the front and how far behind it is still the front `[m]`.
    fn of(frame: &Frame, thickness: &[f64], bin: f64, (front, behind): (f64, f64)) -> Option<Self> {
        let surface = |x: f64| surface(thickness, bin, x);
        let depths: Vec<f64> = frame.position.iter().map(|x| surface(x[0]) - x[1]).collect();
        let (viscosity, pressure) = (frame.scalar("viscosity"), frame.scalar("pressure"));
        let velocity = frame.vector("velocity");
        if depths.is_empty() || viscosity.len() != depths.len() || velocity.len() != depths.len() {
            return None;
        }
        let mut order: Vec<usize> = (0..depths.len()).collect();
        order.sort_by(|&a, &b| velocity[b][0].total_cmp(&velocity[a][0]).then(a.cmp(&b)));
        order.truncate(((FASTEST * depths.len() as f64) as usize).max(1));
        let relative =
            order.iter().map(|&k| (depths[k] / surface(frame.position[k][0]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0));
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
            fastest_depth: mean(&relative.collect::<Vec<f64>>()),
            viscosity_and_depth: with(&depths),
            viscosity_and_pressure: with(pressure),
            viscosity_and_shear_rate: with(frame.scalar("shear_rate")),
            front_viscosity: at_front.get(at_front.len() / 2).copied(),
        })
    }
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
        // two columns of twenty grains lie behind the front; the median depth of twenty rows is 0.525 from above
        assert!((inside.front_viscosity.expect("a value") - 0.525 * 0.525).abs() < 1e-12, "{inside:?}");
    }

    #[test]
    fn the_surface_is_linear_between_bins() {
        let thickness = [1.0, 0.5];
        assert_eq!(surface(&thickness, 0.1, 0.0), 1.0);
        assert!((surface(&thickness, 0.1, 0.1) - 0.75).abs() < 1e-12);
        assert_eq!(surface(&thickness, 0.1, 0.9), 0.0);
    }
}
