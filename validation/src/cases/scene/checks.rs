//! Rules between the fields of a scene.

use super::body::vector;
use super::gauge::Gauge;
use super::parameters::SceneParameters;
use super::wall::WallLine;
use crate::case::ParameterError;
use crate::cases::enclosed::names;
use crate::cases::rules;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::enclosure::Enclosure;
use bagnold_solver::weakly_compressible::numerics::Contact;

impl SceneParameters {
    /// Everything that is refused beyond the ranges of single fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        self.check_names()?;
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material).map_err(|error| error.within("bulk"))?;
        self.sides.check()?;
        for (k, body) in self.bodies.iter().enumerate() {
            body.check().map_err(|error| error.within(&format!("bodies[{k}]")))?;
        }
        for (k, wall) in self.walls.iter().enumerate() {
            wall.check(self.spacing).map_err(|error| error.within(&format!("walls[{k}]")))?;
        }
        self.check_gauges()?;
        self.check_scales()?;
        rules::viscous_step("numerics", &self.numerics, &self.material)?;
        if self.walls.iter().any(|wall| wall.surface == Surface::Smooth) {
            rules::gate("numerics", &self.numerics)?;
        }
        let enclosure = Enclosure { shells: self.walls.iter().map(WallLine::shell).collect(), exits: self.exits() };
        rules::refuse("numerics", enclosure.numerics_problem(&self.numerics))?;
        if self.numerics.contact == Contact::None && !self.walls.is_empty() {
            let remedy = "contact keeps particles in front of walls of segments; leave it as it is";
            return Err(ParameterError::field("numerics.contact", "none", "\"half-spacing\" with walls", remedy));
        }
        Ok(())
    }

    /// Names that are unlike each other and may stand in files.
    fn check_names(&self) -> Result<(), ParameterError> {
        let walls = self.walls.iter().map(|wall| wall.name.as_str());
        names::check(&self.name, walls, self.gauges.iter().map(Gauge::name))
    }

    fn check_gauges(&self) -> Result<(), ParameterError> {
        for (k, gauge) in self.gauges.iter().enumerate() {
            if let Gauge::Force { wall, .. } = gauge {
                names::check_wall(k, wall, self.walls.iter().map(|wall| wall.name.as_str()))?;
            }
            if let Some((from, to)) = gauge.line() {
                let length = (vector(&to) - vector(&from)).norm();
                names::check_line(k, &[to.0, to.1], length, self.spacing, "")?;
            }
        }
        names::check_measured(&self.measured, |name| self.gauges.iter().any(|gauge| gauge.name() == name))
    }

    /// Times and lengths that fit to each other.
    fn check_scales(&self) -> Result<(), ParameterError> {
        names::check_times(self.interval, self.duration)?;
        rules::count("pictures", self.pictures, 1, 100, "four are usual")?;
        if vector(&self.gravity).norm() == 0.0 {
            let (rule, remedy) =
                ("unlike (0, 0)", "the stiffness is measured by it; give it in m/s², such as [0, -9.81]");
            return Err(ParameterError::field("gravity", "(0, 0)", rule, remedy));
        }
        let (lower, upper) = self.extent();
        let size = (upper - lower).max();
        let most = size / 4.0;
        if self.spacing > most {
            let rule = format!("at most a quarter of the scene's size, {most}");
            return Err(ParameterError::field("spacing", self.spacing, &rule, "make the particles smaller"));
        }
        Ok(())
    }
}
