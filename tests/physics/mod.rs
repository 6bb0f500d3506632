//! Every case against its gates: the quick tier always, the paper tier with `cargo test -- --ignored`.
//!
//! The runs come from the store that the report uses too, so that none is simulated twice.

mod controls;
mod expected_failures;
mod falling_rows;
mod league;
mod long_runs;
mod perturbation;
mod reference_values;
mod run_out;
mod scene_preparation;
mod scene_texts;
mod scenes;
mod submerged_layer;
pub(crate) mod verdict;

use bagnold_harness::case::Tier;
use bagnold_validation::REGISTRY;

/// Both tiers of each case. A name here is that of the registry with `_` for `-`.
macro_rules! cases {
    ($($case:ident),+ $(,)?) => {
        /// The cases that have tests.
        const TESTED: &[&str] = &[$(stringify!($case)),+];

        $(mod $case {
            use crate::physics::verdict::assert_gates;
            use bagnold_harness::case::Tier;

            #[test]
            fn holds_its_gates_at_the_quick_tier() {
                assert_gates(&stringify!($case).replace('_', "-"), Tier::Quick);
            }

            #[test]
            #[ignore = "minutes: the paper tier"]
            fn holds_its_gates_at_the_paper_tier() {
                assert_gates(&stringify!($case).replace('_', "-"), Tier::Paper);
            }
        })+
    };
}

bagnold_validation::for_every_case!(cases);

#[test]
fn canonical_studies_hold_their_gates_at_the_quick_tier() {
    // one after the other: each uses all cores
    let holds = |name: &str| std::panic::catch_unwind(|| verdict::assert_gates(name, Tier::Quick)).is_ok();
    let failed: Vec<&str> = REGISTRY.studies().map(|study| study.name()).filter(|name| !holds(name)).collect();
    assert!(failed.is_empty(), "see above: {}", failed.join(", "));
}

#[test]
fn every_registered_case_is_tested() {
    let registered: Vec<&str> = REGISTRY.cases().map(|case| case.name()).collect();
    let tested: Vec<String> = TESTED.iter().map(|name| name.replace('_', "-")).collect();
    assert_eq!(tested, registered, "a case is named as its module, with `-` for `_`");
}
