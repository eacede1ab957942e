"""What works where another package is there: tables by pandas, pictures by Matplotlib."""
from __future__ import annotations

from types import ModuleType
from typing import Any, cast


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
