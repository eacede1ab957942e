#pragma once
/// What the parts of the module add to it.
#include <pybind11/pybind11.h>

namespace spoolflow::python {

/// spoolflow.Error, and which failure becomes which exception, with the words of the command line.
void add_errors(pybind11::module_& module);
/// Recordings from files and of the virtual rig.
void add_recordings(pybind11::module_& module);
/// Columns in memory as recordings, and recordings as files.
void add_memory(pybind11::module_& module);
/// What a file holds, before anything is made of it.
void add_inspections(pybind11::module_& module);
/// Estimates as files.
void add_tables(pybind11::module_& module);
/// Models and their sensors, step by step and over arrays.
void add_sensors(pybind11::module_& module);
/// Many valves at once.
void add_batches(pybind11::module_& module);
/// From campaigns to models: of valves, of types and of their units; models in their machines.
void add_calibrations(pybind11::module_& module);
/// What commands do with a model: validate, monitor, analyse.
void add_work(pybind11::module_& module);
/// Whole measuring campaigns of the virtual rig.
void add_campaigns(pybind11::module_& module);
/// Models as C++, FMUs and flash pages.
void add_exports(pybind11::module_& module);
/// What physics says against a run of a calibrated valve.
void add_doubts(pybind11::module_& module);

}  // namespace spoolflow::python
