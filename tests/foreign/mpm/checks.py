"""Checks of the material point method of `material_points.py` round an axis and behind a gate.

A round lattice in a smooth cylinder (a gate that stands still) rests; a lattice in the air falls as a whole, whatever
its stress; and one whose velocity is linear gets the density and the stress that the strain rates give.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from material_points import Column, Grains, Setup

ROUND = Setup(aspect_ratio=0.9, is_round=True)
STEPS = 4000  # of the cylinder at rest: 1.4 s


def column_of(setup: Setup) -> Column:
    """Column with 20 points over its radius."""
    return Column(Grains(), setup, 20, 2, 0.3)


def speed_in_cylinder() -> tuple[float, float]:
    """Largest speed at first and in the end of a lattice in a cylinder, over sqrt(g h_0)."""
    column = column_of(replace(ROUND, gate_speed=0.0))
    largest = []
    for _ in range(STEPS):
        column.step(np.inf)
        largest.append(np.abs(column.velocity).max() / np.sqrt(column.gravity * column.height))
    return float(max(largest)), float(largest[-1])


def lifted() -> Column:
    """Column whose lattice hangs in the air, half its height above the bed."""
    column = column_of(ROUND)
    column.position[:, 1] += 0.5 * column.height
    column.largest[1] *= 2.0
    column.nodes = (column.nodes[0], 2 * column.nodes[1])
    return column


def residual_in_air() -> float:
    """Vertical momentum of a stressed lattice in the air after a step, less that of gravity, over the latter."""
    column = lifted()
    random = np.random.default_rng(1)
    column.deviator = 0.3 * column.pressure[:, None] * random.uniform(-1.0, 1.0, column.deviator.shape)
    column.step(np.inf)
    given = -column.mass.sum() * column.gravity * column.time
    return float(np.sum(column.mass * column.velocity[:, 1]) / given - 1.0)


def error_of_strain() -> float:
    """Largest error of density and deviator after a step with v_r = k r and v_z = 0, over what they change by."""
    column = lifted()
    column.along = column.across = 0.0
    column.density[:] = dense = 1.01 * column.grains.density  # pressure enough that nothing yields
    column.mass = column.density * column.spacing**2 * column.position[:, 0]
    rate = 1e-3 / column.time_step
    column.velocity[:, 0] = rate * column.position[:, 0]
    column.affine[:, 0, 0] = rate
    (r, z), margin = column.position.T, 3.0 * column.cell
    inside = (r < column.length - margin) & (np.abs(z - column.height) < 0.5 * column.height - margin)
    column.step(np.inf)
    strain = column.time * rate
    density = np.log(column.density[inside] / dense) / (-2.0 * strain) - 1.0
    # the mean of k, k and 0 is 2 k/3: s_rr = s_tt = 2 G k/3, s_zz = -4 G k/3, so that (s_rr - s_zz)/2 = G k
    deviator = column.deviator[inside] / (column.shear_modulus * strain) - [1.0, 0.0, 2.0 / 3.0]
    return float(max(np.abs(density).max(), np.abs(deviator).max()))


def main() -> None:
    """Prints what the checks give."""
    (largest, last) = speed_in_cylinder()
    print(f"cylinder at rest: largest speed over sqrt(g h_0) {largest:.1e}, after {STEPS} steps {last:.1e}")
    print(f"lattice in the air: vertical momentum off by {residual_in_air():.1e}")
    print(f"uniform strain: density and deviator off by {error_of_strain():.1e}")


if __name__ == "__main__":
    main()
