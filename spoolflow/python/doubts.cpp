#include <algorithm>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "spoolflow/consistency/run_doubts.hpp"
#include "spoolflow/python/bindings.hpp"
#include "spoolflow/python/columns.hpp"
#include "spoolflow/python/models.hpp"
#include "spoolflow/python/signal_check.hpp"

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
    consistency::RunMeans means;
    const std::size_t size = given.columns().size();
    for (std::size_t from = 0; from < size; from += at_once) {
      check();
      means.take(block_of(given.columns(), from, std::min(at_once, size - from)));
    }
    std::vector<std::string> out;
    for (consistency::Doubt& doubt : consistency::doubts_about(consistency::known_valve(model->model), means, file))
      out.push_back(std::move(doubt.text));
    return out;
  });
}

}  // namespace

void add_doubts(py::module_& module) {
  module.def("doubts_about", &doubts_about);
}

}  // namespace spoolflow::python
