"""Calibrated valves and their sensors."""
from __future__ import annotations

import json
import math
import os
from typing import Any, Dict, List, Mapping, Optional

from numpy.typing import NDArray

from . import _native
from .columns import STEP_NAMES, Clock, of_one_coil_or_both
from .environments import Environment, as_environment
from .errors import naming_missing
from .estimates import Answer, Estimate
from .files import PathLike, write_whole
from .runs import index_of
from .samples import sample_columns


class Sensor:
    """A sensor in operation: goes on from sample to sample and remembers what it saw. For one thread at a time.

        sensor = model.sensor()
        answer = sensor.step(time_s=0.001, current_A=1.2, position_m=0.8e-3, voltage_V=5.1, oil_temperature_K=313)
        answer.flow_L_min, answer.status_text
    """

    def __init__(self, model: "Model", estimator: Optional[str] = None) -> None:
        #: "condensed" or "observer"
        self.estimator: str = model.estimators[-1] if estimator is None else estimator
        self.model = model
        self._sensor = _native.Sensor(model._kept, self.estimator)
        self._clock = Clock()

    def step(self, *, time_s: float, position_m: float, current_A: Optional[float] = None,
             voltage_V: Optional[float] = None, oil_temperature_K: Optional[float] = None,
             current_a_A: Optional[float] = None, current_b_A: Optional[float] = None,
             voltage_a_V: Optional[float] = None, voltage_b_V: Optional[float] = None,
             pressure_p_Pa: Optional[float] = None, pressure_a_Pa: Optional[float] = None,
             pressure_b_Pa: Optional[float] = None, pressure_t_Pa: Optional[float] = None) -> Answer:
        """One sample; arguments as of `Model.estimate`, a number each. None or NaN: not measured.

        A time that repeats or runs back is answered with status `time_fault`.
        """
        given = locals()
        del given["self"]
        sample = of_one_coil_or_both(given, self.model.direction)
        numbers = [sample.get(name, math.nan) for name in STEP_NAMES]
        try:
            answer = self._sensor.step(numbers)
        except TypeError:
            raise _native.Error(_no_number(sample)) from None
        return Answer(float(time_s), answer)

    def estimate(self, run: Optional[Mapping[str, Any]] = None, **samples: Any) -> Estimate:
        """The next samples, as `Model.estimate` takes them; goes on where the sensor is. Instants count from the first that the
        sensor was given."""
        return self._estimate(sample_columns(run, samples, self.model.direction, self._clock), index_of(run))

    def _estimate(self, columns: Dict[str, NDArray[Any]], index: Any) -> Estimate:
        return Estimate(columns["time_s"], self._sensor.run(columns), index)

    @property
    def time_s(self) -> float:
        """Time of the last sample that had one [s]; NaN before."""
        return self._sensor.time_s

    def reset(self) -> None:
        """As new."""
        self._sensor.reset()
        self._clock = Clock()

    def __copy__(self) -> "Sensor":
        raise TypeError("a sensor's memory is not copied, and two would share it; make another with model.sensor()")

    def __repr__(self) -> str:
        return f"<Sensor of {self.model.name}: {self.estimator}>"


class Model:
    """Everything known about one valve: what `calibrate` makes and `load_model` reads. Does not change."""

    def __init__(self, kept: "_native.Model") -> None:
        self._kept = kept

    @property
    def name(self) -> str:
        """Of the valve."""
        return self._kept.name

    @property
    def rated_flow_m3_per_s(self) -> float:
        """Full scale of every % FS figure [m3/s]."""
        return self._kept.rated_flow_m3_per_s

    @property
    def rated_flow_L_min(self) -> float:
        """The same [L/min]."""
        return self._kept.rated_flow_m3_per_s * _native.L_min_per_m3_per_s

    @property
    def stroke_m(self) -> float:
        """Of the spool, to one side [m]."""
        return self._kept.stroke_m

    @property
    def direction(self) -> str:
        """"b": flow P to B; "a": flow P to A; "both": the whole valve, whose flow is > 0 for P to B."""
        return self._kept.direction

    @property
    def estimators(self) -> List[str]:
        """Those it is calibrated for: "condensed", "observer"; the best is the last."""
        return self._kept.estimators

    @property
    def doubts(self) -> List[str]:
        """What physics says against the recordings that it was made from, a sentence each."""
        return self._kept.doubts

    @property
    def provenance(self) -> Dict[str, Any]:
        """Tool version, time, inputs with their checksums, as in the model file."""
        provenance: Dict[str, Any] = json.loads(self._kept.text)["provenance"]
        return provenance

    @property
    def type(self) -> Optional[Dict[str, Any]]:
        """Of the model of a type or of a unit: by what units differ and where this one lies, as in the model file; else None."""
        section: Optional[Dict[str, Any]] = json.loads(self._kept.text).get("type")
        return section

    @property
    def wear_states(self) -> List[Dict[str, float]]:
        """Where references have moved the model to (docs/references.md), oldest first; the first is as calibrated: `edge_width` as a
        share more, `friction_ratio`, `position_zero_m`, and the standard uncertainties `flow_share` and `friction_share`. Of a whole valve
        those of both directions in the order of `provenance["adaptations"]`, which says whose each is."""
        as_calibrated = {"edge_width": 0.0, "friction_ratio": 1.0, "position_zero_m": 0.0, "flow_share": 0.0, "friction_share": 0.0}
        return [as_calibrated, *(each["wear"] for each in self.provenance.get("adaptations", []) if "wear" in each)]

    @property
    def drift(self) -> Optional[str]:
        """How fast references move it, in 30 days with its 95 % band; None where none looked, or all within a day of calibration."""
        return _native.drift(self._kept)

    def gone_back(self, state: int) -> "Model":
        """The model as it was in an earlier one of `wear_states`, 0 for as calibrated; the log goes on."""
        if state < 0:
            raise _native.Error(f"state: Value {state} is below 0, as calibrated")
        return Model(_native.gone_back(self._kept, state))

    def in_environment(self, environment: Environment = "machine", **keys: float) -> "Model":
        """The model whose band holds what that machine leaves open (docs/environment.md): "machine", "bench", or a TOML file; or
        single half-widths: `model.in_environment(vibration_g=1.0, viscosity_percent=50)`."""
        with as_environment(environment, keys) as known:
            return Model(_native.in_environment(self._kept, known))

    def save(self, path: PathLike) -> None:
        """Writes the model file (JSON, docs/formats/model.md); all commands read it."""
        write_whole(path, self._kept.text)

    def sensor(self, estimator: Optional[str] = None) -> Sensor:
        """A sensor as new, for samples as they come. `estimator`: "observer" (where there is one) or "condensed"."""
        return Sensor(self, estimator)

    def estimate(self, run: Optional[Mapping[str, Any]] = None, *, estimator: Optional[str] = None,
                 time_s: Any = None, current_A: Any = None, position_m: Any = None, voltage_V: Any = None,
                 oil_temperature_K: Any = None, current_a_A: Any = None, current_b_A: Any = None,
                 voltage_a_V: Any = None, voltage_b_V: Any = None, pressure_p_Pa: Any = None,
                 pressure_a_Pa: Any = None, pressure_b_Pa: Any = None, pressure_t_Pa: Any = None,
                 environment: Optional[Environment] = None, **columns: Any) -> Estimate:
        """The flow rate of a run with its 95 % band, sample by sample: the numbers of `spoolflow estimate`.

        Give a recording, a table of pandas or any mapping with these names, or arrays of one length, a number a sample:

        time_s: time [s], rising; a sample whose time repeats or runs back has status `time_fault`.
        current_A: coil current [A], mean over the sample's step; of a whole valve that of the active coil.
        position_m: spool position [m], 0 closed, > 0 opens P to B; of a whole valve < 0 opens P to A.
        voltage_V: coil voltage [V], mean over the step. Without it the observer's band is wider.
        oil_temperature_K: oil temperature [K], 233 to 423. Without it that of the calibration is assumed.
        current_a_A, current_b_A, voltage_a_V, voltage_b_V: of a whole valve's coils a and b [A, V].
        pressure_p_Pa, pressure_a_Pa, pressure_b_Pa, pressure_t_Pa: at a whole valve's ports [Pa], where measured.
        estimator: "observer" (where the model has one) or "condensed".
        environment: what the machine leaves open, as of `in_environment`.
        columns: the same in other units, under any name that files may have: position_mm, current_mA, oil_temperature_C, ...
            Such columns are read, and refused, as a file's. An index of instants or times is the time, and so is a column
            `time` of them.

        NaN is a value that was not measured. Contiguous arrays of float64 are read where they are, without a copy; others
        (float32, slices with steps, lists, columns of pandas) are converted once. Raises Error where a column is missing,
        is no row of numbers, has another length, or is in another unit by all its numbers (mm, mA, degC, ms, bar), or the time runs
        backwards throughout, as recordings are refused; single wild samples have a status.
        """
        samples = {**locals(), **columns}
        for name in ("self", "run", "estimator", "environment", "columns"):
            del samples[name]
        sensor = Sensor(self if environment is None else self.in_environment(environment), estimator)
        arrays = sample_columns(run, samples, self.direction)
        _native.check_units(arrays)
        return sensor._estimate(arrays, index_of(run))

    def doubts_about(self, run: Optional[Mapping[str, Any]] = None, **samples: Any) -> List[str]:
        """What speaks against a run being of this valve, a sentence each, with the usual recording error that explains it (other units, a
        sign turned round, a gap in time): what `spoolflow estimate` reports about its recording. Empty where nothing does.

        run: a recording, or any mapping with the names of `estimate`; or arrays by these names.
        """
        columns = sample_columns(run, samples, self.direction)
        return _native.doubts_about(self._kept, columns, getattr(run, "file", "the run"))

    def __repr__(self) -> str:
        return (f"<Model {self.name}: direction {self.direction}, rated flow {self.rated_flow_L_min:g} L/min, "
                f"stroke {1e3 * self.stroke_m:g} mm, {' and '.join(self.estimators)}>")

    def _content(self) -> str:
        """All that it says but for the moment at which it was made."""
        content = json.loads(self._kept.text)
        content["provenance"].pop("created", None)
        return json.dumps(content, sort_keys=True)

    def __eq__(self, other: object) -> bool:
        """Whether both say the same of the valve, from the same inputs; when they were made does not count."""
        if not isinstance(other, Model):
            return NotImplemented
        return self._kept.text == other._kept.text or self._content() == other._content()

    def __hash__(self) -> int:
        return hash((self.name, self.rated_flow_m3_per_s, self.stroke_m, self.direction))

    def __reduce__(self) -> Any:
        return (_from_text, (self._kept.text,))


def _no_number(sample: Mapping[str, Any]) -> str:
    """What is wrong with a sample that the compiled part does not take."""
    for name, value in sample.items():
        if getattr(value, "ndim", 0) > 0:
            return f"{name}: holds {getattr(value, 'size', 'several')} numbers, where a step takes one; give arrays to estimate()"
        try:
            float(value)
        except (TypeError, ValueError):
            return f"{name}: is no number but a {type(value).__name__}; give a number, NaN where it is missing"
    return "a sample holds what is no number; give a number each, NaN where it is missing"


def _from_text(text: str) -> Model:
    return Model(_native.Model(text, "a pickled model"))


def load_model(path: PathLike) -> Model:
    """Reads a model file that `calibrate` wrote. Raises FileNotFoundError where there is none, else Error with the file and the
    place in it."""
    with naming_missing(path):
        return Model(_native.read_model(os.fsdecode(path)))
