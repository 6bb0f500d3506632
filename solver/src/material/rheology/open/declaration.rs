//! Whether what a law of a user's own says that it keeps can be kept.

use super::{OpenFieldLaw, OpenLawError};
use crate::material::rheology::field::{LawField, MOST_MEMORIES};

pub(super) fn check(name: &'static str, law: &dyn OpenFieldLaw) -> Result<(), OpenLawError> {
    let (field, memories) = (law.field(), law.memories());
    let wrong = |kept: &LawField, found: String, rule: String, remedy| {
        Err(OpenLawError::Declaration { name, declared: kept.name.to_owned(), found, rule, remedy })
    };
    for (place, kept) in std::iter::once(&field).chain(memories).enumerate() {
        if !(kept.holds(kept.initial) && kept.initial.is_finite()) {
            let (least, most) = kept.bounds;
            let remedy = "give the value that particles begin with";
            return wrong(
                kept,
                kept.initial.to_string(),
                format!("finite and from {least} to {most} at first"),
                remedy,
            );
        }
        if place > 0 && kept.diffusion.is_some() {
            let rule = "without diffusion, because only a law's field diffuses";
            return wrong(kept, "a diffusing quantity".to_owned(), rule.to_owned(), "make it the law's field");
        }
        if place > MOST_MEMORIES {
            let rule = format!("among the first {MOST_MEMORIES} beside the law's field");
            return wrong(kept, format!("number {place}"), rule, "leave out quantities that follow from the others");
        }
        if memories[place.min(memories.len())..].iter().any(|other| other.name == kept.name) {
            let remedy = "give each another name";
            return wrong(kept, "declared twice".to_owned(), "declared once".to_owned(), remedy);
        }
    }
    Ok(())
}
