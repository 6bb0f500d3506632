//! A warning that many runs may have the same cause for.

use std::sync::atomic::{AtomicBool, Ordering};

/// Warns once; what follows are details that only a verbose program shows.
#[derive(Debug, Default)]
pub struct FirstWarning(AtomicBool);

impl FirstWarning {
    /// Nothing was warned of yet.
    #[must_use]
    pub const fn new() -> Self {
        Self(AtomicBool::new(false))
    }

    /// Warns, and says that it does not do so again.
    pub fn warn(&self, text: &str) {
        if self.0.swap(true, Ordering::Relaxed) {
            tracing::info!("{text}");
        } else {
            tracing::warn!("{text}; further warnings of this kind are not shown");
        }
    }
}
