//! The canonical cases, by families: layers on an incline, collapses, channels of water. A case imports no other case; what the
//! cases of a family share stands in the family's folder, what cases of several families share in `shared`.

pub mod bed_load_1d;
pub mod channel;
pub mod collapse;
pub mod layer;
pub mod nonlocal_shear;
pub mod settling;
mod shared;
pub mod water_column;

use bagnold_figure as figure;
use bagnold_harness::{case, checkpoint, evidence, input, metric, observation, output, setup, store};
use bagnold_inference::{sampling, statistics};
use bagnold_reference as reference;
