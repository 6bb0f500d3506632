"""Cases and what a run of one leaves behind."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable, Iterator, Mapping
from os import PathLike, fspath
from types import MappingProxyType
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from . import _native
from ._settings import settings, varied


class DivergenceWarning(UserWarning):
    """A run diverged although its case does not expect it: its numbers mean nothing."""


class Particles(Mapping[str, NDArray[np.float64]]):
    """The particles of one run at one time: arrays by their names, a row a particle, to be read only.

    Vectors have three columns; in two dimensions the third is 0. ``units`` has the unit of each array.
    """

    def __init__(self, run: str, time: float, arrays: Mapping[str, tuple[str, NDArray[np.float64]]]) -> None:
        self.run = run
        self.time = time
        self.units: dict[str, str] = {name: unit for name, (unit, _) in arrays.items()}
        self._arrays = {name: array for name, (_, array) in arrays.items()}

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __repr__(self) -> str:
        names = ", ".join(f"{name} [{unit}]" for name, unit in self.units.items())
        return f"<{len(self['position'])} particles at {self.time:g} s: {names}>"


class Result:
    """A finished case: numbers with their verdicts, profiles and series, particles, figures."""

    def __init__(self, described: Mapping[str, Any]) -> None:
        self.document: dict[str, Any] = json.loads(described["document"])
        """Everything in ``metrics.json`` of ``bagnold run``."""
        self.case: str = self.document["case"]
        """Name of the case."""
        self.tier: str = self.document["tier"]
        """The tier that its parameters started from."""
        self.state_hash: str = self.document["state_hash"]
        """Hash of the final states' bits: the same on any machine and number of threads."""
        self.parameters: dict[str, Any] = json.loads(described["parameters"])
        """The parameters as run, tables as mappings."""
        self.case_file: str = described["case_file"]
        """The same as TOML with remarks: as a file, ``run`` takes it."""
        self.description: str = described["description"]
        """What is simulated and what it is judged against."""
        self._tables: dict[str, dict[str, NDArray[np.float64]]] = described["tables"]
        self._frames: dict[str, list[tuple[float, dict[str, Any]]]] = described["frames"]
        self._figures: _native.Figures = described["figures"]

    @property
    def metrics(self) -> pd.DataFrame:
        """A row a number: name, variant, value, unit, reference, limits, margin and verdict."""
        return _metrics(self.document["metrics"])

    @property
    def runs(self) -> pd.DataFrame:
        """A row a run: variant, outcome, particles, steps, simulated and wall time."""
        return pd.DataFrame(self.document["runs"])

    @property
    def profiles(self) -> list[str]:
        """Names of all profiles and series."""
        return list(self._tables)

    def profile(self, name: str) -> pd.DataFrame:
        """A profile or series, a column each with its unit in the heading.

        ``name`` may be a part of the name, where only one has it.

        Raises ``KeyError`` if there is none, or more than one.
        """
        return pd.DataFrame(self._tables[_only_one(name, self._tables, "profile")])

    def times(self, run: str | None = None) -> list[float]:
        """Times at which there are particles of a run [s]."""
        return [time for time, _ in self._frames[self._run(run)]]

    def particles(self, time: float | None = None, run: str | None = None) -> Particles:
        """The particles of a run at the time nearest to ``time`` [s]; without one at the last.

        ``run`` is a run's variant or a part of it; a case with a single run needs none. The arrays are the solver's own
        numbers, which were not copied.

        Raises ``KeyError`` if there is no such run, or no particles of it.
        """
        name = self._run(run)
        frames = self._frames[name]
        if not frames:
            raise KeyError(f"{self.case} keeps no particles of the run {name!r}")
        nearest = frames[-1] if time is None else min(frames, key=lambda frame: abs(frame[0] - time))
        return Particles(name, *nearest)

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        return self._figures.names()

    def figure(self, name: str) -> str:
        """A figure as SVG; ``IPython.display.SVG`` shows it in a notebook."""
        svg = self._figures.svg(_only_one(name, self.figures, "figure"))
        assert svg is not None, "a figure of that name was found"
        return svg

    @property
    def passes(self) -> bool:
        """Whether no gate fails, expected failures not excepted."""
        return all(metric["verdict"] != "fail" for metric in self.document["metrics"])

    def _run(self, name: str | None) -> str:
        if name is None:
            if len(self._frames) == 1:
                return next(iter(self._frames))
            raise KeyError(f"which run? {_listed(self._frames)}")
        return _only_one(name, self._frames, "run")

    def __repr__(self) -> str:
        return f"<{self.case}, {self.tier} tier: {len(self._frames)} runs, {len(self.document['metrics'])} numbers>"


def cases() -> pd.DataFrame:
    """All cases: name and a line about each."""
    return pd.DataFrame(_native.cases(), columns=["name", "summary"])


def show(case: str, tier: str = "quick") -> str:
    """A case's parameters as TOML, with units and remarks.

    Raises ``Refused`` for an unknown case.
    """
    return command("show", case, "--tier", tier)


def run(
    case: str | PathLike[str],
    *,
    tier: str | None = None,
    vary: Mapping[str, Iterable[Any]] = MappingProxyType({}),
    only: str | Iterable[str] = (),
    overlay: str | PathLike[str] | Iterable[str | PathLike[str]] = (),
    fresh: bool = False,
    threads: int | None = None,
    store: str | PathLike[str] | None = None,
    **parameters: Any,
) -> Result:
    """Simulates a case, or a TOML file that describes a case or study, and judges it.

    Every other keyword is a parameter of the case, as ``show`` lists them: ``resolution=20``,
    ``material={"viscosity": 0.5}``. ``tier`` is "quick" (default), "paper" or "fine"; ``vary`` gives several values of
    parameters, each with each, in place of the runs of the tier; ``only`` names runs by their keys,
    such as "material=sand,aspect_ratio=3"; ``overlay`` names CSV files with measurements, which are drawn into the figure
    with their axes and give a metric ``overlay_residual``; ``fresh`` simulates what is stored; ``threads`` changes no result.

    Other Python threads run meanwhile. Ctrl-C raises ``KeyboardInterrupt``; the same call then resumes from the last
    checkpoint.

    Raises ``Refused``, a ``ValueError``, for what the case does not take, with the program's message. Warns of runs that
    diverge although their case does not expect it.
    """
    only = [only] if isinstance(only, str) else list(only)
    overlay = [overlay] if isinstance(overlay, (str, PathLike)) else list(overlay)
    described = _native.run(
        fspath(case),
        tier=tier,
        settings=[*settings(parameters), *varied(vary)],
        only=only,
        overlay=overlay,
        fresh=fresh,
        threads=threads,
        store=store,
    )
    result = Result(described)
    for one in result.document["runs"]:
        diverged = one["outcome"].get("diverged") if isinstance(one["outcome"], dict) else None
        if diverged and not diverged["expected"]:
            warnings.warn(f"{one['variant']} diverged: {diverged['message']}", DivergenceWarning, stacklevel=2)
    return result


def command(*words: str) -> str:
    """What a command of the program prints.

    Raises ``Refused`` for words that it does not understand and input that it refuses.
    """
    code, text = _native.command(list(words))
    if code == 2:
        raise _native.Refused(text.strip())
    return text


def _metrics(entries: Iterable[Mapping[str, Any]]) -> pd.DataFrame:
    """Numbers of ``metrics.json`` as rows, their limits in two columns."""
    rows = []
    for entry in entries:
        row = {key: value for key, value in entry.items() if key not in ("limit", "uncertainty")}
        limit = entry.get("limit") or {}
        within = limit.get("within", (None, None))
        row["at_least"] = limit.get("at_least", within[0])
        row["at_most"] = limit.get("at_most", within[1])
        rows.append(row)
    frame = pd.DataFrame(rows)
    numbers = ["value", "bagnold", "reference", "margin", "at_least", "at_most"]
    present = [name for name in numbers if name in frame]
    return frame.astype({name: "float64" for name in present})


def _only_one(part: str, names: Iterable[str], what: str) -> str:
    """The name itself, or the only one that has the part in it."""
    names = list(names)
    if part in names:
        return part
    found = [name for name in names if part in name]
    if len(found) == 1:
        return found[0]
    raise KeyError(f"{len(found) or 'no'} {what}s with {part!r} in their name; there are {_listed(found or names)}")


def _listed(names: Iterable[str]) -> str:
    return ", ".join(repr(name) for name in names) or "none"
