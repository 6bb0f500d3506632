//! Quantities and metrics that the cases of a layer share.

use super::LayerObservation;
use crate::metric::{Limit, Metric, Variant, quantities};
use crate::observation::Recorded;

quantities! {
    shared pub(crate)
    PARTICLES_LOST: accounted("particles_lost", "-", "particles that ended below the bed or far above the layer"),
}

/// The number of particles that ended below the bed or far above the layer, gated at 0.
pub(crate) fn particles_lost(variant: &Variant, record: &Recorded<LayerObservation>) -> Metric {
    PARTICLES_LOST
        .of(variant, record.data.particles_lost as f64)
        .exactly(0.0, "no particle passes a wall")
        .gated(Limit::AtMost(0.0), "0: a particle below the bed is lost mass")
}
