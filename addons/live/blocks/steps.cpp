#include "addons/live/blocks/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spoolflow::fleet {
namespace {

double nearest(double value, double step, double last) {
  return step * std::clamp(std::round(value / step), -last, last) + 0.0;  // + 0: no negative zero
}

}  // namespace

estimation::TimedSample on_grid(estimation::TimedSample sample) {
  constexpr double none = estimation::not_measured;
  sample.time_s =
      std::isfinite(sample.time_s) ? nearest(sample.time_s, time_step_s, static_cast<double>(last_time)) : none;
  for (const BlockChannel& channel : block_channels) {
    double& value = member(sample, channel);
    if (std::isnan(value)) continue;
    if (std::isfinite(value)) {
      value = nearest(value, channel.step, static_cast<double>(last_value));
    } else {
      value = channel.member == &estimation::TimedSample::current_a_A ? std::numeric_limits<double>::infinity() : none;
    }
  }
  return sample;
}

}  // namespace spoolflow::fleet
