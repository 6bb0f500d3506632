//! Settling grains: drag, hindered settling and measured suspensions.

mod beads;
mod drag_tables;
mod grains;

pub use beads::{SETTLING_BEADS, SettlingBeads};
pub use drag_tables::{HINDERED_SLIPS, HinderedSlip, STANDARD_DRAG};
pub use grains::{GrainForm, SettlingGrains, richardson_zaki_confidence, richardson_zaki_exponent};
