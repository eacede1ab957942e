#pragma once
/// From columns of samples to answers: the one way through which a sensor meets what was recorded, simulated or sent.
#include <concepts>
#include <limits>
#include <span>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::estimation {

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

/// One sample after the other, as in the valve: calls `each(k, estimate)` after sample k, when sensor.state() is that
/// after the sample. A sensor goes on where it was, so that columns may come in pieces.
/// `Samples`: Columns, or whatever else holds a TimedSample at each index.
template <class Samples, std::invocable<std::size_t, const sensor::Estimate<double>&> Each>
void run(RunningSensor& sensor, const Samples& samples, Each&& each) {
  for (std::size_t k = 0; k < samples.size(); ++k) each(k, sensor.step(samples[k]));
}

/// One estimate a sample, in `estimates`, which is as long as the columns. Compiled here once, at the library's own
/// optimisation, whatever the caller's is.
void run(RunningSensor& sensor, const Columns& columns, std::span<sensor::Estimate<double>> estimates);

}  // namespace spoolflow::estimation
