//! The four flows that the first page opens with: a figure, its number, and how far each is validated.

use super::comparison::{self, Comparison, comparisons};
use super::judgement::{JudgedCase, Judgement, KINDS, Tally};
use super::power::rejected_inputs;
use super::rows::limit;
use super::view::VerdictMark;
use super::{CaseReport, DrawnFigure};
use crate::evidence::StatedUncertainty;
use crate::figure::Figure;
use crate::metric::{COVERAGE, Metric, Origin, Variant};
use crate::number::two_digits;
use serde_json::{Value, json};

/// A flow, the cases that show it and the figure that stands for it in each.
struct Flow {
    title: &'static str,
    figures: &'static [(&'static str, &'static str)],
    /// Sentences about the figure's numbers.
    claims: &'static [Claim],
}

/// A sentence with the `{range}` and the `{number}` of the values of a metric, the `{limits}` of their gates, `{half}` of the widest bracket
/// that they are the middle of, the `{wide}` largest relative uncertainty of 95 %, and the `{works}` that they are compared with.
struct Claim {
    case: &'static str,
    metric: &'static str,
    /// Variants that it speaks of.
    of: fn(&Variant) -> bool,
    value: fn(&Metric) -> f64,
    says: &'static str,
}

/// Prediction over reference.
fn over_reference(metric: &Metric) -> f64 {
    metric.reference.as_ref().and_then(|reference| reference.value).map_or(f64::NAN, |value| metric.value / value)
}

/// Whether a variant has a part, such as `material=sand`.
fn has(variant: &Variant, part: &str) -> bool {
    variant.parts().any(|(key, value)| format!("{key}={}", value.text()) == part)
}

const FLOWS: [Flow; 4] = [
    Flow {
        title: "Bagnold's velocity profile",
        figures: &[("bagnold", "velocity-profile")],
        claims: &[Claim {
            case: "bagnold",
            metric: "velocity_l2",
            of: |_| true,
            value: |metric| metric.value,
            says: "Velocity profiles of two materials differ by {range} % (L2) from the exact solution of the same law (limits {limits}); no experiment is involved (runs: {number}).",
        }],
    },
    Flow {
        title: "Layers on slopes",
        figures: &[("fed-slope", "thickness-over-slope"), ("flow-thickness", "start-stop")],
        claims: &[
            Claim {
                case: "fed-slope",
                metric: "thickness_behind_front",
                of: |_| true,
                value: over_reference,
                says: "Layers that start from the exact front of the same law stay {range} times as thick behind it; no experiment is involved (slopes: {number}).",
            },
            Claim {
                case: "fed-slope",
                metric: "front_speed",
                of: |_| true,
                value: over_reference,
                says: "Their fronts move at {range} of the exact speed.",
            },
            Claim {
                case: "flow-thickness",
                metric: "experimental_excess",
                of: |variant| variant.get("surface").is_none(),
                value: |metric| metric.value,
                says: "Layers of the local law stop on slopes {range}° flatter (± {half}°, half the bracket) than by the fit of {works} to experiments (layers: {number}).",
            },
            Claim {
                case: "flow-thickness",
                metric: "experimental_excess",
                of: |variant| has(variant, "surface=vanishing"),
                value: |metric| metric.value,
                says: "Layers of the nonlocal law, with a fluidity that vanishes at the surface, stop on slopes {range}° flatter (± {half}°, layers: {number}).",
            },
        ],
    },
    Flow {
        title: "Collapses",
        figures: &[("column-planar", "scaling"), ("column-round", "scaling"), ("incline-collapse", "run-out")],
        claims: &[
            Claim {
                case: "column-planar",
                metric: "run_out",
                of: |variant| has(variant, "material=sand"),
                value: over_reference,
                says: "Columns of sand on a plane run out {range} times as far as by the fit of {works} to experiments (columns: {number}).",
            },
            Claim {
                case: "column-planar",
                metric: "final_height",
                of: |variant| has(variant, "material=sand"),
                value: over_reference,
                says: "Their deposits are {range} times as high as by that fit.",
            },
            Claim {
                case: "column-planar",
                metric: "kinetic_energy",
                of: |_| true,
                value: over_reference,
                says: "Two fall times after the release columns have {range} times the kinetic energy that another code gives under the same law (columns: {number}).",
            },
        ],
    },
    Flow {
        title: "Bed load",
        figures: &[("bed-load-1d", "transport"), ("bed-load", "transport")],
        claims: &[
            Claim {
                case: "bed-load-1d",
                metric: "transport_ratio",
                of: |variant| has(variant, "start=rest"),
                value: |metric| metric.value,
                says: "A 1-D continuum of dilating grains, without particles, transports {range} times the rate by the dashed fit of {works} (slopes: {number}). The inputs make these ratios uncertain by up to ± {wide} % (two standard uncertainties).",
            },
            Claim {
                case: "bed-load",
                metric: "transport_ratio",
                of: |variant| has(variant, "formulation=stabilised"),
                value: |metric| metric.value,
                says: "Bingham grains, fitted on other slopes, transport {range} times that rate.",
            },
        ],
    },
];

/// The figure of a case that stands for its flow.
pub(super) fn figure_of(case: &CaseReport) -> Option<&Figure> {
    let (_, name) = FLOWS.iter().flat_map(|flow| flow.figures).find(|(name, _)| *name == case.name)?;
    case.figures.iter().find(|figure| figure.name == *name)
}

/// The flows that the report has a case of. `drawn` holds the figures of the cases in the report's order, `small` the small
/// pictures.
pub(super) fn panels(judgement: &Judgement<'_>, drawn: &[Vec<DrawnFigure>], small: &[DrawnFigure]) -> Vec<Value> {
    FLOWS.iter().filter_map(|flow| panel(flow, judgement, drawn, small)).collect()
}

fn panel(flow: &Flow, judgement: &Judgement<'_>, drawn: &[Vec<DrawnFigure>], small: &[DrawnFigure]) -> Option<Value> {
    let report = judgement.report;
    let place = |name: &str| report.cases.iter().position(|case| case.name == name);
    let places: Vec<usize> = flow.figures.iter().filter_map(|(name, _)| place(name)).collect();
    let cases: Vec<&CaseReport> = places.iter().map(|&place| &report.cases[place]).collect();
    let first = places.iter().find_map(|&place| {
        let case = &report.cases[place];
        let name = &figure_of(case)?.name;
        let whole = drawn.get(place)?.iter().find(|drawn| drawn.name == *name && drawn.failure.is_none())?;
        let small = small.iter().find(|drawn| drawn.name == case.name && drawn.failure.is_none())?;
        Some((whole, small))
    });
    let (figure, small) = first?;
    let all = comparisons(report);
    // a run that shows what an input does is no comparison of its own
    let is_altered = |own: &&Comparison<'_>| {
        StatedUncertainty::of(own.case).is_some_and(|stated| stated.is_altered(&own.metric.variant))
    };
    let compared = all.iter().flat_map(|(_, own)| own).filter(|own| cases.iter().any(|case| case.name == own.case));
    let compared: Vec<&Comparison<'_>> = compared.filter(|own| !is_altered(own)).collect();
    Some(json!({
        "title": flow.title,
        // the whole figure, whose files are linked, and its first panel
        "figure": figure,
        "small": small,
        "sentences": flow.claims.iter().filter_map(|claim| sentence(claim, &cases)).collect::<Vec<_>>(),
        "verdict": verdict(&compared, &cases, judgement),
        "controls": cases.iter().filter_map(|case| Some(json!({ "case": case.name, "text": rejected_inputs(case)? }))).collect::<Vec<_>>(),
        "cases": cases.iter().map(|case| &case.name).collect::<Vec<_>>(),
    }))
}

fn sentence(claim: &Claim, cases: &[&CaseReport]) -> Option<String> {
    let all = cases.iter().filter(|case| case.name == claim.case).flat_map(|case| &case.metrics);
    let named = all.filter(|metric| metric.name == claim.metric && (claim.of)(&metric.variant));
    let own: Vec<&Metric> = named.filter(|metric| (claim.value)(metric).is_finite()).collect();
    let range = span(own.iter().map(|metric| (claim.value)(metric)), decimals)?;
    // the middle of a bracket is known as an even spread of its width
    let known = own.iter().filter_map(|metric| metric.uncertainty.of(&[Origin::Numerical])).fold(0.0, f64::max);
    let mut works: Vec<&str> =
        own.iter().filter_map(|metric| metric.reference.as_ref()?.source.split(',').next()).collect();
    works.dedup();
    let mut limits: Vec<String> =
        own.iter().filter_map(|metric| Some(limit(metric.gate.as_ref()?.limit, &metric.unit))).collect();
    limits.dedup();
    let relative = own.iter().filter_map(|metric| Some(COVERAGE * metric.uncertainty.standard()? / metric.value.abs()));
    let wide = two_digits(100.0 * relative.fold(0.0, f64::max));
    let says = claim
        .says
        .replace("{range}", &range)
        .replace("{half}", &decimals(3.0_f64.sqrt() * known))
        .replace("{limits}", &limits.join(", "))
        .replace("{wide}", &wide);
    Some(says.replace("{works}", &works.join(" and ")).replace("{number}", &own.len().to_string()))
}

/// Two decimals; two digits of what is smaller than a tenth.
fn decimals(value: f64) -> String {
    if value.abs() < 0.1 { two_digits(value) } else { format!("{value:.2}").replace('-', "−") }
}

/// Least and greatest of some values; none without values.
fn span(values: impl Iterator<Item = f64>, digits: fn(f64) -> String) -> Option<String> {
    let (least, most) = values.map(|value| (value, value)).reduce(|all, own| (all.0.min(own.0), all.1.max(own.1)))?;
    let [least, most] = [least, most].map(digits);
    Some(if least == most { most } else { format!("{least} to {most}") })
}

/// What the `{number}` of `{all}` comparisons with one verdict say of the model, which is off by a `{share}`; in the order of the verdicts.
const STATEMENTS: [(VerdictMark, &str); 4] = [
    (VerdictMark::PASS, "{number} of {all} comparisons with published results agree within their uncertainty, {share}"),
    (VerdictMark::EXPECTED, "{number} differ by more than their uncertainty; the least model errors are {share}"),
    (VerdictMark::INCONCLUSIVE, "{number} are undecided, because part of the uncertainty is unknown"),
    (VerdictMark::OBSERVED, "without known uncertainty: {number}"),
];

/// Verdict on the model by comparisons with published results, and the number of gates that pass.
fn verdict(compared: &[&Comparison<'_>], cases: &[&CaseReport], judgement: &Judgement<'_>) -> Vec<Value> {
    let mut lines = Vec::new();
    let mut add = |mark: VerdictMark, text: String| lines.push(json!({ "mark": mark, "text": text }));
    let all = compared.len();
    for (place, (mark, says)) in STATEMENTS.into_iter().enumerate() {
        let own = || compared.iter().filter(|own| comparison::verdict(own) == place);
        let shares = own().map(|own| own.model_error().size() / own.measured().abs()).filter(|share| share.is_finite());
        let share = span(shares, |share| two_digits(100.0 * share));
        let share = share.map_or_else(String::new, |span| format!("{span} % of the reference"));
        let number = own().count();
        if number > 0 {
            let says = says.replace("{number}", &number.to_string()).replace("{all}", &all.to_string());
            add(mark, says.replace("{share}", &share));
        }
    }
    if all == 0 {
        add(VerdictMark::OBSERVED, "no published result with a stated uncertainty is compared here".to_owned());
    }
    let is_own = |judged: &JudgedCase<'_>| cases.iter().any(|case| case.name == judged.case.name);
    for (kind, name) in &KINDS[..3] {
        let own = judgement.metrics().filter(|(judged, own)| is_own(judged) && own.metric.kind == *kind);
        let tally = Tally(own.filter_map(|(_, judged)| judged.severity).collect());
        if tally.all() > 0 {
            add(VerdictMark::of(tally.0.iter().min().copied()), format!("{name}, {}", tally.in_words()));
        }
    }
    lines
}
