//! What results are compared with: exact profiles, layers in one dimension that check the particles independently (a package
//! of their own), and published or measured data in CSV files.
//!
//! Nothing here uses the particle solver, so that agreement with it means something; of the solver's `material` only
//! the drag laws and the viscosity of suspensions are used, which have tests against values computed by hand, and the
//! parameters of μ(I) as a record.
//!
//! Numbers of papers stand in `reference-data/*/*.csv` with their provenance. The program carries these tables, reads each
//! once, and no number of a paper is written in the code that uses it.

mod bed_load_onset;
mod bed_load_profiles;
mod bed_load_transport;
mod collapse_laws;
mod collapsed_columns;
mod drag_tables;
mod eddy_film;
mod error;
mod film;
mod grains;
mod input_range;
mod law_film;
mod layer_statement;
mod liquid_column;
mod lowest_velocity;
mod measured;
mod measured_table;
mod motion_thresholds;
mod papers;
mod propagation;
mod rough_channel;
mod sensitivity_table;
mod settling;
mod settling_beads;
mod shipped;
mod slope_laws;
#[cfg(test)]
mod stale_tests;
mod stated_uncertainty;
mod steady_film;
mod validation_set;

pub use bagnold_layer::{
    BagnoldProfile, LayerError, LayerProfile, LayerTransient, NonlocalLayer, NonlocalProfile, NonlocalShear,
    NonlocalShearProfile, ShearStress, TransientHistory, bed_load as bed_load_layer, time_to_steadiness,
};
pub use bed_load_onset::{ONSET_SCATTER, ONSET_SOURCE, critical_shields_number, onset_confidence};
pub use bed_load_profiles::MeasuredBedLoad;
pub use bed_load_transport::{
    MEASURED_BAND, MEASURED_TRANSPORT, MeasuredRates, TransportFormula, measured_rates_about,
};
pub use collapse_laws::{Author, COLLAPSE_DURATION, CollapseLaw, CollapseLaws, DRAWN, PLANAR_COLLAPSE, ROUND_COLLAPSE};
pub use collapsed_columns::{ALUMINIUM_BAR_PILE, MeasuredPile, MeasuredRunOuts, ROUND_COLUMN_RUN_OUTS};
pub use drag_tables::{HINDERED_SLIPS, HinderedSlip, STANDARD_DRAG, StandardDrag};
pub use eddy_film::EddyFilm;
pub use error::ReferenceError;
pub use film::{BinghamFilm, HerschelBulkleyFilm, Incline, NewtonianFilm};
pub use grains::{
    ALUMINIUM_BARS, FlowRule, GLASS_BEADS, GLASS_BEADS_FLOW_RULE, LAGREE_GRAINS, PublishedGrains, TABLE_2_SAND,
};
pub use input_range::{Basis, InputRange, Spread};
pub use law_film::LawFilm;
pub use layer_statement::{LAYER_STATEMENTS, LayerStatement};
pub use liquid_column::{
    GATED_WATER_FRONT, HEIGHT_READING, MeasuredFront, MeasuredHeights, NamedFront, OTHER_WATER_FRONTS, WATER_FRONT,
    WATER_HEIGHTS, spread_of_water_fronts,
};
pub use lowest_velocity::{LowestVelocity, SHEET_FLOW_LOWEST_VELOCITY};
pub use measured::{MeasuredData, Metadata, ReferenceKind};
pub use measured_table::ReferenceColumn;
pub use motion_thresholds::{MOTION_THRESHOLDS, MotionThresholds, ThresholdBand};
pub use papers::{Element, FigureName, MetricName, PAPERS, Paper, PaperError, Printed, RunName, Settled, TestName};
pub use rough_channel::{ORIGIN_DEPTH, RoughChannel, roughness_ratio};
pub use sensitivity_table::{RangeEnd, SensitivityRow, sensitivity_table, sensitivity_text};
pub use settling::{GrainForm, SettlingGrains, richardson_zaki_confidence, richardson_zaki_exponent};
pub use settling_beads::{SETTLING_BEADS, SettlingBeads};
pub use shipped::{shipped_table, shipped_tables};
pub use slope_laws::{RoughIncline, SLOPE_EXPERIMENT, SlopeExperiment, slope_run_out};
pub use stated_uncertainty::{Refinement, StatedPart, StatedUncertainty, UnknownPart, completed};
pub use steady_film::SteadyFilm;
pub use validation_set::{ValidatedComparison, ValidationSet, WAY_OF_FRONT};
