//! Values of a user that are possible but unlikely for grains and sediment, mostly because they have another unit.

use crate::input::number_in;
use crate::number::four_digits;
use std::ops::{Range, RangeInclusive};
use toml::{Table, Value};

/// A field by the end of its name, its usual range, and the slip behind a value outside of it.
struct Usual {
    field: &'static str,
    range: RangeInclusive<f64>,
    unit: &'static str,
    /// Values for which the slip is the likely one, what was meant by them, and the words for it.
    slip: (Range<f64>, fn(f64) -> f64, &'static str),
}

const ANY: f64 = f64::INFINITY;
const DEGREES: &str = "degrees, the value of `friction_angle`,";

/// Usual values; the first of several rows for one field has its range.
const USUAL: &[Usual] = &[
    Usual { field: "slope_angle", range: 1.0..=60.0, unit: " °", slip: (0.1..1.0, f64::to_degrees, "in radians") },
    Usual { field: "friction_angle", range: 3.0..=60.0, unit: " °", slip: (-ANY..1.2, f64::to_degrees, "in radians") },
    Usual { field: "static_friction", range: 0.02..=2.0, unit: "", slip: (3.0..60.0, tangent, DEGREES) },
    Usual { field: "grain_diameter", range: 1e-6..=0.1, unit: " m", slip: (0.1..ANY, thousandth, "in millimetres") },
    Usual {
        field: "grain_density", range: 500.0..=12e3, unit: " kg/m³", slip: (-ANY..12.0, thousandfold, "in g/cm³")
    },
    Usual { field: "bulk_density", range: 100.0..=2e4, unit: " kg/m³", slip: (-ANY..8.0, thousandfold, "in g/cm³") },
    Usual { field: "fluid_density", range: 500.0..=3e3, unit: " kg/m³", slip: (0.5..3.0, thousandfold, "in g/cm³") },
    Usual { field: "gravity", range: 1.0..=300.0, unit: " m/s²", slip: (900.0..1100.0, hundredth, "in cm/s²") },
    Usual { field: "gravity", range: 1.0..=300.0, unit: " m/s²", slip: (9e3..11e3, thousandth, "in mm/s²") },
];

fn tangent(degrees: f64) -> f64 {
    libm::tan(degrees.to_radians())
}

fn hundredth(value: f64) -> f64 {
    value * 1e-2
}

fn thousandth(value: f64) -> f64 {
    value * 1e-3
}

fn thousandfold(value: f64) -> f64 {
    value * 1e3
}

/// Most spacings that a grain is wide: beyond, a particle is a small part of a grain.
const WIDEST_GRAIN: f64 = 10.0;

/// Warnings of what the user gave, with the likely unit, each behind its field.
pub(in crate::case) fn warnings(fields: &Table) -> Vec<(String, String)> {
    let mut found = Vec::new();
    collect(fields, "", &mut found);
    found
}

fn collect(fields: &Table, above: &str, found: &mut Vec<(String, String)>) {
    for (name, value) in fields {
        let path = if above.is_empty() { name.clone() } else { format!("{above}.{name}") };
        match value {
            Value::Table(inner) => collect(inner, &path, found),
            Value::Array(entries) if name == "gravity" => {
                let parts: Vec<f64> = entries.iter().filter_map(number_in).collect();
                let size = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
                found.extend(unusual(name, &path, size));
                if let Some(up) = parts.last().filter(|up| **up > 0.0) {
                    let text =
                        format!("`{path}` points upwards: its last component is {up}; for downwards give {}", -up);
                    found.push((path, text));
                }
            }
            Value::Array(entries) => {
                for (index, inner) in entries.iter().enumerate() {
                    if let Value::Table(inner) = inner {
                        collect(inner, &format!("{path}[{index}]"), found);
                    }
                }
            }
            _ => found.extend(number_in(value).and_then(|value| unusual(name, &path, value))),
        }
    }
}

fn unusual(name: &str, path: &str, value: f64) -> Option<(String, String)> {
    let mut rows = USUAL.iter().filter(|usual| usual.field == name).peekable();
    let Usual { range, unit, .. } = rows.peek()?;
    // 0 switches most of these off
    if value == 0.0 || range.contains(&value) {
        return None;
    }
    let (shown, low, high) = (four_digits(value), range.start(), range.end());
    let slip = rows.map(|usual| &usual.slip).find(|(values, ..)| values.contains(&value));
    let likely = slip.map(|(_, meant, words)| format!("; {shown} {words} is {}{unit}", four_digits(meant(value))));
    let text = format!("`{path}` is {shown}{unit}, but usually {low} to {high}{unit}{}", likely.unwrap_or_default());
    Some((path.to_owned(), text))
}

/// Warning of grains of a scene that are many particle spacings wide.
pub(in crate::case) fn wide_grains(parameters: &Table) -> Option<String> {
    let material = parameters.get("material")?.as_table()?;
    let (diameter, spacing) = (number_in(material.get("grain_diameter")?)?, number_in(parameters.get("spacing")?)?);
    (diameter > WIDEST_GRAIN * spacing).then(|| {
        let ratio = diameter / spacing;
        format!("`material.grain_diameter` is {diameter} m, {ratio:.0} particle spacings, but a particle stands for several grains; check both units")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_unit_is_told_with_the_value_that_was_meant() {
        let of = |text: &str| {
            warnings(&text.parse().expect("TOML")).into_iter().map(|(_, text)| text).collect::<Vec<_>>().join("\n")
        };
        assert_eq!(
            of("[sand.law]\nfriction_angle = 0.48"),
            "`sand.law.friction_angle` is 0.48 °, but usually 3 to 60 °; 0.48 in radians is 27.50 °"
        );
        assert!(of("material.grain_diameter = 0.7").ends_with("; 0.7 in millimetres is 7×10⁻⁴ m"));
        assert!(of("material.grain_density = 2.65").ends_with("; 2.65 in g/cm³ is 2650 kg/m³"));
        assert_eq!(of("bulk_density = 13534.0"), "", "mercury");
        assert!(of("bulk_density = 13.5").contains("13.5"), "mercury in g/cm³");
        assert!(of("gravity = [0.0, -966.0]").ends_with("; 966 in cm/s² is 9.66 m/s²"));
        assert!(of("gravity = [0.0, 9.81]").ends_with("its last component is 9.81; for downwards give -9.81"));
        assert!(of("gravity = [0.0, -9810.0]").ends_with("; 9810 in mm/s² is 9.81 m/s²"));
        assert!(
            of("bodies = [{ material = { static_friction = 27 } }]")
                .contains("bodies[0].material.static_friction` is 27, but usually")
        );
        assert!(of("slope_angle = 0.436").ends_with("; 0.436 in radians is 24.98 °"));
        assert_eq!(of("gravity = [4.9, -8.5]\nmaterial = { grain_diameter = 0.0005, bulk_density = 0 }"), "");
    }
}
