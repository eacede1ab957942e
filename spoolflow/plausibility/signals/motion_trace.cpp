#include "spoolflow/plausibility/signals/motion_trace.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::plausibility {

using recording::Channel;

namespace {

constexpr double followed_s = 300;
constexpr auto most_blocks = static_cast<std::size_t>(followed_s / MotionTrace::block_s);

}  // namespace

void MotionTrace::add(double time_s, const Values& values) {
  if (!std::isfinite(time_s) || !std::isfinite(values[0] + values[1])) return;
  if (blocks_.empty()) begin_s_ = time_s;
  constexpr double rounding = 1e-6;  // of times such as 0.006 s
  const double place = (time_s - begin_s_) / block_s + rounding;
  if (!(place >= 0) || place >= static_cast<double>(most_blocks)) return;
  const auto block = static_cast<std::size_t>(place);
  if (block + 1 < blocks_.size()) return;  // times that run backwards
  if (block >= blocks_.size()) blocks_.resize(block + 1);
  Block& last = blocks_.back();
  for (std::size_t k = 0; k < values.size(); ++k) last.sums[k] += static_cast<float>(values[k]);
  ++last.samples;
}

void MotionTrace::take(const std::array<std::vector<double>, recording::channel_count>& columns) {
  const auto column = [&](Channel channel) -> const std::vector<double>& {
    return columns[static_cast<std::size_t>(channel)];
  };
  const std::vector<double>&time_s = column(Channel::time), &position_m = column(Channel::position);
  const std::vector<double>&other_A = column(Channel::current_a), &other_V = column(Channel::voltage_a);
  const bool both = !column(Channel::current_b).empty() && !other_A.empty();
  const std::vector<double>& current_A = column(both ? Channel::current_b : Channel::current);
  const std::vector<double>& voltage_V = column(both ? Channel::voltage_b : Channel::voltage);
  const std::size_t size = time_s.size();
  if (position_m.size() != size || current_A.size() != size) return;
  const bool measured = voltage_V.size() == size && (!both || other_V.size() == size);
  for (std::size_t k = 0; k < size; ++k) {
    const double of_voltage_V = measured ? voltage_V[k] - (both ? other_V[k] : 0) : std::nan("");
    add(time_s[k], {position_m[k], current_A[k] - (both ? other_A[k] : 0), of_voltage_V});
  }
}

std::vector<double> MotionTrace::means(std::size_t of, std::size_t blocks) const {
  std::vector<double> out;
  for (std::size_t from = 0; from < blocks_.size(); from += blocks) {
    double sum = 0, samples = 0;
    for (std::size_t k = from; k < std::min(from + blocks, blocks_.size()); ++k) {
      sum += blocks_[k].sums[of];
      samples += blocks_[k].samples;
    }
    out.push_back(samples > 0 ? sum / samples : std::nan(""));
  }
  return out;
}

}  // namespace spoolflow::plausibility
