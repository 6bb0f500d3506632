//! The four flows that the first page opens with: a figure, its number, and how far each is validated.

use super::comparison::{Comparison, ModelError, comparisons};
use super::power::{GatePower, rejected_inputs};
use super::view::{FigureView, VerdictMark, picture};
use super::{CaseReport, DrawnFigure, Report};
use crate::figure::Figure;
use crate::metric::{Metric, MetricKind, Verdict};
use crate::number::two_digits;
use serde::Serialize;

/// A flow, the cases that show it and the figure that stands for it in each.
struct Flow {
    title: &'static str,
    figures: &'static [(&'static str, &'static str)],
    /// Sentences about the figure's number: the first that has one is shown.
    claims: &'static [Claim],
}

/// A sentence with the `{least}`, the `{most}` and the `{number}` of values.
struct Claim {
    metric: &'static [&'static str],
    of: Share,
    says: &'static str,
}

/// Things that a claim counts.
enum Share {
    /// The value of a metric.
    Value,
    /// Prediction over reference.
    OverReference,
}

const FLOWS: [Flow; 4] = [
    Flow {
        title: "Bagnold's velocity profile",
        figures: &[("bagnold", "velocity-profile")],
        claims: &[Claim {
            metric: &["velocity_l2"],
            of: Share::Value,
            says: "Velocity profiles are within {most} % (L2) of Bagnold's solution (runs: {number}).",
        }],
    },
    Flow {
        title: "Thickness of flow",
        figures: &[("flow-thickness", "start-stop")],
        claims: &[Claim {
            metric: &["experimental_excess"],
            of: Share::Value,
            says: "Layers stop at slopes {least}° to {most}° below the measured stopping curve (runs: {number}).",
        }],
    },
    Flow {
        title: "Collapses",
        figures: &[("column-planar", "scaling"), ("column-round", "scaling"), ("incline-collapse", "run-out")],
        claims: &[Claim {
            metric: &["run_out", "front_displacement"],
            of: Share::OverReference,
            says: "Run-outs are {least} to {most} times those of experiments and published laws (comparisons: {number}).",
        }],
    },
    Flow {
        title: "Bed load",
        figures: &[("bed-load-1d", "transport"), ("bed-load", "transport")],
        claims: &[
            Claim {
                metric: &["transport_over_measured"],
                of: Share::Value,
                says: "The transport is {least} to {most} times the median of measured runs (slopes: {number}).",
            },
            Claim {
                metric: &["predicted_transport"],
                of: Share::OverReference,
                says: "The transport is {least} to {most} times a fit to measured runs (slopes: {number}).",
            },
        ],
    },
];

/// A flow as the template sees it.
#[derive(Debug, Serialize)]
pub(super) struct FlowPanel {
    title: &'static str,
    cases: Vec<String>,
    /// The whole figure, whose files are linked.
    figure: FigureView,
    /// Its first panel.
    small: FigureView,
    sentence: String,
    verdict: Vec<VerdictLine>,
    controls: Vec<String>,
}

/// A part of a verdict.
#[derive(Debug, Serialize)]
struct VerdictLine {
    mark: VerdictMark,
    text: String,
}

/// The figure that stands for a case: that of its flow, else its first.
pub(super) fn figure_of(case: &CaseReport) -> Option<&Figure> {
    let named = FLOWS.iter().flat_map(|flow| flow.figures).find(|(name, _)| *name == case.name);
    let found = named.and_then(|(_, name)| case.figures.iter().find(|figure| figure.name == *name));
    found.or(case.figures.first())
}

/// The flows that the report has a case of. `drawn` holds the figures of the cases in the report's order, `small` those of the
/// table of cases.
pub(super) fn panels(report: &Report, drawn: &[Vec<DrawnFigure>], small: &[DrawnFigure]) -> Vec<FlowPanel> {
    FLOWS.iter().filter_map(|flow| panel(flow, report, drawn, small)).collect()
}

fn panel(flow: &Flow, report: &Report, drawn: &[Vec<DrawnFigure>], small: &[DrawnFigure]) -> Option<FlowPanel> {
    let place = |name: &str| report.cases.iter().position(|case| case.name == name);
    let places: Vec<usize> = flow.figures.iter().filter_map(|(name, _)| place(name)).collect();
    let cases: Vec<&CaseReport> = places.iter().map(|&place| &report.cases[place]).collect();
    let first = places.iter().find_map(|&place| {
        let case = &report.cases[place];
        let name = &figure_of(case)?.name;
        let whole = drawn.get(place)?.iter().find(|drawn| drawn.name == *name && drawn.failure.is_none())?;
        let small = small.iter().find(|drawn| drawn.name == case.name && drawn.failure.is_none())?;
        Some((picture(whole), picture(small)))
    });
    let (figure, small) = first?;
    let all = comparisons(report);
    let compared: Vec<&Comparison<'_>> =
        all.iter().flat_map(|(_, own)| own).filter(|own| cases.iter().any(|case| case.name == own.case)).collect();
    Some(FlowPanel {
        title: flow.title,
        figure,
        small,
        sentence: flow.claims.iter().find_map(|claim| sentence(claim, &compared, &cases)).unwrap_or_default(),
        verdict: verdict(&compared, &cases),
        controls: cases.iter().filter_map(|case| rejected_inputs(case)).collect(),
        cases: cases.iter().map(|case| case.name.clone()).collect(),
    })
}

fn sentence(claim: &Claim, compared: &[&Comparison<'_>], cases: &[&CaseReport]) -> Option<String> {
    let is_it = |name: &str| claim.metric.contains(&name);
    let values: Vec<f64> = match claim.of {
        Share::Value => {
            let metrics = cases.iter().flat_map(|case| &case.metrics).filter(|metric| is_it(&metric.name));
            metrics.map(|metric| metric.value).filter(|value| value.is_finite()).collect()
        }
        Share::OverReference => {
            let own = compared.iter().filter(|own| is_it(&own.metric.name));
            own.map(|own| own.metric.value / own.measured()).filter(|ratio| ratio.is_finite()).collect()
        }
    };
    let (least, most) = range(values.iter().copied())?;
    let text = claim.says.replace("{least}", &two_digits(least)).replace("{most}", &two_digits(most));
    Some(text.replace("{number}", &values.len().to_string()))
}

/// Verdict on the model by comparisons with measurements, and the number of gates that hold.
fn verdict(compared: &[&Comparison<'_>], cases: &[&CaseReport]) -> Vec<VerdictLine> {
    let mut lines = Vec::new();
    let mut add = |mark, text| lines.push(VerdictLine { mark, text });
    // how many comparisons say something, and the part of the reference that it is about
    let those = |part: fn(ModelError) -> Option<f64>| {
        let own: Vec<(f64, f64)> =
            compared.iter().filter_map(|own| Some((part(own.model_error())?, own.measured().abs()))).collect();
        let shares = own.iter().map(|(part, reference)| part / reference).filter(|share| share.is_finite());
        let of_reference = range(shares).map_or_else(String::new, |(least, most)| {
            let [least, most] = [least, most].map(|share| two_digits(100.0 * share));
            let span = if least == most { most } else { format!("{least} to {most}") };
            format!("{span} % of the reference")
        });
        Some((own.len(), of_reference)).filter(|(number, _)| *number > 0)
    };
    let all = compared.len();
    if let Some((number, level)) = those(|error| if let ModelError::Within(level) = error { Some(level) } else { None })
    {
        add(VerdictMark::PASS, format!("validated within u_val in {number} of {all} comparisons: u_val is {level}"));
    }
    if let Some((number, least)) =
        those(|error| if let ModelError::AtLeast(least) = error { Some(least) } else { None })
    {
        add(VerdictMark::KNOWN, format!("model error of at least {least} in {number}"));
    }
    if let Some((number, _)) = those(|error| if let ModelError::BeyondKnown(by) = error { Some(by) } else { None }) {
        add(VerdictMark::OBSERVED, format!("error above the known part of u_val in {number}"));
    }
    if let Some((number, _)) = those(|error| (error == ModelError::Unknown).then_some(0.0)) {
        add(VerdictMark::OBSERVED, format!("not known in {number}"));
    }
    if all == 0 {
        add(VerdictMark::OBSERVED, "not known: no comparison with a measured value".to_owned());
    }
    for (kind, what) in [(MetricKind::Validation, "experiments"), (MetricKind::Verification, "exact solutions")] {
        let judged = cases.iter().flat_map(|case| &case.metrics).filter(|metric| metric.kind == kind);
        let verdicts: Vec<Verdict> = judged.map(Metric::verdict).filter(|own| *own != Verdict::Observed).collect();
        let holding = verdicts.iter().filter(|own| **own == Verdict::Pass).count();
        if !verdicts.is_empty() {
            let mark = if holding == verdicts.len() { VerdictMark::PASS } else { VerdictMark::KNOWN };
            add(mark, format!("{holding} of {} gates against {what} hold", verdicts.len()));
        }
    }
    let powers = cases.iter().flat_map(|case| case.metrics.iter().map(|metric| GatePower::of(case, metric)));
    let blind = powers.filter(|power| *power == GatePower::CannotTell).count();
    if blind > 0 {
        add(VerdictMark::KNOWN, format!("cannot tell: {blind} of those that hold reject no control"));
    }
    lines
}

fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().map(|value| (value, value)).reduce(|all, own| (all.0.min(own.0), all.1.max(own.1)))
}
