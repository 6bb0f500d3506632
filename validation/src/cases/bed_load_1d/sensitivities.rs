//! Closures that differ from the literature's in one point.

use super::Record;
use super::figures::percent;
use super::metrics::of;
use super::parameters::BedLoad1dParameters;
use super::runs::{BedLoad1dRun, Purpose};
use crate::case::ParameterError;
use crate::cases::rules;
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};
use crate::reference::TransportFormula;
use crate::reference::bed_load_layer::{Closures, LayerState, MixingLength};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::parameter::{between, each, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What each closure is replaced by, one at a time; empty lists for none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sensitivities {
    /// μ_2 `[-]`.
    #[schemars(transform = each(positive("give μ_2, such as 0.97")))]
    pub limiting_friction: Vec<f64>,
    /// μ_s `[-]`.
    #[schemars(transform = each(positive("give μ_s, such as 0.35")))]
    pub static_friction: Vec<f64>,
    /// I_0 `[-]`.
    #[schemars(transform = each(positive("give I_0, such as 0.69")))]
    pub reference_inertia: Vec<f64>,
    /// φ_max `[-]`.
    #[schemars(transform = each(between(0.1, 0.74, "grains at rest fill 0.5 to 0.64 of the space")))]
    pub largest_fraction: Vec<f64>,
    /// B `[-]`.
    #[schemars(transform = each(between(0.0, 100.0, "grains loosen in shear: give B, such as 0.31, or 0 for grains that do not")))]
    pub dilation: Vec<f64>,
    /// Heights of cells `[m]`.
    #[schemars(transform = each(positive("give it in metres, such as 2.5e-4")))]
    pub cell_height: Vec<f64>,
    /// Drag laws.
    pub drag: Vec<DragLaw>,
    /// Mixing lengths.
    pub mixing_length: Vec<MixingLength>,
}

/// A replaced closure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Replaced {
    /// μ_2 `[-]`.
    LimitingFriction(f64),
    /// μ_s `[-]`.
    StaticFriction(f64),
    /// I_0 `[-]`.
    ReferenceInertia(f64),
    /// φ_max `[-]`.
    LargestFraction(f64),
    /// B `[-]`.
    Dilation(f64),
    /// Height of a cell `[m]`.
    CellHeight(f64),
    /// Drag law.
    Drag(DragLaw),
    /// Mixing length.
    MixingLength(MixingLength),
}

impl Sensitivities {
    /// None.
    pub(super) fn none() -> Self {
        Self {
            limiting_friction: Vec::new(),
            static_friction: Vec::new(),
            reference_inertia: Vec::new(),
            largest_fraction: Vec::new(),
            dilation: Vec::new(),
            cell_height: Vec::new(),
            drag: Vec::new(),
            mixing_length: Vec::new(),
        }
    }

    /// The range of the literature for each closure; Gidaspow's drag, which jumps at φ = 0.2, has no steady state.
    pub(super) fn literature() -> Self {
        Self {
            limiting_friction: vec![0.64, 0.8, 1.2],
            static_friction: vec![0.3, 0.4],
            reference_inertia: vec![0.3, 1.0],
            largest_fraction: vec![0.55, 0.64],
            dilation: vec![0.0, 0.15, 0.62],
            cell_height: vec![1e-3, 5e-4, 1.25e-4],
            drag: vec![DragLaw::SchillerNaumann, DragLaw::MorsiAlexander, DragLaw::WenYu, DragLaw::Ergun],
            mixing_length: vec![MixingLength::Root, MixingLength::Linear],
        }
    }

    /// All replacements, closure by closure.
    pub(super) fn all(&self) -> Vec<Replaced> {
        let values =
            |values: &[f64], replaced: fn(f64) -> Replaced| values.iter().map(|v| replaced(*v)).collect::<Vec<_>>();
        let mut all = values(&self.limiting_friction, Replaced::LimitingFriction);
        all.extend(values(&self.static_friction, Replaced::StaticFriction));
        all.extend(values(&self.reference_inertia, Replaced::ReferenceInertia));
        all.extend(values(&self.largest_fraction, Replaced::LargestFraction));
        all.extend(values(&self.dilation, Replaced::Dilation));
        all.extend(values(&self.cell_height, Replaced::CellHeight));
        all.extend(self.drag.iter().map(|law| Replaced::Drag(*law)));
        all.extend(self.mixing_length.iter().map(|length| Replaced::MixingLength(*length)));
        all
    }

    pub(super) fn check(&self, parameters: &BedLoad1dParameters) -> Result<(), ParameterError> {
        for replaced in self.all() {
            let (changed, cell_height) = replaced.apply(parameters.closures, parameters.cell_height);
            rules::refuse("sensitivities", changed.problem())?;
            parameters.cells("sensitivities.cell_height", cell_height)?;
        }
        Ok(())
    }
}

impl Replaced {
    /// The closures and the height of a cell with the replacement.
    pub(super) fn apply(self, closures: Closures, cell_height: f64) -> (Closures, f64) {
        let changed = match self {
            Self::LimitingFriction(limiting_friction) => Closures { limiting_friction, ..closures },
            Self::StaticFriction(static_friction) => Closures { static_friction, ..closures },
            Self::ReferenceInertia(reference_inertia) => Closures { reference_inertia, ..closures },
            Self::LargestFraction(largest_fraction) => Closures { largest_fraction, ..closures },
            Self::Dilation(dilation) => Closures { dilation, ..closures },
            Self::CellHeight(_) => closures,
            Self::Drag(drag) => Closures { drag, ..closures },
            Self::MixingLength(mixing_length) => Closures { mixing_length, ..closures },
        };
        (changed, if let Self::CellHeight(height) = self { height } else { cell_height })
    }

    /// Name of the closure as in the parameters.
    pub(super) fn closure(self) -> &'static str {
        match self {
            Self::LimitingFriction(_) => "limiting_friction",
            Self::StaticFriction(_) => "static_friction",
            Self::ReferenceInertia(_) => "reference_inertia",
            Self::LargestFraction(_) => "largest_fraction",
            Self::Dilation(_) => "dilation",
            Self::CellHeight(_) => "cell_height",
            Self::Drag(_) => "drag",
            Self::MixingLength(_) => "mixing_length",
        }
    }

    /// Its value, if it is a number.
    pub(super) fn value(self) -> Option<f64> {
        match self {
            Self::LimitingFriction(value)
            | Self::StaticFriction(value)
            | Self::ReferenceInertia(value)
            | Self::LargestFraction(value)
            | Self::Dilation(value)
            | Self::CellHeight(value) => Some(value),
            Self::Drag(_) | Self::MixingLength(_) => None,
        }
    }

    /// Its value as in the parameters.
    pub(super) fn value_text(self) -> String {
        match self {
            Self::Drag(law) => law.name().to_owned(),
            Self::MixingLength(length) => length.name().to_owned(),
            _ => self.value().map_or_else(String::new, |value| value.to_string()),
        }
    }
}

/// Closures in the order of the figure, with their labels.
const DRAWN: [(&str, &str); 8] = [
    ("limiting_friction", "μ_2 [-]"),
    ("static_friction", "μ_s [-]"),
    ("reference_inertia", "I_0 [-]"),
    ("largest_fraction", "φ_max [-]"),
    ("dilation", "B [-]"),
    ("cell_height", "height of a cell [mm]"),
    ("drag", "drag law, numbered"),
    ("mixing_length", "mixing length, numbered"),
];

/// Place of a replacement on its axis; laws are numbered.
fn place(replaced: Replaced) -> f64 {
    match replaced {
        Replaced::Drag(law) => {
            DragLaw::ALL.iter().position(|other| *other == law).map_or(0.0, |place| place as f64 + 1.0)
        }
        Replaced::MixingLength(length) => match length {
            MixingLength::None => 0.0,
            MixingLength::Integral => 1.0,
            MixingLength::Root => 2.0,
            MixingLength::Linear => 3.0,
        },
        Replaced::CellHeight(height) => 1e3 * height,
        _ => replaced.value().unwrap_or(f64::NAN),
    }
}

/// The literature's own closure of a name.
fn own(name: &str, run: &BedLoad1dRun) -> Replaced {
    let closures = &run.closures;
    match name {
        "limiting_friction" => Replaced::LimitingFriction(closures.limiting_friction),
        "static_friction" => Replaced::StaticFriction(closures.static_friction),
        "reference_inertia" => Replaced::ReferenceInertia(closures.reference_inertia),
        "largest_fraction" => Replaced::LargestFraction(closures.largest_fraction),
        "dilation" => Replaced::Dilation(closures.dilation),
        "cell_height" => Replaced::CellHeight(run.cell_height),
        "drag" => Replaced::Drag(closures.drag),
        _ => Replaced::MixingLength(closures.mixing_length),
    }
}

/// Transport over the value of each closure.
pub(super) fn figure(records: &[Record], layers: &[(&BedLoad1dRun, &LayerState)]) -> Option<Figure> {
    let mut panels = Vec::new();
    for (name, label) in DRAWN {
        let mut panel = Panel::new("", Axis::linear(label), Axis::logarithmic("q*/q* of Wong & Parker [-]"));
        for (slot, (run, state)) in layers.iter().enumerate() {
            let expected = TransportFormula::WongParker.transport(run.stream.shields_number());
            let mut points: Vec<(f64, f64)> = of(records, |purpose| matches!(purpose, Purpose::Sensitivity(_)))
                .filter(|(other, _)| other.stream.slope == run.stream.slope)
                .filter_map(|(other, state)| match other.purpose {
                    Purpose::Sensitivity(replaced) if replaced.closure() == name => {
                        Some((place(replaced), state.transport() / expected))
                    }
                    _ => None,
                })
                .collect();
            if points.is_empty() || expected <= 0.0 {
                continue;
            }
            points.push((place(own(name, run)), state.transport() / expected));
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let entry = if panels.is_empty() { percent(run) } else { String::new() };
            let mark = if matches!(name, "drag" | "mixing_length") { Mark::Points } else { Mark::LinePoints };
            panel.series.push(Series::new(&entry, mark, slot, points));
        }
        if panel.series.is_empty() {
            continue;
        }
        let places = || panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
        let (from, to) = (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
        let entry = if panels.is_empty() { "gate of the transport" } else { "" };
        panel.bands.push(Band { label: entry.to_owned(), points: vec![(from, 0.8, 1.25), (to, 0.8, 1.25)] });
        panels.push(panel);
    }
    (!panels.is_empty()).then(|| Figure {
        name: "sensitivities".to_owned(),
        caption: "Transport over that of Wong & Parker's formula when one closure is replaced, the others kept. Drag laws: \
                  1 Morsi–Alexander, 2 Schiller–Naumann, 3 Wen–Yu, 4 Ergun, 5 Gidaspow, 6 Di Felice; mixing lengths: 1 \
                  integral over the room between the grains, 2 κ z √(1 − z/h), 3 κ z. The mixing length decides: eddies \
                  that do not feel the grains triple the transport; limiting friction and dilation follow."
            .to_owned(),
        panels,
        columns: 2,
    })
}
