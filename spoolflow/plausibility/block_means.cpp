#include "spoolflow/plausibility/block_means.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

std::vector<double> means_of(const std::vector<double>& values, std::size_t width) {
  std::vector<double> out(values.size() / width);
  for (std::size_t k = 0; k < out.size(); ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < width; ++j) sum += values[k * width + j];
    out[k] = sum / static_cast<double>(width);
  }
  return out;
}

/// Where each stretch begins, and behind the last.
std::vector<std::size_t> stretches(std::span<const double> time_s) {
  std::vector<std::size_t> out{0};
  double begun_s = std::nan("");
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    if (std::isnan(begun_s)) begun_s = time_s[k];
    if (!(std::abs(time_s[k] - begun_s) >= shortest_block_s)) continue;
    out.push_back(k);
    begun_s = time_s[k];
  }
  out.push_back(time_s.size());
  return out;
}

}  // namespace

double mean_of_numbers(std::span<const double> values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return 2 * count >= values.size() && count > 0 ? sum / static_cast<double>(count) : std::nan("");
}

std::vector<double> longer_blocks(std::span<const double> time_s, std::span<const double> values) {
  const std::vector<std::size_t> begins = stretches(time_s);
  std::vector<double> out;
  for (std::size_t k = 0; k + 1 < begins.size(); ++k)
    out.push_back(mean_of_numbers(values.subspan(begins[k], begins[k + 1] - begins[k])));
  return out;
}

recording::Recording longer_blocks(const recording::Recording& means) {
  recording::Recording out{means.file, {}};
  for (const Channel channel : recording::all_channels) {
    if (means.has(channel)) out.column(channel) = longer_blocks(means.column(Channel::time), means.column(channel));
  }
  return out;
}

void name_alike(recording::Recording& means) {
  if (!means.has(Channel::pressure_difference) && means.has(Channel::pressure_upstream) &&
      means.has(Channel::pressure_downstream)) {
    const std::vector<double>& down = means.column(Channel::pressure_downstream);
    std::vector<double> difference = means.column(Channel::pressure_upstream);
    for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= down[k];
    means.column(Channel::pressure_difference) = std::move(difference);
  }
  if (!means.has(Channel::flow)) means.column(Channel::flow) = means.column(Channel::flow_reference);
  means.column(Channel::flow_reference).clear();
}

recording::Recording block_means(const recording::Recording& recording, std::size_t most) {
  recording::Recording out{recording.file, {}};
  const std::size_t width = std::max<std::size_t>(recording.size() / most, 1);
  for (const Channel channel : recording::all_channels) {
    if (recording.has(channel)) out.column(channel) = means_of(recording.column(channel), width);
  }
  name_alike(out);
  return out;
}

std::vector<double> velocities(const recording::Recording& means) {
  const std::vector<double>& time_s = means.column(Channel::time);
  const std::vector<double>& position_m = means.column(Channel::position);
  std::vector<double> out(position_m.size(), 0.0);
  for (std::size_t k = 1; k + 1 < out.size(); ++k) {
    const double step_s = time_s[k + 1] - time_s[k - 1];
    if (step_s > 0) out[k] = (position_m[k + 1] - position_m[k - 1]) / step_s;
  }
  return out;
}

}  // namespace spoolflow::plausibility
