//! The scene of the tiers: half a column that collapses in a channel with rough side walls and falls over the edge at its end.

use super::{SpaceBody, SpaceGauge, SpaceParameters, SpaceSides, SpaceVector, SpaceWall};
use crate::case::Tier;
use crate::enclosed::DomainSide;
use bagnold_solver::weakly_compressible::numerics::Numerics;

pub(super) fn of_tier(tier: Tier) -> SpaceParameters {
    let rows = match tier {
        Tier::Quick => 8.0,
        Tier::Paper => 16.0,
        Tier::Fine => 24.0,
    };
    let spacing = 0.08 / rows;
    let sides = SpaceSides {
        left: DomainSide::Mirror(0.0),
        right: DomainSide::Open(0.4),
        front: DomainSide::Mirror(0.0),
        back: DomainSide::None,
        bottom: DomainSide::Open(-0.1),
        top: DomainSide::None,
    };
    SpaceParameters {
        pictures: 3,
        bodies: vec![SpaceBody::Box { lower: (0.0, 0.0, 0.0), upper: (0.1, 0.04, 0.12), velocity: (0.0, 0.0, 0.0) }],
        walls: channel(),
        gauges: vec![
            SpaceGauge::Front {
                name: "front".to_owned(),
                from: (0.0, 0.0, 0.0),
                to: (0.2, 0.0, 0.0),
                thickness: spacing,
                width: 0.06,
            },
            SpaceGauge::Depth {
                name: "depth".to_owned(),
                at: (0.05, 0.02, 0.0),
                width: 0.04,
                direction: None,
                normal_to: None,
            },
            SpaceGauge::Force { name: "on-the-side".to_owned(), wall: "side".to_owned() },
            SpaceGauge::Flux {
                name: "over-the-edge".to_owned(),
                corners: ((0.2, -0.1, -0.06), (0.2, 0.1, -0.06), (0.2, -0.1, 0.2)),
            },
        ],
        // in space 1.3 holds 80 neighbours, 1.5 holds 120
        numerics: Numerics { smoothing_ratio: 1.3, ..Numerics::default() },
        ..SpaceParameters::of_beads("channel", (0.0, 0.0, -9.81), spacing, sides)
    }
}

/// Half of a channel 0.2 m long: its bed, the face below its end, and one of its side walls.
fn channel() -> Vec<SpaceWall> {
    let (length, half, height) = (0.2, 0.04, 0.14);
    let quad = |corners: [SpaceVector; 4]| {
        let [a, b, c, d] = corners;
        (a, b, c, d)
    };
    let bed = quad([(0.0, 0.0, 0.0), (length, 0.0, 0.0), (length, half, 0.0), (0.0, half, 0.0)]);
    let end = quad([(length, 0.0, 0.0), (length, 0.0, -0.06), (length, half, -0.06), (length, half, 0.0)]);
    let side = quad([(0.0, half, 0.0), (length, half, 0.0), (length, half, height), (0.0, half, height)]);
    vec![SpaceWall::of_quads("bed", vec![bed, end]), SpaceWall::of_quads("side", vec![side])]
}
