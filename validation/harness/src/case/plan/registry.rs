//! The cases that the program knows, by name.

use crate::case::AnyCase;
use crate::case::given::error::ParameterError;
use crate::input::nearest;
use crate::store::CodeOrigin;

/// A list of cases with unique names.
#[derive(Clone, Copy)]
pub struct Registry(&'static [&'static dyn AnyCase]);

impl Registry {
    /// A registry of these cases, which `list` and the report keep in this order.
    pub const fn new(cases: &'static [&'static dyn AnyCase]) -> Self {
        Self(cases)
    }

    /// Cases with code of their own.
    pub fn cases(self) -> impl Iterator<Item = &'static dyn AnyCase> {
        self.iter().filter(|case| !case.is_study())
    }

    /// Canonical studies.
    pub fn studies(self) -> impl Iterator<Item = &'static dyn AnyCase> {
        self.iter().filter(|case| case.is_study())
    }

    /// All cases and canonical studies.
    pub fn iter(self) -> impl Iterator<Item = &'static dyn AnyCase> {
        self.0.iter().copied()
    }

    /// Origin of the code of the cases: elsewhere, if that of any of them is.
    pub fn origin(self) -> CodeOrigin {
        self.iter().map(AnyCase::origin).fold(CodeOrigin::PACKAGE, CodeOrigin::and)
    }

    /// The case of that name.
    ///
    /// # Errors
    /// An unknown name; the error suggests the nearest one.
    pub fn find(self, name: &str) -> Result<&'static dyn AnyCase, ParameterError> {
        let unknown = || ParameterError::unknown_case(name, &nearest(name, self.iter().map(AnyCase::name)));
        self.iter().find(|case| case.name() == name).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests {
    use crate::case::pendulum::REGISTRY;

    #[test]
    fn an_unknown_case_is_refused_with_the_nearest_name() {
        let message = |name| REGISTRY.find(name).err().map(|error| error.to_string());
        assert_eq!(message("pendulum"), None);
        assert_eq!(
            message("pendlum"),
            Some("`pendlum`: unknown case; did you mean `pendulum`? `bagnold list` prints all cases".to_owned())
        );
        assert_eq!(
            message("pendulum.toml"),
            Some(
                "`pendulum.toml`: unknown case; run a file with `bagnold run`; `bagnold list` prints all cases"
                    .to_owned()
            )
        );
        assert_eq!(message("zzz"), Some("`zzz`: unknown case; `bagnold list` prints all cases".to_owned()));
    }
}
