//! Bed load: onset of motion, transport formulas and measurements, and measured profiles.

mod layer_statement;
mod lowest_velocity;
mod motion_thresholds;
mod onset;
mod profiles;
mod side_walls;
mod transport;

pub use layer_statement::{LAYER_STATEMENTS, LayerStatement};
pub use lowest_velocity::{LOWEST_LAYER_TOP, LowestVelocity, SHEET_FLOW_LOWEST_VELOCITY};
pub use motion_thresholds::{MOTION_THRESHOLDS, thresholds_about};
pub use onset::{ONSET_SCATTER, ONSET_SOURCE, critical_shields_number};
pub use profiles::MeasuredBedLoad;
pub use side_walls::Flume;
pub use transport::{
    MEASURED_BAND, MEASURED_TRANSPORT, TransportFormula, measured_grains, measured_rates_about, measured_scatter,
};
