"""What the extension module gives to the package."""

from collections.abc import Sequence
from os import PathLike
from typing import Any


class Refused(ValueError):
    """Input that Bagnold refuses, or output that cannot be written."""

class Figures:
    """A case's figures, drawn when they are asked for."""

    def names(self) -> list[str]: ...
    def svg(self, name: str) -> str | None: ...

def cases() -> list[tuple[str, str]]: ...
def command(words: list[str]) -> tuple[int, str]: ...
def run(
    target: str,
    *,
    tier: str | None = None,
    settings: list[str] = ...,
    only: list[str] = ...,
    overlay: Sequence[str | PathLike[str]] = ...,
    fresh: bool = False,
    threads: int | None = None,
    store: str | PathLike[str] | None = None,
) -> dict[str, Any]: ...

