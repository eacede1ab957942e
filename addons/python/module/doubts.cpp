#include <algorithm>
#include <array>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/columns.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/monitor/contradiction.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/recording/plausibility.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using recording::Channel;

/// As a reader hands it out: of a whole valve's run the coils have names of their own.
recording::SampleBlock block_of(const estimation::Columns& columns, std::size_t from, std::size_t count) {
  const bool both = !columns.current_a_A.empty();
  const std::pair<Channel, std::span<const double>> known[]{
      {Channel::time, columns.time_s},
      {both ? Channel::current_b : Channel::current, columns.current_A},
      {both ? Channel::voltage_b : Channel::voltage, columns.voltage_V},
      {Channel::position, columns.position_m},
      {Channel::oil_temperature, columns.oil_temperature_K},
      {Channel::current_a, columns.current_a_A},
      {Channel::voltage_a, columns.voltage_a_V}};
  recording::SampleBlock out;
  out.rows = count;
  for (const auto& [channel, column] : known) {
    if (column.empty()) continue;
    const auto part = column.subspan(from, count);
    out.columns[static_cast<std::size_t>(channel)].assign(part.begin(), part.end());
  }
  return out;
}

/// What `estimate` says against a run, a sentence each; `file` names it.
std::vector<std::string> doubts_about(const SharedModel& model, const py::dict& arrays,
                                      const std::filesystem::path& file) {
  const ColumnArrays given(arrays);
  return at_work([&](SignalCheck& check) {
    constexpr std::size_t at_once = 4096;
    plausibility::RunMeans means;
    estimation::RunningSensor sensor =
        estimation::running_sensor(model->model, estimation::best_estimator(model->model));
    std::optional<monitor::Monitor> watch;
    if (model->model.has_observer()) watch.emplace(model->model);
    const std::size_t size = given.columns().size();
    for (std::size_t from = 0; from < size; from += at_once) {
      check();
      const std::size_t count = std::min(at_once, size - from);
      means.take(block_of(given.columns(), from, count));
      for (std::size_t k = from; watch && k < from + count; ++k) {
        const estimation::TimedSample sample = given.columns()[k];
        watch->take(sample, sensor.step(sample));
      }
    }
    std::vector<std::string> out;
    for (plausibility::Finding& finding :
         plausibility::run_findings(plausibility::known_valve(model->model), means, file))
      out.push_back(std::move(finding.text));
    if (watch) monitor::add_contradiction(*watch, file.string(), out);
    return out;
  });
}

/// The channel and the SI unit that an argument's name says.
struct NamedColumn {
  std::span<const double> estimation::Columns::*column;
  Channel channel;
  const char* unit;
};
constexpr std::array<NamedColumn, column_names.size()> names_say{{
    {&estimation::Columns::time_s, Channel::time, "s"},
    {&estimation::Columns::current_A, Channel::current, "A"},
    {&estimation::Columns::voltage_V, Channel::voltage, "V"},
    {&estimation::Columns::position_m, Channel::position, "m"},
    {&estimation::Columns::oil_temperature_K, Channel::oil_temperature, "K"},
    {&estimation::Columns::current_a_A, Channel::current_a, "A"},
    {&estimation::Columns::voltage_a_V, Channel::voltage_a, "V"},
    {&estimation::Columns::pressure_p_Pa, Channel::pressure_p, "Pa"},
    {&estimation::Columns::pressure_a_Pa, Channel::pressure_a, "Pa"},
    {&estimation::Columns::pressure_b_Pa, Channel::pressure_b, "Pa"},
    {&estimation::Columns::pressure_t_Pa, Channel::pressure_t, "Pa"},
}};

/// Refuses arrays in another unit than their names say, with the words for recordings: mm for m, mA for A, degC for K,
/// ms for s, bar for Pa; and a time that runs backwards throughout. Looks at a few thousand samples, as a wrong unit
/// shows in all of them.
void check_units(const py::dict& arrays) {
  constexpr std::size_t most = 4096;
  const ColumnArrays given(arrays);
  const std::size_t step = 1 + given.columns().size() / most;
  std::vector<recording::BoundColumn> bound;
  std::vector<std::span<const double>> columns;
  for (const ColumnName& each : column_names) {
    const std::span<const double> column = given.columns().*(each.column);
    if (column.empty()) continue;
    const auto* const named = std::ranges::find(names_say, each.column, &NamedColumn::column);
    bound.push_back({0, named->channel, 1, 0, each.name, *units::unit_named(named->unit)});
    columns.push_back(column);
  }
  recording::Plausibility plausibility("the run", bound, std::nullopt);
  std::vector<double> seen;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    seen.clear();
    const std::size_t each = bound[k].channel == Channel::time ? 1 : step;  // by its steps
    for (std::size_t at = 0; at < columns[k].size() && seen.size() < most; at += each) seen.push_back(columns[k][at]);
    plausibility.take(k, seen, [each](std::size_t row) { return fmt::format("the run, sample {}", row * each + 1); });
  }
  plausibility.finish();
}

}  // namespace

void add_doubts(py::module_& module) {
  module.def("check_units", &check_units);
  module.def("doubts_about", &doubts_about);
}

}  // namespace spoolflow::python
