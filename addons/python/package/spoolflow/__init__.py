"""Soft flow-rate sensor for solenoid-operated spool valves.

The flow rate through a valve's metering edge, with a 95 % band, from coil current, coil voltage, spool position and oil
temperature: no added hardware. The valve is calibrated once from bench recordings.

    import spoolflow

    model = spoolflow.calibrate("campaign.toml")         # or spoolflow.load_model("model.json")
    run = spoolflow.read_recording("duty_cycle.csv")
    estimate = model.estimate(run)                       # or model.estimate(time_s=t, current_A=i, position_m=x, ...)
    estimate.flow_L_min                                  # array of NumPy, one number a sample

Units stand in names: `current_A` in ampere, `position_m` in metre, `oil_temperature_K` in kelvin, `flow_m3_per_s`. NaN is
a value that was not measured. Input that cannot be used raises `spoolflow.Error`, in the words of the command line. While
it works, other threads run, and Ctrl-C stops it.
"""
from ._native import Error, __version__
from .calibrations import calibrate
from .campaigns import SimulatedCampaign, campaign, simulate_campaign
from .errors import FileMissing
from .estimates import Answer, Estimate, Status
from .exports import export_cpp, export_fmu, export_parameters
from .figures import Figures
from .models import Model, Sensor, load_model
from .recalibrations import recalibrate
from .recordings import Recording, inspect, read_recording
from .work import (Analysis, Condition, DitherAdvice, Simulation, Validation, analyse, estimate_many, monitor, simulate,
                   validate)

__all__ = [
    "Analysis", "Answer", "Condition", "DitherAdvice", "Error", "Estimate", "Figures", "FileMissing", "Model", "Recording", "Sensor",
    "SimulatedCampaign", "Simulation", "Status", "Validation", "__version__", "analyse", "calibrate", "campaign",
    "estimate_many", "export_cpp", "export_fmu", "export_parameters", "inspect", "load_model", "monitor", "read_recording", "recalibrate",
    "simulate", "simulate_campaign", "validate",
]
