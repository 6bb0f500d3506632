//! Warnings that many runs may have the same cause for.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

static CAUTIONS: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Warns of an input that is possible but unlikely to be meant. Each text appears once.
pub fn caution(text: &str) {
    caution_about(text, text);
}

/// Warns of a subject once, whatever the text is: a scene is filled for each of its spacings and controls.
pub fn caution_about(subject: &str, text: &str) {
    if CAUTIONS.lock().unwrap_or_else(PoisonError::into_inner).insert(subject.to_owned()) {
        tracing::warn!("{text}");
    }
}

/// Number of different warnings by [`caution`] in this process.
#[must_use]
pub fn cautions() -> usize {
    CAUTIONS.lock().unwrap_or_else(PoisonError::into_inner).len()
}

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
