//! Grains that dilate under water whose velocity is given: what they do with the drag alone.

use super::super::step::measure;
use super::super::{IncompressibleScene, Phase, State};
use super::Columns;
use crate::parameter::ParameterProblem;
use crate::run::SceneError;
use crate::vector::Vector;

/// The grains of a scene, driven by its fluid, which keeps its places and velocities and feels nothing.
#[derive(Debug)]
pub struct DrivenGrains<const D: usize> {
    scene: IncompressibleScene<D>,
    fluid: Phase<D>,
    columns: Columns<D>,
    failed: bool,
}

impl DrivenGrains<2> {
    /// Sets up the grains of a scene.
    ///
    /// # Errors
    /// A scene that breaks a rule, or whose grains do not dilate.
    pub fn new(scene: IncompressibleScene<2>) -> Result<Self, SceneError> {
        let mut state = State::of(scene)?;
        measure(&mut state);
        let State { scene, phases, columns: Some(columns), .. } = state else {
            let (rule, remedy) = ("that of dilating grains", "give the sediment a dilatancy");
            return Err(ParameterProblem::new("sediment pressure", "another", rule, remedy).into());
        };
        Ok(Self { scene, fluid: phases.fluid, columns, failed: false })
    }

    /// Takes a step `[s]`; false once a grain has left the range of the model.
    pub fn step(&mut self, time_step: f64) -> bool {
        let Self { scene, fluid, columns, failed } = self;
        let mut advance = || {
            columns.gather(scene, fluid, &fluid.velocity_gradient)?;
            match &scene.sediment {
                Some(material) => columns.advance(material, &fluid.velocity, time_step),
                None => Ok(()),
            }
        };
        *failed = *failed || advance().is_err();
        columns.grains.wrap(&scene.domain);
        !*failed
    }

    /// Positions `[m]` and velocities `[m/s]` of the free grains, shape `[particles]`.
    #[must_use]
    pub fn grains(&self) -> (&[Vector<2>], &[Vector<2>]) {
        (&self.columns.grains.position, &self.columns.grains.velocity)
    }

    /// Their masses `[kg]`, per metre of width.
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.columns.grains.mass
    }
}
