"""Prediction of collapses of grains from their friction on slopes: blind.py STAGE FOLDER.

Stages, in this order: `chute` runs grains on slopes, `predict` fits the law and computes the
collapses with Bagnold, `grains` runs the collapses with seeds that follow from the digest of the
prediction. Every stage adds tables to FOLDER/results. LAMMPS starts as the program `lmp`,
Bagnold as `bagnold`; the variables LAMMPS and BAGNOLD may name others.
"""
import concurrent.futures
import csv
import hashlib
import json
import math
import os
import random
import shutil
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
DISCS = os.path.join(HERE, "..", "..", "lammps")
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(DISCS, "bagnold", "deck"))
from tables import fit, windows  # noqa: E402
LAMMPS = os.environ.get("LAMMPS", "lmp")
BAGNOLD = os.environ.get("BAGNOLD", "bagnold")
D, DENSITY = 0.002, 2500.0
DRAWS = 12
# largest change of the velocity between four windows of a steady flow
STEADY = 0.3
# slopes of the fit, slopes that only judge it, and seeds on each slope of the fit
SLOPES = {
    "discs": ([17, 18, 20, 22, 24, 26], [19, 21, 23, 25], [1, 2, 3]),
    "spheres": ([20, 22, 24, 26, 28], [21, 23, 25, 27], [1]),
}
# aspect ratios with half widths over the mean diameter
COLUMNS = {"discs": {0.5: 40, 1: 40, 3: 24, 7: 14}, "spheres": {1: 20, 3: 14}}
# slope in degrees, length and height of the reservoir over D, speed of the gate in m/s
INCLINE = (10, 40, 28, 1.3)
QUANTITIES = ["run_out", "final_height", "run_out centroid", "run_out front_at_0.05_r0"]
TABLES = ["friction.csv", "law.csv", "prediction.csv"]


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write(path, rows):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        for row in rows:
            number = lambda value: f"{value:.5g}" if isinstance(value, float) else value
            table.writerow({key: number(value) for key, value in row.items()})


def lammps(folder, deck, variables):
    """One run; the tables of earlier runs of the folder are gone."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    words = [word for key, value in variables.items() for word in ("-var", key, str(value))]
    with open(os.path.join(folder, "log"), "w") as log:
        subprocess.run([LAMMPS, "-in", deck, *words], cwd=folder, stdout=log, check=True)


def on_all_cores(work, tasks):
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("PROCESSES", os.cpu_count()))) as pool:
        return list(pool.map(lambda task: work(*task), tasks))


def on_slope(folder, grains, seed, angle):
    deck = os.path.join(DISCS, "bagnold", "deck") if grains == "discs" else HERE
    at = os.path.join(folder, f"{grains}-{seed}", str(angle))
    lammps(at, os.path.join(deck, "in.chute"), {"angle": angle, "seed": seed})


def unsteadiness(path):
    """Range of the mean velocity of the four windows over its mean; large where grains stop."""
    means = [statistics.fmean([row[2] for row in window]) for window in windows(path)]
    return (max(means) - min(means)) / abs(statistics.fmean(means))


def on_slopes(folder, slopes):
    """Inertial number, friction and solid fraction of steady flows of grains, seed by seed."""
    tasks = [(folder, *one, angle) for one, angles in slopes.items() for angle in angles]
    on_all_cores(on_slope, tasks)
    rows = []
    for (grains, seed), angles in slopes.items():
        at = os.path.join(folder, f"{grains}-{seed}")
        tables = os.path.join(DISCS, "bagnold", "deck", "tables.py")
        subprocess.run([sys.executable, tables, *map(str, angles)], cwd=at, check=True)
        for row in read(os.path.join(at, "results", "friction.csv")):
            measured = {key: float(row[key]) for key in ("mu", "I", "phi")}
            change = unsteadiness(os.path.join(at, row["angle"], "profile.txt"))
            rows.append({"grains": grains, "angle": row["angle"], "seed": seed, **measured,
                         "unsteadiness": change})
    return rows


def chute(folder, results):
    slopes = {
        (grains, seed): fitted for grains, (fitted, _, seeds) in SLOPES.items() for seed in seeds
    }
    write(os.path.join(results, "friction.csv"), on_slopes(folder, slopes))


def is_steady(row):
    return float(row["I"]) > 1e-3 and float(row["unsteadiness"]) < STEADY


def laws(friction):
    """Draw 0 is the fit; the others fit inertial numbers drawn within their errors."""
    friction = [row for row in friction if is_steady(row)]
    chance = random.Random(1)
    slopes = {}
    for row in friction:
        slopes.setdefault((row["grains"], row["mu"]), []).append(float(row["I"]))
    several = [seeds for seeds in slopes.values() if len(seeds) > 1]
    scatter = math.sqrt(statistics.fmean(
        [(statistics.stdev(seeds) / statistics.fmean(seeds)) ** 2 for seeds in several]
    ))
    rows = []
    for grains in SLOPES:
        phi = statistics.fmean([float(row["phi"]) for row in friction if row["grains"] == grains])
        for draw in range(DRAWS + 1):
            points = []
            for (of, mu), seeds in slopes.items():
                if of == grains:
                    error = scatter / math.sqrt(len(seeds)) if draw > 0 else 0.0
                    I = statistics.fmean(seeds) * (1 + error * chance.gauss(0, 1))
                    points.append((I, float(mu)))
            mu_s, mu_2, reference, _ = fit(points)
            rows.append({"grains": grains, "draw": draw, "mu_s": mu_s, "mu_2": mu_2,
                         "I_0": reference, "phi": phi})
    return rows


def material(law, is_nonlocal):
    """Lines of the law of a case file."""
    lines = [
        f'law = "{"nonlocal-mu-i" if is_nonlocal else "mu-i"}"',
        f"static_friction = {law['mu_s']}",
        f"limiting_friction = {law['mu_2']}",
        f"reference_inertia = {law['I_0']}",
        f"grain_diameter = {D}",
        f"grain_density = {DENSITY}",
    ]
    if is_nonlocal:
        lines += ["cooperativity = 0.48", "relaxation_time = 1e-4", 'surface = "vanishing"',
                  "seed = 1e-6"]
    return lines


def column_file(grains, aspect_ratio, law, is_nonlocal, resolution):
    width = COLUMNS[grains][aspect_ratio] * D
    return "\n".join([
        'case = "column-planar"',
        'grains = "lagree"',
        f"resolution = {resolution}",
        f"aspect_ratio = {float(aspect_ratio)}",
        f"half_width = {width}",
        f"solid_fraction = {law['phi']}",
        "[material]",
        *material(law, is_nonlocal),
    ]) + "\n"


def incline_file(law, is_nonlocal, resolution):
    angle, length, height, speed = INCLINE
    return "\n".join([
        'case = "incline-collapse"',
        f"resolution = {resolution}",
        f"slope_angle = {float(angle)}",
        f"initial_height = {height * D}",
        f"reservoir_length = {length * D}",
        "channel_length = 1.2",
        f"gate_speed = {speed}",
        f"solid_fraction = {law['phi']}",
        "[material]",
        *material(law, is_nonlocal),
    ]) + "\n"


def quantities(metrics):
    """Values, and 95 % intervals where the program gives them, by quantity of the first run."""
    values = {}
    for metric in metrics:
        variant = dict(part.split("=") for part in metric["variant"].split(",") if part)
        if "seed" in variant or "time" in variant or metric["name"].startswith("ensemble"):
            continue
        name = " ".join([metric["name"], *([variant["quantity"]] if "quantity" in variant else [])])
        values.setdefault(name, (metric["value"], metric.get("prediction") or {}))
    return values


def bagnold(folder, name, text, only):
    path = os.path.join(folder, name + ".toml")
    with open(path, "w") as file:
        file.write(text)
    out = os.path.join(folder, name)
    shutil.rmtree(out, ignore_errors=True)
    words = [BAGNOLD, "run", path, "--out", out, "--quiet", *(["--only", only] if only else [])]
    code = subprocess.run(words, stdout=subprocess.DEVNULL).returncode
    if code > 1:  # 1: gates fail, which limits of other grains may
        sys.exit(f"{' '.join(words)} ended with {code}")
    return quantities(json.load(open(os.path.join(out, "metrics.json")))["metrics"])


def predicted(folder, grains, aspect_ratio, is_nonlocal, draws):
    """Rows of one collapse: value at the finer resolution, errors from draws and resolution.

    The draws are computed with the local law only: the nonlocal law has no error of its own.
    """
    best = draws[0]
    if aspect_ratio is None:
        case, coarse, names = "incline-collapse", 30, ["front_displacement"]
        text = lambda law, resolution: incline_file(law, is_nonlocal, resolution)
        only = None
    else:
        case, coarse, names = "column-planar", 10 if aspect_ratio > 5 else 20, QUANTITIES
        text = lambda law, n: column_file(grains, aspect_ratio, law, is_nonlocal, n)
        only = f"material=lagree,aspect_ratio={aspect_ratio}"
    law = "nonlocal" if is_nonlocal else "local"
    stem = f"{grains}-{law}-{aspect_ratio or 'incline'}"
    run = lambda name, of, n: bagnold(folder, f"{stem}-{name}", text(of, n),
                                      only and f"{only},resolution={n}")
    fine, usual = run("fine", best, 2 * coarse), run("usual", best, coarse)
    of_law = [] if is_nonlocal else draws[1:]
    drawn = [run(f"draw-{draw['draw']}", draw, coarse) for draw in of_law]
    rows = []
    for name in names:
        value, interval = fine[name][0], usual[name][1]
        rows.append({
            "grains": grains, "law": law, "case": case,
            "aspect_ratio": "" if aspect_ratio is None else aspect_ratio, "quantity": name,
            "value": value,
            "u_input": statistics.stdev([one[name][0] for one in drawn]) if drawn else 0.0,
            "u_numerical": abs(value - usual[name][0]),
            "lower": interval.get("lower", ""), "upper": interval.get("upper", ""),
        })
    return rows


def inertia(law, angle):
    mu = math.tan(math.radians(angle))
    return law["I_0"] * (mu - law["mu_s"]) / (law["mu_2"] - mu)


def predict(folder, results):
    rows = laws(read(os.path.join(results, "friction.csv")))
    write(os.path.join(results, "law.csv"), rows)
    of = {grains: [row for row in rows if row["grains"] == grains] for grains in SLOPES}
    collapses = [(grains, a) for grains, columns in COLUMNS.items() for a in columns]
    collapses.append(("discs", None))
    prediction = []
    for grains, aspect_ratio in collapses:
        for is_nonlocal in (False, True):
            prediction += predicted(folder, grains, aspect_ratio, is_nonlocal, of[grains])
    for grains, draws in of.items():
        for angle in SLOPES[grains][1]:
            drawn = [inertia(law, angle) for law in draws]
            prediction.append({
                "grains": grains, "law": "local", "case": f"slope of {angle}°", "aspect_ratio": "",
                "quantity": "inertial_number", "value": drawn[0],
                "u_input": statistics.stdev(drawn[1:]), "u_numerical": 0.0, "lower": "", "upper": "",
            })
    write(os.path.join(results, "prediction.csv"), prediction)


def seeds(results):
    """Three seeds of four hexadecimal digits each, from the digest of the prediction."""
    digest = hashlib.sha256()
    for name in TABLES:
        digest.update(open(os.path.join(results, name), "rb").read())
    return [int(digest.hexdigest()[4 * k : 4 * k + 4], 16) for k in range(3)]


def judged(folder, case, parameters, variant):
    """What `bagnold judge` measures of the final thickness of grains, by quantity."""
    with open(os.path.join(folder, "submission.toml"), "w") as file:
        file.write(f'case = "{case}"\nlaw = "grains"\n{parameters}\n[code]\nname = "grains"\n'
                   f'version = "1"\n[[run]]\nvariant = "{variant}"\n[run.profile]\n'
                   'file = "results/thickness.csv"\n'
                   'columns = { x = "x [m]", thickness = "end [m]" }\n')
    out = os.path.join(folder, "judged")
    shutil.rmtree(out, ignore_errors=True)
    words = [BAGNOLD, "judge", "submission.toml", "--out", out, "--quiet"]
    code = subprocess.run(words, cwd=folder, stdout=subprocess.DEVNULL).returncode
    if code > 1:
        sys.exit(f"{folder}: {' '.join(words)} ended with {code}")
    code = json.load(open(os.path.join(out, "metrics.json")))["codes"][0]
    return quantities(code["metrics"])


def collapse(folder, grains, aspect_ratio, seed):
    """Values of one collapse of grains, measured as Bagnold measures its own."""
    tables = os.path.join(DISCS, "column-planar", "deck", "tables.py")
    if aspect_ratio is None:
        angle, length, height, speed = INCLINE
        folder = os.path.join(folder, f"incline-{seed}")
        deck = os.path.join(HERE, "in.incline")
        variables = {"angle": angle, "w": length, "t": height, "v": speed, "seed": seed}
        size = length * D, height * D
        case, variant, names = "incline-collapse", f"slope_angle={angle}", ["front_displacement"]
        parameters = (f"with = {{ slope_angle = {float(angle)}, initial_height = {height * D}, "
                      f"reservoir_length = {length * D}, channel_length = 1.2 }}")
    else:
        folder = os.path.join(folder, f"{grains}-a{aspect_ratio}-{seed}")
        deck = os.path.join(DISCS, "column-planar", "deck") if grains == "discs" else HERE
        deck = os.path.join(deck, "in.column")
        width = COLUMNS[grains][aspect_ratio]
        variables = {"a": aspect_ratio, "w": width, "seed": seed}
        size = width * D, width * D * aspect_ratio
        case, names = "column-planar", QUANTITIES
        variant = f"material=lagree,aspect_ratio={aspect_ratio}"
        parameters = (f'with = {{ grains = "lagree", aspect_ratio = {float(aspect_ratio)}, '
                      f"half_width = {size[0]}, solid_fraction = 0.6, material = {{ "
                      "static_friction = 0.32, limiting_friction = 0.6, reference_inertia = 0.4, "
                      "grain_diameter = 0.002, grain_density = 2500.0 } }")
    lammps(folder, deck, variables)
    subprocess.run([sys.executable, tables, *map(str, size), "1000"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    values = judged(folder, case, parameters, variant)
    return case, {name: values[name][0] for name in names}


def grains(folder, results):
    tasks, slopes = [], {}
    for kind, columns in COLUMNS.items():
        of = seeds(results) if kind == "discs" else seeds(results)[:1]
        tasks += [(folder, kind, a, seed) for a in columns for seed in of]
        slopes.update({(kind, seed): SLOPES[kind][1] for seed in of})
    tasks += [(folder, "discs", None, seed) for seed in seeds(results)]
    rows = []
    for task, (case, values) in zip(tasks, on_all_cores(collapse, tasks)):
        _, kind, aspect_ratio, seed = task
        for name, value in values.items():
            rows.append({"grains": kind, "case": case,
                         "aspect_ratio": "" if aspect_ratio is None else aspect_ratio,
                         "quantity": name, "seed": seed, "value": value})
    for row in on_slopes(folder, slopes):
        rows.append({"grains": row["grains"], "case": f"slope of {row['angle']}°",
                     "aspect_ratio": "", "quantity": "inertial_number", "seed": row["seed"],
                     "value": row["I"]})
    write(os.path.join(results, "measured.csv"), rows)


if __name__ == "__main__":
    stage, folder = sys.argv[1], os.path.abspath(sys.argv[2])
    results = os.path.join(folder, "results")
    os.makedirs(results, exist_ok=True)
    {"chute": chute, "predict": predict, "grains": grains}[stage](folder, results)
