//! The cases `scene` and `scene-space`: what is judged, drawn and written of a scene.

use super::flow::{Dimension, SceneFlow};
use super::{SceneObservation, SceneRecord, figures, foreign, metrics, series};
use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RunList};
use crate::figure::Figure;
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use std::marker::PhantomData;

/// Scenes in the plane or in space.
#[derive(Debug)]
pub struct SceneCase<S, const D: usize>(PhantomData<S>);

impl<S, const D: usize> SceneCase<S, D> {
    /// The case.
    pub const NEW: Self = Self(PhantomData);
}

impl<S: Dimension<D>, const D: usize> Case for SceneCase<S, D>
where
    Simulation<D>: Compiled<D>,
{
    const NAME: &'static str = S::NAME;
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = S::SUMMARY;
    const DESCRIPTION: &'static str = S::DESCRIPTION;
    type Flow = SceneFlow<S, D>;
    const QUANTITIES: &'static [Quantity] = &metrics::quantities_of::<S, D>();
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;

    fn metrics(records: &[SceneRecord<S, D>]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(records: &[SceneRecord<S, D>]) -> Vec<Figure> {
        figures::all(records)
    }

    fn setup(list: &RunList<SceneFlow<S, D>>) -> Option<Figure> {
        Some(figures::setup(list.flows()))
    }

    fn from_external(
        flow: &SceneFlow<S, D>,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<SceneObservation<D>>>, FieldError> {
        foreign::observe(flow, given)
    }

    fn tables(records: &[SceneRecord<S, D>]) -> Vec<Table> {
        series::tables(records)
    }
}
