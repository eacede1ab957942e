#include "spoolflow/calibration/type/one_side.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/numerics/largest_magnitude.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

/// Beyond the centre by so much [m] the spool stands on the other side: the edges overlap by more.
constexpr double other_side_m = 20e-6;
/// At rest in the centre: so close to it [share of the stroke], with so little of the largest current.
constexpr double centre_share = 0.05, currentless_share = 0.01;
constexpr std::size_t least_samples = 100;

/// Where the spool reads while both coils are off [m].
double centre_m(const recording::Recording& whole, double stroke_m) {
  const auto position_m = whole[Channel::position], a_A = whole[Channel::current_a], b_A = whole[Channel::current_b];
  const double off_A = currentless_share * std::max(numerics::largest_magnitude(a_A), numerics::largest_magnitude(b_A));
  std::vector<double> readings_m;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    if (std::abs(a_A[k]) < off_A && std::abs(b_A[k]) < off_A && std::abs(position_m[k]) < centre_share * stroke_m)
      readings_m.push_back(position_m[k]);
  }
  if (readings_m.size() < least_samples) {
    throw CalibrationError(
        fmt::format("{}: in {} samples the spool rests in the centre without current, {} are needed to find where that "
                    "reads; record half a second with both coils off, or each direction in a file of its own, with "
                    "direction = \"a\" or \"b\"",
                    whole.file.string(), readings_m.size(), least_samples));
  }
  return numerics::median(std::move(readings_m));
}

}  // namespace

OneSide one_side(const recording::Recording& whole, const std::string& direction, double stroke_m) {
  const double sign = direction == "a" ? -1 : 1, closed_m = sign * centre_m(whole, stroke_m);
  OneSide side{whole, closed_m};
  recording::Recording& out = side.run;
  out.column(Channel::current) = whole.column(direction == "a" ? Channel::current_a : Channel::current_b);
  out.column(Channel::voltage) = whole.column(direction == "a" ? Channel::voltage_a : Channel::voltage_b);
  for (const Channel channel : {Channel::current_a, Channel::current_b, Channel::voltage_a, Channel::voltage_b})
    out.column(channel).clear();
  std::vector<double>& position_m = out.column(Channel::position);
  std::vector<double>& flow_m3_per_s = out.column(Channel::flow_reference);
  for (const Channel channel : {Channel::flow_reference, Channel::position_set}) {
    for (double& value : out.column(channel)) value *= sign;
  }
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    position_m[k] *= sign;
    if (!(position_m[k] < closed_m - other_side_m)) continue;
    position_m[k] = closed_m;
    if (!flow_m3_per_s.empty()) flow_m3_per_s[k] = 0;
  }
  return side;
}

}  // namespace spoolflow::calibration
