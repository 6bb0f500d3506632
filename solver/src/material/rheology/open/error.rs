//! Errors in the registration and construction of user-defined laws.

/// A name that cannot be given to a law.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("a law named `{name}` exists already; give yours another name")]
pub struct RegistrationError {
    /// The name.
    pub name: &'static str,
}

/// A law that cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum OpenLawError {
    /// No law has this name.
    #[error("unknown variant `{name}`, expected one of {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The names of all laws, each in backticks.
        known: String,
    },
    /// A law that declares what cannot be kept.
    #[error("`{declared}` of the law `{name}` is {found}, but must be {rule}; {remedy}")]
    Declaration {
        /// The law.
        name: &'static str,
        /// The name of what it keeps.
        declared: String,
        /// Defect of the declaration, completing "is …".
        found: String,
        /// The rule.
        rule: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// A parameter that is missing, unknown, or outside its range.
    #[error("{0}")]
    Parameter(String),
}
