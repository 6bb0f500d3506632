//! Collapsing columns: scaling laws, measured piles, and flows down a slope.

mod collapse_laws;
mod collapsed_columns;
mod other_codes;
mod slope_laws;

pub use collapse_laws::{
    COLLAPSE_DURATION, CollapseLaw, CollapseLawSource, CollapseLaws, DRAWN, PLANAR_COLLAPSE, ROUND_COLLAPSE,
};
pub use collapsed_columns::{ALUMINIUM_BAR_PILE, MeasuredPile, MeasuredRunOuts, ROUND_COLUMN_RUN_OUTS};
pub use other_codes::{AT_REST, CodeQuantity, CodeSeries, OtherCodes, PLANAR_CODES, ROUND_CODES, SLOPE_CODES};
pub use slope_laws::{RoughIncline, SLOPE_EXPERIMENT, SlopeExperiment, slope_run_out};
