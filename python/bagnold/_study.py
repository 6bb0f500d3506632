"""Other codes under Bagnold's gates, and parameters from data."""

from __future__ import annotations

import json
from collections.abc import Iterable
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from ._result import _metrics, command


class Judgement:
    """Verdicts on other codes' results."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.document = document
        """Everything in ``metrics.json`` of ``bagnold judge``."""
        self.case: str = document["case"]
        """The case that the codes compute."""

    @property
    def metrics(self) -> pd.DataFrame:
        """A row a number and code: the code's value, Bagnold's, the reference, limits and verdict.

        What a code did not give has the verdict "not_judged".
        """
        frames = []
        for code in self.document["codes"]:
            frame = _metrics(code["metrics"])
            frame.insert(0, "code", f"{code['name']} {code['version']}".strip())
            frames.append(frame)
        return pd.concat(frames, ignore_index=True)

    @property
    def codes(self) -> pd.DataFrame:
        """A row a code: the number of gates of each severity."""
        rows = [{"name": code["name"], "version": code["version"], **code["tally"]} for code in self.document["codes"]]
        return pd.DataFrame(rows)

    def __repr__(self) -> str:
        verdicts = [
            f"{code['name']} {code['version']}".strip()
            + ": "
            + ", ".join(f"{number} {word}" for word, number in code["tally"].items() if number)
            for code in self.document["codes"]
        ]
        return f"<{self.case}: {'; '.join(verdicts)}>"


class Calibration:
    """Parameters that agree best with data, and what the data leave open."""

    def __init__(self, document: dict[str, Any], folder: Path) -> None:
        self.document = document
        """Everything in ``result.json`` of ``bagnold calibrate``."""
        self.folder = folder
        """Folder with the page, the figures and ``calibrated.toml``, which ``run`` takes."""
        self.findings: list[str] = document["findings"]
        """What the data leave open, in sentences."""

    @property
    def parameters(self) -> pd.DataFrame:
        """A row a parameter: best value, 95 % interval with the gaps in it, and whether the model has confirmed its ends."""
        rows = []
        for found in self.document["parameters"]:
            lower, upper = found["interval"] or (None, None)
            row = {key: found[key] for key in ("name", "unit", "best")}
            gaps = [tuple(gap) for gap in found.get("gaps", [])]
            rows.append(row | {"lower": lower, "upper": upper, "gaps": gaps, "settled": all(found["settled"])})
        return pd.DataFrame(rows)

    @property
    def fit(self) -> pd.DataFrame:
        """A row a fitted datum beside the model."""
        return pd.DataFrame(self.document["fit"])

    @property
    def hold_out(self) -> pd.DataFrame:
        """A row a datum that was held out, beside the prediction."""
        return pd.DataFrame(self.document["hold_out"])

    def __repr__(self) -> str:
        found = []
        for parameter in self.document["parameters"]:
            interval = parameter["interval"]
            inner = [end for gap in parameter.get("gaps", []) for end in gap]
            edges = [interval[0], *inner, interval[1]] if interval else []
            ends = " or".join(f" [{low:.4g}, {high:.4g}]" for low, high in zip(edges[::2], edges[1::2]))
            found.append(f"{parameter['name']} {parameter['best']:.4g}{ends} {parameter['unit']}")
        left_open = f"; {len(self.findings)} findings" if self.findings else ""
        return f"<{', '.join(found)}{left_open}>"


def judge(
    files: str | PathLike[str] | Iterable[str | PathLike[str]],
    *,
    out: str | PathLike[str] | None = None,
) -> Judgement:
    """Judges other codes' results, a TOML file each, as Bagnold's own are judged.

    ``out`` is a folder for the page, figures and tables; without one nothing is written.

    Raises ``Refused`` for submissions that cannot be understood, with the program's message.
    """
    if isinstance(files, (str, PathLike)):
        files = [files]
    with TemporaryDirectory() as temporary:
        folder = Path(out) if out is not None else Path(temporary) / "judged"
        command("--quiet", "judge", *map(fspath, files), "--out", str(folder))
        return Judgement(json.loads((folder / "metrics.json").read_text(encoding="utf-8")))


def calibrate(plan: str | PathLike[str], *, out: str | PathLike[str], resume: bool = False) -> Calibration:
    """Finds the parameters that agree best with the data of a plan, and judges them on data held out.

    ``out`` is the calibration's folder. Interrupted, the same call resumes; ``resume`` opens one that is done.

    Raises ``Refused`` for plans that cannot be understood, with the program's message.
    """
    folder = Path(out)
    command("--quiet", "calibrate", fspath(plan), "--out", str(folder), *(["--resume"] if resume else []))
    return Calibration(json.loads((folder / "result.json").read_text(encoding="utf-8")), folder)
