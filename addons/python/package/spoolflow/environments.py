"""What the machine around a valve leaves open (docs/environment.md)."""
from __future__ import annotations

import contextlib
import os
import tempfile
from typing import Any, Iterator, Mapping, Union

from . import _native, settings
from .errors import naming_missing
from .files import PathLike

#: "bench", "machine", a TOML file, or a dict with the keys of [environment]: `{"vibration_g": 1.0}`.
Environment = Union[PathLike, Mapping[str, Any]]


@contextlib.contextmanager
def as_environment(environment: Environment, more: Mapping[str, Any]) -> Iterator[str]:
    """The name or the file while it is needed; `more` are keys beside it. Messages call a dict `environment`."""
    if not isinstance(environment, Mapping):
        name = os.fsdecode(environment)
        if not more:
            with naming_missing(None if name in ("bench", "machine") else name):
                yield name
            return
        if name not in ("bench", "machine"):
            raise _native.Error(f"{sorted(more)[0]} is given beside the file {name}; give \"bench\", \"machine\" or all in the file")
        environment = {"kind": name}
    with tempfile.TemporaryDirectory(prefix="spoolflow-") as folder:
        file = os.path.join(folder, "environment")
        with open(file, "w", encoding="utf-8") as out:
            out.write(settings.text_of({"environment": {**environment, **more}}))
        try:
            yield file
        except _native.Error as failure:
            raise _native.Error(str(failure).replace(file, "environment")) from None
