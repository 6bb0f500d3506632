//! Scenes of a user's own, whatever the number of axes: what the cases `scene` and `scene-space` share. What the plane and
//! space give in a way of their own (bodies, walls, inlets, gauges, sides, pictures) stands in the folders of these
//! cases, behind [`Dimension`].

mod behind_walls;
mod brief;
mod checks;
mod cut_cells;
mod doubts;
pub(super) mod figures;
pub(super) mod filling;
mod flow;
pub(super) mod foreign;
pub(super) mod gauges;
mod geostatic;
mod given;
mod given_load;
mod given_rate;
mod given_turn;
mod inflow;
mod lattice;
pub(super) mod measure;
mod measured;
pub(super) mod metrics;
pub(super) mod names;
mod observation;
pub(super) mod periods;
mod prediction;
mod run;
mod scene_case;
pub(super) mod series;
pub mod setting;
mod settling;
pub(super) mod shapes;
pub mod sides;
mod sound;
mod start;
mod surfaces;
mod wall_load;
mod wall_turn;
mod yields;

pub use flow::{Dimension, DrawFrames, DrawSites, SceneFlow, SceneStart};
pub use given::PlainData;
pub use given_load::GivenLoad;
pub use given_rate::{GivenRate, TableEnds};
pub use given_turn::GivenTurn;
pub use measure::{DepthGauge, Measurand, Opening, Probe};
pub use measured::MeasuredSeries;
pub use observation::{FedMass, OutflowRecord, SceneObservation};
pub use scene_case::SceneCase;
pub use settling::BodyPreparation;
pub use sides::DomainSide;
pub use surfaces::SideSearch;

#[cfg(test)]
use crate::case::{RunList, Tier};
use crate::observation::Recorded;
#[cfg(test)]
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// A run of a scene with what it left behind.
type SceneRecord<S, const D: usize> = (SceneFlow<S, D>, Recorded<SceneObservation<D>>);

/// The scene of the quick tier.
#[cfg(test)]
pub(crate) fn quick<S: Dimension<D>, const D: usize>() -> SceneFlow<S, D>
where
    Simulation<D>: Compiled<D>,
{
    RunList::of_tier(Tier::Quick).base
}
