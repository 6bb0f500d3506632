//! Paths of a parameter in the files of the cases.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Dotted path of a parameter, for all cases or by case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Paths {
    /// At the same dotted path of every case.
    Everywhere(String),
    /// At a dotted path for each case by name.
    ByCase(BTreeMap<String, String>),
}

impl Paths {
    /// The dotted path in a case.
    pub fn in_case(&self, case: &str) -> Option<&str> {
        match self {
            Self::Everywhere(path) => Some(path),
            Self::ByCase(paths) => paths.get(case).map(String::as_str),
        }
    }

    /// A short name: the last key of the path.
    pub fn name(&self) -> String {
        let path = match self {
            Self::Everywhere(path) => Some(path),
            Self::ByCase(paths) => paths.values().next(),
        };
        path.and_then(|path| path.rsplit('.').next()).unwrap_or_default().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_may_differ_from_case_to_case() {
        #[derive(Deserialize)]
        struct Holder {
            path: Paths,
        }
        let read = |text: &str| toml::from_str::<Holder>(text).expect("valid").path;
        let everywhere = read("path = \"grains.static_friction\"");
        assert_eq!(everywhere.in_case("film"), Some("grains.static_friction"));
        assert_eq!(everywhere.name(), "static_friction");
        let by_case = read("path = { film = \"a.b\", bagnold = \"c\" }");
        assert_eq!((by_case.in_case("film"), by_case.in_case("settling")), (Some("a.b"), None));
    }
}
