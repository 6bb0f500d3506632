//! The scene of the tiers: a column of grains that collapses onto a step and falls over its edge.

use super::{FlowSide, PlaneBody, PlaneGauge, PlaneParameters, PlaneSides, WallLine};
use crate::case::Tier;
use crate::enclosed::DomainSide;
use bagnold_solver::weakly_compressible::walls::Surface;

pub(super) fn of_tier(tier: Tier) -> PlaneParameters {
    let rows = match tier {
        Tier::Quick => 20.0,
        Tier::Paper => 40.0,
        Tier::Fine => 80.0,
    };
    let sides = PlaneSides {
        left: DomainSide::Mirror(0.0),
        right: DomainSide::Open(0.45),
        bottom: DomainSide::Open(-0.1),
        top: DomainSide::None,
    };
    PlaneParameters {
        duration: 0.6,
        interval: 0.005,
        bodies: vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (0.1, 0.1), velocity: (0.0, 0.0) }],
        walls: vec![WallLine {
            name: "step".to_owned(),
            points: vec![(0.0, 0.0), (0.16, 0.0), (0.17, 0.02), (0.21, 0.02), (0.21, -0.08)],
            closed: false,
            flow: FlowSide::Left,
            surface: Surface::Rough,
            both_sides: false,
            motion: Vec::new(),
        }],
        gauges: vec![
            PlaneGauge::Front { name: "front".to_owned(), from: (0.0, 0.0), to: (0.21, 0.0), thickness: 0.1 / rows },
            PlaneGauge::Depth {
                name: "on-the-step".to_owned(),
                at: (0.19, 0.02),
                width: 0.02,
                direction: None,
                normal_to: None,
            },
            PlaneGauge::Force { name: "force".to_owned(), wall: "step".to_owned() },
            PlaneGauge::Flux { name: "over-the-edge".to_owned(), from: (0.21, 0.2), to: (0.21, 0.02) },
        ],
        ..PlaneParameters::of_beads("step", (0.0, -9.81), 0.1 / rows, sides)
    }
}
