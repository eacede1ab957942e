"""What works where another package is there: tables by pandas, pictures by Matplotlib."""
from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any, Mapping, cast

if TYPE_CHECKING:
    import xarray as xr

_UNITS = (("_m3_per_s", "m3/s"), ("_L_min", "L/min"), ("_bar", "bar"), ("_Pa", "Pa"), ("_mm", "mm"), ("_s", "s"), ("_A", "A"),
          ("_V", "V"), ("_m", "m"), ("_N", "N"), ("_K", "K"))


def pandas() -> ModuleType:
    try:
        import pandas
    except ImportError:
        raise ImportError("to_pandas() needs pandas; install it (Debian: python3-pandas), or use the arrays") from None
    return cast(ModuleType, pandas)


def matplotlib_axes(axes: Any) -> Any:
    """`axes`, or those of a new figure."""
    if axes is not None:
        return axes
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("plot() needs Matplotlib; install it (Debian: python3-matplotlib), or use the arrays") from None
    return pyplot.subplots()[1]


def dataset(columns: Mapping[str, Any], attributes: Mapping[str, Any]) -> "xr.Dataset":
    """Columns of one length over `time_s`; what ends a name as a unit stands in the variable's `units`, too."""
    try:
        import xarray
    except ImportError:
        raise ImportError("to_xarray() needs xarray; install it (Debian: python3-xarray), or use the arrays") from None
    out = xarray.Dataset({name: ("time_s", column) for name, column in columns.items() if name != "time_s"},
                         {"time_s": ("time_s", columns["time_s"])}, dict(attributes))
    for name in out.variables:
        unit = next((unit for ending, unit in _UNITS if str(name).endswith(ending)), None)
        if unit is not None:
            out[name].attrs["units"] = unit
    return out
