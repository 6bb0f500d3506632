//! Positions and speeds at many times, in the few bytes that an animation needs.

use serde::{Deserialize, Serialize};

/// A run as a sequence of pictures.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MotionSequence {
    /// Pictures in time order.
    pub frames: Vec<MotionFrame>,
    /// Share of the particles that was kept `[-]`: the same ones in every picture.
    pub share: f64,
}

/// One picture. Single precision is a hundred times finer than a pixel.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MotionFrame {
    /// Time `[s]`.
    pub time: f64,
    /// Positions along the flow and across it `[m]`.
    pub position: Vec<[f32; 2]>,
    /// Speeds `[m/s]`, one a position.
    pub speed: Vec<f32>,
    /// The surface as a chain of points `[m]`.
    pub surface: Vec<[f32; 2]>,
    /// The front's place along the flow `[m]`.
    pub front: f64,
}
