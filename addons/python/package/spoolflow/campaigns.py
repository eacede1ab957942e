"""Whole measuring campaigns of a virtual valve."""
from __future__ import annotations

import os
from typing import Any, Dict, Iterator, List, Mapping, Optional

from . import _native
from .files import PathLike, write_whole
from .work import Progress, Simulation


class SimulatedCampaign(Mapping[str, Simulation]):
    """The recordings of a campaign by the names of their files, in their order by time: `campaign["spring.csv"].current_A`."""

    def __init__(self, recordings: Mapping[str, Simulation], text: str) -> None:
        self._recordings = dict(sorted(recordings.items()))
        #: campaign.toml for them, as `calibrate` reads it beside the files
        self.text = text

    def __getitem__(self, name: str) -> Simulation:
        return self._recordings[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._recordings)

    def __len__(self) -> int:
        return len(self._recordings)

    def __repr__(self) -> str:
        return f"<SimulatedCampaign: {len(self)} recordings: {', '.join(self)}>"


def _checked(workers: int) -> int:
    if not 0 <= workers <= 1024:
        raise _native.Error(f"workers: Value {workers} not in range 0 to 1024")
    return workers


def _refuse_to_replace(folder: str, listing: str, names: List[str]) -> None:
    """An earlier campaign of the rig is replaced, other files are not."""
    if _native.is_virtual_campaign(listing):
        return
    for name in ["campaign.toml", *names, *(os.path.join("truth", each) for each in names)]:
        path = os.path.join(folder, name)
        if os.path.exists(path):
            raise _native.Error(f"cannot write {path}: it is there already and comes from no earlier campaign of the virtual rig; "
                                "move it, or name another folder")


def campaign(valve: PathLike, folder: PathLike, *, calibration_only: bool = False, truth: bool = False, workers: int = 0,
             progress: Optional[Progress] = None) -> str:
    """Makes a whole measuring campaign of a valve on the virtual rig: the folder of `spoolflow campaign`.

    valve: a valve file (TOML, docs/rig.md), or "size_6", "size_10", "fast_dither", "whole_size_6", "whole_differential".
    folder: for the recordings; is made where it is not there. An earlier campaign of the rig in it is replaced; other files of
        these names are refused.
    calibration_only: leave out the operating runs that judge a model. truth: write flow, pressure and each force of every
        run to folder/truth, too. workers: threads, 0 for all cores; the recordings are the same.
    progress: called with the share done, 0 to 1.

    Returns the name of campaign.toml, which `calibrate` reads. The size_6 valve's takes some 20 s and 100 MB.
    """
    target = os.fsdecode(folder)
    listing = os.path.join(target, "campaign.toml")
    _checked(workers)
    text, names = _native.campaign_outline(os.fsdecode(valve), calibration_only)
    _refuse_to_replace(target, listing, names)
    os.makedirs(os.path.join(target, "truth") if truth else target, exist_ok=True)
    write_whole(listing, text)  # first: it says that the recordings beside it may be made again

    def store(name: str, recording: str, really: Optional[str]) -> None:
        if really is not None:
            write_whole(os.path.join(target, "truth", name), really)
        write_whole(os.path.join(target, name), recording)

    _native.campaign(os.fsdecode(valve), calibration_only, truth, True, workers, store, progress)
    return listing


def simulate_campaign(valve: PathLike, *, calibration_only: bool = False, truth: bool = False, workers: int = 0,
                      progress: Optional[Progress] = None) -> SimulatedCampaign:
    """The same as recordings in memory, before they are rounded for their files. Arguments as of `campaign`."""
    out: Dict[str, Simulation] = {}

    def store(name: str, recording: "_native.Recording", really: Optional[Dict[str, Any]]) -> None:
        out[name] = Simulation(recording, name)
        out[name].truth = really

    text = _native.campaign(os.fsdecode(valve), calibration_only, truth, False, _checked(workers), store, progress)
    return SimulatedCampaign(out, text)
