"""From bench recordings to models: of valves, of types, of a type's units."""
from __future__ import annotations

import contextlib
import os
import tempfile
import warnings
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Union

from . import _native, apart, settings
from .errors import FileMissing, calling, naming_missing
from .files import PathLike, keep_apart, write_whole
from .models import Model
from .runs import as_recording, is_path, several_of
from .work import AnyModel, StepProgress, _units

#: campaign.toml, or a dict that says the same, whose recordings may be in memory: `{"valve": {"name": "A", "rated_flow_L_min":
#: 80, "stroke_mm": 2.4}, "recording": [{"protocol": "spring", "file": table}, ...]}`.
Campaign = Union[PathLike, Mapping[str, Any]]


def _entry(given: Mapping[str, Any], k: int, folder: str, names: Dict[str, str]) -> Dict[str, Any]:
    """A recording of a campaign as its file says it; what is in memory is written down with every digit."""
    out = dict(given)
    if "file" not in out:
        return out
    file = out["file"]
    if is_path(file):
        out["file"] = os.path.abspath(os.fsdecode(file))
        if not os.path.exists(out["file"]):
            raise FileMissing(f"recording[{k}]: the recording {os.fsdecode(file)} does not exist", os.fsdecode(file))
        return out
    path = os.path.join(folder, f"{k}_{out.get('protocol', 'recording')}.csv")
    called = getattr(file, "file", None) or f"recording[{k}]"
    _native.write_recording(as_recording(file, out.pop("channels", None), name=called)._read, path)
    names[path], out["file"] = called, path
    return out


@contextlib.contextmanager
def _as_file(campaign: Campaign) -> Iterator[str]:
    """The path of the campaign while it is needed. Messages call a dict `campaign`, and its recordings as they were given."""
    if not isinstance(campaign, Mapping):
        yield os.fsdecode(campaign)
        return
    with tempfile.TemporaryDirectory(prefix="spoolflow-") as folder:
        names: Dict[str, str] = {}
        listed = [_entry(each, k, folder, names) for k, each in enumerate(campaign.get("recording", []))]
        file = os.path.join(folder, "campaign.toml")
        names[file] = "campaign"
        with open(file, "w", encoding="utf-8") as out:
            out.write(settings.text_of({**campaign, "recording": listed}))
        with calling(names):
            yield file


@contextlib.contextmanager
def _type_file(type: Optional[AnyModel]) -> Iterator[Optional[str]]:
    if type is None or is_path(type):
        yield None if type is None else os.fsdecode(type)  # type: ignore[arg-type]
        return
    if not isinstance(type, Model):
        raise _native.Error(f"type: a type's model or its file is needed, and this is a {type.__class__.__name__}; make one with "
                            "spoolflow.calibrate(campaign, as_type=True)")
    with tempfile.TemporaryDirectory(prefix="spoolflow-") as folder:
        file = os.path.join(folder, "type.json")
        type.save(file)
        yield file


def calibrate(campaign: Union[Campaign, Iterable[Campaign]], *, allow_outside: bool = False, despite_doubts: bool = False,
              as_type: bool = False, type: Optional[AnyModel] = None, report: Optional[PathLike] = None,
              units: Sequence[str] = (), progress: Optional[StepProgress] = None) -> Model:
    """Makes a valve's model from the bench recordings of a campaign: the model of `spoolflow calibrate`.

    campaign: campaign.toml, which names the valve, the oil and the recordings with their protocols
        (docs/formats/campaign.md), or a dict that says the same, whose `file` may be a table of pandas, a recording or a
        dict of arrays.
    allow_outside: read recordings that the campaign names outside its own folder, too; a dict may always name any.
    despite_doubts: make a model of recordings that contradict each other or physics, too; `model.doubts` keeps them.
    as_type: the model is of every unit of the valve's type (docs/type_and_unit.md): by the campaign's [tolerances]; of
        three campaigns and more, given as a list, by how these differ.
    type: a type's model or its file; `campaign` is then that of one of its units, and `model.type` says where it lies.
    report: an HTML page to write about the calibration of a valve; `units` are its reader's ("gal/min", "psi", ...).
    progress: called with what begins and the share done, 0 to 1 (not where HDF5 or MATLAB files are read beside other
        threads, which a process of its own does).

    What is only unusual about the recordings is warned of. Raises Error, naming the campaign's line, the file, the
    channel and the likely cause.
    """
    several = several_of(campaign)
    _refuse_contradictions(len(several), as_type, type, report)
    with contextlib.ExitStack() as kept_files:
        kept_files.enter_context(naming_missing(*several, type))
        files = [kept_files.enter_context(_as_file(each)) for each in several]
        outside = allow_outside or any(isinstance(each, Mapping) for each in several)
        type_file = kept_files.enter_context(_type_file(type))
        recordings: List[Any] = [name for file in files for name in _native.campaign_files(file, type_file)]
        keep_apart({"report": report}, [*several, *recordings, type])
        if type_file is None:
            kept, page, notes = apart.call("calibrate", recordings, files, outside, despite_doubts, as_type,
                                           _units(report, units), progress=progress)
        else:
            kept, page, notes = apart.call("calibrate_unit", recordings, files[0], outside, type_file, progress=progress)
    for note in [*notes, *(f"doubt: {doubt}" for doubt in kept.doubts)]:
        warnings.warn(note, stacklevel=2)
    if report is not None and page is not None:
        write_whole(report, page)
    return Model(kept)


def _refuse_contradictions(count: int, as_type: bool, type: Optional[AnyModel], report: Optional[PathLike]) -> None:
    if count == 0:
        raise _native.Error("no campaign is given; name one at least")
    if not isinstance(as_type, bool):
        raise _native.Error(f"as_type: True or False is needed, not {as_type!r}")
    if as_type and type is not None:
        raise _native.Error("as_type makes a type's model, type one of its units: give one of them")
    if count > 1 and (not as_type or count == 2):
        raise _native.Error(f"{count} campaigns are given: one makes a valve's model, three and more a type's with as_type=True")
    if report is not None and (type is not None or count > 1):
        raise _native.Error("report shows one campaign's fits: leave it out with a type's units and with several campaigns")
