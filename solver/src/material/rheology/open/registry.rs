//! The laws that are known by name. Global, because a file is read without a context: a program registers its laws
//! before it reads the first.

use super::error::{OpenLawError, RegistrationError};
use super::{Instance, Kind, OpenField, OpenLaw, OpenPlastic, OpenViscous, Parameters};
use crate::material::rheology::{BUILT_IN_NAMES, Rheology};
use std::sync::{Mutex, PoisonError};

/// Makes a law from its parameters, or says what is wrong with them.
pub type Maker = fn(&Parameters) -> Result<OpenLaw, OpenLawError>;

struct Entry {
    name: &'static str,
    maker: Maker,
}

/// Laws by name, and the ones that were made: a law with the same parameters is made once, so that a sweep that reads a
/// file a thousand times keeps one.
struct Registry {
    entries: Vec<Entry>,
    made: Vec<Rheology>,
}

static REGISTRY: Mutex<Registry> = Mutex::new(Registry { entries: Vec::new(), made: Vec::new() });

/// Makes a law known by its name, as its `law` key has it.
///
/// # Errors
/// A name that another law has.
pub fn register(name: &'static str, maker: Maker) -> Result<(), RegistrationError> {
    let mut registry = REGISTRY.lock().unwrap_or_else(PoisonError::into_inner);
    if BUILT_IN_NAMES.contains(&name) || registry.entries.iter().any(|entry| entry.name == name) {
        return Err(RegistrationError { name });
    }
    registry.entries.push(Entry { name, maker });
    Ok(())
}

/// The names of the laws of this crate, which no other law can have.
#[must_use]
pub fn built_in() -> &'static [&'static str] {
    BUILT_IN_NAMES
}

/// The names of the registered laws, in the order of their registration.
#[must_use]
pub fn registered() -> Vec<&'static str> {
    REGISTRY.lock().unwrap_or_else(PoisonError::into_inner).entries.iter().map(|entry| entry.name).collect()
}

impl Rheology {
    /// A registered law by its name and its parameters, in SI units.
    ///
    /// # Errors
    /// A name that no law has, or what the law says of its parameters.
    pub fn open(name: &str, parameters: &[(&str, f64)]) -> Result<Self, OpenLawError> {
        Self::open_with(
            name,
            Parameters::new(parameters.iter().map(|&(name, value)| (name.to_owned(), value)).collect()),
        )
    }

    pub(super) fn open_with(name: &str, parameters: Parameters) -> Result<Self, OpenLawError> {
        let found = {
            let registry = REGISTRY.lock().unwrap_or_else(PoisonError::into_inner);
            let is_it = |law: &&Self| law.written().is_err_and(|law| law.name == name && *law.parameters == parameters);
            if let Some(&law) = registry.made.iter().find(is_it) {
                return Ok(law);
            }
            registry.entries.iter().find(|entry| entry.name == name).map(|entry| (entry.name, entry.maker))
        };
        let Some((name, maker)) = found else {
            let known: Vec<_> = BUILT_IN_NAMES.iter().copied().chain(registered()).collect();
            let known = known.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            return Err(OpenLawError::Unknown { name: name.to_owned(), known });
        };
        // made outside the lock, so that a law may be made of another one
        let law = match maker(&parameters)?.0 {
            Kind::Viscous(law) => Self::OpenViscous(OpenViscous(keep(Instance { name, parameters, law }))),
            Kind::Plastic(law) => Self::OpenPlastic(OpenPlastic(keep(Instance { name, parameters, law }))),
            Kind::WithField(law) => {
                super::declaration::check(name, law.as_ref())?;
                Self::OpenField(OpenField(keep(Instance { name, parameters, law })))
            }
        };
        REGISTRY.lock().unwrap_or_else(PoisonError::into_inner).made.push(law);
        Ok(law)
    }
}

/// Keeps a value for the life of the program.
fn keep<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}
