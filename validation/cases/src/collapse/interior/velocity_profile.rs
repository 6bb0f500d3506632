//! Velocity over depth in a spreading heap: a flowing layer, about linear, and below it a tail that decays.

use crate::figure::{Axis, Figure, Panel};
use crate::observation::Frame;
use crate::statistics::{LinearFit, common_slope, linear_fit};

/// The flowing layer moves faster than this share of the profile's largest velocity `[-]`; what is slower is the tail.
const FLOWING: f64 = 0.35;
/// The tail ends at this share `[-]`: what is slower is the creep of the elastic core.
const CREEPING: f64 = 0.05;
/// It also ends where the velocity grows downwards by more than this factor from bin to bin `[-]`: what is less is the
/// scatter of bins with four particles.
const SCATTER: f64 = 1.1;
/// Fewest points of a fit.
const FEWEST: usize = 3;

/// The profile at one station along the flow.
#[derive(Debug, Clone)]
pub(crate) struct Station {
    /// Place along the flow `[m]`.
    pub(crate) x: f64,
    /// (height of the bin's centre `[m]`, mean velocity along the flow `[m/s]`), upwards.
    pub(crate) profile: Vec<(f64, f64)>,
    /// Points of the flowing layer.
    pub(crate) flowing: Vec<(f64, f64)>,
    /// Points of the tail, downwards.
    pub(crate) tail: Vec<(f64, f64)>,
    /// Line through the flowing layer: shear rate `[1/s]` as slope.
    pub(crate) shear: Option<LinearFit>,
}

impl Station {
    /// Averages the particles within half a `width` of `x`, in bins one `layer` high `[m]`.
    pub(crate) fn of(frame: &Frame, x: f64, width: f64, layer: f64) -> Self {
        let mut bins: Vec<(f64, usize)> = Vec::new();
        for (position, velocity) in frame.position.iter().zip(frame.vector("velocity")) {
            if (position[0] - x).abs() > 0.5 * width {
                continue;
            }
            let bin = (position[1] / layer).max(0.0) as usize;
            if bins.len() <= bin {
                bins.resize(bin + 1, (0.0, 0));
            }
            bins[bin].0 += velocity[0];
            bins[bin].1 += 1;
        }
        let filled = bins.iter().enumerate().filter(|(_, (_, count))| *count > 0);
        let profile = filled.map(|(bin, &(sum, count))| ((bin as f64 + 0.5) * layer, sum / count as f64)).collect();
        Self::fitted(x, profile)
    }

    /// Height of the fastest row over that of the surface `[-]`, for rows one `layer` high `[m]`; none where nothing moves outwards.
    pub(crate) fn fastest_height(&self, layer: f64) -> Option<f64> {
        let surface = self.profile.last()?.0 + 0.5 * layer;
        let fastest = self.profile.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        (fastest.1 > 0.0).then(|| fastest.0 / surface)
    }

    /// Divides a profile into flowing layer and tail.
    pub(crate) fn fitted(x: f64, profile: Vec<(f64, f64)>) -> Self {
        let fastest = profile.iter().map(|point| point.1).fold(0.0, f64::max);
        // from the surface downwards: a core that creeps faster further down belongs to neither
        let flowing: Vec<(f64, f64)> =
            profile.iter().rev().take_while(|point| point.1 > FLOWING * fastest).copied().collect();
        let mut tail: Vec<(f64, f64)> = Vec::new();
        for &point in profile.iter().rev().skip(flowing.len()) {
            if point.1 <= CREEPING * fastest || tail.last().is_some_and(|above| point.1 > SCATTER * above.1) {
                break;
            }
            tail.push(point);
        }
        let shear = if flowing.len() >= FEWEST { linear_fit(&flowing) } else { None };
        Self { x, profile, flowing, tail, shear }
    }
}

/// Powers of the depth below the surface, of curved profiles u = u_s − c (y_s − y)ⁿ: Bagnold's, and the parabola of a liquid.
const CURVED: [f64; 2] = [1.5, 2.0];

/// Root mean square misfit of the line through a flowing layer over that of the better of the curved profiles with as many
/// constants `[-]`: below 1 the line describes it better than any of them. A share of the variance cannot tell: a line explains
/// 0.94 of a parabola's and 0.98 of that of Bagnold's profile. None without a layer of one point more than there are constants.
pub(crate) fn linear_misfit_ratio(station: &Station, layer: f64) -> Option<f64> {
    let flowing = &station.flowing;
    let surface = flowing.first()?.0 + 0.5 * layer;
    let misfit = |power: f64| {
        let points: Vec<(f64, f64)> = flowing.iter().map(|&(y, u)| (libm::pow(surface - y, power), u)).collect();
        let fit = linear_fit(&points)?;
        Some(points.iter().map(|(x, u)| (u - fit.intercept - fit.slope * x).powi(2)).sum::<f64>())
    };
    let curved = CURVED.iter().filter_map(|&power| misfit(power)).fold(f64::INFINITY, f64::min);
    (flowing.len() > FEWEST).then_some(())?;
    Some((misfit(1.0)? / curved).sqrt())
}

/// ℓ in u ∝ exp(y/ℓ) `[m]` that all tails share, each with an amplitude of its own; none without a tail of three points.
pub(crate) fn decay_length(stations: &[Station]) -> Option<f64> {
    let logarithms = |tail: &Vec<(f64, f64)>| tail.iter().map(|&(y, u)| (y, libm::log(u))).collect();
    let tails: Vec<Vec<(f64, f64)>> =
        stations.iter().map(|station| &station.tail).filter(|tail| tail.len() >= FEWEST).map(logarithms).collect();
    common_slope(&tails).map(|rate| rate.value).filter(|rate| *rate > 0.0).map(|rate| 1.0 / rate)
}

/// Profiles with both fits: on linear axes with the line, on half-logarithmic ones with the exponential.
pub(crate) fn figure(name: &str, caption: &str, stations: &[Station], (unit_length, unit): (f64, &str)) -> Figure {
    let height = format!("y/{unit} [-]");
    let mut linear = Panel::new("flowing layer: line", Axis::linear("u [m/s]"), Axis::linear(&height));
    let mut decaying = Panel::new("tail: exponential", Axis::logarithmic("u [m/s]"), Axis::linear(&height));
    let decay = decay_length(stations);
    let axes = |points: &[(f64, f64)]| points.iter().map(|&(y, u)| (u, y / unit_length)).collect::<Vec<_>>();
    for (slot, station) in stations.iter().enumerate() {
        let share = station.shear.map(|fit| format!(", R² = {:.2}", fit.r_squared)).unwrap_or_default();
        let label = format!("x = {:.2} {unit}{share}", station.x / unit_length);
        linear.points(&label, slot, axes(&station.profile));
        decaying.points("", slot, axes(&station.profile));
        if let (Some(fit), Some(top), Some(bottom)) = (station.shear, station.flowing.first(), station.flowing.last()) {
            let end = |y: f64| (y, fit.intercept + fit.slope * y);
            linear.reference("fits", axes(&[end(bottom.0), end(top.0)]));
        }
        if let (Some(decay), true) = (decay, station.tail.len() >= FEWEST) {
            let count = station.tail.len() as f64;
            let offsets = station.tail.iter().map(|&(y, u)| libm::log(u) - y / decay);
            let amplitude = offsets.sum::<f64>() / count;
            let ends = [station.tail[0].0, station.tail[station.tail.len() - 1].0];
            let line = ends.map(|y| (y, libm::exp(amplitude + y / decay)));
            decaying.reference("", axes(&line));
        }
    }
    // creep that turns round every other spacing says nothing on a logarithmic axis
    let fastest = stations.iter().flat_map(|station| &station.profile).map(|point| point.1).fold(0.0, f64::max);
    if fastest > 0.0 {
        decaying.x.limits = Some((1e-3 * fastest, 1.3 * fastest));
    }
    Figure::new(name, caption, vec![linear, decaying])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Line from 0.2 at y = 0.5 to 1 at y = 1, below it 0.2 exp((y − 0.5)/0.05).
    fn synthetic(y: f64) -> f64 {
        if y > 0.5 { 0.2 + 1.6 * (y - 0.5) } else { 0.2 * libm::exp((y - 0.5) / 0.05) }
    }

    #[test]
    fn both_parts_of_a_synthetic_profile_are_found() {
        let profile: Vec<(f64, f64)> =
            (0..50).map(|k| (f64::from(k) + 0.5) * 0.02).map(|y| (y, synthetic(y))).collect();
        let station = Station::fitted(1.0, profile);
        let shear = station.shear.expect("a flowing layer");
        assert!((shear.slope - 1.6).abs() < 1e-12 && shear.r_squared > 1.0 - 1e-12);
        // the tail begins in the line's slow part, which is not exponential: cut it off
        let tail = station.tail.iter().copied().filter(|point| point.0 < 0.5).collect();
        let station = Station { tail, ..station };
        let decay = decay_length(&[station.clone(), station]).expect("a tail");
        assert!((decay - 0.05).abs() < 1e-12);
    }

    #[test]
    fn a_jet_within_the_heap_is_not_fastest_at_its_surface() {
        let station = |speeds: [f64; 4]| {
            Station::fitted(1.0, speeds.iter().enumerate().map(|(row, &u)| (row as f64 + 0.5, u)).collect())
        };
        assert_eq!(station([0.1, 0.2, 0.4, 0.8]).fastest_height(1.0), Some(3.5 / 4.0));
        assert_eq!(station([0.1, 0.9, 0.4, 0.8]).fastest_height(1.0), Some(1.5 / 4.0));
        assert_eq!(station([0.0; 4]).fastest_height(1.0), None);
    }

    #[test]
    fn the_misfits_tell_a_line_from_profiles_that_a_line_explains_to_nine_tenths() {
        let layer = 0.05;
        let ratio = |power: f64| {
            let depth = |y: f64| 1.0 - y;
            // a ripple of a thousandth, without which the right profile has no misfit at all
            let point = |k: i32| (f64::from(k) + 0.5) * layer;
            let speed = |y: f64| 1.0 - 0.6 * libm::pow(depth(y), power) + 1e-3 * libm::cos(40.0 * y);
            let profile: Vec<(f64, f64)> = (0..20).map(point).map(|y| (y, speed(y))).collect();
            let station = Station::fitted(1.0, profile);
            assert!(station.shear.is_some_and(|line| line.r_squared > 0.93), "{power}");
            linear_misfit_ratio(&station, layer).expect("twenty points")
        };
        assert!(
            ratio(1.0) < 0.1 && ratio(1.5) > 10.0 && ratio(2.0) > 10.0,
            "{} {} {}",
            ratio(1.0),
            ratio(1.5),
            ratio(2.0)
        );
    }

    #[test]
    fn particles_are_averaged_in_their_bins() {
        let frame = Frame {
            time: 0.0,
            position: vec![[1.0, 0.1, 0.0], [1.02, 0.15, 0.0], [1.0, 0.3, 0.0], [2.0, 0.1, 0.0]],
            scalars: Vec::new(),
            vectors: vec![(
                "velocity".to_owned(),
                "m/s".to_owned(),
                [1.0, 3.0, 5.0, 9.0].map(|u| [u, 0.0, 0.0]).to_vec(),
            )],
        };
        let station = Station::of(&frame, 1.0, 0.1, 0.2);
        assert_eq!(station.profile.len(), 2);
        for (found, expected) in station.profile.iter().zip([(0.1, 2.0), (0.3, 5.0)]) {
            assert!((found.0 - expected.0).abs() < 1e-12 && (found.1 - expected.1).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn creep_that_turns_round_ends_the_tail() {
        for creep in [-0.01, 0.25] {
            let profile = vec![(0.5, 0.3), (1.5, creep), (2.5, 0.2), (3.5, 0.6), (4.5, 0.9), (5.5, 1.0)];
            assert_eq!(Station::fitted(0.0, profile).tail, [(2.5, 0.2)]);
        }
        let station = Station::fitted(0.0, vec![(1.5, -0.01), (2.5, 0.2), (3.5, 0.6), (4.5, 0.9), (5.5, 1.0)]);
        assert_eq!(station.flowing.len(), 3);
        assert_eq!(decay_length(&[station]), None);
    }
}
