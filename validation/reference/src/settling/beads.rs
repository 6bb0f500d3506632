//! Beads that settle as a dense suspension, measured by magnetic resonance (Pham Van Bang et al. 2008): how fast their upper interface
//! falls and their deposit rises, tables `measured-….csv` of `reference-data/settling`.

use super::grains::SettlingGrains;
use crate::evidence::{MeasuredData, read_shipped, shipped_table};
use crate::input::FieldError;
use crate::metric::Confidence;
use crate::statistics::{FittedValue, common_slope};
use std::sync::LazyLock;

/// Gravity `[m/s²]`.
const GRAVITY: f64 = 9.81;
/// Distance of the interfaces down to which both are followed `[m]`: two to three pixels.
const APART: f64 = 2e-3;
/// Heights between which the suspension's fraction is read, at first, and below which that of the deposit is, at last `[m]`: off
/// the deposit that there is already, the upper interface and the floor.
const SUSPENSION: (f64, f64) = (0.012, 0.050);
const DEPOSIT: (f64, f64) = (0.002, 0.042);

/// A number of beads and oil.
type GrainNumber = fn(&mut SettlingGrains) -> &mut f64;

/// The numbers of beads and oil that have a range, by their names in the table.
const NUMBERS: [(&str, GrainNumber); 4] = [
    ("bead diameter", |grains| &mut grains.grain_diameter),
    ("bead density", |grains| &mut grains.grain_density),
    ("oil density", |grains| &mut grains.fluid_density),
    ("oil viscosity", |grains| &mut grains.kinematic_viscosity),
];

/// Measured settling of beads in oil.
#[derive(Debug, Clone, PartialEq)]
pub struct SettlingBeads {
    /// Beads and oil.
    pub grains: SettlingGrains,
    /// Uncertainty range of each number: its name, with beads and oil at the lower and the upper end of the range.
    pub ends: Vec<(&'static str, SettlingGrains, SettlingGrains)>,
    /// (time `[s]`, height of the upper interface `[m]`).
    pub upper: Vec<(f64, f64)>,
    /// (time `[s]`, height up to which there is a deposit `[m]`).
    pub deposit: Vec<(f64, f64)>,
    /// Speed at which the upper interface falls `[m/s]`.
    pub sinking: FittedValue,
    /// Speed at which the deposit rises `[m/s]`.
    pub rise: FittedValue,
    /// Solid fraction of the suspension with its standard deviation over the height `[-]`.
    pub suspension: FittedValue,
    /// Solid fraction of the deposit with its standard deviation over the height `[-]`.
    pub packing: FittedValue,
    /// Source of the measurements.
    pub source: String,
    /// Confidence in the measurements.
    pub confidence: Confidence,
}

/// The experiment.
pub static SETTLING_BEADS: LazyLock<SettlingBeads> = LazyLock::new(|| {
    read_shipped("settling/measured-interfaces.csv", |interfaces| {
        SettlingBeads::read(
            interfaces,
            &shipped_table("settling/measured-fraction.csv")?,
            &shipped_table("settling/measured-beads.csv")?,
        )
    })
});

/// Mean and standard deviation of the values between two heights.
fn between(heights: &[f64], values: &[f64], (from, to): (f64, f64)) -> FittedValue {
    let inside: Vec<f64> =
        heights.iter().zip(values).filter(|(z, _)| (from..=to).contains(*z)).map(|(_, value)| *value).collect();
    let mean = inside.iter().sum::<f64>() / inside.len() as f64;
    let square: f64 = inside.iter().map(|value| (value - mean).powi(2)).sum();
    FittedValue { value: mean, standard_error: (square / inside.len().saturating_sub(1) as f64).sqrt() }
}

impl SettlingBeads {
    fn read(interfaces: &MeasuredData, fraction: &MeasuredData, beads: &MeasuredData) -> Result<Self, FieldError> {
        let (upper, deposit) = (interfaces.points("time", "upper interface")?, interfaces.points("time", "deposit")?);
        let apart: Vec<usize> = (0..upper.len()).filter(|&k| upper[k].1 - deposit[k].1 > APART).collect();
        let slope = |points: &[(f64, f64)]| {
            let points: Vec<(f64, f64)> = apart.iter().map(|&k| points[k]).collect();
            let none = FittedValue { value: f64::NAN, standard_error: f64::NAN };
            common_slope(&[points]).map_or(none, |fit| FittedValue { value: fit.value.abs(), ..fit })
        };
        let value = |what| beads.number_of("what", what, "value");
        let heights = fraction.numbers("height")?;
        let grains = SettlingGrains {
            grain_diameter: value("bead diameter")?,
            grain_density: value("bead density")?,
            fluid_density: value("oil density")?,
            kinematic_viscosity: value("oil viscosity")?,
            gravity: GRAVITY,
        };
        let ends = NUMBERS.iter().map(|&(what, number)| {
            let half = beads.number_of("what", what, "half width")?;
            let moved = |by: f64| {
                let mut moved = grains;
                *number(&mut moved) += by;
                moved
            };
            Ok((what, moved(-half), moved(half)))
        });
        let ends = ends.collect::<Result<_, FieldError>>()?;
        Ok(Self {
            grains,
            ends,
            sinking: slope(&upper),
            rise: slope(&deposit),
            suspension: between(heights, fraction.numbers("first")?, SUSPENSION),
            packing: between(heights, fraction.numbers("last")?, DEPOSIT),
            upper,
            deposit,
            source: interfaces.metadata.source.clone(),
            confidence: interfaces.metadata.confidence,
        })
    }

    /// Speed at which a deposit rises under beads that sink at a speed, v φ/(φ_d − φ), from the volume of both `[m/s]`.
    pub fn rise_under(&self, sinking: f64) -> f64 {
        let (suspension, packing) = (self.suspension.value, self.packing.value);
        sinking * suspension / (packing - suspension)
    }

    /// Relative standard uncertainty of that factor from both fractions `[-]`.
    pub fn rise_known_to(&self) -> f64 {
        let apart = self.packing.value - self.suspension.value;
        let by_suspension = (1.0 / self.suspension.value + 1.0 / apart) * self.suspension.standard_error;
        let by_packing = self.packing.standard_error / apart;
        by_suspension.hypot(by_packing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_beads_keep_their_volume() {
        let beads = &*SETTLING_BEADS;
        // the interface falls by 7.0 mm in 1020 s, the deposit rises by 34.4 mm
        assert!((beads.sinking.value * 1e6 - 6.8).abs() < 0.3, "{:?}", beads.sinking);
        assert!((beads.rise.value * 1e5 - 3.37).abs() < 0.1, "{:?}", beads.rise);
        assert!((beads.suspension.value - 0.50).abs() < 0.01, "{:?}", beads.suspension);
        assert!((beads.packing.value - 0.60).abs() < 0.005, "{:?}", beads.packing);
        // what sinks from above makes the deposit
        let ratio = beads.rise_under(beads.sinking.value) / beads.rise.value;
        assert!((ratio - 1.0).abs() < 2.0 * beads.rise_known_to(), "{ratio} ± {}", beads.rise_known_to());
    }
}
