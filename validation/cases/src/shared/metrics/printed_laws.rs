//! Laws of the solver against values of the same laws as they are printed, computed outside of the program. A flow whose
//! reference takes the law from the solver cannot tell a wrong constant from a right one; this can.

use crate::evidence::shipped_table;
use crate::metric::{Confidence, Limit, Metric, Variant, quantities};

quantities! {
    shared pub(crate)
    LAW_ERROR: verified("law_error", "%", "value of a law over the printed law, minus 1"),
}

/// One metric per law: its value at the place that the table describes, over the table's.
pub(crate) fn metrics(table: &str, laws: &[(&str, f64)]) -> Vec<Metric> {
    let printed = |law: &str| shipped_table(table).ok()?.number_of("law", law, "value").ok();
    let metric = |&(law, value): &(&str, f64)| {
        LAW_ERROR
            .of(&Variant::of("law", law), 100.0 * (value / printed(law).unwrap_or(f64::NAN) - 1.0))
            .against(Some(0.0), "the printed law, evaluated outside of the program", Confidence::High)
            .gated(Limit::Within(-5e-5, 5e-5), "5e-5 %: half of the table's seventh digit; the formula is the same")
            .with_snapshot_tolerance(0.0, 1e-6)
    };
    laws.iter().map(metric).collect()
}
