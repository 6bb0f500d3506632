//! Grains that creep beside a flow: a chute between rough walls, a bed below a plate and a heap between side walls, under the nonlocal law.

mod channel;
mod figures;
mod flow;
mod heap;
mod heap_figure;
mod marks;
mod metrics;
mod parameters;
mod probe;
mod profile;
mod quantities;
mod run;

pub use channel::{Channel, ChannelGrains, Motion, STIFFNESS, UpperBoundary};
pub use flow::{ExactShear, RheologyChoice, ShearFlow, ShearedGrains};
pub use parameters::{ChuteParameters, DraggedBedParameters, HeapParameters, NonlocalShearParameters};
pub use probe::ShearObservation;
pub use run::ShearRun;

use crate::case::{Case, RecordOf, Run};
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct NonlocalShearFlows;

type NonlocalShearRecord = RecordOf<NonlocalShearParameters>;

impl Case for NonlocalShearFlows {
    const NAME: &'static str = "nonlocal-shear";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "grains that creep beside a flow: a chute, a dragged bed and a heap between side walls under the nonlocal law";
    const DESCRIPTION: &'static str = "Three flows of glass beads, periodic along rough walls, whose stresses the balance of momentum gives: a \
        vertical chute, a bed under gravity below a plate that drags it, and a heap on a slope between side walls, whose friction stops it below its surface. Where the shear stress over the pressure is below μ_s a local \
        law is at rest. Under the nonlocal law the shear decays there over a few grains, as it does in experiments. The steady \
        flow is an ordinary differential equation, solved without particles; particles begin a tenth too fast and are compared with it at the pressure \
        that they have: the length over which the velocity falls by e below the depth at which the local law is at rest, the layer \
        that shears at a wall of the chute, the velocities, the traction of the plate. The heap flows under the local law too, whose profile is exact.";
    type Parameters = NonlocalShearParameters;
    const QUANTITIES: &'static [Quantity] = quantities::QUANTITIES;

    fn metrics(_: &NonlocalShearParameters, records: &[NonlocalShearRecord]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(_: &NonlocalShearParameters, records: &[NonlocalShearRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(_: &NonlocalShearParameters, records: &[NonlocalShearRecord]) -> Vec<Table> {
        records.iter().map(rows).collect()
    }
}

/// The rows of a run, and the velocity that they ought to have.
fn rows((run, record): &NonlocalShearRecord) -> Table {
    let seen = &record.data;
    let exact = run.exact(seen);
    let expected: Vec<f64> =
        seen.height.iter().map(|&y| exact.as_ref().map_or(f64::NAN, |exact| exact.velocity(y))).collect();
    let columns: [(&str, &[f64]); 5] = [
        ("y [m]", &seen.height),
        ("u [m/s]", &seen.velocity),
        ("u exact [m/s]", &expected),
        ("p [Pa]", &seen.pressure),
        ("s_xy [Pa]", &seen.shear_stress),
    ];
    Table::of_columns(format!("profile-{}", run.variant().file_name()), &columns)
}
