//! Runs of both models: their loop, end, interruption, continuation and divergence.

mod course;
mod divergence;
pub(crate) mod observed_run;
mod saved;
mod scene_error;
mod stop_reason;

pub(crate) use course::Watching;
pub use course::{Observer, RunProgress};
pub use divergence::Divergence;
pub(crate) use divergence::NO_PARTICLE;
pub use saved::{ContinueError, ForeignState};
pub use scene_error::SceneError;
pub use stop_reason::StopReason;
