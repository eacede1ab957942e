#include "spoolflow/calibration/numerics/zero_phase_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spoolflow::calibration {
namespace {

/// One section of second order with unit gain at rest, made by the bilinear transform.
struct Section {
  double b, a1, a2;  ///< numerator b (1 + z)^2

  Section(double warped, double inverse_quality) {
    const double square = warped * warped;
    const double a0 = 1 + warped * inverse_quality + square;
    b = square / a0;
    a1 = 2 * (square - 1) / a0;
    a2 = (1 - warped * inverse_quality + square) / a0;
  }

  /// From the steady state of the first value on.
  void run(std::vector<double>& values) const {
    double in1 = values.front(), in2 = in1, out1 = in1, out2 = in1;
    for (double& value : values) {
      const double in = value;
      value = b * (in + 2 * in1 + in2) - a1 * out1 - a2 * out2;
      in2 = in1;
      in1 = in;
      out2 = out1;
      out1 = value;
    }
  }
};

}  // namespace

std::vector<double> zero_phase_low_pass(const SampledSignal& signal, double bandwidth_Hz) {
  const auto count = static_cast<std::ptrdiff_t>(signal.values.size());
  const double share = bandwidth_Hz * signal.time_step_s;  // of the sample rate
  if (count < 3 || share >= 0.45) return {signal.values.begin(), signal.values.end()};

  const std::ptrdiff_t margin = std::min(count - 1, static_cast<std::ptrdiff_t>(3 / share));
  const auto first = static_cast<std::size_t>(margin);
  std::vector<double> values(signal.values.size() + 2 * first);
  for (std::ptrdiff_t k = -margin; k < count + margin; ++k) {
    const std::ptrdiff_t inside = k < 0 ? -k : k >= count ? 2 * (count - 1) - k : k;
    const double here = signal.values[static_cast<std::size_t>(inside)];
    values[static_cast<std::size_t>(k + margin)] = k < 0        ? 2 * signal.values.front() - here
                                                   : k >= count ? 2 * signal.values.back() - here
                                                                : here;
  }
  const double warped = std::tan(std::numbers::pi * share);
  const Section sections[] = {{warped, 2 * std::sin(std::numbers::pi / 8)},
                              {warped, 2 * std::cos(std::numbers::pi / 8)}};
  for (int pass = 0; pass < 2; ++pass) {
    for (const Section& section : sections) section.run(values);
    std::reverse(values.begin(), values.end());
  }
  return {values.begin() + margin, values.begin() + margin + count};
}

std::vector<double> derivative(const SampledSignal& signal) {
  const std::size_t count = signal.values.size();
  std::vector<double> out(count, 0.0);
  for (std::size_t k = 0; count > 1 && k < count; ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = k + 1 == count ? k : k + 1;
    out[k] =
        (signal.values[after] - signal.values[before]) / (static_cast<double>(after - before) * signal.time_step_s);
  }
  return out;
}

}  // namespace spoolflow::calibration
