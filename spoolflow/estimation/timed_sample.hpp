#pragma once
/// What a running sensor reads: one instant, or columns of them.
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "spoolflow/sensor/whole_valve/port_pressures.hpp"

namespace spoolflow::estimation {

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// What is measured at one instant. NaN means not measured.
struct TimedSample {
  double time_s;
  double current_A;  ///< of a whole valve that of solenoid b, or where that of a is not measured of the active one
  double voltage_V;
  double position_m;
  double oil_temperature_K;
  double current_a_A = not_measured;  ///< of a whole valve's solenoid a
  double voltage_a_V = not_measured;
  sensor::PortPressures<double> ports{};  ///< of a whole valve
};

/// One instant of a whole valve whose coils both have their instruments. NaN means not measured; without either current
/// the last answer is held.
struct TimedWholeSample {
  double time_s;
  double current_a_A, current_b_A;
  double voltage_a_V, voltage_b_V;
  double position_m;
  double oil_temperature_K;
  sensor::PortPressures<double> ports{};
};

/// What is measured of both coils, as a running sensor takes it. A current that is missing now is not one that nobody
/// measures: infinite, it says so.
inline TimedSample of_both_coils(const TimedWholeSample& in) {
  const double current_a_A = std::isnan(in.current_a_A) ? std::numeric_limits<double>::infinity() : in.current_a_A;
  return {in.time_s,   in.current_b_A, in.voltage_b_V, in.position_m, in.oil_temperature_K,
          current_a_A, in.voltage_a_V, in.ports};
}

/// What a sensor reads, in SI units, one entry a sample; a missing value is NaN. Time, current and position are equally
/// long; all others are as long, or empty where they were not measured. See TimedSample.
struct Columns {
  std::span<const double> time_s, current_A, voltage_V, position_m, oil_temperature_K;
  std::span<const double> current_a_A{}, voltage_a_V{};  ///< of a whole valve's solenoid a
  std::span<const double> pressure_p_Pa{}, pressure_a_Pa{}, pressure_b_Pa{}, pressure_t_Pa{};  ///< of its ports

  [[nodiscard]] std::size_t size() const { return time_s.size(); }
  /// The same of the first samples.
  [[nodiscard]] Columns first(std::size_t count) const {
    const auto of = [&](std::span<const double> column) { return column.empty() ? column : column.first(count); };
    return {of(time_s),       of(current_A),   of(voltage_V),     of(position_m),    of(oil_temperature_K),
            of(current_a_A),  of(voltage_a_V), of(pressure_p_Pa), of(pressure_a_Pa), of(pressure_b_Pa),
            of(pressure_t_Pa)};
  }
  [[nodiscard]] TimedSample operator[](std::size_t k) const {
    const auto of = [k](std::span<const double> column) { return column.empty() ? not_measured : column[k]; };
    return {time_s[k],
            current_A[k],
            of(voltage_V),
            position_m[k],
            of(oil_temperature_K),
            of(current_a_A),
            of(voltage_a_V),
            {of(pressure_p_Pa), of(pressure_a_Pa), of(pressure_b_Pa), of(pressure_t_Pa)}};
  }
};

}  // namespace spoolflow::estimation
