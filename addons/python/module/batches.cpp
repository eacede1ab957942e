#include <algorithm>
#include <map>
#include <memory>
#include <pybind11/stl.h>
#include <tuple>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/columns.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/estimation/batch/running_batch.hpp"
#include "spoolflow/numerics/single_precision.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using numerics::single_precision;

/// A model in single precision, as batches take it: of each estimator the part that is asked for.
struct SingleModel {
  std::unique_ptr<sensor::CondensedTables<float>> condensed, condensed_a;
  std::unique_ptr<sensor::ObserverParameters<float>> observer, observer_a;
  sensor::WholeCondensedTables<float> whole_condensed{};
  sensor::WholeValveParameters<float> whole_observer{};

  explicit SingleModel(const model::Model& model)
      : condensed(std::make_unique<sensor::CondensedTables<float>>(
            single_precision(sensor::laid_out(model.condensed.parameters)))) {
    if (model.whole()) {
      condensed_a = std::make_unique<sensor::CondensedTables<float>>(
          single_precision(sensor::laid_out(model.p_to_a->condensed.parameters)));
      whole_condensed = {condensed.get(), condensed_a.get()};
    }
    if (!model.has_observer()) return;
    observer = std::make_unique<sensor::ObserverParameters<float>>(single_precision(model.observer->parameters));
    if (!model.whole()) return;
    observer_a =
        std::make_unique<sensor::ObserverParameters<float>>(single_precision(model.p_to_a->observer->parameters));
    whole_observer = {observer.get(), observer_a.get()};
  }
};

/// One valve of many.
struct Valve {
  const SingleModel* model;
  double rated_flow_m3_per_s;
  bool whole, condensed;
  const estimation::Columns* run;
  EstimateArrays<float>* answers;
};

/// Some valves of one kind, side by side in one batch.
template <class Parameters>
void estimate_together(std::span<const Valve> valves, const Parameters& (*parameters)(const SingleModel&),
                       SignalCheck& check) {
  std::vector<estimation::batch::BatchedValve<Parameters>> in_batch;
  std::size_t longest = 0;
  for (const Valve& valve : valves) {
    in_batch.push_back({&parameters(*valve.model), valve.rated_flow_m3_per_s});
    longest = std::max(longest, valve.run->size());
  }
  estimation::batch::RunningBatch<Parameters> batch(in_batch);
  constexpr std::size_t at_once = 1024;
  std::vector<std::vector<sensor::Estimate<float>>> estimates(
      valves.size(), std::vector<sensor::Estimate<float>>(std::min(at_once, longest)));
  std::vector<estimation::Columns> runs(valves.size());
  std::vector<std::span<sensor::Estimate<float>>> answers(valves.size());
  for (std::size_t from = 0; from < longest; from += at_once) {
    check();
    for (std::size_t k = 0; k < valves.size(); ++k) {
      const std::size_t begin = std::min(from, valves[k].run->size());
      const std::size_t count = std::min(at_once, valves[k].run->size() - begin);
      runs[k] = part(*valves[k].run, begin, count);
      answers[k] = std::span(estimates[k]).first(count);
    }
    batch.run(runs, answers);
    for (std::size_t k = 0; k < valves.size(); ++k) valves[k].answers->put(from, answers[k]);
  }
}

void estimate_alike(std::span<const Valve> valves, SignalCheck& check) {
  const Valve& first = valves.front();
  if (first.whole && first.condensed) {
    estimate_together<sensor::WholeCondensedTables<float>>(
        valves, [](const SingleModel& of) -> const auto& { return of.whole_condensed; }, check);
  } else if (first.whole) {
    estimate_together<sensor::WholeValveParameters<float>>(
        valves, [](const SingleModel& of) -> const auto& { return of.whole_observer; }, check);
  } else if (first.condensed) {
    estimate_together<sensor::CondensedTables<float>>(
        valves, [](const SingleModel& of) -> const auto& { return *of.condensed; }, check);
  } else {
    estimate_together<sensor::ObserverParameters<float>>(
        valves, [](const SingleModel& of) -> const auto& { return *of.observer; }, check);
  }
}

/// As many valves as are stepped together are a piece of the work; all of a piece are of one kind.
std::vector<std::span<const Valve>> pieces_of(const std::vector<Valve>& ordered) {
  std::vector<std::span<const Valve>> out;
  for (std::size_t from = 0; from < ordered.size();) {
    const auto alike = [&](const Valve& valve) {
      return valve.whole == ordered[from].whole && valve.condensed == ordered[from].condensed;
    };
    std::size_t until = from + 1;
    while (until < ordered.size() && until - from < estimation::batch::valves_together && alike(ordered[until]))
      ++until;
    out.push_back(std::span(ordered).subspan(from, until - from));
    from = until;
  }
  return out;
}

/// One dictionary of arrays a valve. `estimators` are those of the models, checked by the package.
py::list estimate_many(const std::vector<SharedModel>& models, const std::vector<std::string>& estimators,
                       const std::vector<py::dict>& runs, unsigned workers) {
  std::map<const KeptModel*, SingleModel> single;
  std::vector<ColumnArrays> given;
  std::vector<EstimateArrays<float>> answers;
  given.reserve(runs.size());
  answers.reserve(runs.size());
  std::vector<Valve> valves;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const model::Model& model = models.at(k)->model;
    given.emplace_back(runs[k]);
    answers.emplace_back(given.back().columns().size());
    const auto known = single.try_emplace(models[k].get(), model).first;
    valves.push_back({&known->second, model.valve.rated_flow_m3_per_s, model.whole(), estimators.at(k) == "condensed",
                      &given.back().columns(), &answers.back()});
  }
  std::stable_sort(valves.begin(), valves.end(), [](const Valve& a, const Valve& b) {
    return std::tuple(a.whole, a.condensed, a.run->size()) < std::tuple(b.whole, b.condensed, b.run->size());
  });
  const std::vector<std::span<const Valve>> pieces = pieces_of(valves);
  at_work([&](SignalCheck& check) {
    parallel::for_each(pieces.size(), workers == 0 ? parallel::cores() : workers,
                       [&](std::size_t k) { estimate_alike(pieces[k], check); });
  });
  py::list out;
  for (const EstimateArrays<float>& each : answers) out.append(each.by_name());
  return out;
}

}  // namespace

void add_batches(py::module_& module) {
  module.def("estimate_many", &estimate_many);
}

}  // namespace spoolflow::python
