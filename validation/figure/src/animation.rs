//! Moving pictures: particles coloured by a scalar over time on fixed axes, as plain data.

use super::{Axis, Field, Figure, Panel, Series};
use serde::{Deserialize, Serialize};

/// An animation. Axes and colours are fixed, so that only what moves moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Animation {
    /// File name without ending, kebab-case, unique within its folder.
    pub name: String,
    /// Caption for the report: what is seen and what it means.
    pub caption: String,
    /// Horizontal axis with limits.
    pub x: Axis,
    /// Vertical axis with limits.
    pub y: Axis,
    /// Label of the colour bar with unit.
    pub label: String,
    /// Colour limits, in the unit of the values.
    pub limits: (f64, f64),
    /// Time that a picture is shown `[s]`; the last one is shown longer.
    pub seconds_per_frame: f64,
    /// The pictures in time order.
    pub frames: Vec<AnimationFrame>,
}

/// One picture of an animation. Single precision is finer than a pixel and halves what a long animation holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AnimationFrame {
    /// Title, which includes the time.
    pub title: String,
    /// Positions (x, y) in axis units.
    pub points: Vec<[f32; 2]>,
    /// The scalar of each point.
    pub values: Vec<f32>,
    /// Particle diameter in axis units.
    pub diameter: f64,
    /// Lines over the particles; unlabelled, since a legend would move with the data.
    pub lines: Vec<Series>,
}

impl Animation {
    /// The figure of one picture.
    pub fn figure(&self, frame: &AnimationFrame) -> Figure {
        let mut panel = Panel::new(&frame.title, self.x.clone(), self.y.clone());
        panel.field = Some(Field {
            points: frame.points.iter().map(|&[x, y]| (f64::from(x), f64::from(y))).collect(),
            values: frame.values.iter().copied().map(f64::from).collect(),
            label: self.label.clone(),
            diameter: frame.diameter,
            limits: Some(self.limits),
        });
        panel.series.clone_from(&frame.lines);
        Figure { name: self.name.clone(), caption: String::new(), panels: vec![panel], columns: 1 }
    }
}
