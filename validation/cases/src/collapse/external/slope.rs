//! A collapse on a slope as another code gives it.

use super::heap::{Room, snapshot};
use crate::case::{ExternalColumn, ExternalData, ExternalObservation, ExternalSchema};
use crate::collapse::metrics::quantities::*;
use crate::collapse::slope::EARLIEST_REST;
use crate::collapse::{Collapse, SlopeCollapse, SlopeFlow};
use crate::input::FieldError;

/// Possible data of a run on a slope.
pub(crate) const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema {
    particles: &[
        ExternalColumn::new("x", "m", "distance from the back of the reservoir, along the slope"),
        ExternalColumn::new("y", "m", "height above the bed, normal to it"),
        ExternalColumn::new("area", "m^2", "area that a particle or cell stands for"),
        ExternalColumn::new("mass", "kg", "mass of one, of a metre across; with the density in place of the area"),
        ExternalColumn::new("density", "kg/m^3", "density"),
        ExternalColumn::new("vx", "m/s", "velocity down the slope"),
        ExternalColumn::new("vy", "m/s", "velocity away from the bed"),
    ],
    series: &[
        ExternalColumn::new("time", "s", "time since the gate began to move"),
        ExternalColumn::new(
            "front",
            "m",
            "distance of the front from the back of the reservoir, at a thickness of 0.02 r_0",
        ),
    ],
    profile: &[
        ExternalColumn::new("x", "m", "distance from the back of the reservoir, rising"),
        ExternalColumn::new(
            "thickness",
            "m",
            "thickness of the deposit there, normal to the bed: volume per area of it",
        ),
    ],
    description: "r_0 is the length of the reservoir, at whose end the gate stands. The bed is divided into bins of 0.1 r_0; each \
        particle's volume is spread evenly over a spacing to either side, and a bin's thickness is the volume in it over its area. \
        The front at 0.02 r_0 is the length of the bed that carries that thickness, from the thickest bin down the slope: each \
        particle counts as a cell as wide as it is high, the root of its area, thickness in whole rows of the mean cell, read half a \
        row below, what lies in fewer than four rows as a wedge of its volume, and grains beyond a gap of two cells not at all; of a profile \
        the front is where it first falls below 0.02 r_0. front_displacement is the last front's distance from the gate, front its place at a time over r_0, of the first \
        time given that is not earlier. deposit_slope_angle is that of a line through the thickness over 20 to 80 % of the front's \
        distance, from the bed. The last picture, or the profile, is the deposit at rest; a picture \
        before 0.4 s is none.",
};

/// How far from the origin a particle may be, over the length of the channel.
const REACH: f64 = 3.0;

/// The observation from what another code gives.
///
/// # Errors
/// Columns that are missing beside others; particles out of reach.
pub(crate) fn observe(run: &SlopeFlow, given: &ExternalData) -> Result<ExternalObservation<SlopeCollapse>, FieldError> {
    let r = run.reservoir_length;
    let room = Room {
        spacing: run.spacing(),
        reach: REACH * run.channel_length,
        density: run.density(),
        size: r * run.initial_height,
        start: None,
        kind: "reservoir",
        origin: "check the unit and the origin: it lies on the bed at the back of the reservoir, x points down the slope",
    };
    let mut measured = Vec::new();
    let mut thickness = Vec::new();
    let mut collapse =
        Collapse { momentum_residual: f64::NAN, top: f64::NAN, centroid: f64::NAN, ..Collapse::default() };
    let snapshots =
        given.pictures.iter().map(|picture| snapshot::<2>(&room, picture)).collect::<Result<Vec<_>, _>>()?;
    if let (Some(end), Some(picture)) = (snapshots.last(), given.pictures.last()) {
        let mut surveyor = run.surveyor();
        for snapshot in &snapshots {
            thickness.push(surveyor.observe(snapshot).iter().map(|bin| bin.1).collect::<Vec<f64>>());
        }
        collapse = Collapse { momentum_residual: f64::NAN, ..surveyor.finish(end) };
        if end.time >= EARLIEST_REST {
            measured.extend([FRONT_DISPLACEMENT.name, DEPOSIT_SLOPE_ANGLE.name]);
        }
        measured.extend([PARTICLES_LOST.name, FRONT.name]);
        let moves = ["vx", "vy"].iter().all(|name| !picture.column(name).is_empty());
        if moves && given.pictures.len() > 1 {
            measured.push(REST_TIME.name);
        }
    }
    let (x, profile) = (given.profile("x"), given.profile("thickness"));
    if !x.is_empty() && !profile.is_empty() {
        collapse.deposit = x.iter().zip(profile).map(|(x, thickness)| (x / r, thickness / r)).collect();
        measured.extend([FRONT_DISPLACEMENT.name, DEPOSIT_SLOPE_ANGLE.name]);
    }
    let (time, front) = (given.series("time"), given.series("front"));
    if !time.is_empty() && !front.is_empty() {
        let unknown = || vec![f64::NAN; time.len()];
        collapse.time = time.to_vec();
        collapse.front = front.iter().map(|front| front / r).collect();
        // energies and thicknesses belong to the pictures' times
        (collapse.kinetic_energy, collapse.potential_energy) = (unknown(), unknown());
        thickness = vec![Vec::new(); time.len()];
        measured.retain(|name| *name != REST_TIME.name);
        measured.push(FRONT.name);
    }
    measured.sort_unstable();
    measured.dedup();
    Ok(ExternalObservation { observation: SlopeCollapse { collapse, thickness }, measured })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::NamedColumns;

    fn run() -> SlopeFlow {
        SlopeFlow::default()
    }

    /// A wedge that ends 1 m from the back has its front where a line says.
    #[test]
    fn a_profile_has_the_front_that_geometry_gives() {
        let run = run();
        let r = run.reservoir_length;
        let x: Vec<f64> = (0..=100).map(|k| 0.01 * f64::from(k)).collect();
        let thickness = x.iter().map(|x| 0.1 * (1.0 - x)).collect();
        let profile: NamedColumns = [("x".to_owned(), x), ("thickness".to_owned(), thickness)].into();
        let seen = observe(&run, &ExternalData { profile, ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, ["deposit_slope_angle", "front_displacement"]);
        // 0.1 (1 − x) = 0.02 r_0 at x = 0.96 m
        let displacement = seen.observation.collapse.run_out() * r;
        assert!((displacement - (1.0 - 0.2 * r - r)).abs() < 1e-9, "{displacement}");
        let slope = seen.observation.collapse.slope_angle();
        assert!((slope - libm::atan(0.1).to_degrees()).abs() < 1e-9, "{slope}");
    }

    #[test]
    fn a_series_gives_fronts_and_no_rest() {
        let series: NamedColumns = [("time", vec![0.0, 0.3, 0.4]), ("front", vec![0.2, 0.5, 0.7])]
            .map(|(name, values)| (name.to_owned(), values))
            .into();
        let seen = observe(&run(), &ExternalData { series, ..ExternalData::default() }).expect("complete");
        assert_eq!(seen.measured, ["front"]);
        assert_eq!(seen.observation.collapse.front[1], 0.5 / run().reservoir_length);
    }
}
