//! Knowledge about references: tables of papers and measurements with their provenance, the papers' elements, stated
//! uncertainties, and the validation set.
//!
//! Numbers of papers stand in `reference-data/*/*.csv`. The program carries these tables, reads each once, and no number of a
//! paper is written in the code that uses it.

mod held_out;
mod input_range;
mod measured;
mod measured_columns;
mod papers;
mod propagation;
mod sensitivity_table;
mod shipped;
mod stated_uncertainty;
mod validation_set;

pub use held_out::{HeldOutDatum, HeldOutJudgement};
pub use input_range::{Basis, InputRange, Spread};
pub use measured::{MeasuredData, Metadata, NumberColumn, ReferenceColumn, ReferenceKind};
pub use measured_columns::{MeasuredColumns, WantedColumns, heading, in_unit, there};
pub use papers::{Element, MetricName, PAPERS, Paper, Printed, RunName};
pub use sensitivity_table::{RangeEnd, SensitivityRow, sensitivity_table, sensitivity_text};
pub use shipped::{read_shipped, shipped_table, shipped_tables};
pub use stated_uncertainty::{Refinement, StatedPart, StatedUncertainty, UnknownPart, completed};
pub use validation_set::{ValidatedComparison, ValidationSet, WAY_OF_FRONT};
