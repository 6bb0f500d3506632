//! Digest of the inputs that another code shares with a case.

use crate::case::{AnyCase, Changes, ParameterError, Tier};
use sha2::{Digest, Sha256};
use toml::Table;

/// Parts of the names of parameters that are a code's own business.
const OWN_BUSINESS: [&str; 6] = ["numerics", "resolution", "jitter", "seed", "columns", "preparation"];
/// Digits of the digest.
const DIGITS: usize = 8;

/// First digits of the SHA-256 of a case's parameters, without comments, numerics and resolutions.
pub(super) fn digest(parameters: &str) -> String {
    let mut fields: Table = parameters.parse().unwrap_or_default();
    fields.retain(|name, _| !OWN_BUSINESS.iter().any(|part| name.contains(part)));
    let text = fields.to_string();
    crate::store::hexadecimal(&Sha256::digest(text.as_bytes()))[..DIGITS].to_owned()
}

/// Digest of the inputs of a case at a tier, as its export names it.
///
/// # Errors
/// A tier whose parameters the case refuses, which no case does.
pub fn inputs_of(case: &'static dyn AnyCase, tier: Tier) -> Result<String, ParameterError> {
    Ok(digest(case.prepare(tier, &Changes::default())?.parameters_toml()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_count_and_numerics_do_not() {
        let of = |text: &str| digest(text);
        let own = of("slope_angle = 10.0  # [°]\nresolution = 20\n[numerics]\nkernel = \"a\"\n");
        assert_eq!(own, of("slope_angle = 10.0\nresolution = 40\n[numerics]\nkernel = \"b\"\n"));
        assert_ne!(own, of("slope_angle = 11.0\nresolution = 20\n"));
    }
}
