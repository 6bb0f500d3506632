//! Errors for the mutation check stand outside of the sources (`validation/dev/mutations.toml`): a reader of an equation sees the
//! equation.

use crate::structure::source::workspace;
use bagnold_dev::mutation::Mutations;
use bagnold_harness::case::{Changes, Tier};
use bagnold_validation::REGISTRY;

#[test]
fn every_text_of_a_mutation_stands_once_in_its_file() {
    let mutations = Mutations::read(&workspace()).unwrap_or_else(|error| panic!("{error}"));
    let mut wrong = Vec::new();
    let mut places = 0;
    for mutation in mutations.iter() {
        assert!(!mutation.places.is_empty(), "{} changes nothing", mutation.name);
        for place in &mutation.places {
            places += 1;
            let path = workspace().join(place.path());
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let count = text.matches(&place.needle()).count();
            if count != 1 {
                wrong.push(format!("{}: `{}` stands {count} times in {}", mutation.name, place.needle(), place.file));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(places >= 75, "{places} places");
}

#[test]
fn every_mutation_has_tests_or_cases_that_take_their_settings() {
    let all = Mutations::read(&workspace()).expect("a file of mutations");
    assert!(all.iter().count() >= 60);
    for mutation in all.iter() {
        let scopes = all.scopes(mutation);
        let is_control = || solver_controls().any(|error| error == mutation.name);
        assert!(!scopes.is_empty() || !mutation.tests.is_empty() || is_control(), "nothing asks for {}", mutation.name);
        for scope in scopes {
            let case = REGISTRY.find(&scope.case).expect("a case");
            let changes = Changes { file: None, settings: &scope.settings, ..Changes::default() };
            assert!(case.prepare(Tier::Quick, &changes).is_ok(), "{scope:?}");
        }
    }
    let last = all.iter().last().expect("one");
    assert_eq!((all.number(last), all.find(&last.name)), (all.iter().count(), Some(last)));
}

/// Errors of the solver that the cases' controls name.
fn solver_controls() -> impl Iterator<Item = String> {
    REGISTRY.iter().flat_map(|case| case.controls()).filter_map(|control| control.solver)
}

#[test]
fn every_control_of_the_solver_is_a_mutation() {
    let all = Mutations::read(&workspace()).expect("a file of mutations");
    let missing: Vec<String> = solver_controls().filter(|error| all.find(error).is_none()).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_solver_knows_no_mutation() {
    let mut open = vec![workspace().join("solver/src")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("readable").flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default().to_lowercase();
            for word in ["planted", "mutation"] {
                assert!(!text.contains(word), "{} speaks of `{word}`", path.display());
            }
        }
    }
}
