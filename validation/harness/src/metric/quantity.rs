//! Declaration of a metric, made once: its name, unit and sentence. A case lists its quantities; metrics are built from
//! them.

use super::{Metric, MetricKind, Variant};

/// A number that a case gives, for any of its runs.
///
/// Every metric of a case begins as one of its quantities, `RUN_OUT.of(&variant, value)`, so that the list is where a
/// reader finds what there is, and a name that is not in it can be refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[must_use]
pub struct Quantity {
    /// Stable snake_case name.
    pub name: &'static str,
    /// Unit of the value, `-` for none, `%` for percent.
    pub unit: &'static str,
    /// Kind of reference that its verdict rests on.
    pub kind: MetricKind,
    /// Description, one sentence without a full stop.
    pub description: &'static str,
}

impl Quantity {
    /// A quantity of the run's own account.
    pub const fn accounted(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self { name, unit, kind: MetricKind::Bookkeeping, description }
    }

    /// A quantity that one of the two papers says something about.
    pub const fn stated(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self { name, unit, kind: MetricKind::Statement, description }
    }

    /// A quantity that is checked against the model's own equations.
    pub const fn verified(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self { name, unit, kind: MetricKind::Verification, description }
    }

    /// A quantity that is compared with an experiment or a published fit.
    pub const fn validated(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self { name, unit, kind: MetricKind::Validation, description }
    }

    /// Observed metric for a run, in the quantity's unit; the metric's methods add reference and gate.
    pub fn of(&self, variant: &Variant, value: f64) -> Metric {
        Metric::observed(self.name, variant, value, self.unit).of_kind(self.kind)
    }
}

/// Declares a case's quantities: each a constant, and the list of all, which begins with those that it shares with others.
/// They are seen by the parent of the module, or as a visibility in front says. What several cases share is declared
/// likewise, behind the word `shared` and without a list.
///
/// `quantities! { [channel::BED_SHEAR] FRONT: validated("front", "m", "how far the front has come"), }`
#[macro_export]
macro_rules! quantities {
    ([$($shared:expr),* $(,)?] $($declared:tt)+) => {
        $crate::quantities! { pub(super) [$($shared),*] $($declared)+ }
    };
    ($seen:vis [$($shared:expr),*] $($name:ident: $kind:ident($($declared:literal),+ $(,)?),)+) => {
        $crate::quantities! { shared $seen $($name: $kind($($declared),+),)+ }

        /// All quantities of the case.
        $seen const QUANTITIES: &[$crate::metric::Quantity] = &[$($shared,)* $($name,)+];
    };
    (shared $seen:vis $($name:ident: $kind:ident($($declared:literal),+ $(,)?),)+) => {
        $(#[doc = concat!($("`", $declared, "` "),+)] $seen const $name: $crate::metric::Quantity = $crate::metric::Quantity::$kind($($declared),+);)+
    };
}
pub use quantities;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metric_has_what_its_quantity_declares() {
        const FRONT: Quantity = Quantity::validated("front", "m", "how far the front has come");
        let metric = FRONT.of(&Variant::of("slope", 0.03), 0.5);
        assert_eq!((metric.name.as_str(), metric.unit.as_str(), metric.kind), ("front", "m", MetricKind::Validation));
        assert_eq!(metric.gate, None);
    }
}
