"""Python's values as the changes that ``bagnold run --set`` takes: a path and a value in TOML."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any


def settings(parameters: Mapping[str, Any]) -> list[str]:
    """``{"material": {"viscosity": 0.5}}`` as ``["material.viscosity=0.5"]``."""
    return [f"{path}={_toml(value, path)}" for path, value in _paths(parameters, "")]


def varied(parameters: Mapping[str, Any]) -> list[str]:
    """``{"resolution": [10, 20]}`` as the list of runs in place of the tier's."""
    if not parameters:
        return []
    vary = [{"path": path, "values": values} for path, values in parameters.items()]
    return ["variants=[]", f"vary={_toml(vary, 'vary')}"]


def _paths(parameters: Mapping[str, Any], above: str) -> Iterator[tuple[str, Any]]:
    for name, value in parameters.items():
        if isinstance(value, Mapping):
            yield from _paths(value, f"{above}{name}.")
        else:
            yield f"{above}{name}", value


def _toml(value: Any, path: str) -> str:
    """The value as TOML writes it, with every digit."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        # float: NumPy's are subclasses whose text names their type
        return repr(float(value)) if isinstance(value, float) else str(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{name} = {_toml(part, path)}" for name, part in value.items()) + "}"
    if hasattr(value, "tolist"):
        return _toml(value.tolist(), path)
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_toml(part, path) for part in value) + "]"
    raise TypeError(f"`{path}` is a {type(value).__name__}, but must be a number, text, truth value, list or mapping of these")
