"""What the commands do with a model, for Python: validate, monitor, analyse; and simulate."""
from __future__ import annotations

import contextlib
import os
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Literal, Mapping, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _native, apart
from .channels import Channels
from .environments import Environment
from .errors import naming_missing
from .estimates import Estimate
from .extras import matplotlib_axes, pandas
from .figures import JudgedFigures, flat
from .files import PathLike, keep_apart, write_whole
from .models import Model, load_model
from .recordings import Recording
from .runs import Files, Run, as_files, index_of, several_of
from .samples import sample_columns

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

AnyModel = Union[Model, PathLike]
#: Called with the share of the work that is done, 0 to 1.
Progress = Callable[[float], None]
#: Called with what begins, and the share.
StepProgress = Callable[[str, float], None]
#: One recording or several, as files or in memory.
Runs = Union[Run, Iterable[Run]]


def as_model(model: AnyModel) -> Model:
    """A model, read where its file is given."""
    return model if isinstance(model, Model) else load_model(model)


def _path(file: Optional[PathLike]) -> Optional[str]:
    return None if file is None else os.fsdecode(file)


def _units(report: Optional[PathLike], units: Sequence[str]) -> Optional[List[str]]:
    return None if report is None else [units] if isinstance(units, str) else list(units)


def _warn(notes: Iterable[str], files: Files) -> None:
    """Of recordings as they were read, by the names that they were given with."""
    for note in notes:
        warnings.warn(files.noted(note), stacklevel=3)


class Validation(JudgedFigures):
    """How good a model is on recordings with a reference flow: the figures of `validate --json`
    (docs/formats/metrics.md) by attributes.

        validation.verdict                  # the figures in one sentence
        validation.limits                   # what limits them, the most important first
        validation.runs[0].estimators[-1].error.all.p95.percent_FS
    """

    def table(self) -> List[Dict[str, Any]]:
        """A row for each run with reference flow and estimator: errors [% of full scale], share in the band [%]."""
        rows = []
        for run in self.runs:
            for result in run.estimators if run.has_reference else []:
                every = result.error.all
                rows.append({
                    "run": os.path.splitext(run.file)[0], "estimator": result.estimator,
                    "p95_percent_FS": every.p95.percent_FS, "rms_percent_FS": every.rms.percent_FS,
                    "largest_percent_FS": every.largest.percent_FS, "in_band_percent": 100 * every.band_coverage,
                })
        return rows

    def to_pandas(self) -> "pd.DataFrame":
        """`table()` as a table of pandas, with every other figure of the run and estimator behind it, under the names that lead to
        it: `error.moving.p95.percent_FS` is `error_moving_p95_percent_FS`."""
        every = [flat(result) for run in self.runs for result in (run.estimators if run.has_reference else [])]
        return pandas().DataFrame([{**more, **row} for more, row in zip(every, self.table())])

    def plot(self, axes: "Optional[Axes]" = None) -> "Axes":
        """95th percentile of the errors by run and estimator [% of full scale]. Needs Matplotlib."""
        axes = matplotlib_axes(axes)
        rows = self.table()
        axes.barh([f"{row['run']}, {row['estimator']}" for row in rows], [row["p95_percent_FS"] for row in rows])
        axes.set_xlabel("95 % of the errors within [% of full scale]")
        return axes

    def __repr__(self) -> str:
        return f"<Validation: {self.verdict}>"


def validate(model: AnyModel, recordings: Runs, *, channels: Optional[Channels] = None,
             environment: Optional[Environment] = None, estimator: str = "both",
             requirements: Optional[PathLike] = None, reference_lag_s: Optional[float] = None,
             apply_reference_lag: bool = True, compare: Union[PathLike, Iterable[PathLike]] = (),
             report: Optional[PathLike] = None, units: Sequence[str] = (), progress: Optional[Progress] = None) -> Validation:
    """Compares the estimate with a reference flow meter: the figures of `spoolflow validate`.

    model: a model or its file. recordings: one or several that also hold `flow_reference`: files, recordings, tables of
        pandas, dicts of arrays, with columns called as those of files (`<channel>_<unit>` in any unit). That a run was an
        input of the calibration shows by its file alone: of tables and arrays it is not known.
    channels: a channel map where columns have other names or units, as of `read_recording`.
    environment: what the machine leaves open, as of `Model.in_environment`.
    estimator: "both", "condensed" or "observer".
    requirements: limits (TOML, docs/formats/requirements.md) against which the figures are judged.
    reference_lag_s: lag of the reference meter [s], 0 to 10; None: lag and dead time are found in each run.
    apply_reference_lag: delay and lag the estimate as the meter does before comparing.
    compare: figures of other valves or models to show beside these in the report, which it needs: what `Validation.save` or
        `validate --json` wrote.
    report: an HTML page to write; `units` are its reader's. progress: called with the share done, 0 to 1.
    """
    if reference_lag_s is not None and not 0 <= reference_lag_s <= 10:
        raise _native.Error(f"reference_lag_s: Value {reference_lag_s} not in range 0 to 10")
    others = [os.fsdecode(compare)] if isinstance(compare, (str, bytes, os.PathLike)) else [os.fsdecode(each) for each in compare]
    if others and report is None:
        raise _native.Error("compare: others are shown in the report, and none is asked for; give report=..., too")
    known = as_model(model)
    if environment is not None:
        known = known.in_environment(environment)
    runs = several_of(recordings)
    keep_apart({"report": report}, [model, *runs, requirements, *others, channels, environment])
    with naming_missing(*runs, requirements, *others, channels), as_files(runs, channels) as files:
        figures, page, _, notes = apart.call(
            "validate", files.paths, known._kept, files.paths, files.channels, estimator, _path(requirements),
            reference_lag_s, apply_reference_lag, others, _units(report, units), progress=progress)
    _warn(notes, files)
    if report is not None and page is not None:
        write_whole(report, page)
    return Validation(figures)


class Condition(JudgedFigures):
    """The condition of a valve: the figures of `monitor --json` (docs/monitoring.md) by attributes. Saved, it is a baseline
    for later runs: `monitor(..., baseline=path)`.

        condition.ne107              # sign of NAMUR NE 107: "good", "M", "S", "C" or "F"
        condition.indicators, condition.causes
    """

    def to_pandas(self) -> "pd.DataFrame":
        """The indicators as a table of pandas, a trend's figures as `trend_per_hour` and so on."""
        return pandas().DataFrame([flat(indicator) for indicator in self.indicators])

    def plot(self, axes: "Optional[Axes]" = None) -> "Axes":
        """Of each judged indicator how far it is from its baseline, in its 95 % uncertainties. Needs Matplotlib."""
        axes = matplotlib_axes(axes)
        shown = [each for each in self.indicators
                 if each.state in ("good", "raised") and each.value is not None and each.baseline is not None
                 and each.uncertainty_95]
        axes.barh([each.name for each in shown], [(each.value - each.baseline) / each.uncertainty_95 for each in shown],
                  color=["tab:red" if each.state == "raised" else "tab:blue" for each in shown])
        axes.set_xlabel("deviation from the baseline [95 % uncertainties]")
        return axes

    def __repr__(self) -> str:
        raised = [indicator.name for indicator in self.indicators if indicator.state == "raised"]
        return f"<Condition: NE 107 {self.ne107}; raised: {', '.join(raised) or 'none'}>"


def monitor(model: AnyModel, recordings: Runs, *, baseline: Optional[PathLike] = None,
            adapt: Optional[PathLike] = None, channels: Optional[Channels] = None, false_alarms_per_year: float = 1.0,
            report: Optional[PathLike] = None, units: Sequence[str] = (),
            progress: Optional[Progress] = None) -> Condition:
    """Judges the condition of a valve from recordings of its operation: the figures of `spoolflow monitor`.

    model: a model with an observer, or its file. recordings: as of `validate`, in the order in which they were made.
    baseline: what `Condition.save` or `monitor --json` wrote of healthy runs; None: the model is the reference.
    adapt: a model file to write: the model with what is raised put right as it was found (docs/monitoring.md). Raises Error
        where nothing is raised, or what cannot be corrected.
    false_alarms_per_year: wanted at most over all indicators, of a valve at work day and night, 1e-6 to 1e4.
    channels, report, units, progress: as of `validate`.
    """
    if not 1e-6 <= false_alarms_per_year <= 1e4:
        raise _native.Error(f"false_alarms_per_year: Value {false_alarms_per_year} not in range 1e-06 to 10000")
    known = as_model(model)
    runs = several_of(recordings)
    keep_apart({"adapt": adapt, "report": report}, [model, *runs, baseline, channels])
    with naming_missing(*runs, baseline, channels), as_files(runs, channels) as files:
        figures, page, corrected, notes = apart.call(
            "monitor", files.paths, known._kept, files.paths, files.channels, _path(baseline) or "",
            false_alarms_per_year, adapt is not None, _units(report, units), progress=progress)
    _warn(notes, files)
    if adapt is not None:
        write_whole(adapt, corrected)
    if report is not None and page is not None:
        write_whole(report, page)
    return Condition(figures)


class Analysis(JudgedFigures):
    """How uncertain the flow rate is and why: the figures of `analyse --json` (docs/formats/analysis.md) by attributes.

        analysis.verdict             # what to improve next
        analysis.remarks             # what the figures rest on
        analysis.mean_shares.groups  # of the variance
    """

    def to_pandas(self) -> "pd.DataFrame":
        """A row for each working point and estimator, every figure under the names that lead to it."""
        return pandas().DataFrame([flat(point) for point in self.points])

    def __repr__(self) -> str:
        return f"<Analysis: {self.verdict}>"


class DitherAdvice(JudgedFigures):
    """How to dither a valve: the figures of `analyse --dither --json` (docs/formats/analysis.md) by attributes; `verdict` says
    in one sentence what to set."""

    def __init__(self, text: str, verdict: str) -> None:
        super().__init__(text)
        #: what to set, and what it brings
        self.verdict = verdict

    def __repr__(self) -> str:
        return f"<DitherAdvice: {self.verdict}>"


@overload
def analyse(model: AnyModel, scenario: Optional[PathLike] = None, *, recording: Optional[Run] = None,
            channels: Optional[Channels] = None, dither: Literal[False] = False, dither_shape: str = "sine",
            ripple_limit_percent: float = 0.5, samples: Optional[int] = None, seed: Optional[int] = None,
            study: Optional[bool] = None, workers: int = 0, direction: str = "b", report: Optional[PathLike] = None,
            units: Sequence[str] = (), progress: Optional[StepProgress] = None) -> Analysis: ...


@overload
def analyse(model: AnyModel, scenario: Optional[PathLike] = None, *, dither: Literal[True], dither_shape: str = "sine",
            ripple_limit_percent: float = 0.5, workers: int = 0, direction: str = "b", report: Optional[PathLike] = None,
            units: Sequence[str] = ()) -> DitherAdvice: ...


def analyse(model: AnyModel, scenario: Optional[PathLike] = None, *, recording: Optional[Run] = None,
            channels: Optional[Channels] = None, dither: bool = False, dither_shape: str = "sine",
            ripple_limit_percent: float = 0.5, samples: Optional[int] = None, seed: Optional[int] = None,
            study: Optional[bool] = None, workers: int = 0, direction: str = "b", report: Optional[PathLike] = None,
            units: Sequence[str] = (), progress: Optional[StepProgress] = None) -> Union[Analysis, DitherAdvice]:
    """How uncertain the flow rate is, why, and what to improve next: the figures of `spoolflow analyse`.

    scenario: what to analyse (TOML); `spoolflow analyse --print-scenario` prints one with every key at its default.
    recording: a run of one direction along which the budget is made up as well; channels: its channel map.
    samples: base samples of the global study, 2 to 65536; seed: of all random numbers, > 0.
    study: whether there is a global study on the virtual rig, which takes minutes; None: as the scenario says.
    workers: threads, 0 for all cores. direction: "a" or "b", of a model of a whole valve.
    report, units: as of `validate`. progress: called with the task and the share done, 0 to 1.

    dither: how to dither instead: which amplitude [A] and frequency [Hz] of the coil current narrow the band at rest most,
        as a `DitherAdvice`. Needs a model with an observer; `recording`, `samples`, `seed` and `study` have no meaning beside it.
    dither_shape: course of the dither's current, "sine" or "square".
    ripple_limit_percent: of the flow that dither may make, half of peak to peak in % of full scale, 0.001 to 100.
    """
    kept = as_model(model)._kept
    keep_apart({"report": report}, [model, scenario, recording, channels])
    for name, value, least, most in (("samples", samples, 2, 65536), ("seed", seed, 1, 2**64 - 1), ("workers", workers, 0, 1024)):
        if value is not None and not least <= value <= most:
            raise _native.Error(f"{name}: Value {value} not in range {least} to {most}")
    if direction not in ("a", "b"):
        raise _native.Error(f"direction: {direction} not in {{a,b}}")
    if dither:
        advice = _advise_dither(kept, _path(scenario), dither_shape, ripple_limit_percent, workers, direction,
                                _units(report, units), {"recording": recording, "samples": samples, "study": study})
        if report is not None and advice[1] is not None:
            write_whole(report, advice[1])
        return DitherAdvice(advice[0], advice[2] or "")
    if dither_shape != "sine" or ripple_limit_percent != 0.5:
        raise _native.Error("dither_shape, ripple_limit_percent: have a meaning beside dither=True alone; give it, too, or leave them away")
    with contextlib.ExitStack() as kept_files:
        kept_files.enter_context(naming_missing(scenario, recording, channels))
        files = Files([], None, {}) if recording is None else kept_files.enter_context(as_files([recording], channels))
        figures, page, _, notes = apart.call(
            "analyse", files.paths, kept, _path(scenario), samples, seed, study, workers, direction,
            next(iter(files.paths), None), files.channels, _units(report, units), progress=progress)
    _warn(notes, files)
    if report is not None and page is not None:
        write_whole(report, page)
    return Analysis(figures)


def _advise_dither(kept: "_native.Model", scenario: Optional[str], shape: str, ripple_limit_percent: float, workers: int,
                   direction: str, units: Optional[List[str]],
                   others: Mapping[str, Any]) -> "tuple[str, Optional[str], Optional[str], List[str]]":
    for name, value in others.items():
        if value is not None:
            raise _native.Error(f"{name}: has no meaning beside dither; leave one of them away")
    if shape not in ("sine", "square"):
        raise _native.Error(f"dither_shape: {shape} not in {{sine,square}}")
    if not 0.001 <= ripple_limit_percent <= 100:
        raise _native.Error(f"ripple_limit_percent: Value {ripple_limit_percent} not in range 0.001 to 100")
    return _native.dither(kept, scenario, workers, direction, shape, ripple_limit_percent / 100, units)


class Simulation(Recording):
    """A recording of the virtual rig, as its instruments show it."""

    #: What really happened, free of any instrument, by the headers of the truth's file (`flow_L_min`, ...); None where not
    #: asked for.
    truth: Optional[Dict[str, NDArray[Any]]]


def simulate(scenario: PathLike, *, truth: bool = False, progress: Optional[Progress] = None) -> Simulation:
    """Makes one recording on the virtual test rig: that of `spoolflow simulate`, before it is rounded for its file.

    scenario: the protocol, the valve, and what differs from them (TOML, docs/rig.md).
    truth: keep flow, pressure and each force beside it, too (`simulation.truth`). progress: as of `validate`.
    """
    file = os.fsdecode(scenario)
    with naming_missing(scenario):
        recording, really = _native.simulate(file, truth, progress)
    out = Simulation(recording, file)
    out.truth = really
    return out


def estimate_many(models: Union[Model, Sequence[Model]], runs: Sequence[Mapping[str, Any]], *,
                  estimator: Optional[str] = None, workers: int = 0) -> List[Estimate]:
    """Runs of many valves, each through a sensor of its own, on all cores.

    models: a model for each run, or one for all. runs: recordings, tables of pandas, or mappings with the names of
        `Model.estimate`; of any lengths and rates.
    estimator: "observer" or "condensed"; None: of each model the best. workers: threads, 0 for all cores.

    An estimate for each run, the same as from `Model.estimate`.
    """
    models = [models] * len(runs) if isinstance(models, Model) else list(models)
    if len(models) != len(runs):
        raise _native.Error(f"{len(models)} models and {len(runs)} runs; give one model a run, or one for all")
    estimators, columns = [], []
    for k, (model, run) in enumerate(zip(models, runs)):
        name = model.estimators[-1] if estimator is None else estimator
        model.sensor(name)  # refuses what the model is not calibrated for
        estimators.append(name)
        try:
            columns.append(sample_columns(run, {}, model.direction))
            _native.check_units(columns[-1])
        except _native.Error as error:
            raise _native.Error(f"runs[{k}]: {error}") from None
    answers = _native.estimate_many([model._kept for model in models], estimators, columns, workers)
    return [Estimate(column["time_s"], answer, index_of(run)) for column, answer, run in zip(columns, answers, runs)]
