"""Models for other programs and controllers: what `spoolflow export` writes."""
from __future__ import annotations

import os
from typing import List, Optional, Union

from . import _native
from .files import PathLike, write_bytes
from .models import Model
from .work import AnyModel, as_model


def _direction(direction: Optional[str]) -> Optional[str]:
    if direction not in (None, "a", "b"):
        raise _native.Error(f"direction: {direction} not in {{a,b}}")
    return direction


def export_cpp(model: AnyModel, folder: PathLike, *, direction: Optional[str] = None) -> List[str]:
    """The sensor as C++ for firmware (docs/embedded.md): the folder of `spoolflow export cpp`.

    model: a model or its file. folder: is made where it is not there. Files of an earlier export are replaced where nobody
        changed them; all else in the folder stays.
    direction: "a" or "b", of a model of a whole valve one direction alone.

    Returns the names of the files, relative to the folder. Raises Error where a file of somebody's would be overwritten.
    """
    target = os.fsdecode(folder)
    files = _native.export_cpp(as_model(model)._kept, target, _direction(direction))
    for name, content in files:
        path = os.path.join(target, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        write_bytes(path, content)
    return [name for name, _ in files]


def export_parameters(model: AnyModel, path: PathLike, *, direction: Optional[str] = None,
                      sensors: Optional[str] = None) -> None:
    """The parameters as bytes for a flash page (docs/embedded.md): the file of `spoolflow export parameters`.

    model, direction: as of `export_cpp`. sensors: "observer" or "condensed" alone; None: both.
    The time in it is that of SOURCE_DATE_EPOCH where that is set.
    """
    write_bytes(path, _native.export_parameters(as_model(model)._kept, _direction(direction), sensors))


def export_fmu(model: Union[Model, PathLike], path: PathLike, *, fmi: int = 2, direction: Optional[str] = None) -> None:
    """A co-simulation FMU for Linux and, where this build serves it, Windows (docs/fmu.md): the file of `spoolflow export fmu`.

    model: a model or its file: the FMU of the sensor. Or a valve file (TOML), or "size_6", "size_10", "fast_dither",
        "whole_size_6", "whole_differential": that of the virtual valve.
    fmi: version of the standard, 2 or 3. direction: as of `export_cpp`, of a sensor alone.
    """
    if not isinstance(model, Model) and _native.names_valve(os.fsdecode(model)):
        if direction is not None:
            raise _native.Error(f"direction: {direction}: a virtual valve has no direction to choose; leave it away")
        content = _native.export_valve_fmu(os.fsdecode(model), fmi)
    else:
        content = _native.export_sensor_fmu(as_model(model)._kept, fmi, _direction(direction))
    write_bytes(path, content)
