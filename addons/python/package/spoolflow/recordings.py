"""Recordings in memory: a column a channel, in SI units."""
from __future__ import annotations

import json
import os
import zlib
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping, Optional, Tuple, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _native, apart
from .channels import Channels, as_file
from .errors import naming_missing
from .extras import dataset, matplotlib_axes, pandas
from .files import PathLike

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes


class Recording(Mapping[str, NDArray[Any]]):
    """A whole recording: `recording["current_A"]` or `recording.current_A`, an array a channel, NaN where a sample is
    missing. Names are those of docs/formats/channels.md with the SI unit: `time_s`, `current_A`, `voltage_V`,
    `position_m`, `oil_temperature_K`, `flow_reference_m3_per_s`, `pressure_difference_Pa`, ...; shares (`position_set`, 0
    to 1) and numbers (`test`) have none. The arrays refer to the recording's memory; nothing is copied. What is written into
    them (`recording.current_A[:] *= 1.02`) counts for all that is made of the recording; another array in the place of one
    takes a table: `{**recording, "current_A": other}`.
    """

    def __init__(self, read: "_native.Recording", file: str) -> None:
        self._read = read
        self._source: Optional[Tuple[str, int, int, int]] = None
        self._columns: Dict[str, NDArray[Any]] = read.columns()
        #: where it was read
        self.file = file
        notes = read.notes()
        #: samples whose time stamp is that of the sample before
        self.duplicate_times: int = notes["duplicate_times"]
        #: empty cells
        self.missing_values: int = notes["missing_values"]
        #: which columns had a time of their own, from which rate to which, and how; empty where none
        self.resampled: str = notes["resampled"]

    @overload
    def __getitem__(self, name: str) -> NDArray[Any]: ...

    @overload
    def __getitem__(self, name: "Union[slice, List[int], NDArray[Any]]") -> "Recording": ...

    def __getitem__(self, name: Any) -> "Union[NDArray[Any], Recording]":
        """A channel by its name; samples by a slice, by their numbers or by a mask: `recording[recording.time_s < 10]`."""
        if isinstance(name, (slice, list, np.ndarray)):
            samples = np.arange(self.samples, dtype=np.int64)[name]
            if not len(samples):
                raise _native.Error(f"{self.file}: none of its {self.samples} samples is chosen; it goes from {self._span()}")
            return Recording(_native.picked(self._read, np.ascontiguousarray(samples)), self.file)
        try:
            return self._columns[name]
        except (KeyError, TypeError):
            raise KeyError(self._without(name)) from None

    def between(self, from_s: float, to_s: float) -> "Recording":
        """The samples of from_s <= time < to_s [s]."""
        return self[(self["time_s"] >= from_s) & (self["time_s"] < to_s)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of channels; `samples` is that of samples."""
        return len(self._columns)

    def __getattr__(self, name: str) -> NDArray[Any]:
        columns: Dict[str, NDArray[Any]] = self.__dict__.get("_columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(self._without(name))

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _native.columns:
            raise AttributeError(f"{name}: a recording's array is not replaced; write into it, {name}[:] = ..., or make a table, "
                                 f"{{**recording, '{name}': ...}}")
        super().__setattr__(name, value)

    def __getstate__(self) -> Dict[str, Any]:
        """Without the arrays, which are the recording's memory."""
        return {name: value for name, value in self.__dict__.items() if name != "_columns"}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state, _columns=state["_read"].columns())

    def _without(self, name: str) -> str:
        return f"{name}: no such channel; the recording has {', '.join(self.__dict__.get('_columns', {}))}"

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._columns]

    def whole_file(self) -> Optional[str]:
        """The file that it is all of, by its own names and units, where neither has changed since; else None."""
        source = self._source
        return source[0] if source is not None and source == self._stamp(source[0]) else None

    def _stamp(self, file: str) -> Optional[Tuple[str, int, int, int]]:
        """What changes with the content of the file or of the arrays."""
        try:
            of = os.stat(file)
        except OSError:
            return None
        checksum = 0
        for column in self._columns.values():
            checksum = zlib.crc32(column.data, checksum)
        return os.path.abspath(file), of.st_mtime_ns, of.st_size, checksum

    @property
    def samples(self) -> int:
        return len(self._columns["time_s"])

    def to_pandas(self) -> "pd.DataFrame":
        """A table with a column a channel, in SI units. Needs pandas."""
        return pandas().DataFrame(dict(self._columns))

    def to_xarray(self) -> "xr.Dataset":
        """A Dataset with a variable a channel over the coordinate `time_s`, in SI units, which stand in `units`. Needs xarray."""
        return dataset({name: column for name, column in self._columns.items()}, {"file": self.file})

    def plot(self, name: str = "current_A", axes: "Optional[Axes]" = None) -> "Axes":
        """One channel over time. Needs Matplotlib."""
        axes = matplotlib_axes(axes)
        axes.plot(self["time_s"], self[name], linewidth=1)
        axes.set_xlabel("time_s")
        axes.set_ylabel(name)
        return axes

    def _span(self) -> str:
        time = self["time_s"]
        return f"{time[0]:g} to {time[-1]:g} s"

    def __repr__(self) -> str:
        return f"<Recording {self.file}: {self.samples} samples, {self._span()}: {', '.join(self)}>"


def _check_stroke(stroke_m: Optional[float]) -> None:
    if isinstance(stroke_m, str):
        raise _native.Error(f"stroke_m: {stroke_m!r} is text; give a number [m]")
    if stroke_m is not None and not 0 < stroke_m <= 0.1:
        raise _native.Error(f"stroke_m: Value {stroke_m} not in range 0 to 0.1 m; spools move by 0.5 to 20 mm")


def read_recording(path: PathLike, channels: Optional[Channels] = None, *,
                   stroke_m: Optional[float] = None) -> Recording:
    """Reads a recording whole: CSV, MATLAB v5 or v7.3, HDF5, TDMS, MDF 4, Excel (.xlsx), recognised by content.

    path: the file. Columns named `<channel>_<unit>`, such as `current_A` or `position_mm`, need nothing more.
    channels: a channel map of a file with other column names or units: a file (TOML, docs/formats/channels.md), or a
        dict such as `{"current_A": "I_coil [mA]", "position": {"column": "LVDT", "unit": "V", "scale": 0.24, "to": "mm"}}`.
    stroke_m: the valve's stroke [m], > 0 and up to 0.1, where positions are given in percent.

    Raises FileNotFoundError where there is none, else Error with file, line and column: text among numbers, times that run
    back, values implausible for their unit.
    """
    file = os.fsdecode(path)
    _check_stroke(stroke_m)
    with naming_missing(path, channels), as_file(channels) as map_file:
        read = apart.call("read_recording", [file], file, map_file, stroke_m)
    out = Recording(read, file)
    if channels is None and stroke_m is None:
        out._source = out._stamp(file)
    return out


def inspect(path: PathLike, channels: Optional[Channels] = None, *, stroke_m: Optional[float] = None) -> Dict[str, Any]:
    """What a recording holds, before anything is made of it: what `spoolflow inspect --json` writes, as a dict.

    path, channels, stroke_m: as of `read_recording`.

    `format`, `columns`, `unread` (what else it holds, and why that is not read), `samples`, `begin_s`, `end_s`, `rate_Hz`,
    `time_step_jitter` (share of the step), `duplicate_times`, `gap_count`, `gaps_s`; `channels`: lowest, highest and mean in
    `unit`, missing samples, the share that stands at an end; of `raw_columns` the range in the file's unit and what each is
    taken for; `times`, where columns have several; what is `missing` and `helpful`; `proposed_map`, a dict for `channels`
    once its units are filled in, and `proposed_channel_map`, the same as TOML. A number that is not known is None.

    Raises Error as `read_recording`; where no channel is recognised, only the columns and the proposal are there.
    """
    file = os.fsdecode(path)
    _check_stroke(stroke_m)
    with naming_missing(path, channels), as_file(channels) as map_file:
        seen: Dict[str, Any] = json.loads(apart.call("inspect", [file], file, map_file, stroke_m))
    return seen
