#include "tests/cortex_m/packed_run.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "spoolflow/estimation/bare_steps.hpp"
#include "spoolflow/validation/sensor_channels.hpp"

namespace spoolflow::cortex_m {
namespace {

using recording::Channel;
using Sample = sensor::Sample<float>;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

std::vector<Sample> samples_of(const model::Model& model, const std::filesystem::path& file) {
  const auto reader = recording::open_reader(file, validation::sensor_channels(model, {}));
  std::vector<Sample> samples;
  recording::SampleBlock block;
  double last_s = 0;
  while (reader->next(block)) {
    const auto column = [&](Channel channel, std::size_t k) {
      const std::vector<double>& values = block.columns[static_cast<std::size_t>(channel)];
      return values.empty() ? missing : static_cast<float>(values[k]);
    };
    for (std::size_t k = 0; k < block.rows; ++k) {
      const double time_s = block.columns[static_cast<std::size_t>(Channel::time)][k];
      const double step_s = samples.empty() ? 0.0 : time_s - last_s;
      last_s = time_s;
      samples.push_back({static_cast<float>(step_s), column(Channel::current, k), column(Channel::voltage, k),
                         column(Channel::position, k), column(Channel::oil_temperature, k)});
    }
  }
  return samples;
}

/// Half-open, half-lifted: every 100 ms something else happens to a valve that was at work.
void append_disturbances(std::vector<Sample>& samples, double stroke_m) {
  Sample steady = samples[samples.size() / 2];
  steady.time_step_s = 1e-3F;
  const auto stroke = static_cast<float>(stroke_m);
  for (int k = 0; k < 2000; ++k) {
    Sample sample = steady;
    const int part = k / 100;
    if (part == 2) sample.position_m += 0.2F * stroke;
    if (part == 4) sample.position_m = 0.6F * stroke + 0.0001F * static_cast<float>(k % 100) * stroke;
    if (part == 5) sample.position_m = missing;
    if (part == 6) sample.current_A = missing;
    if (part == 7) sample.voltage_V = sample.oil_temperature_K = missing;
    if (part == 8) sample.current_A *= 3.0F;
    if (part == 9) sample.position_m = 0.0F;
    if (part >= 10) sample.oil_temperature_K = 200.0F;
    if (part == 11) sample.time_step_s = 0.0F;
    if (part > 12) sample.position_m = 0.5F * stroke * static_cast<float>(k % 20) / 20.0F;
    samples.push_back(sample);
  }
}

void append(std::string& bytes, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xFFU);
}

}  // namespace

std::string packed_run(const model::Model& model, estimation::Estimator estimator,
                       const std::filesystem::path& recording) {
  std::vector<Sample> samples = samples_of(model, recording);
  if (samples.size() > most_samples) samples.resize(most_samples);
  const std::size_t recorded = samples.size();
  append_disturbances(samples, model.valve.stroke_m);
  const std::vector<double> golden =
      estimator == estimation::Estimator::observer
          ? estimation::stepped_flows(model.observer.value().parameters, sensor::ObserverState<double>{}, samples)
          : estimation::stepped_flows(sensor::laid_out(model.condensed.parameters), sensor::CondensedState<double>{},
                                      samples);
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(samples.size()));
  append(bytes, static_cast<std::uint32_t>(recorded));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& in = samples[k];
    for (const float number : {in.time_step_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K,
                               static_cast<float>(golden[k])}) {
      append(bytes, std::bit_cast<std::uint32_t>(number));
    }
  }
  return bytes;
}

}  // namespace spoolflow::cortex_m
