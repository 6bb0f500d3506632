//! What scenes of a user's own share, in the plane and in space: sides of the domain, series of gauges, balances.

pub(super) mod metrics;
pub(super) mod names;
mod observation;
pub(super) mod series;
pub(super) mod sides;

pub use observation::{Left, SceneObservation};
pub use series::Measured;
pub use sides::DomainSide;
