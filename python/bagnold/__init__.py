"""Granular and sediment flows by smoothed particle hydrodynamics, judged against exact solutions and experiments.

>>> import bagnold
>>> r = bagnold.run("film", resolution=20)
>>> r.metrics[["name", "value", "unit", "verdict"]]

Everything is computed by the library behind the program ``bagnold``, with the same numbers to the last digit.
Quantities are in SI units, angles in degrees. Finished runs are kept in the program's store and not simulated again.
"""

from ._native import Refused
from ._result import DivergenceWarning, Particles, Result, cases, run, show
from ._study import Calibration, Judgement, calibrate, judge

__all__ = [
    "Calibration",
    "DivergenceWarning",
    "Judgement",
    "Particles",
    "Refused",
    "Result",
    "calibrate",
    "cases",
    "judge",
    "run",
    "show",
]
