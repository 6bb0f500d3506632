//! Numbers of TOML files, which may be written without a point.

use toml::Value;

/// The number of a value, whole or not; none for another type.
pub fn number_in(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}
