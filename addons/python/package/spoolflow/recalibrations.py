"""A valve's model moved on by what its machine knows of the oil that passed (docs/references.md)."""
from __future__ import annotations

import contextlib
import os
import tempfile
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native, apart, settings
from .channels import Channels
from .columns import array_of
from .errors import calling, naming_missing
from .files import PathLike
from .models import Model
from .runs import as_files, columns_of, is_path, is_run, several_of
from .work import AnyModel, Runs, as_model

#: REF.toml, or one or several dicts with the keys of its [[reference]]. Their `recording` is a file's name or the number of the
#: recording, 0 for the first; their `marks` a file, a table with columns `begin_s`, `end_s` and of a pump `speed_rpm`, or rows.
References = Union[PathLike, Mapping[str, Any], Sequence[Mapping[str, Any]]]


def _marks_file(marks: Any, where: str, file: str) -> str:
    """The file of marks, written where they are in memory."""
    if is_path(marks):
        return os.path.abspath(os.fsdecode(marks))
    if is_run(marks):
        columns = columns_of(marks)
        missing = [name for name in ("begin_s", "end_s") if name not in columns]
        if missing:
            raise _native.Error(f"{where}: marks have no column {missing[0]}; give begin_s, end_s and of a pump speed_rpm")
        names = [name for name in ("begin_s", "end_s", "speed_rpm") if name in columns]
        listed = [array_of(name, columns[name]) for name in names]
        if len({len(each) for each in listed}) > 1:
            raise _native.Error(f"{where}: columns of marks have {' and '.join(str(len(each)) for each in listed)} rows; give each as many")
        rows = np.column_stack(listed)
    else:
        rows = np.asarray(marks, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] not in (2, 3):
            raise _native.Error(f"{where}: marks are rows of begin_s, end_s and of a pump speed_rpm; these have the shape {rows.shape}")
        names = ["begin_s", "end_s", "speed_rpm"][: rows.shape[1]]
    np.savetxt(file, rows, "%.17g", ",", header=",".join(names), comments="")
    return file


def _recording_name(given: Any, where: str, runs: Sequence[Any], paths: Sequence[str]) -> str:
    """The name of the file that the recording has while it is read."""
    if isinstance(given, int):
        if not 0 <= given < len(paths):
            raise _native.Error(f"{where}: recording {given} is not given; there are 0 to {len(paths) - 1}")
        return os.path.basename(paths[given])
    for run, path in zip(runs, paths):
        called = run if is_path(run) else getattr(run, "file", None)
        if isinstance(called, (str, bytes, os.PathLike)) and os.path.basename(os.fsdecode(called)) == str(given):
            return os.path.basename(path)
    return str(given)  # which is refused, with the names that there are


@contextlib.contextmanager
def _as_file(references: References, runs: Sequence[Any], paths: Sequence[str]) -> Iterator[str]:
    """The path of the references while it is needed. Messages call dicts `references`."""
    if isinstance(references, (str, bytes, os.PathLike)):
        yield os.fsdecode(references)
        return
    given = references.get("reference", [references]) if isinstance(references, Mapping) else references
    with tempfile.TemporaryDirectory(prefix="spoolflow-") as folder:
        names: Dict[str, str] = {}
        tables: List[Dict[str, Any]] = []
        for k, each in enumerate(given):
            if not isinstance(each, Mapping):
                raise TypeError(f"references[{k}]: a dict is needed, not {type(each).__name__}")
            where, table = f"references[{k}]", dict(each)
            if "marks" in table:
                table["marks"] = _marks_file(table["marks"], where, os.path.join(folder, f"marks_{k + 1}.csv"))
                names[os.path.join(folder, f"marks_{k + 1}.csv")] = f"{where}: marks"
            if "recording" in table:
                table["recording"] = _recording_name(table["recording"], where, runs, paths)
            tables.append(table)
        file = os.path.join(folder, "references")
        with open(file, "w", encoding="utf-8") as out:
            out.write(settings.text_of({"reference": tables}))
        names[file] = "references"
        with calling(names):
            yield file


def recalibrate(model: AnyModel, recordings: Runs, references: References, *, channels: Optional[Channels] = None) -> Model:
    """The model moved on by what the machine knows of its oil, as `spoolflow recalibrate` does: position zero, friction and width of
    the edges, each where the evidence pays for it.

        moved = spoolflow.recalibrate(model, monday, {"kind": "stroke", "name": "boom", "ends": "marks",
                                                      "marks": [(0.5, 3.1), (4.0, 6.9)], "area_cm2": 40, "length_mm": 650})
        moved.provenance["adaptations"][-1]["reasons"]   # what was changed, what stays, and why
        moved.wear_states, moved.drift, moved.gone_back(0)

    model: with an observer, or its file. References of a whole valve say their direction, "b" (P to B) or "a".
    recordings: of the valve at work, as of `validate`, oldest first. channels: their map.
    references: a file of tables [[reference]] (TOML), a dict with the keys of one, or several.

    Raises Error where references contradict forces or each other, with the likely cause.
    """
    known = as_model(model)
    runs = several_of(recordings)
    named = references if is_path(references) else None
    with naming_missing(*runs, named, channels), as_files(runs, channels) as files:
        with _as_file(references, runs, files.paths) as file:
            kept, _, _ = apart.call("recalibrate", files.paths, known._kept, files.paths, files.channels, file)
    return Model(kept)
