"""Collapse of dry grains by the material point method of `material_points.py`.

Planar half columns and round columns of the grains of Lagree, Staron and Popinet (2011), released at once, and a
reservoir of glass beads on a slope behind a gate, as the cases `column-planar`, `column-round` and `incline-collapse`
have them; followed until they rest.  Everything is computed in SI units and written in centimetres, grams and
milliseconds or seconds, as README.md says.  Run-out and height are measured here as well, by the definitions of those
cases.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from material_points import Array, Column, Grains, Setup

BIN_WIDTH = 0.1  # bins of the thickness over r_0
FRONT_THICKNESS = 0.02  # thickness at the front over r_0
ROW_THICKNESS = 0.05  # the same of a front that a row of points has
RESOLVED_ROWS = 4  # rows from which on a heap is resolved; what lies in fewer counts by its area
GAP = 2.0  # bare bed over the width of a cell beyond which grains do not count
SUB_POINTS = 8  # points over which the area of a material point is spread
SHOWN = (0.0, 0.75, 1.5, 2.5, 3.5, 5.0, 7.0)  # times of the dumps over sqrt(h_0/g); the end follows
AT_REST = 5e-7  # kinetic energy over the potential energy released at which a heap rests
GLASS_BEADS = Grains(0.382, 0.643, 0.279, 5e-4)
# setup, grains and points over r_0
KINDS = {
    "planar": (Setup(), Grains(), 20),
    "slope": (Setup(length=0.2, aspect_ratio=0.7, slope=22.0, gate_speed=1.3), GLASS_BEADS, 30),
    "round": (Setup(is_round=True), Grains(), 20),
}
ASPECT_RATIOS = {"planar": [1.0, 3.0], "slope": [0.7], "round": [0.9, 3.0]}


def thickness_of(column: Column) -> Array:
    """Volume of the points in each bin over its bed, over r_0; a point is spread over a spacing to either side."""
    width = BIN_WIDTH * column.length
    offsets = 2.0 * (np.arange(SUB_POINTS) + 0.5) / SUB_POINTS - 1.0
    bins = (np.abs(column.position[:, :1] + offsets * column.spacing) / width).astype(np.intp)
    shares = np.broadcast_to(column.volume[:, None] / SUB_POINTS, bins.shape)
    count = int(np.ceil(column.setup.bed_end / width))
    bed = width * width * (np.arange(count) + 0.5) if column.setup.is_round else width  # of a radian, or a metre across
    return np.bincount(bins.ravel(), shares.ravel(), count)[:count] / (bed * column.length)


def front_of(thickness: Array, least: float = FRONT_THICKNESS) -> float:
    """First place over r_0 at which the thickness falls below `least`, linear between the centres of the bins."""
    for k, (before, after) in enumerate(zip(thickness[:-1], thickness[1:])):
        if before >= least > after:
            return float(BIN_WIDTH * (k + 0.5 + (before - least) / (before - after)))
    return float(BIN_WIDTH * (len(thickness) - 0.5))


def front_by_rows(x: Array, area: Array, start: float, height: float, least: float) -> float:
    """Front at a thickness `least` by rows of square cells, from the thickest place `start` with its `height` outwards.

    All in one unit of length.  Thickness is read half a row below each whole number of rows; what lies in fewer rows than
    four is a wedge of its area.
    """
    width = np.sqrt(area)
    row = float(width.mean())
    (lower, upper) = (x - 0.5 * width, x + 0.5 * width)
    crossing = lower < 0.0
    begin = np.concatenate([np.maximum(lower, 0.0), np.zeros(int(crossing.sum()))])
    end = np.concatenate([np.maximum(upper, 0.0), -lower[crossing]])
    high = np.concatenate([width, width[crossing]])
    edges = np.unique(np.concatenate([begin, end, [start]]))
    edges = edges[edges >= start]
    middle = 0.5 * (edges[:-1] + edges[1:])
    thickness = np.array([high[(begin < place) & (end > place)].sum() for place in middle])
    length = np.diff(edges)
    (bare, reach) = (0.0, len(length))
    for k, (piece, on_it) in enumerate(zip(length, thickness)):
        bare = 0.0 if on_it > 0.0 else bare + piece
        if bare > GAP * row and thickness[:k].any():
            reach = k
            break
    (length, thickness) = (length[:reach], thickness[:reach])

    def place(rows: int) -> float:
        return start + float(length[thickness >= (rows - 0.5) * row].sum())

    resolved = min(RESOLVED_ROWS, -(-max(round(height / row), 1) // 2))
    bound = (resolved - 0.5) * row
    if least >= bound:
        rows = max(int(least / row + 0.5), resolved)
        share = least / row + 0.5 - rows
        return place(rows) + share * (place(rows + 1) - place(rows))
    left = float((length * thickness)[thickness < bound].sum())
    # whole rows of a wedge have k (k - 1)/(k - 1/2)^2 of its area
    part = resolved * (resolved - 1) / (resolved - 0.5) ** 2
    wedge = 2.0 * left / part / bound if resolved > 1 else 0.0
    return place(resolved) + wedge * (1.0 - least / bound)


def rows_front_of(column: Column, thickness: Array, least: float = FRONT_THICKNESS) -> float:
    """Front by rows over r_0, at a thickness over r_0; in the plane."""
    thickest = int(np.argmax(thickness))
    (scale, start) = (column.length, BIN_WIDTH * thickest)
    (x, area) = (column.position[:, 0] / scale, column.volume / scale**2)
    return front_by_rows(x, area, start, float(thickness[thickest]), least)


def centroid_of(column: Column) -> float:
    """Mean of x over the mass, over r_0."""
    return float(np.sum(column.mass * column.position[:, 0]) / column.mass.sum()) / column.length


def write_dump(path: Path, column: Column) -> None:
    """Writes position, velocity, area in the plane and density of all points in centimetres, grams and seconds."""
    density = column.mass / column.volume
    area = column.volume / column.position[:, 0] if column.setup.is_round else column.volume
    columns = np.column_stack([1e2 * column.position, 1e2 * column.velocity, 1e4 * area, 1e-3 * density])
    decimals = [3, 3, 2, 2, 5, 4]
    columns = np.stack([np.round(values, digits) + 0.0 for values, digits in zip(columns.T, decimals)], axis=1)  # no -0
    formats = [f"%.{digits}f" for digits in decimals]
    header = "x_cm,y_cm,vx_cm_s,vy_cm_s,area_cm2,rho_g_cm3"
    np.savetxt(path, columns, fmt=formats, delimiter=",", header=header, comments="")


def header_of(setup: Setup) -> str:
    """Names of the columns of `series.csv`."""
    (across, volume) = ("rad", "volume_cm3_per_rad") if setup.is_round else ("m", "area_cm2")
    names = ["t_ms", "front_cm", "height_cm", f"kinetic_J_per_{across}", f"potential_J_per_{across}", volume]
    names += ["front_at_0.05_cm", "centroid_cm", "kinetic_over_Mgh0"]
    return ";".join(names if setup.is_round else [*names, "rows_front_cm"])


def sample_of(column: Column, thickness: Array, row_thick: float) -> str:
    """Line of `series.csv`; `row_thick` is the front at ROW_THICKNESS over r_0."""
    (kinetic, potential) = column.energies()
    (scale, is_round) = (1e2 * column.length, column.setup.is_round)
    values = [f"{1e3 * column.time:.3f}", f"{scale * front_of(thickness):.4f}", f"{scale * thickness[0]:.4f}"]
    values += [f"{kinetic:.4e}", f"{potential:.5f}", f"{(1e6 if is_round else 1e4) * column.volume.sum():.3f}"]
    values += [f"{scale * row_thick:.4f}", f"{scale * centroid_of(column):.4f}"]
    values.append(f"{kinetic / (column.mass.sum() * column.gravity * column.height):.5f}")
    if not is_round:
        values.append(f"{scale * rows_front_of(column, thickness):.4f}")
    return ";".join(values)


def run(column: Column, out: Path, longest: float, has_points: bool) -> dict[str, float]:
    """Runs a column until it rests, for at most `longest` sqrt(h_0/g), writes its files and measures the heap."""
    scale = float(np.sqrt(column.height / column.gravity))
    points = 20  # of the time series over the scale
    (released_from, started_with) = (column.energies()[1], column.volume.sum())
    (index, series) = (["t_ms;file"], [header_of(column.setup)])

    def dump() -> None:
        name = f"points_{len(index) - 1:02}.csv"
        write_dump(out / name, column)
        index.append(f"{1e3 * column.time:.3f};{name}")

    out.mkdir(parents=True, exist_ok=True)
    shown, fronts, rests = list(SHOWN if has_points else ()), [], False
    for sample in range(round(longest * points) + 1):
        target = sample / points * scale
        while column.time < target * (1.0 - 1e-12):
            column.step(target - column.time)
        kinetic, potential = column.energies()
        thickness = thickness_of(column)
        fronts.append((column.time, front_of(thickness, ROW_THICKNESS)))
        series.append(sample_of(column, thickness, fronts[-1][1]))
        rests = sample > 2 * points and kinetic < AT_REST * (released_from - potential)
        if shown and sample >= shown[0] * points - 1e-9 and not rests:
            shown.pop(0)
            dump()
        if rests:
            break
    (out / "series.csv").write_text("\n".join(series) + "\n", encoding="ascii")
    if has_points:
        dump()
        (out / "times.csv").write_text("\n".join(index) + "\n", encoding="ascii")

    times, rows_fronts = np.array(fronts).T
    mark = rows_fronts[0] + 0.99 * (rows_fronts[-1] - rows_fronts[0])
    stop = int(np.argmax(rows_fronts >= mark))
    stopped = np.interp(mark, rows_fronts[stop - 1 : stop + 1], times[stop - 1 : stop + 1])
    measured = {
        "run-out over r_0": (front_of(thickness) if column.setup.is_round else rows_front_of(column, thickness)) - 1.0,
        "run-out over r_0, front at 0.05 r_0": fronts[-1][1] - 1.0,
        "final height over r_0": float(thickness[0]),
        "centroid over r_0": centroid_of(column),
        "stopping time over sqrt(h_0/g)": float(stopped) / scale,
        "rest time [s]": column.time if rests else float("inf"),
        "volume over the initial one": float(column.volume.sum() / started_with),
    }
    return measured


def laws_of(setup: Setup) -> dict[str, float]:
    """Run-out and height by published laws: Lagree et al. (2011) in the plane, Lube et al. (2004) on round ones."""
    a = setup.aspect_ratio
    if setup.slope > 0.0:
        return {}
    if setup.is_round:
        run_out, height = 1.24 * a if a < 1.7 else 1.6 * a**0.5, min(a, 0.88 * a ** (1.0 / 6.0))
        return {"run-out over r_0": run_out, "final height over r_0": height}
    return {"run-out over r_0": 2.2 * a if a < 7.0 else 3.9 * a**0.7, "final height over r_0": 0.65 * a**0.35}


def name_of(setup: Setup, grains: Grains, kind: str, points: int) -> str:
    """Name of the folder of a run, after what sets it apart."""
    name = f"a{setup.aspect_ratio:g}"
    if setup.is_round:
        name = f"round-{name}"
    if setup.slope > 0.0:
        name = f"slope-{setup.slope:g}" + ("-no-gate" if setup.gate_speed is None else "")
    (_, usual, usual_points) = KINDS[kind]
    if grains.limiting_friction != usual.limiting_friction:
        name += f"-mu2-{grains.limiting_friction:g}"
    return name if points == usual_points else f"{name}-{points}-points"


def arguments() -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kind", choices=sorted(KINDS), default="planar", help="what collapses")
    parser.add_argument("--aspect-ratios", type=float, nargs="+", help="h_0/r_0")
    parser.add_argument("--limiting-friction", type=float, help="mu_2 in place of that of the grains")
    parser.add_argument("--no-gate", action="store_true", help="release the grains on the slope at once")
    parser.add_argument("--points", type=int, help="material points over r_0")
    parser.add_argument("--per-cell", type=int, default=2, help="material points along a cell")
    parser.add_argument("--courant", type=float, default=0.3, help="Courant number of the elastic waves")
    parser.add_argument("--longest", type=float, default=15.0, help="longest simulated time over sqrt(h_0/g)")
    parser.add_argument("--series-only", action="store_true", help="write no points")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "output", help="folder of the output")
    options = parser.parse_args()
    options.aspect_ratios = options.aspect_ratios or ASPECT_RATIOS[options.kind]
    (setup, grains, usual_points) = KINDS[options.kind]
    options.points = usual_points if options.points is None else options.points
    if options.limiting_friction is not None and options.limiting_friction < grains.static_friction:
        parser.error(f"--limiting-friction must be at least mu_s = {grains.static_friction:g}")
    if options.no_gate and setup.gate_speed is None:
        parser.error("--no-gate is for --kind slope")
    if setup.gate_speed is not None and not options.no_gate and options.points % options.per_cell != 0:
        parser.error("--points must be a multiple of --per-cell with a gate, which stands at a node")
    if min(options.aspect_ratios) <= 0.0 or options.points < 2 or options.per_cell < 1 or options.longest <= 0.0:
        parser.error("aspect ratios, --per-cell and --longest must be above 0, --points 2 or more")
    if not 0.0 < options.courant <= 1.0:
        parser.error("--courant must be above 0 and at most 1")
    return options


def main() -> None:
    """Runs the columns and prints what was measured beside published laws."""
    options = arguments()
    (setup, grains, _) = KINDS[options.kind]
    if options.limiting_friction is not None:
        grains = replace(grains, limiting_friction=options.limiting_friction)
    if options.no_gate:
        setup = replace(setup, gate_speed=None)
    for aspect_ratio in options.aspect_ratios:
        setup = replace(setup, aspect_ratio=aspect_ratio)
        column = Column(grains, setup, options.points, options.per_cell, options.courant)
        name = name_of(setup, grains, options.kind, options.points)
        measured = run(column, options.out / name, options.longest, not options.series_only)
        print(f"{name}: {len(column.mass)} points, steps of {1e3 * column.time_step:.4f} ms")
        for quantity, value in measured.items():
            print(f"  {quantity}: {value:.4f}")
        for quantity, value in laws_of(setup).items():
            difference = 100.0 * (measured[quantity] / value - 1.0)
            print(f"  {quantity} by a published law: {value:.4f}; here {difference:+.1f} %")


if __name__ == "__main__":
    main()
