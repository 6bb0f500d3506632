//! States at the resolution of the paper tier that runs of the quick tier start from; `states/bed-load.toml` makes them.

use super::flow::{BedLoadFlow, Continuum, StartState};
use crate::case::Flow;
use crate::observation::Frame;
use crate::output::Table;
use bagnold_solver::incompressible::ParticleSet;
use bagnold_solver::vector::Vector;

/// Slopes `[-]` with the particles over moving and over held grains.
const STATES: [(f64, [&str; 2]); 3] = [
    (
        0.02,
        [
            include_str!("../../../states/state-formulation-dilating-slope-0.02-start-1-spacing-0.001.csv"),
            include_str!("../../../states/state-formulation-dilating-slope-0.02-grains-held-start-1-spacing-0.001.csv"),
        ],
    ),
    (
        0.03,
        [
            include_str!("../../../states/state-formulation-dilating-slope-0.03-start-1-spacing-0.001.csv"),
            include_str!("../../../states/state-formulation-dilating-slope-0.03-grains-held-start-1-spacing-0.001.csv"),
        ],
    ),
    (
        0.05,
        [
            include_str!("../../../states/state-formulation-dilating-slope-0.05-start-1-spacing-0.001.csv"),
            include_str!("../../../states/state-formulation-dilating-slope-0.05-grains-held-start-1-spacing-0.001.csv"),
        ],
    ),
];

/// Depths of water, bed and held grains, period and spacing of the states `[m]`, and their refinement `[-]`.
const SET_UP: [f64; 6] = [0.046, 0.016, 0.004, 0.01, 1e-3, 2.0];

/// Columns of a table of particles; the phase of water is 0.
const COLUMNS: [&str; 5] = ["phase", "x [m]", "z [m]", "u [m/s]", "w [m/s]"];

/// Free particles of both phases as a run starts.
#[derive(Debug, Clone, Default)]
pub(super) struct KeptState {
    pub(super) water: ParticleSet<2>,
    pub(super) grains: ParticleSet<2>,
}

impl KeptState {
    /// The state that a run starts from, its velocities times the run's factor; none where none is kept.
    pub(super) fn of(run: &BedLoadFlow) -> Option<Self> {
        let Continuum { bed_depth, held_depth, length, spacing, sediment_refinement, .. } = run.continuum;
        let held_depth = if run.rests() { SET_UP[2] } else { held_depth };
        let set_up = [run.depth, bed_depth, held_depth, length, spacing, f64::from(sediment_refinement)];
        let is_kept = run.dilates() && set_up == SET_UP;
        let (_, tables) = STATES.iter().find(|(slope, _)| is_kept && *slope == run.slope)?;
        let mut state = Self::default();
        for row in tables[usize::from(run.rests())].lines().skip(1) {
            let mut cells = row.split(',').map_while(|cell| cell.parse().ok());
            let phase = if cells.next()? == 0.0 { &mut state.water } else { &mut state.grains };
            phase.position.push(Vector::<2>::new(cells.next()?, cells.next()?));
            phase.velocity.push(Vector::<2>::new(cells.next()?, cells.next()?) * run.start());
        }
        Some(state)
    }
}

/// The last state of a run that others can start from, to 10 nm and 1 µm/s.
pub(super) fn table(run: &BedLoadFlow, frames: &[Frame]) -> Option<Table> {
    let is_source = run.dilates() && run.continuum.start_state == StartState::Layer;
    let last = frames.last().filter(|_| is_source)?;
    let rounded = |values: &[f64; 3], parts: f64| [0, 1].map(|axis| (values[axis] * parts).round() / parts);
    let of_particle = |((place, velocity), phase): ((&[f64; 3], &[f64; 3]), &f64)| {
        let [[x, z], [u, w]] = [rounded(place, 1e8), rounded(velocity, 1e6)];
        vec![*phase, x, z, u, w]
    };
    let rows = last.position.iter().zip(last.vector("velocity")).zip(last.scalar("phase")).map(of_particle);
    Some(Table::of_rows(format!("state-{}", run.variant().file_name()), &COLUMNS, rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};

    #[test]
    fn states_have_the_particles_of_their_runs() {
        let runs = RunList::<BedLoadFlow>::of_tier(Tier::Quick).flows().to_vec();
        let kept: Vec<&BedLoadFlow> = runs.iter().filter(|run| run.continuum.start_state == StartState::Kept).collect();
        assert!(!kept.is_empty());
        for run in kept {
            let layer = run.layer().expect("a steady layer");
            let state = KeptState::of(run).expect("a kept state");
            let from_layer = BedLoadFlow {
                continuum: Continuum { start_state: StartState::Layer, ..run.continuum.clone() },
                ..run.clone()
            };
            let channel = from_layer.continuum_channel(&layer, &|_| 0.0);
            assert_eq!(state.water.position.len(), channel.fluid.len());
            let grains = channel.sediment.expect("grains").particles;
            assert_eq!(state.grains.position.len(), grains.position.len());
        }
    }
}
