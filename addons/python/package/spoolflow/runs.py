"""What users give as a run: a file, a recording, a table of pandas, arrays or a dictionary of them, a Dataset of xarray."""
from __future__ import annotations

import contextlib
import os
import re
import tempfile
import warnings
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _native
from .channels import Channels, as_file
from .columns import array_of, in_seconds
from .files import PathLike
from .recordings import Recording, read_recording

if TYPE_CHECKING:
    import pandas as pd

#: Columns are called as those of files: `<channel>_<unit>` in any unit that files take, or as a channel map says.
Run = Union[PathLike, Mapping[str, Any], "pd.DataFrame"]


def is_path(run: Any) -> bool:
    return isinstance(run, (str, bytes, os.PathLike))


def is_run(run: Any) -> bool:
    """Whether it is one run rather than several."""
    return is_path(run) or hasattr(run, "keys") or getattr(getattr(run, "dtype", None), "names", None) is not None


def several_of(runs: Any) -> List[Any]:
    """One run as a list of it."""
    return [runs] if is_run(runs) else list(runs)


def columns_of(run: Any) -> Dict[str, Any]:
    """The columns by their names; an index of instants or times is `time_s`, one with the name of a column is that."""
    if getattr(getattr(run, "dtype", None), "names", None) is not None:  # a structured array
        return {name: run[name] for name in run.dtype.names}
    if hasattr(run, "data_vars"):  # a Dataset of xarray
        return {str(name): run[name].values for name in [*run.coords, *run.data_vars] if run[name].ndim == 1}
    if not hasattr(run, "keys"):
        raise _native.Error(
            f"a run is a file, a table or a mapping of columns, and this is a {type(run).__name__}; read a file by "
            "spoolflow.read_recording(path), or give time_s=..., current_A=..., position_m=...")
    names = [str(name) for name in run.keys()]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise _native.Error(f"column {twice[0]} stands twice; keep one of them, or give the other another name")
    out = {str(name): run[name] for name in run.keys()}
    index = getattr(run, "index", None)
    if index is None or callable(index) or any(re.match(r"time($|[^a-z])", name, re.IGNORECASE) for name in out):
        return out
    if getattr(index, "dtype", np.dtype(float)).kind in "mM":
        return {"time_s": index, **out}
    return out if index.name is None else {str(index.name): index, **out}


def index_of(run: Any) -> Any:
    """The run's index of instants or times, for answers with the same; None where it has none."""
    index = getattr(run, "index", None)
    return index if getattr(getattr(index, "dtype", None), "kind", "") in ("m", "M") else None


def _numbers(name: str, values: Any) -> Optional[Any]:
    """One row of float64; None where it is no numbers."""
    try:
        return array_of(name, values)
    except _native.Error:
        return None


def as_recording(run: Any, channels: Optional[Channels] = None, *, stroke_m: Optional[float] = None,
                 name: str = "the run") -> Recording:
    """Columns in memory, read as those of a file: any unit, channel maps, the same refusals. `name` stands in them."""
    listed: List[Tuple[str, Any, int]] = []
    columns = columns_of(run)
    for key, values in (in_seconds(columns) if channels is None else columns).items():
        numbers = _numbers(key, values)
        if numbers is None and not hasattr(values, "__len__"):
            continue  # a remark beside the columns
        listed.append((key, numbers, len(values) if numbers is None else len(numbers)))
    with as_file(channels) as map_file:
        return Recording(_native.as_recording(listed, name, map_file, stroke_m), name)


class Files(NamedTuple):
    paths: List[str]
    #: the channel map that they need
    channels: Optional[str]
    #: what those that were written down were called
    names: Mapping[str, str]

    def called(self, said: str) -> str:
        """A message with the names that the caller knows."""
        for path, name in self.names.items():
            said = said.replace(path, name)
        return said

    def noted(self, note: str) -> str:
        """The same of what calls files by their last part."""
        for path, name in self.names.items():
            alone = rf"(?<![\w/.-]){re.escape(os.path.basename(path))}"
            note = re.sub(alone, lambda _, name=name: name, note.replace(path, name))  # type: ignore[misc]
        return note


def _stem(run: Any, k: int) -> str:
    file = getattr(run, "file", None)
    stem = os.path.splitext(os.path.basename(file))[0] if isinstance(file, str) else ""
    return stem or f"run_{k + 1}"


@contextlib.contextmanager
def as_files(runs: Union[Run, Iterable[Run]], channels: Optional[Channels] = None) -> Iterator[Files]:
    """The runs as files while they are needed: those in memory are written down with every digit, in SI units. What refuses
    one of them calls it as it was given."""
    several = several_of(runs)
    if not several:
        raise _native.Error("no recording is given; name one at least")
    paths: List[str] = []
    names: Dict[str, str] = {}
    with contextlib.ExitStack() as kept:
        mapped = channels is not None and not all(is_path(run) for run in several)
        map_file = None if mapped else kept.enter_context(as_file(channels))
        for k, run in enumerate(several):
            if mapped and is_path(run):
                run = read_recording(run, channels)
            file = run if is_path(run) else run.whole_file() if isinstance(run, Recording) else None
            if file is not None:  # which the model may know from its calibration
                paths.append(os.fsdecode(file))
                continue
            called = getattr(run, "file", None) or ("the run" if len(several) == 1 else f"recordings[{k}]")
            folder = kept.enter_context(tempfile.TemporaryDirectory(prefix="spoolflow-"))
            paths.append(os.path.join(folder, f"{_stem(run, k)}.csv"))
            written = run if isinstance(run, Recording) else as_recording(run, channels, name=called)
            if written.resampled:
                warnings.warn(f"{called}: {written.resampled}", stacklevel=4)
            names[paths[-1]] = called
            _native.write_recording(written._read, paths[-1])
        try:
            yield Files(paths, map_file, names)
        except _native.Error as failure:
            said = Files(paths, map_file, names).called(str(failure))
            if said == str(failure):
                raise
            raise _native.Error(said) from None
