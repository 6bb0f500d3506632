//! Warnings that many runs may have the same cause for.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Warnings so far by their subjects.
static CAUTIONS: Mutex<BTreeMap<String, String>> = Mutex::new(BTreeMap::new());

/// Whether all input is the program's own, of which nobody is warned.
static IS_SHIPPED: AtomicBool = AtomicBool::new(false);

/// Logs warnings of the program's own input as information from here on, or warns of the user's.
pub fn caution_of_shipped(is_shipped: bool) {
    IS_SHIPPED.store(is_shipped, Ordering::SeqCst);
}

/// Warns of an input that is possible but unlikely to be meant. Each text appears once.
pub fn caution(text: &str) {
    caution_about(text, text);
}

/// Warns of a subject once, whatever the text is: a scene is filled for each of its spacings and controls.
pub fn caution_about(subject: &str, text: &str) {
    if IS_SHIPPED.load(Ordering::SeqCst) {
        tracing::info!("{text}");
        return;
    }
    let mut cautions = CAUTIONS.lock().unwrap_or_else(PoisonError::into_inner);
    let is_new = !cautions.contains_key(subject);
    if is_new {
        cautions.insert(subject.to_owned(), text.to_owned());
    }
    // whoever listens may warn too
    drop(cautions);
    if is_new {
        tracing::warn!("{text}");
    }
}

/// The different warnings by [`caution`] in this process, by their subjects.
pub fn cautions() -> BTreeMap<String, String> {
    CAUTIONS.lock().unwrap_or_else(PoisonError::into_inner).clone()
}
