//! The tiers of a scene, its rules and its run.

use super::SceneRun;
use super::parameters::{Dimension, SceneParameters};
use crate::case::{ParameterError, Parameters, Tier};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

impl<S: Dimension<D>, const D: usize> Parameters for SceneParameters<S, D>
where
    Simulation<D>: Compiled<D>,
{
    type Run = SceneRun<S, D>;
    const STATED: &'static [&'static str] = &["bodies", "walls", "inlets", "gauges", "measured"];

    fn of_tier(tier: Tier) -> Self {
        S::of_tier(tier)
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()
    }

    fn doubts(&self) -> Vec<String> {
        self.doubtful_units()
    }

    fn runs(&self) -> Vec<SceneRun<S, D>> {
        vec![SceneRun { scene: self.clone() }]
    }
}
