//! The cases `scene` and `scene-space`: what is judged, drawn and written of a scene.

use super::flow::{Dimension, SceneFlow};
use super::{figures, foreign, metrics, series};
use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, Setup, Tabulate};
use crate::metric::Quantity;
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
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const SETUP: Setup<Self::Flow> = |list| Some(figures::setup(list.flows()));
    const FROM_EXTERNAL: FromExternal<Self::Flow> = foreign::observe;
    const TABLES: Tabulate<Self::Flow> = series::tables;
}
