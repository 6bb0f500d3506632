"""A case from Python: its numbers are the program's, its arrays the solver's."""

import csv
import json
import os
import subprocess

import bagnold
import numpy as np
import pandas as pd
import pytest

CHEAP = {"vary": {"resolution": [10]}}


@pytest.fixture
def film():
    return bagnold.run("film", **CHEAP)


def test_the_cases_are_listed_and_shown():
    cases = bagnold.cases()
    assert {"film", "bagnold", "bed-load"} <= set(cases["name"])
    assert 'case = "film"' in bagnold.show("film") and "[Pa·s]" in bagnold.show("film", "paper")


def test_metrics_in_three_lines():
    r = bagnold.run("film", **CHEAP)
    metrics = r.metrics
    assert isinstance(metrics, pd.DataFrame)
    of = {metric["name"]: metric for metric in metrics.to_dict("records")}
    error, balance = of["velocity_l2"], of["energy_residual"]
    assert error["unit"] == "%" and error["value"] > 0 and error["verdict"] == "observed", "too coarse to be judged"
    assert balance["verdict"] == "pass" and 0 < balance["value"] <= balance["at_most"]
    assert metrics["value"].dtype == np.float64 and r.passes


def test_parameters_are_python_values(film):
    thin = bagnold.run("film", **CHEAP, material={"viscosity": np.float64(0.5)})
    assert thin.parameters["material"]["viscosity"] == 0.5 and thin.state_hash != film.state_hash
    dotted = bagnold.run("film", **CHEAP, **{"material.viscosity": 0.5})
    assert dotted.state_hash == thin.state_hash
    assert dotted.runs["from_store"].all()


def test_a_file_is_run_as_the_program_runs_it(film, folder):
    (folder / "again.toml").write_text(film.case_file, encoding="utf-8")
    again = bagnold.run(folder / "again.toml", fresh=True, threads=1)
    assert again.state_hash == film.state_hash
    pd.testing.assert_frame_equal(again.metrics, film.metrics, check_exact=True)


def test_profiles_are_tables_and_found_by_a_part_of_their_name(film):
    (name,) = [name for name in film.profiles if name.startswith("profile")]
    profile = film.profile("profile")
    pd.testing.assert_frame_equal(profile, film.profile(name))
    assert "y [m]" in profile and "u [m/s]" in profile and len(profile) >= 10
    with pytest.raises(KeyError, match="no profiles with 'depth'"):
        film.profile("depth")


def test_what_the_program_warns_of_is_a_warning_of_python():
    with pytest.warns(UserWarning, match="0.5 in radians is 28.65"):
        bagnold.run("film", **CHEAP, slope_angle=0.5)


def test_particles_are_arrays_that_nobody_can_change(film):
    particles = film.particles()
    assert particles["position"].shape == particles["velocity"].shape == (len(particles["pressure"]), 3)
    assert particles.units["pressure"] == "Pa" and particles.time == film.times()[-1]
    assert film.particles(time=0.0).time == film.times()[0]
    assert particles["position"].base is not None, "a view of the solver's numbers"
    assert film.particles()["pressure"] is particles["pressure"], "no copy is made when they are asked for again"
    with pytest.raises(ValueError, match="read-only"):
        particles["pressure"][0] = 1.0
    assert np.isfinite(particles["velocity"]).all()


def test_figures_are_svg(film):
    assert film.figures
    assert film.figure(film.figures[0]).startswith("<svg")


def test_the_numbers_are_the_programs_to_the_last_digit(film, folder):
    program = os.environ.get("BAGNOLD_PROGRAM")
    if not program:
        pytest.skip("BAGNOLD_PROGRAM names no program to compare with")
    command = [program, "--quiet", "run", "film", "--vary", "resolution=10", "--fresh", "--store", str(folder / "own"), "--json"]
    text = subprocess.run([*command, "--out", "out"], check=True, capture_output=True, text=True).stdout
    theirs = json.loads(text)
    assert theirs["state_hash"] == film.state_hash
    assert theirs["metrics"] == film.document["metrics"]
    for table in film.profiles:
        with open(f"out/tables/{table}.csv", newline="", encoding="utf-8") as file:
            heading, *rows = csv.reader(file)
        own = film.profile(table)
        assert list(own) == heading
        assert own.to_numpy().tolist() == [[float(number) for number in row] for row in rows]


def test_measurements_are_drawn_and_compared(folder):
    (folder / "mine.csv").write_text("# limit: 50\ny/h [-],u [cm/s],uncertainty [cm/s]\n0.5,1,1\n0.9,1,1\n", encoding="utf-8")
    metrics = bagnold.run("film", **CHEAP, overlay="mine.csv").metrics
    (own,) = metrics[metrics["name"] == "overlay_residual"].to_dict("records")
    assert own["verdict"] == "pass" and own["at_most"] == 50 and own["value"] > 0.5
    with pytest.raises(bagnold.Refused, match="no-such.csv"):
        bagnold.run("film", **CHEAP, overlay=["no-such.csv"])


def test_a_study_is_run_and_judged_from_its_file(folder):
    block = 'case = "scene"\nname = "block"\nspacing = 0.02\nduration = 0.02\ninterval = 0.01\npictures = 1\n'
    body = '[[bodies]]\nshape = "box"\nlower = [0.0, 0.0]\nupper = [0.1, 0.1]\n'
    floor = '[[walls]]\nname = "floor"\npoints = [[-0.2, 0.0], [0.4, 0.0]]\n'
    gauge = '[[gauges]]\nkind = "front"\nname = "front"\nfrom = [0.0, 0.0]\nto = [0.4, 0.0]\nthickness = 0.01\n'
    (folder / "block.toml").write_text(block + body + floor + gauge, encoding="utf-8")
    (folder / "heights.toml").write_text(
        'study = "heights"\nsummary = "two spacings"\nbase = "block.toml"\n'
        '[[vary]]\npath = "spacing"\nvalues = [0.02, 0.0125]\n'
        '[[checks]]\nname = "front_at_the_end"\ntable = "gauges"\ncolumn = "front: front [m]"\nvalue = "last"\n'
        'within = [0.0, 0.4]\nreason = "the floor is that long"\n',
        encoding="utf-8",
    )
    metrics = bagnold.run("heights.toml").metrics
    fronts = metrics[metrics["name"] == "front_at_the_end"]
    assert list(fronts["verdict"]) == ["pass", "pass"], fronts
    with pytest.raises(bagnold.Refused, match="`only`: not available for a study"):
        bagnold.run("heights.toml", only="spacing=0.02")


def test_what_the_program_refuses_is_an_exception_with_its_text():
    with pytest.raises(bagnold.Refused, match="`flim`: unknown case; did you mean `film`?"):
        bagnold.run("flim")
    with pytest.raises(ValueError, match="resolution.*must be"):
        bagnold.run("film", resolution=-3)
    with pytest.raises(bagnold.Refused, match="visocsity"):
        bagnold.run("film", material={"visocsity": 1.0})
    with pytest.raises(bagnold.Refused, match="`tier` must be one of"):
        bagnold.run("film", tier="papre")
    with pytest.raises(bagnold.Refused, match="cannot be read"):
        bagnold.run("no/such/case.toml")
    with pytest.raises(TypeError, match="`depth` is a object"):
        bagnold.run("film", depth=object())
