"""A layer of dry grains on an incline in one dimension: finite volumes over the depth, mu(I) rheology.

    rho du/dt = rho g sin(theta) + d tau/dy,   tau = mu(I) p,   p = rho g cos(theta) (h - y),
    mu(I) = mu_s + (mu_2 - mu_s) I/(I_0 + I),  I = (du/dy) D / sqrt(p/rho_s),   rho = phi rho_s,

u = 0 at the bed, tau = 0 at the surface, at rest in the beginning.  The slope must lie between the two friction
angles: there the layer yields at every height at once and never stops, so that nothing has to be regularised.

Velocities stand at the centres of equal cells, stresses at their faces.  Time is semi-implicit (linearly implicit
Euler): the stress of the new time is expanded about the shear rate g of the old one,
tau(g_new) = tau(g) + tau'(g) (g_new - g), tau'(g) >= 0, which leaves one tridiagonal system a step.

Writes two files, neither in SI units: profile.txt (blanks between columns) and mean.csv (semicolons).
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Layer:
    """Glass beads of Forterre and Pouliquen (2003) on a slope; SI units."""

    slope: float = np.radians(24.0)  # theta [rad]
    height: float = 0.01  # h [m]
    gravity: float = 9.81  # g [m/s2]
    diameter: float = 0.5e-3  # D [m]
    grain_density: float = 2500.0  # rho_s [kg/m3]
    solid_fraction: float = 0.6  # phi [-]
    static_friction: float = 0.382  # mu_s [-]
    limiting_friction: float = 0.643  # mu_2 [-]
    reference_inertia: float = 0.279  # I_0 [-]

    @property
    def density(self) -> float:
        """Density in bulk [kg/m3]."""
        return self.solid_fraction * self.grain_density

    def pressure(self, y: Array) -> Array:
        """Pressure [Pa] at heights [m]."""
        return self.density * self.gravity * np.cos(self.slope) * (self.height - y)

    def stress(self, shear_rate: Array, pressure: Array) -> tuple[Array, Array]:
        """Shear stress [Pa] and its derivative by the shear rate [Pa s]; pressures are above 0."""
        rate = self.reference_inertia * np.sqrt(pressure / self.grain_density) / self.diameter  # where I = I_0
        g = np.maximum(shear_rate, 0.0)
        rise = (self.limiting_friction - self.static_friction) * pressure
        return self.static_friction * pressure + rise * g / (rate + g), rise * rate / (rate + g) ** 2

    def exact_velocity(self, y: Array) -> Array:
        """Bagnold's steady velocity [m/s] at heights [m], which the solver does not know."""
        tangent = np.tan(self.slope)
        inertia = self.reference_inertia * (tangent - self.static_friction) / (self.limiting_friction - tangent)
        scale = inertia / self.diameter * np.sqrt(self.solid_fraction * self.gravity * np.cos(self.slope))
        return 2.0 / 3.0 * scale * (self.height**1.5 - (self.height - y) ** 1.5)


def solve_tridiagonal(lower: Array, diagonal: Array, upper: Array, right: Array) -> Array:
    """Thomas's algorithm; lower[0] and upper[-1] are not used."""
    n = len(right)
    c, d = np.empty(n), np.empty(n)
    c[0], d[0] = upper[0] / diagonal[0], right[0] / diagonal[0]
    for i in range(1, n):
        pivot = diagonal[i] - lower[i] * c[i - 1]
        c[i] = upper[i] / pivot
        d[i] = (right[i] - lower[i] * d[i - 1]) / pivot
    for i in range(n - 2, -1, -1):
        d[i] -= c[i] * d[i + 1]
    return d


class Solver:
    """The layer in motion."""

    def __init__(self, layer: Layer, cells: int, time_step: float) -> None:
        """At rest, over `cells` cells, with steps of `time_step` [s]."""
        self.layer, self.time_step = layer, time_step
        self.width = layer.height / cells
        self.centre = (np.arange(cells) + 0.5) * self.width
        self.velocity = np.zeros(cells)
        # the lower face of each cell; the bed is half a cell below the lowest centre
        self.pressure = layer.pressure(np.arange(cells) * self.width)
        self.distance = np.full(cells, self.width)
        self.distance[0] = 0.5 * self.width

    def shear_rate(self) -> Array:
        """Shear rate [1/s] at the lower face of each cell."""
        return np.diff(self.velocity, prepend=0.0) / self.distance

    def step(self) -> None:
        """Advances by one time step."""
        old = self.shear_rate()
        stress, slope = self.layer.stress(old, self.pressure)
        known = stress - slope * old  # tau_new = known + slope * shear rate_new
        factor = self.time_step / (self.layer.density * self.width)
        below = factor * slope / self.distance
        above = np.append(below[1:], 0.0)  # no stress at the surface
        push = self.time_step * self.layer.gravity * np.sin(self.layer.slope)
        right = self.velocity + push + factor * (np.append(known[1:], 0.0) - known)
        self.velocity = solve_tridiagonal(-below, 1.0 + below + above, -above, right)


def arguments() -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slope", type=float, default=24.0, help="slope angle in degrees")
    parser.add_argument("--cells", type=int, default=50, help="cells over the depth")
    parser.add_argument("--time-step", type=float, default=1e-3, help="time step in seconds")
    parser.add_argument("--duration", type=float, default=4.5, help="simulated time in seconds")
    parser.add_argument("--window", type=float, default=0.5, help="averaging time before the end, in seconds")
    parser.add_argument("--every", type=int, default=10, help="steps between two points of the time series")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "output", help="folder of the output")
    options = parser.parse_args()
    layer = Layer()
    low, high = (float(np.degrees(np.arctan(mu))) for mu in (layer.static_friction, layer.limiting_friction))
    if not low < options.slope < high:
        parser.error(f"--slope must lie between {low:.2f} and {high:.2f} degrees, where the layer flows steadily")
    if options.cells < 2 or options.time_step <= 0.0 or not 0.0 < options.window <= options.duration:
        parser.error("--cells must be 2 or more, --time-step above 0, --window above 0 and at most --duration")
    return options


def main() -> None:
    """Runs the layer, writes both files and compares with the exact profile."""
    options = arguments()
    layer = Layer(slope=float(np.radians(options.slope)))
    solver = Solver(layer, options.cells, options.time_step)
    steps = round(options.duration / options.time_step)
    averaged = round(options.window / options.time_step)
    series, profile = [(0.0, 0.0)], np.zeros(options.cells)
    for step in range(1, steps + 1):
        solver.step()
        if step % options.every == 0:
            series.append((step * options.time_step, float(solver.velocity.mean())))
        if step > steps - averaged:
            profile += solver.velocity / averaged

    options.out.mkdir(parents=True, exist_ok=True)
    percent = 100.0 * solver.centre / layer.height
    columns = np.column_stack([percent, 100.0 * profile, layer.pressure(solver.centre)])
    header = f"# mean over {options.duration - options.window:g} ... {options.duration:g} s\ny/h_% u_cm/s p_Pa"
    np.savetxt(options.out / "profile.txt", columns, fmt=["%6.2f", "%9.5f", "%9.4f"], header=header, comments="")
    lines = ["t_ms;U_mm_per_s", *(f"{1e3 * time:.1f};{1e3 * mean:.4f}" for time, mean in series)]
    (options.out / "mean.csv").write_text("\n".join(lines) + "\n", encoding="ascii")

    exact = layer.exact_velocity(solver.centre)
    error = np.sqrt(np.sum((profile - exact) ** 2) / np.sum(exact**2))
    mean = 0.6 * float(layer.exact_velocity(np.array([layer.height]))[0])
    times, means = np.array(series).T
    change = abs(means[-1] / np.interp(options.duration - options.window, times, means) - 1.0)
    reached = "not reached" if means[-1] < 0.99 * mean else f"{np.interp(0.99 * mean, means, times):.3f} s"
    print(f"{options.cells} cells, {steps} steps of {1e3 * options.time_step:g} ms, {options.slope:g} degrees")
    print(f"velocity against Bagnold's (36): relative L2 {100.0 * error:.4f} %")
    print(f"depth mean {100.0 * profile.mean():.4f} cm/s, exact (37) {100.0 * mean:.4f} cm/s")
    print(f"99 % of the exact depth mean: {reached}; change over the averaging time {100.0 * change:.4f} %")


if __name__ == "__main__":
    main()
