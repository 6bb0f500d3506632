//! Rules of walls that turn, beside what else moves them.

use super::SceneFlow;
use super::checks::check_table;
use super::flow::Dimension;
use super::setting::SceneWall;
use crate::case::ParameterError;
use bagnold_number::four_digits;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Whether the wall of a name turns.
    pub(super) fn turns(&self, name: &str) -> bool {
        self.walls.iter().any(|wall| wall.name() == name && wall.motion().turn.is_some())
    }

    /// Refuses a turn beside a table of displacements or a load, tables that do not go on, and rates beyond sound.
    pub(super) fn check_turn(&self, wall: &S::Wall) -> Result<(), ParameterError> {
        let motion = wall.motion();
        let Some(turn) = &motion.turn else { return Ok(()) };
        let beside = [("motion", !motion.times.is_empty()), ("load", wall.load().is_some())];
        if let Some((field, _)) = beside.into_iter().find(|(_, is_given)| *is_given) {
            return Err(ParameterError::field(field, "given", "absent beside `turn`", "give one of the two"));
        }
        check_table("turn.angles", &turn.times, &turn.angles, S::Wall::GIVEN_BY)?;
        let (rim, sound) = (wall.facet_wall().rim_speed(), self.equation_of_state().sound_speed());
        if rim > sound {
            let value = format!("{} m/s at the rim", four_digits(rim));
            let rule = format!("slower than sound, {} m/s", four_digits(sound));
            return Err(ParameterError::field("turn", value, &rule, "reduce its rate, or raise `stiffness`"));
        }
        Ok(())
    }
}
