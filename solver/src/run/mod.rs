//! What the runs of both models have in common: the loop, how it ends, and how it goes wrong.

mod divergence;
pub(crate) mod observed_run;
mod scene_error;
mod stop_reason;

pub use divergence::Divergence;
pub use scene_error::SceneError;
pub use stop_reason::StopReason;
