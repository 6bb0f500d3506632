//! Rules between the fields of a scene in space.

use super::gauge::Gauge;
use super::parameters::SpaceParameters;
use super::vector;
use super::wall::Wall;
use crate::case::ParameterError;
use crate::cases::enclosed::{names, sides};
use crate::cases::rules;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::enclosure::Enclosure;
use bagnold_solver::weakly_compressible::numerics::Contact;

impl SpaceParameters {
    /// Everything that is refused beyond the ranges of single fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        let walls = self.walls.iter().map(|wall| wall.name.as_str());
        names::check(&self.name, walls, self.gauges.iter().map(Gauge::name))?;
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material).map_err(|error| error.within("bulk"))?;
        self.sides.check()?;
        for (k, body) in self.bodies.iter().enumerate() {
            body.check().map_err(|error| error.within(&format!("bodies[{k}]")))?;
        }
        for (k, wall) in self.walls.iter().enumerate() {
            wall.check(self.spacing).map_err(|error| error.within(&format!("walls[{k}]")))?;
        }
        self.check_scales()?;
        self.check_gauges()?;
        rules::viscous_step("numerics", &self.numerics, &self.material)?;
        if self.walls.iter().any(|wall| wall.surface == Surface::Smooth) {
            rules::gate("numerics", &self.numerics)?;
        }
        let shells = self.walls.iter().map(Wall::shell).collect();
        let enclosure = Enclosure { shells, exits: sides::exits(self.sides.pairs()) };
        rules::refuse("numerics", enclosure.numerics_problem(&self.numerics))?;
        if self.numerics.contact == Contact::None && !self.walls.is_empty() {
            let remedy = "contact keeps particles in front of walls of triangles; leave it as it is";
            return Err(ParameterError::field("numerics.contact", "none", "\"half-spacing\" with walls", remedy));
        }
        Ok(())
    }

    fn check_gauges(&self) -> Result<(), ParameterError> {
        let down = vector(&self.gravity).normalize();
        for (k, gauge) in self.gauges.iter().enumerate() {
            match gauge {
                Gauge::Force { wall, .. } => {
                    names::check_wall(k, wall, self.walls.iter().map(|wall| wall.name.as_str()))?;
                }
                Gauge::Front { from, to, .. } => {
                    let line = vector(to) - vector(from);
                    // a line along gravity has no thickness across it
                    let length = if down.cross(&line).norm() > self.spacing { line.norm() } else { 0.0 };
                    names::check_line(k, &[to.0, to.1, to.2], length, self.spacing, ", across gravity")?;
                }
                Gauge::Flux { corners: (a, b, c), .. }
                    if (vector(b) - vector(a)).cross(&(vector(c) - vector(a))).norm()
                        <= self.spacing * self.spacing =>
                {
                    let value = format!("({}, {}, {}), …", a.0, a.1, a.2);
                    let rule = "three corners that are not in line";
                    let field = format!("gauges[{k}].corners");
                    return Err(ParameterError::field(&field, value, rule, "give a corner and the two next to it"));
                }
                _ => {}
            }
        }
        names::check_measured(&self.measured, |name| self.gauges.iter().any(|gauge| gauge.name() == name))
    }

    /// Times and lengths that fit to each other.
    fn check_scales(&self) -> Result<(), ParameterError> {
        names::check_times(self.interval, self.duration)?;
        rules::count("pictures", self.pictures, 1, 100, "three are usual")?;
        if vector(&self.gravity).norm() == 0.0 {
            let (rule, remedy) =
                ("unlike (0, 0, 0)", "the stiffness is measured by it; give it in m/s², such as [0, 0, -9.81]");
            return Err(ParameterError::field("gravity", "(0, 0, 0)", rule, remedy));
        }
        let (lower, upper) = self.extent();
        let most = (upper - lower).max() / 4.0;
        if self.spacing > most {
            let rule = format!("at most a quarter of the scene's size, {most}");
            return Err(ParameterError::field("spacing", self.spacing, &rule, "make the particles smaller"));
        }
        Ok(())
    }
}
