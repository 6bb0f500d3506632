//! Units as people write them, `cm/s`, `g/cm^3`, `kPa`, and what they are in SI.

/// Powers of length, mass and time.
pub type UnitExponents = [i32; 3];

/// Symbols that stand for themselves, with their value in metres, kilograms and seconds.
const SYMBOLS: [(&str, f64, UnitExponents); 10] = [
    ("m", 1.0, [1, 0, 0]),
    ("g", 1e-3, [0, 1, 0]),
    ("s", 1.0, [0, 0, 1]),
    ("min", 60.0, [0, 0, 1]),
    ("h", 3600.0, [0, 0, 1]),
    ("Pa", 1.0, [-1, 1, -2]),
    ("N", 1.0, [1, 1, -2]),
    ("J", 1.0, [2, 1, -2]),
    ("-", 1.0, [0, 0, 0]),
    ("%", 1e-2, [0, 0, 0]),
];

/// Prefixes of a unit symbol, with their factors.
const PREFIXES: [(&str, f64); 8] =
    [("k", 1e3), ("M", 1e6), ("h", 1e2), ("d", 1e-1), ("c", 1e-2), ("m", 1e-3), ("u", 1e-6), ("µ", 1e-6)];

/// The factor from one unit to another `[-]`, of the same text 1; none where one is unknown or they measure different things.
pub fn factor(from: &str, to: &str) -> Option<f64> {
    if from == to { Some(1.0) } else { factor_with(from, to, &[]) }
}

/// The factor from one unit to another `[-]`, either of which may use further symbols, each with its value in SI and its dimension.
pub fn factor_with(from: &str, to: &str, further: &[(&str, f64, UnitExponents)]) -> Option<f64> {
    let (from, to) = (parse(from, further)?, parse(to, further)?);
    (from.1 == to.1).then_some(from.0 / to.0)
}

/// Whether a unit can be converted at all.
pub fn is_known(unit: &str) -> bool {
    parse(unit, &[]).is_some()
}

/// Value in SI and dimension of a unit.
fn parse(text: &str, further: &[(&str, f64, UnitExponents)]) -> Option<(f64, UnitExponents)> {
    let text = text.trim();
    if text.is_empty() {
        return None;
    }
    let (mut factor, mut dimension) = (1.0, [0; 3]);
    for (place, part) in text.split('/').enumerate() {
        let sign = if place == 0 { 1 } else { -1 };
        let part = if place > 0 { part.trim_start_matches('(').trim_end_matches(')') } else { part };
        for word in part.split(['·', '*', ' ']).filter(|word| !word.is_empty()) {
            let (symbol, power) = powered(word)?;
            let own = found(symbol, further).or_else(|| symbol_of(symbol))?;
            factor *= own.0.powi(sign * power);
            for (sum, own) in dimension.iter_mut().zip(own.1) {
                *sum += sign * power * own;
            }
        }
    }
    Some((factor, dimension))
}

fn found(word: &str, symbols: &[(&str, f64, UnitExponents)]) -> Option<(f64, UnitExponents)> {
    symbols.iter().find(|(symbol, ..)| *symbol == word).map(|(_, factor, dimension)| (*factor, *dimension))
}

/// A symbol and its power: `cm^3`, `cm³`, `m2`, `s^-1`.
fn powered(word: &str) -> Option<(&str, i32)> {
    if let Some((symbol, power)) = word.split_once('^') {
        return Some((symbol, power.parse().ok().filter(|power: &i32| power.abs() <= 9)?));
    }
    for (ending, power) in [("²", 2), ("³", 3), ("2", 2), ("3", 3)] {
        if let Some(symbol) = word.strip_suffix(ending).filter(|symbol| !symbol.is_empty()) {
            return Some((symbol, power));
        }
    }
    Some((word, 1))
}

fn symbol_of(word: &str) -> Option<(f64, UnitExponents)> {
    // `0.1 mm`: a unit of one's own, such as a hundredth of a layer of 10 mm
    if let Some(factor) = word.parse::<f64>().ok().filter(|factor| factor.is_finite() && *factor > 0.0) {
        return Some((factor, [0; 3]));
    }
    let prefixed = |(prefix, scale): &(&str, f64)| {
        let base = word.strip_prefix(prefix).filter(|base| !["-", "%", "min", "h"].contains(base))?;
        found(base, &SYMBOLS).map(|(factor, dimension)| (scale * factor, dimension))
    };
    found(word, &SYMBOLS).or_else(|| PREFIXES.iter().find_map(prefixed))
}

#[cfg(test)]
mod tests {
    use super::factor;

    #[test]
    fn units_of_one_kind_are_converted() {
        let cases = [
            ("cm", "m", 1e-2),
            ("mm", "m", 1e-3),
            ("cm/s", "m/s", 1e-2),
            ("cm^2", "m^2", 1e-4),
            ("mm²", "m^2", 1e-6),
            ("g/cm^3", "kg/m^3", 1e3),
            ("g/cm3", "kg/m³", 1e3),
            ("kPa", "Pa", 1e3),
            ("ms", "s", 1e-3),
            ("min", "s", 60.0),
            ("s^-1", "1/s", 1.0),
            ("kg m/s^2", "N", 1.0),
            ("N/m^2", "Pa", 1.0),
            ("Pa·s", "Pa s", 1.0),
            ("%", "-", 1e-2),
            ("g/(h cm)", "kg/(s m)", 1.0 / 36000.0),
            ("0.1 mm", "m", 1e-4),
        ];
        for (from, to, expected) in cases {
            let found = factor(from, to).unwrap_or(f64::NAN);
            assert!((found / expected - 1.0).abs() < 1e-14, "{from} in {to}: {found}");
        }
    }

    #[test]
    fn units_of_different_kinds_or_unknown_ones_are_not() {
        for (from, to) in [("cm", "s"), ("kg/m", "kg/m^3"), ("furlong", "m"), ("", "m"), ("m^99", "m"), ("k-", "-")] {
            assert_eq!(factor(from, to), None, "{from} in {to}");
        }
    }
}
