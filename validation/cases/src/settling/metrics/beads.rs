//! The drag laws of dense suspensions beside beads whose settling was measured. The runs of the case meet the roots of these laws
//! within hundredths of a per cent, so that what a law says here is what particles with it do.

use super::{DEPOSIT_RISE_OVER_MEASURED, SINKING_OVER_MEASURED};
use crate::metric::{Limit, Metric, Origin, Quantity, Variant};
use crate::reference::settling::{SETTLING_BEADS, SettlingBeads, SettlingGrains};
use crate::statistics::FittedValue;
use bagnold_solver::material::drag::DragLaw;

/// The laws that speak of dense suspensions.
pub(in crate::settling) const LAWS: [DragLaw; 4] =
    [DragLaw::WenYu, DragLaw::Ergun, DragLaw::Gidaspow, DragLaw::DiFelice];

const PRINTED: &str = "half of the last printed digit (uniform); the source states no size distribution";

/// Velocity at which a law lets the beads sink `[m/s]`, and its relative uncertainty from the fraction `[-]`.
pub(in crate::settling) fn sinking(beads: &SettlingBeads, law: DragLaw) -> Option<(f64, f64)> {
    let phi = beads.suspension;
    let at = |fraction: f64| beads.grains.hindered_velocity(law, fraction);
    let own = at(phi.value)?;
    let (low, high) = (at(phi.value + phi.standard_error)?, at(phi.value - phi.standard_error)?);
    Some((own, 0.5 * (high - low) / own))
}

/// Relative standard uncertainty of a law's velocity by each number of beads and oil `[-]`.
fn by_numbers(beads: &SettlingBeads, law: DragLaw, own: f64) -> Vec<(&'static str, f64)> {
    let at = |grains: &SettlingGrains| grains.hindered_velocity(law, beads.suspension.value);
    let effect = |(name, low, high): &(&'static str, SettlingGrains, SettlingGrains)| {
        Some((*name, (at(high)? - at(low)?).abs() / own / 12.0_f64.sqrt()))
    };
    beads.ends.iter().filter_map(effect).collect()
}

pub(super) fn all() -> Vec<Metric> {
    let beads = &*SETTLING_BEADS;
    let of_law = |&law: &DragLaw| -> Option<[Metric; 2]> {
        let (velocity, by_fraction) = sinking(beads, law)?;
        let variant = Variant::of("law", law.name());
        let numbers = by_numbers(beads, law, velocity);
        let over_measured = |quantity: Quantity, own: f64, measured: &FittedValue, edge: &str| {
            let ratio = own / measured.value;
            let metric = quantity
                .of(&variant, ratio)
                .against(Some(1.0), &beads.source, beads.confidence)
                .gated(
                    Limit::Within(0.5, 2.0),
                    "a factor of two: at solid fraction 0.5, drag laws fitted to different experiments differ nearly as much",
                )
                .with_snapshot_tolerance(1e-6, 0.0)
                .known_to(Origin::Numerical, Some(1e-3), "particles reach the velocity of a law within 0.1 %, by other gates of this case");
            let metric = numbers.iter().fold(metric, |metric, (name, relative)| {
                metric.known_to(Origin::Input, Some(ratio * relative), &format!("{name} ({PRINTED})"))
            });
            let line = format!("standard error of the line through the heights of the {edge}");
            metric.known_to(Origin::Experiment, Some(ratio * measured.standard_error / measured.value), &line)
        };
        let sunk = over_measured(SINKING_OVER_MEASURED, velocity, &beads.sinking, "interface");
        let risen = over_measured(DEPOSIT_RISE_OVER_MEASURED, beads.rise_under(velocity), &beads.rise, "deposit");
        let of_sunk = sunk.value * by_fraction;
        let of_risen = risen.value * by_fraction.hypot(beads.rise_known_to());
        let fraction = "solid fraction (standard deviation over the height at first)";
        let fractions =
            "solid fractions (standard deviations of both over the height, for the velocity and for the volumes)";
        Some([
            sunk.known_to(Origin::Input, Some(of_sunk), fraction),
            risen.known_to(Origin::Input, Some(of_risen), fractions),
        ])
    };
    LAWS.iter().filter_map(of_law).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beads_in_stokes_regime_sink_as_by_hand() {
        // Ergun at R → 0: K = 150 φ² ν ρ/((1 − φ) d²), u_s = (1 − φ)³ Δρ g d²/(150 φ ν ρ) without a flux
        let beads = &*SETTLING_BEADS;
        let phi = beads.suspension.value;
        let grains = &beads.grains;
        let weight = (grains.grain_density - grains.fluid_density) * grains.gravity * grains.grain_diameter.powi(2);
        let by_hand = (1.0 - phi).powi(3) * weight / (150.0 * phi * grains.kinematic_viscosity * grains.fluid_density);
        let (own, _) = sinking(beads, DragLaw::Ergun).expect("in range");
        assert!((own / by_hand - 1.0).abs() < 1e-3, "{own} for {by_hand}");
        assert_eq!(all().len(), 2 * LAWS.len());
        // in this regime the velocity goes with d², Δρ, and 1/(ν ρ_f): ±5 µm of 290, ±5 kg/m³ of 100, half of the last digit of ν
        let numbers = by_numbers(beads, DragLaw::Ergun, own);
        let expected = [10.0 / 290.0, 0.05, 0.05 + 5.0 / 950.0, 5e-9 / 2.105e-5].map(|half| half / 3.0_f64.sqrt());
        for ((name, found), expected) in numbers.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 5e-3, "{name}: {found} for {expected}");
        }
    }
}
