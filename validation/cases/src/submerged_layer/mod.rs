//! A layer of grains under a viscous liquid that is tilted: onset and motion by dilatancy and pore pressure, without particles.

mod comparison;
mod figures;
mod parameters;
mod quantities;
mod run;
mod verification;

pub use parameters::{ConsolidationCheck, SubmergedLayerParameters};
pub use run::{LayerPurpose, SubmergedLayerObservation, SubmergedLayerRun};

use crate::case::{Case, RecordOf, Run};
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct SubmergedLayer;

type Record = RecordOf<SubmergedLayerParameters>;

impl Case for SubmergedLayer {
    const NAME: &'static str = "submerged-layer";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "beads under a viscous liquid are tilted: dilatancy and pore pressure delay their flow";
    const DESCRIPTION: &'static str = "\
        Setup. A layer of glass beads (160 µm, depth 4.9 mm) lies under a viscous liquid and is tilted to 25° at \
        once. Grains follow a friction and a dilatancy over the viscous number I = η γ̇/p′. Where they dilate, they \
        draw in water by Darcy's law with the permeability of Kozeny and Carman. Inertia is left out. The \
        constants are quoted from Pailha & Pouliquen (2009) at second hand. The diffusion of solid fraction by shear \
        (A = 1) is chosen. For thin liquids and coarse grains the step is too long: see `water_error`.\n\n\
        Judged. Steady flow and Terzaghi's consolidation against exact solutions, with the order of convergence. \
        Grains, momentum and water are balanced. Seven initial solid fractions against an independent \
        implementation. Onset, final velocity and early pore pressure against the experiment of Pailha et al. \
        (2008).\n\n\
        Observed only. The onset of loose layers, because the experiment tilts in an unknown time and the model at \
        once. The pore pressures of the two densest layers, because the measurement probably carries an offset.";
    type Parameters = SubmergedLayerParameters;
    const QUANTITIES: &'static [Quantity] = quantities::QUANTITIES;

    fn metrics(_: &SubmergedLayerParameters, records: &[Record]) -> Vec<Metric> {
        verification::metrics(records).into_iter().chain(comparison::metrics(records)).collect()
    }

    fn figures(_: &SubmergedLayerParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(_: &SubmergedLayerParameters, records: &[Record]) -> Vec<Table> {
        let of_run = |(run, record): &Record| {
            let data = &record.data;
            let columns = [
                ("t [s]", &data.time[..]),
                ("surface velocity [m/s]", &data.surface_velocity[..]),
                ("pore pressure at the floor [Pa]", &data.floor_pressure[..]),
                ("mean solid fraction [-]", &data.mean_fraction[..]),
            ];
            Table::of_columns(format!("series-{}", run.variant().file_name()), &columns)
        };
        let experiment = |record: &&Record| record.0.purpose == LayerPurpose::Experiment;
        records.iter().filter(experiment).map(of_run).collect()
    }
}
