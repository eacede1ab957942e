/// The compiled part of the Python package `spoolflow`: binds the library's functions, with no physics and no parsing
/// of its own. The package (python/spoolflow) makes arguments of what users give, and plain objects of what comes back.
#include "addons/python/module/bindings.hpp"

PYBIND11_MODULE(_native, module) {
  module.attr("__version__") = SPOOLFLOW_VERSION;
  spoolflow::python::add_errors(module);
  spoolflow::python::add_recordings(module);
  spoolflow::python::add_memory(module);
  spoolflow::python::add_inspections(module);
  spoolflow::python::add_tables(module);
  spoolflow::python::add_sensors(module);
  spoolflow::python::add_batches(module);
  spoolflow::python::add_calibrations(module);
  spoolflow::python::add_work(module);
  spoolflow::python::add_campaigns(module);
  spoolflow::python::add_exports(module);
  spoolflow::python::add_doubts(module);
}
