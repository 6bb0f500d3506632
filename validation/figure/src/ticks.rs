//! Ticks of an axis, and their labels.

use super::Scale;
use super::range::Range;
use bagnold_number::superscript;

/// One labelled tick.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    /// Empty for a tick without a number.
    pub(super) label: String,
}

/// The ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Ticks {
    pub(super) major: Vec<Tick>,
    /// Values of the small ticks between.
    pub(super) minor: Vec<f64>,
    /// The factor common to all labels, such as `×10⁻⁴`; empty for 1.
    pub(super) factor: String,
}

/// About `wanted` ticks for `range`.
pub(super) fn ticks(range: Range, scale: Scale, wanted: usize) -> Ticks {
    match scale {
        Scale::Linear => linear(range, wanted.max(2)),
        Scale::Logarithmic => logarithmic(range, wanted.max(2)),
    }
}

fn linear(range: Range, wanted: usize) -> Ticks {
    let rough = (range.upper - range.lower) / wanted as f64;
    if !(rough.is_finite() && rough > 0.0) {
        return Ticks::default();
    }
    let decade = rough.log10().floor();
    let leading = rough / 10f64.powf(decade);
    // Steps of 1, 2 or 5 times a power of ten: the only ones read without thinking.
    let (step_leading, step_decade) = match leading {
        l if l < 1.5 => (1.0, decade),
        l if l < 3.2 => (2.0, decade),
        l if l < 7.1 => (5.0, decade),
        _ => (1.0, decade + 1.0),
    };
    let step = step_leading * 10f64.powf(step_decade);
    let tolerance = 1e-9;
    let first = (range.lower / step - tolerance).ceil();
    let last = (range.upper / step + tolerance).floor();
    let count = (last - first).clamp(0.0, 100.0) as usize;
    let multiples = (0..=count).map(|index| first + index as f64);

    let largest = range.lower.abs().max(range.upper.abs());
    let exponent = if (1e-2..1e5).contains(&largest) { 0.0 } else { largest.log10().floor() };
    // A label is multiple × step: decimals come from the step, so 0.30000000000000004 cannot appear.
    let decimals = (exponent - step_decade).clamp(0.0, 12.0) as usize;
    let unit = 10f64.powf(exponent);
    let major = multiples
        .map(|multiple| Tick { value: multiple * step, label: fixed(multiple * step / unit, decimals) })
        .collect();
    let factor = if exponent == 0.0 { String::new() } else { format!("×10{}", superscript(exponent as i32)) };
    Ticks { major, minor: Vec::new(), factor }
}

fn logarithmic(range: Range, wanted: usize) -> Ticks {
    let within = |value: f64| value >= range.lower * (1.0 - 1e-9) && value <= range.upper * (1.0 + 1e-9);
    let first = range.lower.log10().floor() as i32;
    let last = range.upper.log10().ceil() as i32;
    let decades: Vec<i32> = (first..=last).filter(|&exponent| within(10f64.powi(exponent))).collect();
    let minor: Vec<f64> = if last - first > 12 {
        Vec::new()
    } else {
        (first..=last)
            .flat_map(|exponent| (2..10).map(move |digit| f64::from(digit) * 10f64.powi(exponent)))
            .filter(|&value| within(value))
            .collect()
    };
    if decades.len() >= 2 {
        let every = decades.len().div_ceil(wanted + 1) as i32;
        let major = decades
            .iter()
            .map(|&exponent| Tick {
                value: 10f64.powi(exponent),
                label: if exponent.rem_euclid(every) == 0 { power_of_ten(exponent) } else { String::new() },
            })
            .collect();
        return Ticks { major, minor, factor: String::new() };
    }
    within_a_decade(range, &decades, minor)
}

/// Less than two decades: powers of ten alone would leave the axis without a scale.
fn within_a_decade(range: Range, decades: &[i32], minor: Vec<f64>) -> Ticks {
    let chosen = |digits: &[f64]| {
        let between = minor.iter().copied().filter(|value| {
            let leading = value / 10f64.powf((value.log10() + 1e-9).floor());
            digits.iter().any(|digit| (leading - digit).abs() < 1e-6)
        });
        let mut values: Vec<f64> = decades.iter().map(|&exponent| 10f64.powi(exponent)).chain(between).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let mut values = Vec::new();
    // The sparsest set that still gives three numbers.
    for digits in [&[2.0, 5.0][..], &[2.0, 3.0, 4.0, 6.0, 8.0], &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]] {
        values = chosen(digits);
        if values.len() >= 3 {
            break;
        }
    }
    if values.len() < 2 {
        // So narrow that even 2 … 9 give no scale; a logarithm is nearly straight there.
        return Ticks { minor, ..linear(range, 3) };
    }
    let plain = range.lower >= 1e-3 && range.upper <= 1e4;
    let major = values
        .into_iter()
        .map(|value| {
            let exponent = (value.log10() + 1e-9).floor() as i32;
            let leading = (value / 10f64.powi(exponent)).round();
            let label = if plain {
                fixed(value, (-exponent).max(0) as usize)
            } else if leading == 1.0 {
                power_of_ten(exponent)
            } else {
                format!("{leading:.0}×{}", power_of_ten(exponent))
            };
            Tick { value, label }
        })
        .collect();
    Ticks { major, minor, factor: String::new() }
}

/// A fixed-point number with a true minus sign and no negative zero.
fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().any(|digit| ('1'..='9').contains(&digit)) => format!("−{digits}"),
        Some(digits) => digits.to_owned(),
        None => text,
    }
}

fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", superscript(exponent)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(lower: f64, upper: f64, scale: Scale, wanted: usize) -> (Vec<String>, String) {
        let ticks = ticks(Range { lower, upper }, scale, wanted);
        let labels = ticks.major.into_iter().map(|tick| tick.label).filter(|label| !label.is_empty());
        (labels.collect(), ticks.factor)
    }

    #[test]
    fn linear_labels_are_clean() {
        let (texts, factor) = labels(0.0, 0.5, Scale::Linear, 5);
        assert_eq!(texts, ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(factor, "");
        let (texts, _) = labels(-1.0, 1.0, Scale::Linear, 4);
        assert_eq!(texts, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        let (texts, factor) = labels(0.0, 3.1e-4, Scale::Linear, 4);
        assert_eq!(texts, ["0", "1", "2", "3"]);
        assert_eq!(factor, "×10⁻⁴");
        let (texts, factor) = labels(0.0, 1.5e6, Scale::Linear, 4);
        assert_eq!(texts, ["0.0", "0.5", "1.0", "1.5"]);
        assert_eq!(factor, "×10⁶");
    }

    #[test]
    fn logarithmic_labels_are_decades_or_plain_numbers() {
        let (texts, _) = labels(1e-4, 1.0, Scale::Logarithmic, 8);
        assert_eq!(texts, ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "1"]);
        let (texts, _) = labels(9.0, 45.0, Scale::Logarithmic, 8);
        assert_eq!(texts, ["10", "20", "30", "40"]);
        let (texts, _) = labels(0.0021, 0.0092, Scale::Logarithmic, 8);
        assert_eq!(texts, ["0.003", "0.004", "0.006", "0.008"]);
    }

    #[test]
    fn hundred_decades_are_thinned() {
        let (texts, _) = labels(1e-60, 1e60, Scale::Logarithmic, 8);
        assert!(texts.len() <= 10 && texts.len() >= 3, "{texts:?}");
    }
}
