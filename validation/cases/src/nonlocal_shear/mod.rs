//! Grains that creep beside a flow: a chute between rough walls, a bed below a plate and a heap between side walls, under the nonlocal law.

mod channel;
mod exact;
mod figures;
mod flow;
mod metrics;
mod probe;
mod stresses;

pub use channel::{Channel, ChannelGrains, Motion, STIFFNESS, UpperBoundary};
pub use exact::ExactShear;
pub use flow::{Drive, NonlocalShearFlow, ShearedGrains};
pub use probe::ShearObservation;

use crate::case::{Case, DrawFigures, Flow, Judge, RecordOf, Tabulate};
use crate::metric::Quantity;
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct NonlocalShearFlows;

type Record = RecordOf<NonlocalShearFlow>;

impl Case for NonlocalShearFlows {
    const NAME: &'static str = "nonlocal-shear";
    const AXES_BY_RUNS: bool = true;
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "grains that creep beside a flow: a chute, a dragged bed and a heap between side walls under the nonlocal law";
    const DESCRIPTION: &'static str = "\
        Setup. Three steady flows of glass beads under the nonlocal law, periodic along rough walls: a vertical \
        chute, a bed dragged by a plate under gravity, and a heap on a slope between side walls. The momentum \
        balance fixes their stresses. A local law is at rest where the stress ratio is below μ_s; the nonlocal law \
        shears there over a few grains. Particles start 10 % too fast; the reference solves the ordinary \
        differential equation of the steady flow at the pressure of the particles.\n\n\
        Judged. Velocities, the e-folding length of the creeping zone, the width of the shear layer at a wall of the \
        chute, and the traction on the plate. The heap also runs under the local law (exact profile, paper tier).";
    type Flow = NonlocalShearFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const TABLES: Tabulate<Self::Flow> = |records| records.iter().map(rows).collect();
}

/// The rows of a run, and the velocity that they ought to have.
fn rows((run, record): &Record) -> Table {
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
