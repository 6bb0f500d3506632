"""Judging and calibrating from Python."""

import json

import bagnold
import pandas as pd
import pytest

SUBMISSION = """
case = "water-film"

[code]
name = "by hand"
version = "1"

[[run]]
variant = "particles=lattice"
numbers = { velocity_l2 = 0.2 }
"""

PLAN = """
title = "viscosity of a film"

[[parameters]]
path = "material.viscosity"
unit = "Pa·s"
lower = 0.2
upper = 2.0
scale = "log"

[[fit]]
case = "film"
with = { resolution = 10 }
data = [{ table = "profile-fluid-newtonian-particles-jittered-resolution-10", x = "y [m]", y = "u [m/s]", file = "mine.csv" }]
"""

DATA = """# quantity: velocity of a film
# unit: m/s
# kind: measured
# confidence: medium
# uncertainty: 3 %, column
# source: own experiment
# licence: own data
y [m],u [m/s],uncertainty [m/s]
0.003,0.086,0.003
0.005,0.126,0.004
0.008,0.161,0.005
"""


def test_another_code_is_judged(folder):
    (folder / "mine.toml").write_text(SUBMISSION, encoding="utf-8")
    judgement = bagnold.judge("mine.toml", out="judged")
    assert judgement.case == "water-film" and list(judgement.codes["name"]) == ["by hand"]
    metrics = judgement.metrics
    given = metrics[metrics["name"] == "velocity_l2"].iloc[0]
    assert (given["code"], given["value"], given["verdict"]) == ("by hand 1", 0.2, "pass")
    assert "not_judged" in set(metrics["verdict"])
    assert repr(judgement).startswith("<water-film: by hand 1: ") and "1 pass" in repr(judgement)
    assert (folder / "judged" / "index.html").is_file()
    with pytest.raises(bagnold.Refused, match="nothing.toml"):
        bagnold.judge("nothing.toml")


def test_a_calibration_gives_parameters_with_intervals(folder):
    (folder / "plan.toml").write_text(PLAN, encoding="utf-8")
    (folder / "mine.csv").write_text(DATA, encoding="utf-8")
    found = bagnold.calibrate("plan.toml", out="found")
    (viscosity,) = found.parameters.to_dict("records")
    assert viscosity["unit"] == "Pa·s" and viscosity["lower"] < viscosity["best"] < viscosity["upper"]
    assert repr(found).startswith(f"<{viscosity['name']} {viscosity['best']:.4g} [") and "Pa·s" in repr(found)
    written = json.loads((folder / "found" / "result.json").read_text(encoding="utf-8"))
    assert viscosity["best"] == written["parameters"][0]["best"]
    assert viscosity["gaps"] == []
    written["parameters"][0] |= {"best": 0.35, "interval": [0.31, 0.6], "gaps": [[0.42, 0.55]]}
    assert "[0.31, 0.42] or [0.55, 0.6]" in repr(type(found)(written, folder))
    assert isinstance(found.fit, pd.DataFrame) and len(found.fit) == 3 and found.hold_out.empty
    with pytest.raises(bagnold.Refused, match="--resume"):
        bagnold.calibrate("plan.toml", out="found")
    assert bagnold.calibrate("plan.toml", out="found", resume=True).document == found.document
