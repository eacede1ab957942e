"""The arrays of a run, or of keyword arguments, as the compiled part reads them."""
from __future__ import annotations

import difflib
import warnings
from typing import Any, Dict, Mapping, Optional

from numpy.typing import NDArray

from . import _native
from .columns import SAMPLE_NAMES, Clock, array_of, in_seconds, of_one_coil_or_both
from .recordings import Recording
from .runs import as_recording, columns_of, is_path


def _refuse_unknown(given: Mapping[str, Any]) -> None:
    """Of keyword arguments those that are no channel in any unit; of a table such columns are left out."""
    for name in given:
        if name not in _native.columns and not _native.names_channel(name):
            near = difflib.get_close_matches(name, (*SAMPLE_NAMES, "estimator", "environment"), 1)
            raise _native.Error(
                f"{name}: is no channel with its unit and no option{''.join(f'; did you mean {each}?' for each in near) or ';'} the "
                f"sensor reads {', '.join(SAMPLE_NAMES)}; a table may have other columns beside them")


def sample_columns(run: Optional[Any], given: Mapping[str, Any], direction: str,
                   clock: Optional[Clock] = None) -> Dict[str, NDArray[Any]]:
    """By the compiled part's names, in SI. Columns with those names are taken as they are; others are read as a file's.
    Instants are counted by the clock."""
    also = sorted(name for name, value in given.items() if value is not None)
    if run is not None:
        if also:
            raise _native.Error(f"{also[0]} is given beside a whole recording; give either a recording or arrays")
        if is_path(run):
            raise _native.Error(
                f"a recording or arrays are estimated, and this is a {type(run).__name__}; read a file by "
                "spoolflow.read_recording(path), or give time_s=..., current_A=..., position_m=...")
        given = columns_of(run)
    else:
        given = {name: given[name] for name in also}
    given = in_seconds(given, clock)
    if run is None:
        _refuse_unknown(given)
    if any(name not in _native.columns for name in given):
        run = given = as_recording(given)
    if isinstance(run, Recording) and run.resampled:
        warnings.warn(f"{run.file}: {run.resampled}", stacklevel=3)
    wanted = {name: given[name] for name in SAMPLE_NAMES if name in given}
    return {name: array_of(name, value) for name, value in of_one_coil_or_both(wanted, direction).items()}
