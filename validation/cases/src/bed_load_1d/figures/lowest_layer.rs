//! The water among moving grains.

use super::super::records::{SolvedLayer, lowest_layer};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::bed_load::{LOWEST_LAYER_TOP, SHEET_FLOW_LOWEST_VELOCITY};
use crate::shared::percent;
use crate::statistics::{Exponent, power_law};

/// The water among moving grains beside the measured sheet flow.
pub(super) fn figure(layers: &[SolvedLayer<'_>], speed: f64) -> Option<Figure> {
    let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
    let height = Axis::logarithmic("height above the grains at rest, over d [-]");
    let mut panel = Panel::new("", height, Axis::logarithmic("u_f/u_* [-]"));
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
    for (slot, (run, state)) in layers.iter().enumerate() {
        let points = lowest_layer(run, state, speed);
        let (Some(law), Some(ends)) = (power_law(&points), range(&points)) else { continue };
        let (entry, line) = fit(&percent(run.stream().slope), law, ends);
        panel.line(&entry, slot + 1, points);
        panel.reference("", line);
    }
    let caption = "Water velocity over the height above the grains at rest. Dashed: power laws with the exponent's \
                   standard error. Points: sheet flow of Sumer et al. (1996) at a larger Shields number; meaning of \
                   columns inferred.";
    Some(Figure::new("lowest-layer", caption, vec![panel]))
}
