"""Figures as plain objects: what a command writes as JSON, by attributes."""
from __future__ import annotations

import json
from typing import Any, Dict, Iterator, List, Mapping

import numpy as np

from .files import PathLike, write_whole


class Figures(Mapping[str, Any]):
    """Named figures: `figures.error.p95` or `figures["error"]["p95"]`, with the names and units of the JSON that the
    command writes. Rows of numbers are arrays, with NaN where nothing is known; a figure that is not known is None.
    """

    def __init__(self, members: Mapping[str, Any]) -> None:
        self._members: Dict[str, Any] = {name: _plain(value) for name, value in members.items()}

    def __getattr__(self, name: str) -> Any:
        members = self.__dict__.get("_members", {})
        if name in members:
            return members[name]
        raise AttributeError(f"{name}: no such figure; there are {', '.join(members)}")

    def __getitem__(self, name: str) -> Any:
        return self._members[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._members]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Figures):
            return NotImplemented
        return self.to_dict() == other.to_dict()

    __hash__ = None  # type: ignore[assignment]

    def to_dict(self) -> Dict[str, Any]:
        """Dictionaries, lists and numbers alone."""
        return {name: _bare(value) for name, value in self._members.items()}

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={_short(value)}" for name, value in self._members.items())
        return f"{type(self).__name__}({shown})"


class JudgedFigures(Figures):
    """All figures of one command."""

    def __init__(self, text: str) -> None:
        super().__init__(json.loads(text))
        self._text = text

    def save(self, path: PathLike) -> None:
        """Writes the figures as the command's `--json` does."""
        write_whole(path, self._text)


def flat(figures: Mapping[str, Any], before: str = "") -> Dict[str, Any]:
    """Every number and text in one row, under the names that lead to it; rows of numbers stay out."""
    out: Dict[str, Any] = {}
    for name, value in figures.items():
        if isinstance(value, Mapping):
            out.update(flat(value, f"{before}{name}_"))
        elif value is None or isinstance(value, (bool, int, float, str)):
            out[before + name] = value
    return out


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return Figures(value)
    if isinstance(value, list):
        numbers = all(isinstance(each, (int, float)) and not isinstance(each, bool) or each is None for each in value)
        if value and numbers and any(each is not None for each in value):
            return np.array([np.nan if each is None else each for each in value], dtype=np.float64)
        return [_plain(each) for each in value]
    return value


def _bare(value: Any) -> Any:
    if isinstance(value, Figures):
        return value.to_dict()
    if isinstance(value, np.ndarray):
        return [None if np.isnan(each) else each for each in value.tolist()]
    if isinstance(value, list):
        return [_bare(each) for each in value]
    return value


def _short(value: Any) -> str:
    if isinstance(value, Figures):
        return "{...}"
    if isinstance(value, np.ndarray):
        return f"<{len(value)} numbers>"
    if isinstance(value, list):
        return f"[{len(value)}]"
    return f"{value:g}" if isinstance(value, float) else repr(value)
