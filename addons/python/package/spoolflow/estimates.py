"""What a sensor answers: one sample's answer, and arrays of them."""
from __future__ import annotations

import enum
import os
from typing import TYPE_CHECKING, Any, List, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from .extras import dataset, matplotlib_axes, pandas
from .files import PathLike, make_whole

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

#: What the sensor reports about an answer, limits apart from faults (docs/troubleshooting.md explains each). Bits of a word:
#: `Status.closed | Status.spool_at_rest`; `Status(word)` names them.
Status = enum.IntFlag("Status", _native.status_bits, module=__name__)  # type: ignore[misc]

#: Of a status word: an input or the model cannot be trusted.
FAULT_BITS = 0xFFFF0000


class Answer:
    """What a sensor says of one sample: flow rate with its 95 % band, and what led to it."""

    __slots__ = (
        "time_s", "flow_m3_per_s", "flow_lower_m3_per_s", "flow_upper_m3_per_s", "pressure_difference_Pa",
        "magnetic_force_N", "spring_force_N", "flow_force_N", "friction_force_N", "status",
    )
    time_s: float
    flow_m3_per_s: float
    flow_lower_m3_per_s: float
    flow_upper_m3_per_s: float
    pressure_difference_Pa: float
    magnetic_force_N: float
    spring_force_N: float
    flow_force_N: float
    friction_force_N: float
    status: int

    def __init__(self, time_s: float, answer: "_native.Answer") -> None:
        self.time_s = time_s
        for name in self.__slots__[1:]:
            setattr(self, name, getattr(answer, name))

    @property
    def flow_L_min(self) -> float:
        """Flow rate [L/min]; of a whole valve > 0 for P to B."""
        return self.flow_m3_per_s * _native.L_min_per_m3_per_s

    @property
    def status_text(self) -> str:
        """The names of what is said, joined by `|` as in ESTIMATE.csv; empty when all is well."""
        return _native.status_text(self.status)

    def __repr__(self) -> str:
        flow, lower, upper = (
            value * _native.L_min_per_m3_per_s
            for value in (self.flow_m3_per_s, self.flow_lower_m3_per_s, self.flow_upper_m3_per_s))
        said = self.status_text or "all is well"
        return f"<Answer at {self.time_s:g} s: {flow:.4g} L/min, 95 % band {lower:.4g} to {upper:.4g} L/min; {said}>"


#: Of an estimate beside the time.
_COLUMNS = (
    "flow_m3_per_s", "flow_lower_m3_per_s", "flow_upper_m3_per_s", "pressure_difference_Pa", "magnetic_force_N",
    "spring_force_N", "flow_force_N", "friction_force_N", "status",
)


class Estimate:
    """The flow rate of a run, sample by sample, in arrays of equal length.

    All float64. Forces: the magnetic one opens (> 0),
    spring and flow force close (> 0), friction has the sign of the velocity.
    """

    time_s: NDArray[Any]  #: as given [s]
    flow_m3_per_s: NDArray[Any]  #: flow rate; of a whole valve > 0 for P to B
    flow_lower_m3_per_s: NDArray[Any]  #: 95 % band
    flow_upper_m3_per_s: NDArray[Any]
    pressure_difference_Pa: NDArray[Any]  #: over the metering edge
    magnetic_force_N: NDArray[Any]
    spring_force_N: NDArray[Any]
    flow_force_N: NDArray[Any]
    friction_force_N: NDArray[Any]
    status: NDArray[Any]  #: uint32, bits of `Status`

    def __init__(self, time_s: NDArray[Any], columns: "dict[str, NDArray[Any]]", index: Any = None) -> None:
        self.time_s = time_s
        #: of pandas, where the run had one of instants or times; else None
        self.index = index
        for name, column in columns.items():
            setattr(self, name, column)

    def __getitem__(self, samples: Any) -> "Estimate":
        """The answers to these samples, by a slice, their numbers or a mask: `estimate[estimate.faulty]`."""
        if not isinstance(samples, (slice, list, np.ndarray)):
            raise TypeError(f"samples are picked by a slice, numbers or a mask, not by a {type(samples).__name__}; "
                            "columns are attributes, such as estimate.flow_L_min")
        index = None if self.index is None else self.index[samples]
        return Estimate(self.time_s[samples], {name: getattr(self, name)[samples] for name in _COLUMNS}, index)

    def between(self, from_s: float, to_s: float) -> "Estimate":
        """The answers to the samples of from_s <= time < to_s [s]."""
        return self[(self.time_s >= from_s) & (self.time_s < to_s)]

    @property
    def flow_L_min(self) -> NDArray[Any]:
        """Flow rate [L/min]."""
        return self.flow_m3_per_s * _native.L_min_per_m3_per_s

    @property
    def flow_lower_L_min(self) -> NDArray[Any]:
        """Lower end of the 95 % band [L/min]."""
        return self.flow_lower_m3_per_s * _native.L_min_per_m3_per_s

    @property
    def flow_upper_L_min(self) -> NDArray[Any]:
        """Upper end of the 95 % band [L/min]."""
        return self.flow_upper_m3_per_s * _native.L_min_per_m3_per_s

    @property
    def pressure_difference_bar(self) -> NDArray[Any]:
        """Over the metering edge [bar]."""
        return self.pressure_difference_Pa / _native.Pa_per_bar

    @property
    def faulty(self) -> NDArray[Any]:
        """Of each sample whether an input or the model cannot be trusted (any fault in `status`)."""
        faulty: NDArray[Any] = (self.status & FAULT_BITS) != 0
        return faulty

    @property
    def status_texts(self) -> List[str]:
        """Of each sample the names of what is said, joined by `|` as in ESTIMATE.csv; empty when all is well."""
        words, which = np.unique(self.status, return_inverse=True)
        names = [_native.status_text(int(word)) for word in words]
        return [names[k] for k in which]

    def share_with(self, status: int) -> float:
        """Share of the samples, 0 to 1, that say any of these: `estimate.share_with(Status.spool_at_rest)`."""
        return float(np.mean((self.status & int(status)) != 0)) if len(self) else 0.0

    def _readable(self) -> "dict[str, Any]":
        """The columns of ESTIMATE.csv in its units, and what it leaves out."""
        return {
            "time_s": self.time_s,
            "flow_L_min": self.flow_L_min,
            "flow_lower_L_min": self.flow_lower_L_min,
            "flow_upper_L_min": self.flow_upper_L_min,
            "pressure_difference_bar": self.pressure_difference_bar,
            "magnetic_force_N": self.magnetic_force_N,
            "flow_force_N": self.flow_force_N,
            "friction_force_N": self.friction_force_N,
            "status": np.array(self.status_texts, dtype=object),
            "spring_force_N": self.spring_force_N,
            "faulty": self.faulty,
        }

    def to_pandas(self) -> "pd.DataFrame":
        """A table with every column, in the units of ESTIMATE.csv (docs/formats/estimate.md), and with the index of the run
        where that was one of instants or times. Needs pandas."""
        return pandas().DataFrame(self._readable(), index=self.index)

    def to_xarray(self) -> "xr.Dataset":
        """The same as a Dataset over the coordinate `time_s`; `units` stand with each variable. Needs xarray."""
        return dataset(self._readable(), {"written_by": f"spoolflow {_native.__version__}"})

    def write(self, path: PathLike) -> None:
        """Writes what `spoolflow estimate` writes, as CSV, Parquet, HDF5 or MATLAB by the suffix: .csv, .parquet,
        .h5 or .mat (docs/formats/estimate.md). The file appears when it is complete, in place of what was there.
        """
        columns = [self.time_s, self.flow_m3_per_s, self.flow_lower_m3_per_s, self.flow_upper_m3_per_s,
                   self.pressure_difference_Pa, self.magnetic_force_N, self.flow_force_N, self.friction_force_N]
        notes = [("written_by", f"spoolflow {_native.__version__}")]
        make_whole(path, lambda file, beside: _native.write_estimate(os.fsdecode(path), file, beside, columns, self.status,
                                                                     notes))

    def plot(self, axes: "Optional[Axes]" = None, *, reference_m3_per_s: Optional[Any] = None) -> "Axes":
        """Flow rate with its band over time [L/min over s], a reference flow beside it where given. Needs Matplotlib.

        Draws into `axes`, else into a new figure, and returns the axes.
        """
        axes = matplotlib_axes(axes)
        axes.fill_between(self.time_s, self.flow_lower_L_min, self.flow_upper_L_min, alpha=0.3, linewidth=0,
                          label="95 % band")
        axes.plot(self.time_s, self.flow_L_min, linewidth=1, label="estimate")
        if reference_m3_per_s is not None:
            reference = np.asarray(reference_m3_per_s, dtype=np.float64) * _native.L_min_per_m3_per_s
            axes.plot(self.time_s, reference, color="black", linewidth=1, label="reference")
        axes.set_xlabel("time [s]")
        axes.set_ylabel("flow rate [L/min]")
        axes.legend()
        return axes

    def __len__(self) -> int:
        return len(self.flow_m3_per_s)

    def __repr__(self) -> str:
        if len(self) == 0:
            return "<Estimate of no samples>"
        low, mean, high = (
            value * _native.L_min_per_m3_per_s
            for value in (self.flow_m3_per_s.min(), self.flow_m3_per_s.mean(), self.flow_m3_per_s.max()))
        width = np.mean(self.flow_upper_m3_per_s - self.flow_lower_m3_per_s) * _native.L_min_per_m3_per_s
        return (f"<Estimate of {len(self)} samples, {self.time_s[0]:g} to {self.time_s[-1]:g} s: "
                f"{low:.4g} to {high:.4g} L/min, mean {mean:.4g}; band {width:.3g} L/min wide on average; "
                f"{100 * float(np.mean(self.faulty)):.2g} % with faults>")
