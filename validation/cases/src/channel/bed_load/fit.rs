//! The fits of `stabilised`: yield stress and viscosity from the transport on two slopes, judged on the third.

use super::BedLoadRecord;
use super::flow::BedLoadFormulation;
use crate::reference::bed_load::TransportFormula;
use crate::shared::ascending;
use crate::statistics::mean;
use bagnold_solver::material::rheology::Rheology;

/// A fit and its prediction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HeldOut {
    /// The slope that was held out `[-]`.
    pub(super) slope: f64,
    /// Its Shields number `[-]`.
    pub(super) shields_number: f64,
    /// τ_y `[Pa]`.
    pub(super) yield_stress: f64,
    /// μ `[Pa·s]`.
    pub(super) viscosity: f64,
    /// q* over Wong & Parker's on the slope held out `[-]`.
    pub(super) ratio: f64,
    /// Whether the parameters lie on the border of the grid.
    pub(super) at_border: bool,
}

/// Points a side of the fine grid that is searched.
const FINE: usize = 200;

/// ln q* over yield stress and viscosity on one slope.
struct TransportSurface {
    slope: f64,
    shields_number: f64,
    yields: Vec<f64>,
    viscosities: Vec<f64>,
    /// Shape `[yield stresses][viscosities]`.
    values: Vec<Vec<f64>>,
}

impl TransportSurface {
    fn at(&self, yield_stress: f64, viscosity: f64) -> f64 {
        let (i, s) = place(&self.yields, yield_stress);
        // transport goes with a power of the viscosity
        let logarithms: Vec<f64> = self.viscosities.iter().map(|mu| libm::log(*mu)).collect();
        let (j, t) = place(&logarithms, libm::log(viscosity));
        let row = |i: usize| self.values[i][j] + t * (self.values[i][j + 1] - self.values[i][j]);
        row(i) + s * (row(i + 1) - row(i))
    }

    fn misfit(&self, yield_stress: f64, viscosity: f64) -> f64 {
        self.at(yield_stress, viscosity) - libm::log(TransportFormula::WongParker.transport(self.shields_number))
    }
}

/// Interval and share of a value in rising nodes.
fn place(nodes: &[f64], value: f64) -> (usize, f64) {
    let interval = nodes.windows(2).position(|pair| value <= pair[1]).unwrap_or(nodes.len() - 2);
    (interval, (value - nodes[interval]) / (nodes[interval + 1] - nodes[interval]))
}

/// One fit for every slope held out; empty without a whole grid on three slopes.
pub(super) fn held_out(records: &[BedLoadRecord]) -> Vec<HeldOut> {
    let surfaces = surfaces(records);
    if surfaces.len() < 3 {
        return Vec::new();
    }
    surfaces
        .iter()
        .map(|held| {
            let fitted: Vec<&TransportSurface> =
                surfaces.iter().filter(|surface| surface.slope != held.slope).collect();
            let line =
                |nodes: &[f64], k: usize| nodes[0] + (nodes[nodes.len() - 1] - nodes[0]) * k as f64 / FINE as f64;
            let law = |i: usize, j: usize| (line(&held.yields, i), line(&held.viscosities, j));
            let squares = |(tau, mu): (f64, f64)| fitted.iter().map(|surface| surface.misfit(tau, mu).powi(2)).sum();
            let nodes = (0..=FINE).flat_map(|i| (0..=FINE).map(move |j| (i, j)));
            let tried = nodes.map(|(i, j)| (squares(law(i, j)), i, j));
            let (_, i, j): (f64, _, _) = tried.fold((f64::INFINITY, 0, 0), |a, b| if b.0 < a.0 { b } else { a });
            let (yield_stress, viscosity) = law(i, j);
            HeldOut {
                slope: held.slope,
                shields_number: held.shields_number,
                yield_stress,
                viscosity,
                ratio: libm::exp(held.misfit(yield_stress, viscosity)),
                at_border: [i, j].iter().any(|&k| k == 0 || k == FINE),
            }
        })
        .collect()
}

fn surfaces(records: &[BedLoadRecord]) -> Vec<TransportSurface> {
    let mut points = Vec::new();
    for (run, record) in records {
        if let (BedLoadFormulation::Fit, Rheology::CoulombBingham(law)) = (run.formulation, run.particles.material) {
            let mean = mean(&record.data.channel.series.within(&record.data.transport, record.data.channel.window));
            let shields = run.stream().shields_number();
            points.push((run.slope, shields, law, libm::log(mean.max(1e-9))));
        }
    }
    let yields = ascending(points.iter().map(|point| point.2.yield_stress));
    let viscosities = ascending(points.iter().map(|point| point.2.plastic_viscosity));
    let slopes = ascending(points.iter().map(|point| point.0));
    if yields.len() < 2 || viscosities.len() < 2 {
        return Vec::new();
    }
    let surface = |&slope: &f64| {
        let of_slope: Vec<_> = points.iter().filter(|point| point.0 == slope).collect();
        let value = |tau: f64, mu: f64| {
            let found = of_slope.iter().find(|point| point.2.yield_stress == tau && point.2.plastic_viscosity == mu);
            found.map(|point| point.3)
        };
        let row = |&tau: &f64| viscosities.iter().map(|&mu| value(tau, mu)).collect::<Option<Vec<f64>>>();
        let values = yields.iter().map(row).collect::<Option<Vec<_>>>()?;
        let (yields, viscosities) = (yields.clone(), viscosities.clone());
        Some(TransportSurface { slope, shields_number: of_slope[0].1, yields, viscosities, values })
    };
    slopes.iter().filter_map(surface).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_is_exact_for_exponentials_of_the_yield_stress_and_powers_of_the_viscosity() {
        let value = |tau: f64, mu: f64| 1.0 - 0.3 * tau - 0.5 * libm::log(mu);
        let (yields, viscosities) = (vec![5.0, 7.0, 11.0], vec![0.2, 0.5]);
        let values = yields.iter().map(|&tau| viscosities.iter().map(|&mu| value(tau, mu)).collect()).collect();
        let surface = TransportSurface { slope: 0.03, shields_number: 0.173, yields, viscosities, values };
        for (tau, mu) in [(5.0, 0.2), (6.5, 0.3), (11.0, 0.5), (9.0, 0.45)] {
            assert!((surface.at(tau, mu) - value(tau, mu)).abs() < 1e-12);
        }
    }
}
