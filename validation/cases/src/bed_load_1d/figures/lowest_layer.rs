//! The water among moving grains.

use super::super::records::{SolvedLayer, lowest_layer};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::bed_load::{LOWEST_LAYER_TOP, SHEET_FLOW_LOWEST_VELOCITY};
use crate::shared::percent;
use crate::statistics::{Exponent, power_law};

/// The water among moving grains beside the measured sheet flow.
pub(super) fn figure(layers: &[SolvedLayer<'_>], speed: f64) -> Option<Figure> {
    let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
    let mut panel = Panel::new(
        "",
        Axis::logarithmic("height above the grains at rest, over d [-]"),
        Axis::logarithmic("u_f/u_* [-]"),
    );
    panel.points("Sumer et al. 1996, τ* = 1.4", 0, measured.points.iter().copied());
    let fit = |name: &str, law: Exponent, range: (f64, f64)| {
        let point = |z: f64| (z, law.coefficient * libm::pow(z, law.value));
        let label = format!("{name}: exponent {:.2} ± {:.2}", law.value, law.standard_error);
        (label, [point(range.0), point(range.1)])
    };
    let range = |points: &[(f64, f64)]| Some((points.first()?.0, points.last()?.0));
    let lowest: Vec<(f64, f64)> = measured.points.iter().copied().filter(|point| point.0 <= LOWEST_LAYER_TOP).collect();
    let (entry, line) = fit("lowest layer of Sumer et al.", measured.law, range(&lowest)?);
    panel.reference(&entry, line);
    let mut bends = Vec::new();
    for (slot, (run, state)) in layers.iter().enumerate() {
        let points = lowest_layer(run, state, speed);
        let (Some(law), Some(ends)) = (power_law(&points), range(&points)) else { continue };
        let (entry, line) = fit(&percent(run.stream().slope), law, ends);
        let local = points.windows(2).filter_map(power_law).map(|law| law.value);
        let (least, most) = local.fold((f64::INFINITY, 0.0_f64), |(least, most), n| (least.min(n), most.max(n)));
        bends.push(format!("{least:.2} to {most:.2} at {}", percent(run.stream().slope)));
        panel.line(&entry, slot + 1, points);
        panel.reference("", line);
    }
    let caption = format!(
        "Velocity of the water among moving grains over the height above the grains at rest, where a power law is straight. Dashed are the \
         fits, each over its range, with the standard error of the exponent from the scatter about the fit. The layers bend: their local \
         exponents are {}. Points are the sheet flow that Sumer et al. (1996) measured at a much greater Shields number, whose columns are \
         inferred. Its lowest layer are the points up to {LOWEST_LAYER_TOP} d.",
        bends.join(", ")
    );
    Some(Figure::new("lowest-layer", &caption, vec![panel]))
}
