#include "addons/python/module/columns.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::python {

ColumnArrays::ColumnArrays(const pybind11::dict& arrays) {
  for (const auto& [key, value] : arrays) {
    const auto name = key.cast<std::string>();
    const auto* const known = std::ranges::find(column_names, name, &ColumnName::name);
    if (known == column_names.end()) throw std::invalid_argument(fmt::format("{}: no sensor reads it", name));
    if (!pybind11::isinstance<pybind11::array_t<double, pybind11::array::c_style>>(value))
      throw std::invalid_argument(fmt::format("{}: is no contiguous array of float64", name));
    const auto array = pybind11::reinterpret_borrow<pybind11::array>(value);
    kept_.push_back(array);
    columns_.*(known->column) = {static_cast<const double*>(array.data()), static_cast<std::size_t>(array.size())};
  }
  for (const ColumnName& each : column_names) {
    const std::size_t size = (columns_.*(each.column)).size();
    const bool needed = each.column == &estimation::Columns::time_s || each.column == &estimation::Columns::current_A ||
                        each.column == &estimation::Columns::position_m;
    if (size == columns_.size() || (size == 0 && !needed)) continue;
    throw std::invalid_argument(
        fmt::format("{}: has {} samples and time_s has {}; give one value a sample, NaN where it is missing", each.name,
                    size, columns_.size()));
  }
}

void answer_run(estimation::RunningSensor& sensor, const estimation::Columns& columns, EstimateArrays& answers,
                SignalCheck& check) {
  constexpr std::size_t at_once = 1024;  // what fits into the processor's nearest memory
  std::vector<sensor::Estimate<double>> estimates(at_once);
  for (std::size_t from = 0; from < columns.size(); from += at_once) {
    check();
    const auto some = std::span(estimates).first(std::min(at_once, columns.size() - from));
    estimation::run(sensor, part(columns, from, some.size()), some);
    answers.put(from, some);
  }
}

}  // namespace spoolflow::python
