"""Channel maps: files of TOML, or dicts that say the same."""
from __future__ import annotations

import contextlib
import json
import os
import tempfile
from typing import Iterator, Mapping, Optional, Union

from . import _native
from .files import PathLike

#: What a column is: its name, or its name with `unit`, `scale`, `offset` and `to` as in docs/formats/channels.md.
Source = Union[str, Mapping[str, Union[str, float]]]
#: A file, or a source for each channel: `{"current_A": "I_coil [mA]", "position": {"column": "LVDT", "unit": "V", "scale":
#: 0.24, "to": "mm"}}`. Channels are called as in docs/formats/channels.md (`current`) or as in a `Recording` (`current_A`);
#: the unit is the column's own, stated in its header or in the file, or by `unit`.
Channels = Union[PathLike, Mapping[str, Source]]

_SI_UNITS = ("_m3_per_s", "_s", "_A", "_V", "_m", "_N", "_Pa", "_K")


def _channel(name: str) -> str:
    if name in _native.channels:
        return name
    for unit in _SI_UNITS:
        if name.endswith(unit) and name[: -len(unit)] in _native.channels:
            return name[: -len(unit)]
    return name  # which reading refuses, with the names that there are


def _toml(value: Union[str, float]) -> str:
    if isinstance(value, str):
        return json.dumps(value)
    number = float(value)
    return repr(number) if number == number else "nan"


def _line(name: str, source: Source) -> str:
    if not isinstance(source, (str, Mapping)):
        raise TypeError(f"channels: {name}: a column's name or a dict is needed, not {type(source).__name__}")
    if isinstance(source, str):
        return f"{json.dumps(_channel(name))} = {json.dumps(source)}\n"
    fields = ", ".join(f"{json.dumps(key)} = {_toml(value)}" for key, value in source.items())
    return f"{json.dumps(_channel(name))} = {{ {fields} }}\n"


@contextlib.contextmanager
def as_file(channels: Optional[Channels]) -> Iterator[Optional[str]]:
    """The path of the map while it is needed; None where there is none. Messages call a dict `channels`."""
    if channels is None or not isinstance(channels, Mapping):
        yield None if channels is None else os.fsdecode(channels)
        return
    lines = "".join(_line(name, source) for name, source in channels.items())
    with tempfile.TemporaryDirectory(prefix="spoolflow-") as folder:
        file = os.path.join(folder, "channels")
        with open(file, "w", encoding="utf-8") as out:
            out.write("[channels]\n" + lines)
        try:
            yield file
        except _native.Error as failure:
            raise _native.Error(str(failure).replace(file, "channels")) from None
