//! Inside a column in mid-collapse and after it: energies, velocity over depth, and what stays in its place.

pub(crate) mod velocity_profile;
pub(crate) mod wedge;

pub(crate) use velocity_profile::{Station, decay_length, linear_misfit_ratio};
pub(crate) use wedge::Wedge;

use super::{BIN_WIDTH, Collapse, ColumnFlow};
use crate::observation::energy::Energies;
use crate::observation::{Frame, Recorded};

/// Time of the velocity profiles over √(h_0/g) `[-]`: in mid-collapse.
pub(crate) const PROFILE_TIME: f64 = 1.5;

/// Energies of a run.
pub(crate) fn energies(collapse: &Collapse) -> Energies<'_> {
    Energies { time: &collapse.time, kinetic: &collapse.kinetic_energy, potential: &collapse.potential_energy }
}

/// Velocity profiles in mid-collapse: inside the initial column, at its edge, and halfway from there to the front.
pub(crate) fn stations<const D: usize>(run: &ColumnFlow<D>, record: &Recorded<Collapse>) -> Vec<Station> {
    // a ring is no bin along x
    let time = PROFILE_TIME * run.time_scale();
    let Some(frame) = Frame::nearest(&record.frames, time).filter(|_| D == 2) else {
        return Vec::new();
    };
    let front = record.data.nearest(time).map_or(1.0, |index| record.data.front[index]);
    let r = run.half_width;
    let station = |x: f64| Station::of(frame, x * r, BIN_WIDTH * r, run.spacing());
    [0.75, 1.0, 0.5 * (1.0 + front)].map(station).to_vec()
}

/// The undisturbed part of a deposit.
pub(crate) fn wedge_of<const D: usize>(run: &ColumnFlow<D>, frames: &[Frame]) -> Option<Wedge> {
    let (start, end) = (frames.first()?, frames.last()?);
    Some(Wedge::between(start, end, run.half_width, run.spacing()))
}
