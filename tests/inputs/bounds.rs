//! No number of a case's parameters is without bounds. That schema and program agree on them is for `tests/schema`.

use bagnold_harness::case::Tier;
use bagnold_validation::REGISTRY;

#[test]
fn every_number_of_every_case_is_bounded_on_both_sides() {
    for case in REGISTRY.cases() {
        let loose = bagnold_solver::parameter::unbounded(&case.schema(Tier::Quick));
        assert!(loose.is_empty(), "{}: give a unit in the doc comment, or a rule: {loose:?}", case.name());
    }
}
