"""What users give as samples, made into the arrays that the compiled part reads."""
from __future__ import annotations

import re
from typing import Any, Dict, Mapping, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native

#: What a sensor may read, as arguments are called. Time, a current and position are needed.
SAMPLE_NAMES = (
    "time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K",
    "current_a_A", "current_b_A", "voltage_a_V", "voltage_b_V",
    "pressure_p_Pa", "pressure_a_Pa", "pressure_b_Pa", "pressure_t_Pa",
)

#: The order of a single sample's numbers in the compiled part.
STEP_NAMES = (
    "time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K", "current_a_A", "voltage_a_V",
    "pressure_p_Pa", "pressure_a_Pa", "pressure_b_Pa", "pressure_t_Pa",
)


def _of_pandas(values: Any) -> Any:
    """NumPy's array of it; instants are UTC, and what is missing is NaN."""
    if getattr(values.dtype, "kind", "") in ("m", "M"):
        return values.values
    if values.dtype.kind in "fiub" and not isinstance(values.dtype, np.dtype):
        return values.to_numpy(dtype=np.float64, na_value=np.nan)
    return values.to_numpy()


class Clock:
    """Counts instants in seconds from the first that it was given."""

    def __init__(self) -> None:
        self._first: Optional[NDArray[Any]] = None

    def seconds(self, array: NDArray[Any]) -> NDArray[Any]:
        """Of instants (datetime64) or of times since one (timedelta64), NaN where one is missing."""
        missing = np.isnat(array)
        since = array
        if array.dtype.kind == "M":
            if self._first is None and not missing.all():
                self._first = array[~missing][:1].astype("datetime64[ns]")
            if self._first is None:
                return np.full(array.shape, np.nan)
            since = array - self._first
        out: NDArray[Any] = since.astype("timedelta64[ns]").astype(np.int64) / 1e9
        out[missing] = np.nan
        return out


def _refuse_text(name: str, values: Any) -> None:
    """Of times that are written out: a file's are read, those of a table become instants by whoever made it."""
    if re.match(r"time($|[^a-z])", name, re.IGNORECASE) and hasattr(values, "__iter__"):
        first = next(iter(values), None)
        if isinstance(first, str):
            raise _native.Error(f"{name}: holds text, such as {first!r}; make instants of it, pandas.to_datetime(...), or numbers")


def in_seconds(columns: Mapping[str, Any], clock: Optional[Clock] = None) -> Dict[str, Any]:
    """The columns, those of instants or of times since one in seconds, as their names then say: `time_s` of `time`."""
    clock = Clock() if clock is None else clock
    out: Dict[str, Any] = {}
    for name, values in columns.items():
        _refuse_text(name, values)
        if getattr(getattr(values, "dtype", None), "kind", "") in ("m", "M"):
            values = clock.seconds(_of_pandas(values) if hasattr(values, "isna") else np.asarray(values))
            name = name if name.endswith("_s") or f"{name}_s" in columns else f"{name}_s"
        out[name] = values
    return out


def array_of(name: str, values: Any) -> NDArray[Any]:
    """`values` as one contiguous row of float64: the very array where it is one, else a copy."""
    try:
        if isinstance(values, np.ma.MaskedArray):
            values = np.ma.asarray(values, dtype=np.float64).filled(np.nan)  # type: ignore[no-untyped-call]
        elif hasattr(values, "isna"):  # a column or an index of pandas
            values = _of_pandas(values)
        array = np.asarray(values)
        if array.dtype.kind in "mM":
            array = Clock().seconds(array)
        if array.dtype.kind not in "fiub":
            if array.dtype.kind != "O":
                raise TypeError
            array = array.astype(np.float64)
        array = np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError, AttributeError):
        raise _native.Error(f"{name}: holds what is no number; give an array of numbers, NaN where one is missing") from None
    if array.ndim != 1:
        raise _native.Error(f"{name}: has {array.ndim} dimensions; give one row of numbers, a number a sample")
    return array


def of_one_coil_or_both(given: Mapping[str, Any], direction: str) -> Dict[str, Any]:
    """The currents and voltages as the sensor of a model of that direction takes them."""
    out = {name: value for name, value in given.items() if value is not None}
    coils = {name: out.pop(name, None) for name in ("current_a_A", "current_b_A", "voltage_a_V", "voltage_b_V")}
    if direction == "both":
        alone = [name for name in ("current_a_A", "current_b_A") if coils[name] is not None]
        if len(alone) == 1 and "current_A" in out:
            raise _native.Error(
                f"{alone[0]} is given beside current_A, which is the active coil's; give current_a_A and current_b_A, or "
                "current_A alone")
        if coils["current_a_A"] is not None and coils["current_b_A"] is not None:
            out.pop("voltage_V", None)
            out.update(current_A=coils["current_b_A"], current_a_A=coils["current_a_A"])
            if coils["voltage_b_V"] is not None:
                out["voltage_V"] = coils["voltage_b_V"]
            if coils["voltage_a_V"] is not None:
                out["voltage_a_V"] = coils["voltage_a_V"]
        elif "current_A" not in out:
            raise _native.Error(
                "the model is of a whole valve and needs the currents of both coils, current_a_A and current_b_A, or "
                "current_A of the active one")
    else:
        for name in ("pressure_p_Pa", "pressure_a_Pa", "pressure_b_Pa", "pressure_t_Pa"):
            out.pop(name, None)  # as estimate does: the sensor of one direction reads none
        if direction == "b":  # of a run of the whole valve, in whose signs P to B is > 0, the coil that this model knows
            if "current_A" not in out and coils["current_b_A"] is not None:
                out["current_A"] = coils["current_b_A"]
            if "voltage_V" not in out and coils["voltage_b_V"] is not None:
                out["voltage_V"] = coils["voltage_b_V"]
    for name in ("time_s", "current_A", "position_m"):
        if name not in out:
            raise _native.Error(f"{name} is missing; the sensor needs time_s, current_A and position_m")
    return out
