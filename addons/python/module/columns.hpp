#pragma once
/// Arrays of NumPy as the library's columns, and the library's answers as arrays.
#include <array>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "addons/python/module/fresh_array.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/estimation/columns.hpp"

namespace spoolflow::python {

struct ColumnName {
  const char* name;
  std::span<const double> estimation::Columns::*column;
};
/// What a sensor reads, under the names of Python's arguments. `current_A` and `voltage_V` are those of the only or the
/// active coil, or of a whole valve's coil b.
inline constexpr std::array<ColumnName, 11> column_names{{
    {"time_s", &estimation::Columns::time_s},
    {"current_A", &estimation::Columns::current_A},
    {"voltage_V", &estimation::Columns::voltage_V},
    {"position_m", &estimation::Columns::position_m},
    {"oil_temperature_K", &estimation::Columns::oil_temperature_K},
    {"current_a_A", &estimation::Columns::current_a_A},
    {"voltage_a_V", &estimation::Columns::voltage_a_V},
    {"pressure_p_Pa", &estimation::Columns::pressure_p_Pa},
    {"pressure_a_Pa", &estimation::Columns::pressure_a_Pa},
    {"pressure_b_Pa", &estimation::Columns::pressure_b_Pa},
    {"pressure_t_Pa", &estimation::Columns::pressure_t_Pa},
}};

/// So many samples from there on.
[[nodiscard]] inline estimation::Columns part(const estimation::Columns& of, std::size_t from, std::size_t count) {
  estimation::Columns out{};
  for (const ColumnName& each : column_names) {
    const std::span<const double> column = of.*(each.column);
    if (!column.empty()) out.*(each.column) = column.subspan(from, count);
  }
  return out;
}

/// Arrays by these names, kept alive while their columns are read.
class ColumnArrays {
 public:
  /// Reads in place what is contiguous float64, as the package makes sure. Throws std::invalid_argument where an array
  /// is of another form, or not as long as the times.
  explicit ColumnArrays(const pybind11::dict& arrays);
  [[nodiscard]] const estimation::Columns& columns() const { return columns_; }

 private:
  std::vector<pybind11::array> kept_;
  estimation::Columns columns_;
};

/// A column a quantity, as they stand in sensor::Estimate.
class EstimateArrays {
 public:
  explicit EstimateArrays(std::size_t samples) : status_(fresh_array<std::uint32_t>(samples)) {
    for (pybind11::array_t<double>& array : arrays_) array = fresh_array<double>(samples);
    for (std::size_t k = 0; k < arrays_.size(); ++k) columns_[k] = arrays_[k].mutable_data();
    words_ = status_.mutable_data();
  }
  /// Needs no lock of the interpreter.
  void put(std::size_t from, std::span<const sensor::Estimate<double>> estimates) {
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      const sensor::Estimate<double>& each = estimates[k];
      columns_[0][from + k] = each.flow_m3_per_s;
      columns_[1][from + k] = each.flow_lower_m3_per_s;
      columns_[2][from + k] = each.flow_upper_m3_per_s;
      columns_[3][from + k] = each.pressure_difference_Pa;
      columns_[4][from + k] = each.magnetic_force_N;
      columns_[5][from + k] = each.spring_force_N;
      columns_[6][from + k] = each.flow_force_N;
      columns_[7][from + k] = each.friction_force_N;
      words_[from + k] = static_cast<std::uint32_t>(each.status);
    }
  }
  /// By the names of the members.
  [[nodiscard]] pybind11::dict by_name() const {
    constexpr std::array names{"flow_m3_per_s",          "flow_lower_m3_per_s", "flow_upper_m3_per_s",
                               "pressure_difference_Pa", "magnetic_force_N",    "spring_force_N",
                               "flow_force_N",           "friction_force_N"};
    static_assert(names.size() == quantities);
    pybind11::dict out;
    for (std::size_t k = 0; k < quantities; ++k) out[names[k]] = arrays_[k];
    out["status"] = status_;
    return out;
  }

 private:
  static constexpr std::size_t quantities = 8;
  std::array<pybind11::array_t<double>, quantities> arrays_;
  pybind11::array_t<std::uint32_t> status_;
  std::array<double*, quantities> columns_{};
  std::uint32_t* words_ = nullptr;
};

/// The answers of one sensor to one run; needs no lock of the interpreter.
void answer_run(estimation::RunningSensor& sensor, const estimation::Columns& columns, EstimateArrays& answers,
                SignalCheck& check);

}  // namespace spoolflow::python
