//! Inputs of grains in suspension, their ranges, and the flows that they are varied in.

use crate::metric::Variant;
use crate::reference::one_dimension::bed_load::Stream;
use bagnold_solver::parameter::{between, each, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Inputs of grains in suspension. Each list is varied alone; an empty list varies nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SuspensionInputs {
    /// Flows whose grains eddies carry; empty for none.
    pub flows: Vec<SuspendedFlow>,
    /// Height of a cell of the measured sheet flows `[m]`.
    #[schemars(transform = positive("give it in metres, such as 1e-3"))]
    pub cell_height: f64,
    /// Turbulent Schmidt number Sc `[-]`, eddy viscosity over the diffusivity of grains; a large one is no suspension.
    #[schemars(transform = between(0.05, 1e9, "0.4 to 1 for suspensions, 1e6 for no suspension"))]
    pub schmidt_number: f64,
    /// Diameter of the sphere with the drag of a grain of the measured sheet flow, over d `[-]`.
    #[schemars(transform = between(0.01, 2.0, "it counts grain diameters: 1 for spheres, 0.5 for crushed plastic"))]
    pub drag_diameter: f64,
    /// Other Schmidt numbers `[-]`.
    #[schemars(transform = each(between(0.05, 1e9, "0.4 to 1 for suspensions")))]
    pub schmidt_numbers: Vec<f64>,
    /// Other diameters of drag over d `[-]`.
    #[schemars(transform = each(between(0.01, 2.0, "it counts grain diameters: 1 for spheres, 0.5 for crushed plastic")))]
    pub drag_diameters: Vec<f64>,
    /// Other values of von Kármán's κ `[-]`.
    #[schemars(transform = each(positive("0.41 in clear water, less with sediment")))]
    pub karman_constants: Vec<f64>,
    /// Other heights of a cell `[m]`.
    #[schemars(transform = each(positive("give it in metres, such as 1e-3")))]
    pub cell_heights: Vec<f64>,
}

impl SuspensionInputs {
    /// Values of the literature, chosen before the runs (`reference-data/bed-load-1d/README.md`).
    pub(super) fn literature() -> Self {
        Self {
            flows: vec![SuspendedFlow::SheetFlow, SuspendedFlow::Duct, SuspendedFlow::Slope],
            cell_height: 5e-4,
            schmidt_number: 0.7,
            drag_diameter: 0.5,
            schmidt_numbers: vec![0.4, 1.0],
            drag_diameters: vec![0.4, 0.6],
            karman_constants: vec![0.225],
            cell_heights: vec![1e-3],
        }
    }

    /// The measured sheet flow alone, in coarse cells.
    pub(super) fn quick() -> Self {
        Self {
            flows: vec![SuspendedFlow::SheetFlow],
            cell_height: 1e-3,
            cell_heights: vec![2e-3],
            ..Self::literature()
        }
    }
}

/// Flow whose grains eddies carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SuspendedFlow {
    /// Sheet flow of Revil-Baudard et al.
    SheetFlow,
    /// Sheet flow of Sumer et al. in a duct, as a stream whose surface is at the height of the largest velocity.
    Duct,
    /// Slope of the case.
    Slope,
}

/// Input that differs from the own ones.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SuspensionInput {
    /// None.
    Own,
    /// No eddies carry grains.
    NoEddies,
    /// Schmidt number `[-]`.
    SchmidtNumber(f64),
    /// Diameter of drag over d `[-]`.
    DragDiameter(f64),
    /// κ `[-]`.
    Karman(f64),
    /// Height of a cell `[m]`.
    CellHeight(f64),
}

/// The variant of a suspended layer.
pub(super) fn variant(flow: SuspendedFlow, input: SuspensionInput, stream: &Stream) -> Variant {
    let own = match flow {
        SuspendedFlow::SheetFlow => Variant::of("layer", "sheet-flow"),
        SuspendedFlow::Duct => Variant::of("layer", "duct"),
        SuspendedFlow::Slope => Variant::of("slope", stream.slope),
    }
    .and("grains", "suspended");
    match input {
        SuspensionInput::Own => own,
        SuspensionInput::NoEddies => own.and("eddies", "none"),
        SuspensionInput::SchmidtNumber(value) => own.and("turbulent_schmidt", value),
        SuspensionInput::DragDiameter(value) => own.and("drag_diameter", value),
        SuspensionInput::Karman(value) => own.and("karman", value),
        SuspensionInput::CellHeight(value) => own.and("cell_height", value),
    }
}
