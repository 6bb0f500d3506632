//! A figure of each quantity that is compared with measurements: predictions with ± u_val beside their references, a line of text
//! for each comparison.

use super::comparison::{Comparison, ModelError, QuantityComparisons, comparisons};
use super::{Report, with_numbers};
use crate::figure::{Axis, Figure, Mark, Panel, Scale};

/// Folder of the figures.
pub(super) const FOLDER: &str = "comparisons";

/// Half height of a reference's mark, in lines of text `[-]`.
const HALF: f64 = 0.42;
/// Ratio of the largest to the least number of a quantity from which its axis is logarithmic `[-]`.
const WIDE: f64 = 20.0;
/// Part of the least number at which a bar on a logarithmic axis ends that reaches to zero `[-]`.
const CUT: f64 = 0.3;

/// Verdict that gives a point its colour.
const VERDICTS: [(&str, usize); 4] = [
    ("validated within u_val", 2),
    ("model error, |E| > u_val", 1),
    ("|E| above the known part of u_val", 4),
    ("u_val not known", 6),
];

/// Of each quantity, in the order of the page.
pub(super) fn figures(report: &Report) -> Vec<Figure> {
    with_numbers(comparisons(report).iter().map(figure).collect())
}

fn figure(((name, unit), own): &QuantityComparisons<'_>) -> Figure {
    let words = name.replace('_', " ");
    let label = format!("{words} [{unit}]");
    let numbers = || own.iter().flat_map(|compared| [compared.metric.value, compared.measured()]);
    let (least, most) = numbers().fold((f64::INFINITY, 0.0_f64), |all, own| (all.0.min(own), all.1.max(own)));
    let x = if least > 0.0 && most > WIDE * least { Axis::logarithmic(&label) } else { Axis::linear(&label) };
    let floor = if x.scale == Scale::Logarithmic { CUT * least } else { f64::NEG_INFINITY };
    // the first comparison stands at the top
    let mut names = names(own);
    names.reverse();
    let mut panel = Panel::new("", x, Axis::named(names));
    let placed = || own.iter().rev().enumerate().map(|(place, compared)| (place as f64 + 1.0, compared));
    for (y, compared) in placed() {
        panel.reference("reference", [-HALF, HALF].map(|half| (compared.measured(), y + half)));
        if let Some(half) = compared.uncertainty() {
            let value = compared.metric.value;
            let (_, colour) = VERDICTS[verdict(compared)];
            panel.line("", colour, [((value - half).max(floor), y), (value + half, y)]);
        }
    }
    for (place, &(verdict_name, colour)) in VERDICTS.iter().enumerate() {
        let those = placed().filter(|(_, compared)| verdict(compared) == place);
        let points: Vec<(f64, f64)> = those.map(|(y, compared)| (compared.metric.value, y)).collect();
        if !points.is_empty() {
            panel.draw(verdict_name, Mark::Points, colour, points);
        }
    }
    let caption = format!("{words}: predictions with ± u_val, as far as it is known, beside their references.");
    Figure::new(&name.replace('_', "-"), &caption, vec![panel])
}

/// Place of a comparison's verdict in the list.
pub(super) fn verdict(compared: &Comparison<'_>) -> usize {
    match compared.model_error() {
        ModelError::Within(_) => 0,
        ModelError::AtLeast(_) => 1,
        ModelError::BeyondKnown(_) => 2,
        ModelError::Unknown => 3,
    }
}

/// Case and variant of each comparison, without what all of the same case have in common.
fn names(own: &[Comparison<'_>]) -> Vec<String> {
    let is_common = |compared: &Comparison<'_>, key: &str| {
        let same = own.iter().filter(|other| other.case == compared.case);
        let values: Vec<_> = same.map(|other| other.metric.variant.get(key)).collect();
        values.windows(2).all(|pair| pair[0] == pair[1])
    };
    let name = |compared: &Comparison<'_>| {
        let parts = compared.metric.variant.parts().filter(|(key, _)| !is_common(compared, key));
        let parts: Vec<String> = parts.map(|(key, value)| key.replace('_', " ") + " " + value.text()).collect();
        format!("{} {}", compared.case, parts.join(", ")).trim_end().to_owned()
    };
    own.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Confidence, Metric, MetricKind, Origin, Variant};
    use crate::tests::{case, report};

    #[test]
    fn comparisons_stand_in_lines_named_by_what_differs() {
        let measured = |variant: &str, value: f64| {
            let variant: Variant = variant.parse().expect("a variant");
            Metric::observed("run_out", &variant, value, "-").of_kind(MetricKind::Validation).against(
                Some(2.0),
                "an experiment",
                Confidence::Medium,
            )
        };
        let known = measured("material=sand,resolution=20", 2.1).known_to(Origin::Repeat, Some(0.3), "seeds");
        let report = report(vec![
            case("column", vec![known, measured("material=bars,resolution=20", 1.5)]),
            case("round", vec![measured("material=sand,resolution=12", 1.0)]),
        ]);
        let figures = figures(&report);
        let panel = &figures[0].panels[0];
        assert_eq!(panel.y.names, ["round", "column material bars", "column material sand"]);
        assert_eq!((panel.x.label.as_str(), panel.y.label.as_str()), ("run out [-]", ""));
        let of = |label: &str| panel.series.iter().find(|series| series.label == label).expect(label);
        assert_eq!(of("validated within u_val").points, [(2.1, 3.0)]);
        assert_eq!(
            of("u_val not known").points,
            [(1.5, 2.0), (1.0, 1.0)][..].iter().rev().copied().collect::<Vec<_>>()
        );
        let bars: Vec<_> = panel.series.iter().filter(|series| series.mark == Mark::Line).collect();
        assert_eq!(bars.len(), 1, "a bar where an uncertainty is known");
        assert!((bars[0].points[1].0 - bars[0].points[0].0 - 0.6).abs() < 1e-12);
    }
}
