#include "spoolflow/calibration/fits/solenoid_samples.hpp"

#include <cmath>

namespace spoolflow::calibration {

using recording::Channel;

SolenoidSamples solenoid_samples(const recording::Recording& recording, double stroke_m, Sampling sampling) {
  const auto time_s = recording[Channel::time];
  const auto current_A = recording[Channel::current];
  const auto position_m = recording[Channel::position];
  const auto force_N = recording[Channel::force];
  SolenoidSamples out;
  out.file = recording.file.filename().string();
  out.sampling = sampling;
  out.voltage_measured = recording.has(Channel::voltage);
  const bool numbered = recording.has(Channel::test);
  const bool warm = recording.has(Channel::oil_temperature);

  std::size_t before = 0;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    if (std::isnan(current_A[k]) || std::isnan(position_m[k]) || std::isnan(force_N[k])) continue;
    const bool first = out.samples.empty();
    const bool moved = !first && std::abs(position_m[k] - position_m[before]) > 0.05 * stroke_m;
    const auto mean_since = [&](std::span<const double> values) {
      return first || moved || sampling == Sampling::mean ? values[k] : 0.5 * (values[k] + values[before]);
    };
    sensor::Sample<double> sample{};
    sample.time_step_s = first ? 0.0 : time_s[k] - time_s[before];
    sample.current_A = mean_since(current_A);
    sample.voltage_V = out.voltage_measured ? mean_since(recording[Channel::voltage]) : std::nan("");
    sample.position_m = position_m[k];
    sample.oil_temperature_K = warm ? recording[Channel::oil_temperature][k] : std::nan("");
    out.samples.push_back(sample);
    out.time_s.push_back(time_s[k]);
    out.force_N.push_back(force_N[k]);
    out.test.push_back(numbered ? static_cast<int>(std::lround(recording[Channel::test][k])) : 0);
    out.restarts.push_back(first || moved ? 1 : 0);
    before = k;
  }
  return out;
}

SolenoidSamples thinned(const SolenoidSamples& given, double current_step_A) {
  constexpr double longest_step_s = 2e-3;
  SolenoidSamples out = given;
  out.samples.clear();
  out.time_s.clear();
  out.force_N.clear();
  out.test.clear();
  out.restarts.clear();
  double first_A = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const sensor::Sample<double>& sample = given.samples[k];
    const bool joins = !out.samples.empty() && given.restarts[k] == 0 && out.restarts.back() == 0 &&
                       given.test[k] == out.test.back() && std::abs(sample.current_A - first_A) < current_step_A &&
                       out.samples.back().time_step_s + sample.time_step_s < longest_step_s;
    if (!joins) {
      out.samples.push_back(sample);
      out.time_s.push_back(given.time_s[k]);
      out.force_N.push_back(given.force_N[k]);
      out.test.push_back(given.test[k]);
      out.restarts.push_back(given.restarts[k]);
      first_A = sample.current_A;
      continue;
    }
    sensor::Sample<double>& mean = out.samples.back();
    const double step_s = mean.time_step_s + sample.time_step_s;
    const double share = sample.time_step_s / step_s;
    mean.current_A += share * (sample.current_A - mean.current_A);
    mean.voltage_V += share * (sample.voltage_V - mean.voltage_V);
    mean.position_m = sample.position_m;
    mean.time_step_s = step_s;
    out.time_s.back() = given.time_s[k];
    out.force_N.back() = given.force_N[k];
  }
  return out;
}

}  // namespace spoolflow::calibration
