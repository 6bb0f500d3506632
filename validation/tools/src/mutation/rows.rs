//! Which statements of the papers fall with an error: the physics is broken in the program, and whoever still calls a
//! statement reproduced shows nothing by it.

use super::MutantRun;
use crate::evidence::PAPERS;
use crate::report::papers::Status;
use std::collections::BTreeMap;

/// Of each element of the papers that a case's metrics reproduce without the error, as `paper element`: whether it falls
/// with it. A run that stops judges nothing.
pub(super) fn judged_rows(case: &str, right: &MutantRun, wrong: &MutantRun) -> BTreeMap<String, bool> {
    let mut rows = BTreeMap::new();
    for paper in PAPERS.iter() {
        for element in paper.elements.iter().filter(|element| element.settled.is_none()) {
            for name in element.metrics.iter().filter(|name| name.case == case) {
                for metric in right.metrics.iter().filter(|metric| name.names(&metric.name, &metric.variant)) {
                    if Status::of(name, metric) != Some(Status::Reproduced) {
                        continue;
                    }
                    let same =
                        wrong.metrics.iter().find(|other| other.name == metric.name && other.variant == metric.variant);
                    let falls =
                        same.and_then(|other| Status::of(name, other)).is_some_and(|is| is != Status::Reproduced);
                    *rows.entry(format!("{} {}", paper.name, element.id)).or_default() |= falls;
                }
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Limit, Metric, Variant};

    /// A metric that some element of the papers names, whatever its variant.
    fn named() -> (&'static str, String, String) {
        let elements = PAPERS.iter().flat_map(|paper| paper.elements.iter().map(move |element| (paper, element)));
        let mut names = elements.filter(|(_, element)| element.settled.is_none()).flat_map(|(paper, element)| {
            let id = format!("{} {}", paper.name, element.id);
            element.metrics.iter().map(move |name| (name, id.clone()))
        });
        let (name, id) = names
            .find(|(name, _)| name.printed.is_none() && name.names(&name.metric, &Variant::default()))
            .expect("an element that a gate judges");
        (&name.case, name.metric.clone(), id)
    }

    #[test]
    fn an_element_falls_with_the_gate_that_it_names() {
        let (case, metric, id) = named();
        let sighting = |value| {
            let metric =
                Metric::observed(&metric, &Variant::default(), value, "%").gated(Limit::AtMost(2.0), "a reason");
            MutantRun { metrics: vec![metric], diverged: Vec::new(), wall_seconds: 1.0 }
        };
        assert_eq!(judged_rows(case, &sighting(1.0), &sighting(3.0)).get(&id), Some(&true));
        assert_eq!(judged_rows(case, &sighting(1.0), &sighting(f64::NAN)).get(&id), Some(&true));
        assert_eq!(judged_rows(case, &sighting(1.0), &sighting(1.5)).get(&id), Some(&false));
        // what is not reproduced without the error is not asked
        assert_eq!(judged_rows(case, &sighting(3.0), &sighting(3.0)).get(&id), None);
        let gone = MutantRun { metrics: Vec::new(), ..sighting(1.0) };
        assert_eq!(judged_rows(case, &sighting(1.0), &gone).get(&id), Some(&false));
        assert!(judged_rows("no-such-case", &sighting(1.0), &sighting(3.0)).is_empty());
    }
}
