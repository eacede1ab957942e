#include "addons/live/gathered_samples.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::live {
namespace {

using recording::Channel;

/// A spool that moves by less than that many times the noise of its position says nothing.
constexpr double least_motion = 20;

struct SampleChannel {
  Channel channel;
  const char* unit;
  double estimation::TimedSample::*member;
};
/// As a datagram has them, by the units of SI.
constexpr std::array<SampleChannel, GatheredSamples::channels> sample_channels{
    {{Channel::time, "s", &estimation::TimedSample::time_s},
     {Channel::current, "A", &estimation::TimedSample::current_A},
     {Channel::voltage, "V", &estimation::TimedSample::voltage_V},
     {Channel::position, "m", &estimation::TimedSample::position_m},
     {Channel::oil_temperature, "K", &estimation::TimedSample::oil_temperature_K},
     {Channel::current_a, "A", &estimation::TimedSample::current_a_A},
     {Channel::voltage_a, "V", &estimation::TimedSample::voltage_a_V}}};

constexpr std::size_t position_place = 3, current_a_place = 5;  ///< in that table

/// The active coil's is that of b where that of a is measured beside it.
Channel channel_of(const SampleChannel& one, bool both_coils) {
  if (both_coils && one.channel == Channel::current) return Channel::current_b;
  if (both_coils && one.channel == Channel::voltage) return Channel::voltage_b;
  return one.channel;
}

}  // namespace

void GatheredSamples::take(const estimation::TimedSample& sample) {
  for (std::size_t c = 0; c < sample_channels.size(); ++c) {
    const double value = sample.*sample_channels[c].member;
    columns_[c].push_back(std::isfinite(value) ? value : estimation::not_measured);
    if (!std::isfinite(value)) continue;
    ranges_[c].lowest = std::min(ranges_[c].lowest, value);
    ranges_[c].highest = std::max(ranges_[c].highest, value);
  }
  if (std::isfinite(sample.time_s)) {
    if (std::isnan(first_s_)) first_s_ = sample.time_s;
    last_s_ = sample.time_s;
  }
  if (columns_.front().size() == rows_together) hand_over();
}

template <class Check>
bool GatheredSamples::checked(Check&& check) {
  try {
    check();
    return true;
  } catch (const recording::RecordingError& error) {
    implausible_ = error.what();
    const std::size_t guess = implausible_.find("; is its unit ");
    if (!in_SI_ && guess != std::string::npos) {
      // The guess is of a number in SI, which is none that the sender wrote.
      implausible_.resize(guess);
      implausible_ += "; is its column in the unit that the header or channel map states?";
    }
    return false;
  }
}

/// What is beyond a limit is named by its extremes, which tell best what unit it is in.
void GatheredSamples::finish() {
  if (bound_.empty()) return;
  if (implausible_.empty()) {
    (void)checked([&] { units_->finish(); });
    return;
  }
  recording::Plausibility again(valve_, bound_, stroke_m_);
  for (std::size_t k = 0; k < bound_.size(); ++k) {
    const auto& [lowest, highest] = ranges_[bound_[k].column];
    if (bound_[k].channel == Channel::time || !(lowest <= highest)) continue;
    const bool falls = std::abs(lowest) > std::abs(highest);
    for (const double extreme : {falls ? lowest : highest, falls ? highest : lowest}) {
      const std::vector<double> values(2, extreme);
      const auto when = [&](std::size_t) { return fmt::format("in {:.0f} s", length_s()); };
      if (!checked([&] { again.take(k, values, when); })) return;
    }
  }
}

bool GatheredSamples::moves() const {
  const double noise = means_.position_resolution().noise_m();
  const double least = std::isfinite(noise) ? noise : means_.position_resolution().step_m();
  const auto& [lowest, highest] = ranges_[position_place];
  return highest - lowest > least_motion * least && highest > lowest;
}

std::vector<std::string> GatheredSamples::findings(const std::vector<plausibility::KnownValve>& known) const {
  std::vector<std::string> out;
  for (plausibility::Finding& one : plausibility::run_findings(known, means_, valve_)) {
    out.push_back(one.text.substr(valve_.size() + 2));  // "press_1: position …"
  }
  return out;
}

void GatheredSamples::bind() {
  const bool both_coils = is_there(current_a_place);
  for (std::size_t c = 0; c < sample_channels.size(); ++c) {
    if (!is_there(c)) continue;
    const SampleChannel& one = sample_channels[c];
    const Channel channel = channel_of(one, both_coils);
    bound_.push_back({c, channel, 1, 0, std::string(recording::name(channel)), *units::unit_named(one.unit)});
  }
  units_.emplace(valve_, bound_, stroke_m_);
}

bool GatheredSamples::is_there(std::size_t c) const {
  return std::any_of(columns_[c].begin(), columns_[c].end(), [](double value) { return std::isfinite(value); });
}

void GatheredSamples::hand_over() {
  if (bound_.empty()) bind();
  recording::SampleBlock block;
  block.rows = rows_together;
  for (std::size_t k = 0; k < bound_.size() && implausible_.empty(); ++k) {
    const std::vector<double>& column = columns_[bound_[k].column];
    (void)checked([&] {
      units_->take(k, column, [&](std::size_t row) { return fmt::format("sample {}", samples_ + row + 1); });
    });
  }
  for (const recording::BoundColumn& one : bound_) {
    block.columns[static_cast<std::size_t>(one.channel)] = std::move(columns_[one.column]);
  }
  samples_ += rows_together;
  if (block.column(Channel::time).size() == block.column(Channel::position).size()) means_.take(block);
  for (std::vector<double>& column : columns_) column.clear();
}

}  // namespace spoolflow::live
