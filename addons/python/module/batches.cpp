#include <algorithm>
#include <pybind11/stl.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/columns.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;

/// One dictionary of arrays a valve, each as from a sensor alone. `estimators` are those of the models, checked by the
/// package.
py::list estimate_many(const std::vector<SharedModel>& models, const std::vector<std::string>& estimators,
                       const std::vector<py::dict>& runs, unsigned workers) {
  std::vector<ColumnArrays> given;
  std::vector<EstimateArrays> answers;
  given.reserve(runs.size());
  answers.reserve(runs.size());
  for (const py::dict& run : runs) {
    given.emplace_back(run);
    answers.emplace_back(given.back().columns().size());
  }
  at_work([&](SignalCheck& check) {
    parallel::for_each(runs.size(), workers == 0 ? parallel::cores() : workers, [&](std::size_t k) {
      estimation::RunningSensor sensor =
          estimation::running_sensor(models.at(k)->model, estimator_named(estimators.at(k)));
      answer_run(sensor, given[k].columns(), answers[k], check);
    });
  });
  py::list out;
  for (const EstimateArrays& each : answers) out.append(each.by_name());
  return out;
}

}  // namespace

void add_batches(py::module_& module) {
  module.def("estimate_many", &estimate_many);
}

}  // namespace spoolflow::python
