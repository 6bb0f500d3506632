"""Collapse of half columns of dry grains by the material point method of `material_points.py`.

Grains of Lagree, Staron and Popinet (2011); no-slip bed at y = 0, symmetry plane at x = 0, released at once, followed
until they rest.  Everything is computed in SI units and written in centimetres, grams and milliseconds or seconds, as
README.md says.  Run-out and height are measured here as well, by the definitions of the case `column-planar`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from material_points import Array, Column, Grains

BIN_WIDTH = 0.1  # bins of the thickness over r_0
FRONT_THICKNESS = 0.02  # thickness at the front over r_0
RESOLVED_ROWS = 4  # rows from which on a heap is resolved; what lies in fewer counts by its area
GAP = 2.0  # bare bed over the width of a cell beyond which grains do not count
SUB_POINTS = 8  # points over which the area of a material point is spread
SHOWN = (0.0, 0.75, 1.5, 2.5, 3.5, 5.0, 7.0)  # times of the dumps over sqrt(h_0/g); the end follows
AT_REST = 5e-7  # kinetic energy over the potential energy released at which a heap rests


def thickness_of(column: Column) -> Array:
    """Area of the points in each bin over its width, over r_0; a point is spread over a spacing to either side."""
    width = BIN_WIDTH * column.half_width
    offsets = 2.0 * (np.arange(SUB_POINTS) + 0.5) / SUB_POINTS - 1.0
    bins = (np.abs(column.position[:, :1] + offsets * column.spacing) / width).astype(np.intp)
    shares = np.broadcast_to(column.area[:, None] / SUB_POINTS, bins.shape)
    count = int(np.ceil(column.bed_end / width))
    return np.bincount(bins.ravel(), shares.ravel(), count)[:count] / (width * column.half_width)


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


def run_out_of(column: Column, least: float = FRONT_THICKNESS) -> float:
    """Run-out over r_0 of the front at a thickness over r_0."""
    thickness = thickness_of(column)
    thickest = int(np.argmax(thickness))
    (scale, start) = (column.half_width, BIN_WIDTH * thickest)
    (x, area) = (column.position[:, 0] / scale, column.area / scale**2)
    return front_by_rows(x, area, start, float(thickness[thickest]), least) - 1.0


def write_dump(path: Path, column: Column) -> None:
    """Writes position, velocity, area and density of all points in centimetres, grams and seconds."""
    density = column.mass / column.area
    columns = np.column_stack([1e2 * column.position, 1e2 * column.velocity, 1e4 * column.area, 1e-3 * density])
    decimals = [3, 3, 2, 2, 5, 4]
    columns = np.stack([np.round(values, digits) + 0.0 for values, digits in zip(columns.T, decimals)], axis=1)  # no -0
    formats = [f"%.{digits}f" for digits in decimals]
    header = "x_cm,y_cm,vx_cm_s,vy_cm_s,area_cm2,rho_g_cm3"
    np.savetxt(path, columns, fmt=formats, delimiter=",", header=header, comments="")


def run(column: Column, out: Path, longest: float) -> dict[str, float]:
    """Runs a column until it rests, for at most `longest` sqrt(h_0/g), writes its files and measures the heap."""
    scale = float(np.sqrt(column.height / column.gravity))
    points = 20  # of the time series over the scale
    (released_from, index) = (column.energies()[1], ["t_ms;file"])
    series = ["t_ms;front_cm;height_cm;kinetic_J_per_m;potential_J_per_m;area_cm2"]

    def dump() -> None:
        name = f"points_{len(index) - 1:02}.csv"
        write_dump(out / name, column)
        index.append(f"{1e3 * column.time:.3f};{name}")

    out.mkdir(parents=True, exist_ok=True)
    shown, fronts, rests = list(SHOWN), [], False
    for sample in range(round(longest * points) + 1):
        target = sample / points * scale
        while column.time < target * (1.0 - 1e-12):
            column.step(target - column.time)
        kinetic, potential = column.energies()
        thickness = thickness_of(column)
        fronts.append((column.time, front_of(thickness, 0.05)))
        lengths = [1e2 * column.half_width * value for value in (front_of(thickness), thickness[0])]
        values = [f"{1e3 * column.time:.3f}", *(f"{value:.4f}" for value in lengths)]
        values += [f"{kinetic:.4e}", f"{potential:.5f}", f"{1e4 * column.area.sum():.3f}"]
        series.append(";".join(values))
        rests = sample > 2 * points and kinetic < AT_REST * (released_from - potential)
        if shown and sample >= shown[0] * points - 1e-9 and not rests:
            shown.pop(0)
            dump()
        if rests:
            break
    dump()
    for name, lines in (("times.csv", index), ("series.csv", series)):
        (out / name).write_text("\n".join(lines) + "\n", encoding="ascii")

    times, rows_fronts = np.array(fronts).T
    mark = rows_fronts[0] + 0.99 * (rows_fronts[-1] - rows_fronts[0])
    stop = int(np.argmax(rows_fronts >= mark))
    stopped = np.interp(mark, rows_fronts[stop - 1 : stop + 1], times[stop - 1 : stop + 1])
    return {
        "run-out over r_0": run_out_of(column),
        "run-out over r_0, front at 0.05 r_0": front_of(thickness, 0.05) - 1.0,
        "final height over r_0": float(thickness[0]),
        "centroid over r_0": float(np.sum(column.mass * column.position[:, 0]) / column.mass.sum()) / column.half_width,
        "stopping time over sqrt(h_0/g)": float(stopped) / scale,
        "rest time [s]": column.time if rests else float("inf"),
        "area over the initial one": float(column.area.sum()) / (column.height * column.half_width),
    }


def arguments() -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--aspect-ratios", type=float, nargs="+", default=[1.0, 3.0], help="h_0/r_0")
    parser.add_argument("--points", type=int, default=20, help="material points over the half width")
    parser.add_argument("--per-cell", type=int, default=2, help="material points along a cell")
    parser.add_argument("--courant", type=float, default=0.3, help="Courant number of the elastic waves")
    parser.add_argument("--longest", type=float, default=15.0, help="longest simulated time over sqrt(h_0/g)")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "output", help="folder of the output")
    options = parser.parse_args()
    if min(options.aspect_ratios) <= 0.0 or options.points < 2 or options.per_cell < 1 or options.longest <= 0.0:
        parser.error("aspect ratios, --per-cell and --longest must be above 0, --points 2 or more")
    if not 0.0 < options.courant <= 1.0:
        parser.error("--courant must be above 0 and at most 1")
    return options


def main() -> None:
    """Runs the columns and prints what was measured beside the law of Lagree et al."""
    options = arguments()
    for aspect_ratio in options.aspect_ratios:
        column = Column(Grains(), aspect_ratio, options.points, options.per_cell, options.courant)
        measured = run(column, options.out / f"a{aspect_ratio:g}", options.longest)
        print(f"a = {aspect_ratio:g}: {len(column.mass)} points, steps of {1e3 * column.time_step:.4f} ms")
        for name, value in measured.items():
            print(f"  {name}: {value:.4f}")
        law = 2.2 * aspect_ratio if aspect_ratio < 7.0 else 3.9 * aspect_ratio**0.7
        difference = 100.0 * (measured["run-out over r_0"] / law - 1.0)
        print(f"  run-out by the law of Lagree et al.: {law:.4f}; here {difference:+.1f} %")
        height = 0.65 * aspect_ratio**0.35
        difference = 100.0 * (measured["final height over r_0"] / height - 1.0)
        print(f"  final height by their law: {height:.4f}; here {difference:+.1f} %")


if __name__ == "__main__":
    main()
