"""A block of dry grains by the material point method, in the plane or round an axis, mu(I) rheology.

Half a planar column or a reservoir on a slope, of length r_0, or a round column of radius r_0.  No-slip bed at y = 0,
which may slope down along x; at x = 0 a symmetry plane (a smooth wall, the same) or an axis; released at once, or by a
gate.

Grid: quadratic B-splines, affine transfer of velocities (APIC), explicit.  The affine matrix of a point is also its
velocity gradient (MLS-MPM).  What of its velocity the grid does not resolve, a flowing point loses over a hundred
times that sound needs across a cell, one that does not flow at once: with the plain transfer, which takes it away at
every step, the flow would be the slower the shorter the step.  A point carries its density and its stress deviator:

    d rho/dt = -rho div v,   p = K (rho/rho_0 - 1), cut at 0 (no tension),   K = 50 rho_0 g h_0,
    ds/dt = 2 G dev D + W s - s W,  G = 0.3 K, then returned to |s| = mu(I) p where |s| > mu_s p,
    |s| = sqrt(s:s/2),  mu(I) = mu_s + (mu_2 - mu_s)/(1 + I_0/I),  I = g_p D/sqrt(p/rho_s),  G g_p dt = |s*| - |s|.

In the plane D and s have two dimensions (s_zz = 0).  Round an axis they have three, x is the distance from it, masses
and volumes are those of a radian, proportional to x; the hoop strain rate v_x/x is taken with the velocity of the grid
at the point, and the hoop stress s_tt - p pushes by -V (s_tt - p)/x, with the point's weights, so that both have the
same work.

div v is the mean of the point's own and of that of its cells: with its own alone one point in seven dilates along
the bed until it bears nothing, with the smooth one alone the points jitter and never rest.

Walls: the velocity field of the grid is odd about the bed, so that it is 0 there and not only at a row of nodes; about
the symmetry plane its normal component is odd and the other even, and so about an axis.  Nodes behind a wall are
images of those before it.  A gate is a smooth wall at x = r_0 for the rows of nodes above its lower edge, and what is
beyond does not move along x there; the row that its edge passes is held in part.
A point that bears no more than half its own weight is loose: it does not count as flowing, and where it lies on the
bed, closer than a spacing, it slides with the friction mu_2, for the grid brakes a row much thinner than a cell by a
part of that only, and single points would run to the end of the bed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Nodes = NDArray[np.intp]  # the nine nodes of each point, [points, 9]

DECAY = 100.0  # decay time of the unresolved velocity of a flowing point over the time of sound across a cell
LOOSEST = 0.5  # density of spray over that in bulk at which its area, which has no stress to act on, grows no more
OWN_SHARE = 0.5  # share of a point's own velocity divergence in the change of its density


@dataclass(frozen=True)
class Setup:
    """Where the grains stand and how they are released; SI units."""

    length: float = 0.1  # half width, length or radius r_0 [m]
    aspect_ratio: float = 1.0  # h_0/r_0 [-]
    slope: float = 0.0  # slope of the bed, down along x [degrees]
    gate_speed: float | None = None  # of a gate at r_0 that is pulled up, normal to the bed [m/s]; none without it
    is_round: bool = False  # whether x is the distance from an axis

    @property
    def bed_end(self) -> float:
        """End of the bed [m]."""
        if self.slope > 0.0:
            return 15.0 * self.length
        return self.length * (2.0 + 1.5 * min(2.7 * self.aspect_ratio, 3.7 * float(self.aspect_ratio**0.7)))


@dataclass(frozen=True)
class Grains:
    """Dry grains with the mu(I) rheology; SI units."""

    static_friction: float = 0.32  # mu_s [-]
    limiting_friction: float = 0.6  # mu_2 [-]
    reference_inertia: float = 0.4  # I_0 [-]
    diameter: float = 2e-3  # D [m]
    grain_density: float = 2500.0  # rho_s [kg/m3]
    solid_fraction: float = 0.6  # phi [-]

    @property
    def density(self) -> float:
        """Density in bulk rho_0 [kg/m3]."""
        return self.solid_fraction * self.grain_density

    def yielded(self, trial: Array, pressure: Array, shear_modulus: float, time_step: float) -> Array:
        """Shear stress [Pa] at the end of a step whose elastic trial stress is `trial` [Pa].

        Relaxation by the plastic rate at the end, t = t* - G dt g_p(t), with g_p = r (t - S)/(L - t) from
        inverting mu(I): S = mu_s p, L = mu_2 p, r = I_0 sqrt(p/rho_s)/D.  That is the quadratic
        (t* - t)(L - t) = a (t - S), a = G dt r, with one root between S and min(L, t*).
        """
        static, limit = self.static_friction * pressure, self.limiting_friction * pressure
        rate = self.reference_inertia * np.sqrt(pressure / self.grain_density) / self.diameter
        a = shear_modulus * time_step * rate
        b = limit + trial + a
        c = limit * trial + a * static
        root = np.sqrt(np.maximum(b * b - 4.0 * c, 0.0))
        flowing = 2.0 * c / np.maximum(b + root, 1e-300)
        return np.where(trial <= static, trial, flowing)


class Column:
    """A block of grains in motion; arrays over material points have the shape [points] or [points, components]."""

    def __init__(self, grains: Grains, setup: Setup, points: int, per_cell: int, courant: float) -> None:
        """`points` material points over r_0, `per_cell` of them along a cell; hydrostatic and at rest."""
        if setup.gate_speed is not None and points % per_cell != 0:
            raise ValueError("a gate must stand at a node")
        self.grains, self.setup, self.length, self.gravity = grains, setup, setup.length, 9.81
        angle = np.radians(setup.slope)
        self.along, self.across = self.gravity * float(np.sin(angle)), self.gravity * float(np.cos(angle))
        self.spacing = self.length / points
        self.cell = per_cell * self.spacing
        rows = round(setup.aspect_ratio * points)
        self.height = rows * self.spacing
        self.bulk_modulus = 50.0 * grains.density * self.gravity * self.height
        self.shear_modulus = 0.3 * self.bulk_modulus
        sound = np.sqrt((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus) / grains.density)
        self.decay_time = DECAY * self.cell / sound
        self.time_step = courant * self.cell / sound
        self.time = 0.0

        column, row = np.meshgrid(np.arange(points), np.arange(rows))
        self.position = (np.stack([column.ravel(), row.ravel()], axis=1) + 0.5) * self.spacing
        depth = self.height - self.position[:, 1]
        self.density = grains.density * np.exp(grains.density * self.across * depth / self.bulk_modulus)
        self.mass = self.density * self.spacing**2  # of a metre across, or of a radian
        if setup.is_round:
            self.mass *= self.position[:, 0]
        self.velocity = np.zeros_like(self.position)
        self.affine = np.zeros((len(self.mass), 2, 2))
        self.deviator = np.zeros((len(self.mass), 3))  # (s_xx - s_yy)/2, s_xy and s_tt [Pa]; s_tt only round an axis
        self.flowing = np.zeros(len(self.mass), dtype=bool)
        self.own_weight = 0.5 * grains.density * self.across * self.spacing  # pressure amid a row alone [Pa]

        # node (i, j) stands at ((i - 1), (j - 1)) cells: one row of images behind either wall
        self.largest = np.array([setup.bed_end, 1.2 * self.height])
        self.nodes = (int(setup.bed_end / self.cell) + 4, int(1.2 * self.height / self.cell) + 4)
        self.gate = points // per_cell + 1  # nodes at x = r_0

    @property
    def pressure(self) -> Array:
        """Pressure [Pa]."""
        return np.maximum(self.bulk_modulus * (self.density / self.grains.density - 1.0), 0.0)

    @property
    def volume(self) -> Array:
        """Area [m2] of each point, or volume of its radian [m3]."""
        return self.mass / np.maximum(self.density, LOOSEST * self.grains.density)

    def step(self, longest: float) -> None:
        """Advances by one time step, or by `longest` [s] where that is shorter."""
        dt = min(self.time_step, longest)
        node, weights, offsets = self._stencil()
        inert = self.mass[:, None, None] * self.affine
        forced = inert - (4.0 * dt / self.cell**2) * self.volume[:, None, None] * self._total_stress()
        before = self._grid_velocity(node, weights, offsets, inert, 0.0)
        after = self._grid_velocity(node, weights, offsets, forced, dt)[node]
        resolved = np.einsum("pn,pnd->pd", weights, after)
        unresolved = self.velocity - np.einsum("pn,pnd->pd", weights, before[node])
        self.velocity = resolved + np.exp(-dt / self.decay_time) * unresolved * self.flowing[:, None]
        self.affine = 4.0 / self.cell**2 * np.einsum("pn,pnd,pne->pde", weights, after, offsets)
        hoop = resolved[:, 0] / self.position[:, 0] if self.setup.is_round else np.zeros_like(self.mass)
        self._brake_loose(dt)
        self.position += dt * resolved
        if not np.all((self.position >= 0.0) & (self.position < self.largest)):
            raise RuntimeError(f"a point left the domain at {self.time:.4f} s")
        divergence = self.affine[:, 0, 0] + self.affine[:, 1, 1] + hoop
        divergence = OWN_SHARE * divergence + (1.0 - OWN_SHARE) * self._smooth(divergence, node, weights)
        self.density = self.density * np.exp(-dt * divergence)
        self._update_deviator(dt, hoop)
        self.time += dt

    def _brake_loose(self, dt: float) -> None:
        """Slows down loose points on the bed."""
        on_bed = ~(self.pressure > self.own_weight) & (self.position[:, 1] < self.spacing)
        loss = dt * self.grains.limiting_friction * self.across
        kept = np.maximum(1.0 - loss / np.maximum(np.abs(self.velocity[:, 0]), 1e-30), 0.0)
        kept = np.where(on_bed, kept, 1.0)
        self.velocity[:, 0] *= kept
        self.affine[:, 0] *= kept[:, None]

    def _stencil(self) -> tuple[Nodes, Array, Array]:
        """Nodes, weights [points, 9] and distances to the nodes [points, 9, 2]."""
        scaled = self.position / self.cell + 1.0
        first = np.floor(scaled - 0.5).astype(np.intp)
        f = scaled - first  # 0.5 ... 1.5
        splines = np.stack([0.5 * (1.5 - f) ** 2, 0.75 - (f - 1.0) ** 2, 0.5 * (f - 0.5) ** 2], axis=1)
        i, j = (k.ravel() for k in np.meshgrid(np.arange(3), np.arange(3), indexing="ij"))
        node = (first[:, :1] + i) * self.nodes[1] + first[:, 1:] + j
        offsets = (np.stack([i, j], axis=1) - f[:, None, :]) * self.cell
        return node, splines[:, i, 0] * splines[:, j, 1], offsets

    def _total_stress(self) -> Array:
        """Stress in the plane [points, 2, 2], tension positive [Pa]."""
        stress = np.empty_like(self.affine)
        mean = -0.5 * self.deviator[:, 2] - self.pressure
        stress[:, 0, 0] = self.deviator[:, 0] + mean
        stress[:, 1, 1] = -self.deviator[:, 0] + mean
        stress[:, 0, 1] = stress[:, 1, 0] = self.deviator[:, 1]
        return stress

    def _gathered(self, values: Array, node: Nodes, weights: Array) -> Array:
        """Sums over the points at each node; values [points, 9] or [points, 1]."""
        flat = np.bincount(node.ravel(), (weights * values).ravel(), self.nodes[0] * self.nodes[1])
        return flat.reshape(self.nodes)

    def _grid_velocity(self, node: Nodes, weights: Array, offsets: Array, carried: Array, dt: float) -> Array:
        """Velocities [nodes, 2] of what the points carry after `dt` of gravity and hoop stress, as the walls allow."""
        momentum = self.mass[:, None, None] * self.velocity[:, None, :] + np.einsum("pde,pne->pnd", carried, offsets)
        if self.setup.is_round:
            hoop = self.deviator[:, 2] - self.pressure
            momentum[:, :, 0] -= (dt * self.volume * hoop / self.position[:, 0])[:, None]
        mass = self._gathered(self.mass[:, None], node, weights)
        x, y = (self._gathered(momentum[:, :, axis], node, weights) for axis in (0, 1))
        x += dt * self.along * mass
        y -= dt * self.across * mass
        # what lies on images belongs to the nodes that they are images of
        mass[2] += mass[0]
        x[2] -= x[0]
        y[2] += y[0]
        mass[:, 2] += mass[:, 0]
        x[:, 2] -= x[:, 0]
        y[:, 2] -= y[:, 0]
        before, beyond, held = self.gate - 1, self.gate + 1, self._held()
        mass[before] += held * mass[beyond]
        x[before] -= held * x[beyond]
        y[before] += held * y[beyond]
        inside = np.maximum(mass, 1e-12 * self.mass.max())
        x, y = x / inside, y / inside
        x[self.gate :] *= 1.0 - held
        x[beyond] -= held * x[before]
        y[beyond] += held * (y[before] - y[beyond])
        x[1] = 0.0
        x[:, 1] = y[:, 1] = 0.0
        x[:, 0], y[:, 0] = -x[:, 2], -y[:, 2]
        x[0], y[0] = -x[2], y[2]
        return np.stack([x.ravel(), y.ravel()], axis=1)

    def _held(self) -> Array:
        """Share of each row of nodes, of the height that it stands for, that the gate holds [-]."""
        if self.setup.gate_speed is None:
            return np.zeros(self.nodes[1])
        heights = (np.arange(self.nodes[1]) - 1.0) * self.cell
        return np.clip((heights - self.setup.gate_speed * self.time) / self.cell + 0.5, 0.0, 1.0)

    def _smooth(self, values: Array, node: Nodes, weights: Array) -> Array:
        """Values [points] averaged by mass onto the nodes and taken back, even about the walls."""
        mass = self._gathered(self.mass[:, None], node, weights)
        mean = self._gathered((self.mass * values)[:, None], node, weights)
        for field in (mass, mean):
            field[2] += field[0]
            field[:, 2] += field[:, 0]
        mean /= np.maximum(mass, 1e-12 * self.mass.max())
        mean[0], mean[:, 0] = mean[2], mean[:, 2]
        return np.sum(weights * mean.ravel()[node], axis=1)

    def _update_deviator(self, dt: float, hoop: Array) -> None:
        """Stress deviator after a step with a hoop strain rate, and which points flow."""
        gradient = self.affine
        shear = 0.5 * (gradient[:, 0, 1] + gradient[:, 1, 0])
        stretch = 0.5 * (gradient[:, 0, 0] - gradient[:, 1, 1])
        spin = 0.5 * (gradient[:, 0, 1] - gradient[:, 1, 0])
        # dt (W s - s W) turns (s_xx, s_xy) by twice the angle of the spin: exactly, so that its size stays
        cosine, sine = np.cos(2.0 * dt * spin), np.sin(2.0 * dt * spin)
        xx = cosine * self.deviator[:, 0] + sine * self.deviator[:, 1] + 2.0 * self.shear_modulus * dt * stretch
        xy = cosine * self.deviator[:, 1] - sine * self.deviator[:, 0] + 2.0 * self.shear_modulus * dt * shear
        tt = self.deviator[:, 2].copy()
        if self.setup.is_round:
            mean = (gradient[:, 0, 0] + gradient[:, 1, 1] + hoop) / 3.0
            tt += 2.0 * self.shear_modulus * dt * (hoop - mean)
        trial = np.hypot(np.hypot(xx, xy), np.sqrt(0.75) * tt)  # s_xx and s_yy are xx and -xx, less tt/2
        stress = self.grains.yielded(trial, self.pressure, self.shear_modulus, dt)
        share = stress / np.maximum(trial, 1e-300)
        self.deviator = share[:, None] * np.stack([xx, xy, tt], axis=1)
        self.flowing = trial > self.grains.static_friction * np.maximum(self.pressure, self.own_weight)

    def energies(self) -> tuple[float, float]:
        """Kinetic and potential energy [J/m], round an axis [J/rad]; potential energy is 0 on the bed at x = 0."""
        kinetic = 0.5 * np.sum(self.mass * np.sum(self.velocity**2, axis=1))
        lifts = self.across * self.position[:, 1] - self.along * self.position[:, 0]
        return float(kinetic), float(np.sum(self.mass * lifts))
