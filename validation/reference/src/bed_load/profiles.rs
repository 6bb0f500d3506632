//! Bed load over the height as others have found it: a grain simulation (Maurin et al.) and a measured sheet flow
//! (Revil-Baudard et al. 2015), tables of `reference-data/bed-load`.

use crate::evidence::{MeasuredData, read_shipped};
use crate::input::FieldError;
use crate::one_dimension::bed_load::Stream;
use crate::statistics::{Extrapolation, interpolated, neighbour_scatter};

/// Authors of the measured layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredBedLoad {
    /// Grains of 6 mm and density 2.5 on a slope of 0.05, simulated one by one.
    GrainSimulation,
    /// Plastic grains of 3 mm, whose measured transport is three to four times a layer's: eddies carry a part of them.
    SheetFlow,
}

/// A column of profile points, heights above the layer's z = 0 `[m]` first.
type HeightProfile = Vec<(f64, f64)>;

/// Measured or simulated profiles of bed load.
#[derive(Debug, Clone, PartialEq)]
pub struct BedLoadProfiles {
    /// φ `[-]`.
    pub solid_fraction: HeightProfile,
    /// Velocity of the grains, of the sheet flow that of both phases `[m/s]`.
    pub grain_velocity: HeightProfile,
    /// Velocity of the water `[m/s]`; none for the sheet flow's own.
    pub fluid_velocity: HeightProfile,
    /// −⟨u'w'⟩ of the water `[m²/s²]`; none for the grain simulation.
    pub turbulent_stress: HeightProfile,
    /// Standard deviation of its points about the line through their neighbours `[m²/s²]`; NaN without any.
    pub stress_scatter: f64,
    /// q* = ∫ φ u_s dz/√((s − 1) g d³) of these points `[-]`.
    pub transport: f64,
    /// Source of the profiles.
    pub source: String,
}

impl MeasuredBedLoad {
    /// Both sources of measured or simulated profiles.
    pub const ALL: [Self; 2] = [Self::GrainSimulation, Self::SheetFlow];

    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::GrainSimulation => "grain-simulation",
            Self::SheetFlow => "sheet-flow",
        }
    }

    /// Height of the layer's z = 0 in the table `[m]`: there the table's grains, packed at φ_max, would end.
    fn level(self) -> f64 {
        match self {
            Self::GrainSimulation => 0.0748,
            Self::SheetFlow => 0.0108,
        }
    }

    /// Stream, over a bed of ten grains.
    pub fn stream(self) -> Stream {
        let water = |slope, flow_depth, grain_density, grain_diameter| Stream {
            slope,
            flow_depth,
            bed_depth: 10.0 * grain_diameter,
            held_depth: 0.0,
            gravity: 9.81,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            grain_density,
            grain_diameter,
            drag_diameter: 1.0,
        };
        match self {
            Self::GrainSimulation => water(0.05, 0.108, 2500.0, 6e-3),
            // u_* = √(g h i) = 0.05 m/s under 0.162 m of water above the bed
            Self::SheetFlow => water(0.0025 / (9.81 * 0.162), 0.162, 1192.0, 3e-3),
        }
    }

    /// Profiles.
    pub fn profiles(self) -> BedLoadProfiles {
        let level = self.level();
        let points = |table: &MeasuredData, name: &str| -> Result<HeightProfile, FieldError> {
            let heights = table.numbers("height")?.iter().map(|height| height - level);
            Ok(heights.zip(table.numbers(name)?.iter().copied()).collect())
        };
        let unit = self.stream().transport_unit();
        match self {
            Self::GrainSimulation => read_shipped("bed-load/grain-simulation.csv", |table| {
                let (fraction, grains) = (points(table, "solid fraction")?, points(table, "grain velocity")?);
                Ok(BedLoadProfiles {
                    transport: flux(&fraction, &grains) / unit,
                    solid_fraction: fraction,
                    grain_velocity: grains,
                    fluid_velocity: points(table, "fluid velocity")?,
                    turbulent_stress: HeightProfile::new(),
                    stress_scatter: f64::NAN,
                    source: table.metadata.source.clone(),
                })
            }),
            Self::SheetFlow => {
                let fraction =
                    read_shipped("bed-load/sheet-flow-fraction.csv", |table| points(table, "solid fraction"));
                let stress = read_shipped("bed-load/sheet-flow-stress.csv", |table| points(table, "covariance"));
                read_shipped("bed-load/sheet-flow-velocity.csv", |table| {
                    let grains = points(table, "velocity")?;
                    Ok(BedLoadProfiles {
                        transport: flux(&fraction, &grains) / unit,
                        solid_fraction: fraction.clone(),
                        grain_velocity: grains,
                        fluid_velocity: HeightProfile::new(),
                        stress_scatter: neighbour_scatter(&stress).unwrap_or(f64::NAN),
                        turbulent_stress: stress.clone(),
                        source: table.metadata.source.clone(),
                    })
                })
            }
        }
    }
}

/// ∫ φ u dz `[m²/s]` over the heights that both have, by trapezia of φ's heights cut into tenths.
fn flux(fraction: &HeightProfile, velocity: &HeightProfile) -> f64 {
    let line = |points: &HeightProfile, height: f64| {
        interpolated(points, height, (Extrapolation::EndValue, Extrapolation::EndValue)).unwrap_or(f64::NAN)
    };
    let carried = |height: f64| line(fraction, height) * line(velocity, height);
    let piece = |(from, to): (f64, f64)| -> f64 {
        let width = (to - from) / 10.0;
        (0..10).map(|k| carried(from + (f64::from(k) + 0.5) * width) * width).sum()
    };
    fraction.windows(2).map(|pair| piece((pair[0].0, pair[1].0))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transports_are_those_of_the_notes_beside_the_tables() {
        // the notes integrate all rows, the tables hold some
        let transport = |of: MeasuredBedLoad| of.profiles().transport;
        assert!((transport(MeasuredBedLoad::GrainSimulation) / 2.34 - 1.0).abs() < 0.06);
        assert!((transport(MeasuredBedLoad::SheetFlow) / 5.1 - 1.0).abs() < 0.06);
    }

    /// Near the bed the covariance tends to u_*², and it falls to nothing at the surface.
    #[test]
    fn the_measured_stress_is_that_of_the_friction_velocity() {
        let of = MeasuredBedLoad::SheetFlow;
        let (stream, profiles) = (of.stream(), of.profiles());
        let square = stream.shear_velocity().powi(2);
        let most = profiles.turbulent_stress.iter().fold(0.0_f64, |most, point| most.max(point.1));
        assert!((most / square - 0.96).abs() < 0.05, "{most} of {square}");
        assert!((0.01..0.08).contains(&(profiles.stress_scatter / square)), "{}", profiles.stress_scatter / square);
    }

    #[test]
    fn streams_have_the_shields_numbers_of_their_sources() {
        let shields = |of: MeasuredBedLoad| of.stream().shields_number();
        assert!((shields(MeasuredBedLoad::GrainSimulation) - 0.60).abs() < 1e-9);
        assert!((shields(MeasuredBedLoad::SheetFlow) / 0.44 - 1.0).abs() < 0.01);
    }
}
