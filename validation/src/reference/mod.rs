//! What results are compared with: exact profiles, a 1-D solver that checks the particles independently, and
//! published or measured data in CSV files.
//!
//! Nothing here uses the particle solver, so that agreement with it means something; of the solver's leaves only the drag
//! laws are used, which have tests against values computed by hand.

mod bagnold_profile;
pub mod bed_load_layer;
mod bed_load_transport;
mod collapse_laws;
mod error;
mod film;
mod layer_transient;
mod measured;
mod measured_table;
mod rough_channel;
mod settling;
mod slope_laws;

pub use bagnold_profile::BagnoldProfile;
pub use bed_load_transport::{HONEST_BAND, TransportFormula};
pub use collapse_laws::{CollapseLaw, DRAWN, PLANAR_HEIGHT, PLANAR_RUN_OUT, ROUND_HEIGHT, ROUND_RUN_OUT};
pub use error::ReferenceError;
pub use film::{BinghamFilm, HerschelBulkleyFilm, Incline, NewtonianFilm};
pub use layer_transient::{LayerProfile, LayerTransient, TransientHistory};
pub use measured::{Column, Confidence, Kind, MeasuredData, Metadata};
pub use rough_channel::RoughChannel;
pub use settling::{GrainForm, RICHARDSON_ZAKI_CONFIDENCE, SettlingGrains, richardson_zaki_exponent};
pub use slope_laws::{RoughIncline, slope_run_out};
