//! States at the resolution of the paper tier that runs of the quick tier start from; `states/bed-load.toml` makes them.

use super::flow::{BedLoadFlow, Continuum, StartState};
use crate::observation::Frame;
use crate::output::Table;
use bagnold_solver::incompressible::ParticleSet;
use bagnold_solver::vector::Vector;

/// Slope `[-]`, whether grains are held, and particles of each state.
const STATES: [(f64, bool, &str); 6] = [
    (0.02, false, include_str!("../../../states/state-0.02-moving.csv")),
    (0.02, true, include_str!("../../../states/state-0.02-held.csv")),
    (0.03, false, include_str!("../../../states/state-0.03-moving.csv")),
    (0.03, true, include_str!("../../../states/state-0.03-held.csv")),
    (0.05, false, include_str!("../../../states/state-0.05-moving.csv")),
    (0.05, true, include_str!("../../../states/state-0.05-held.csv")),
];

/// Depths of water, bed and held grains, period and spacing of the states `[m]`, and their refinement `[-]`.
const SET_UP: [f64; 6] = [0.046, 0.016, 0.004, 0.01, 1e-3, 2.0];

/// Free particles of both phases as a run starts.
#[derive(Debug, Clone, Default)]
pub(super) struct KeptState {
    pub(super) water: ParticleSet<2>,
    pub(super) grains: ParticleSet<2>,
}

impl KeptState {
    /// The state that a run starts from, its velocities times the run's factor; none where none is kept.
    pub(super) fn of(run: &BedLoadFlow) -> Option<Self> {
        let key = (run.slope, run.rests());
        let (.., table) = STATES.iter().find(|(slope, held, _)| (*slope, *held) == key && is_set_up(run))?;
        let mut state = Self::default();
        for row in table.lines().skip(1) {
            let mut cells = row.split(',').map_while(|cell| cell.parse().ok());
            let phase = if cells.next()? == 0.0 { &mut state.water } else { &mut state.grains };
            phase.position.push(Vector::<2>::new(cells.next()?, cells.next()?));
            phase.velocity.push(Vector::<2>::new(cells.next()?, cells.next()?) * run.start());
        }
        Some(state)
    }
}

/// Whether a run has the set-up of the states.
fn is_set_up(run: &BedLoadFlow) -> bool {
    let Continuum { bed_depth, held_depth, length, spacing, sediment_refinement, .. } = run.continuum;
    let held_depth = if run.rests() { SET_UP[2] } else { held_depth };
    run.dilates() && [run.depth, bed_depth, held_depth, length, spacing, f64::from(sediment_refinement)] == SET_UP
}

/// The last state of a run that others can start from, to 10 nm and 1 µm/s.
pub(super) fn table(run: &BedLoadFlow, frames: &[Frame]) -> Option<Table> {
    let is_source = is_set_up(run) && run.continuum.start_state == StartState::Layer && run.starts_as_usual();
    let last = frames.last().filter(|_| is_source)?;
    let rounded = |value: f64, parts: f64| (value * parts).round() / parts;
    let of_particle = |((place, velocity), phase): ((&[f64; 3], &[f64; 3]), &f64)| {
        let [x, z] = [place[0], place[1]].map(|place| rounded(place, 1e8));
        vec![*phase, x, z, rounded(velocity[0], 1e6), rounded(velocity[1], 1e6)]
    };
    let rows = last.position.iter().zip(last.vector("velocity")).zip(last.scalar("phase")).map(of_particle);
    let name = format!("state-{}-{}", run.slope, if run.rests() { "held" } else { "moving" });
    Some(Table::of_rows(name, &["phase", "x [m]", "z [m]", "u [m/s]", "w [m/s]"], rows))
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
