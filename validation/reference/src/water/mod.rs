//! Water: collapsing columns and channels with a rough bed.

mod liquid_column;
mod rough_channel;

pub use liquid_column::{
    GATED_WATER_FRONT, HEIGHT_READING, MeasuredFront, MeasuredHeights, NamedFront, OTHER_WATER_FRONTS, WATER_FRONT,
    WATER_HEIGHTS, spread_of_water_fronts,
};
pub use rough_channel::{RoughChannel, roughness_ratio};
