#include "tests/cortex_m/packed_run.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "spoolflow/estimation/bare_steps.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::cortex_m {
namespace {

using Sample = sensor::Sample<float>;
using WholeValveSample = sensor::WholeValveSample<float>;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

Sample single(const sensor::Sample<double>& in) {
  return {static_cast<float>(in.time_step_s), static_cast<float>(in.current_A), static_cast<float>(in.voltage_V),
          static_cast<float>(in.position_m), static_cast<float>(in.oil_temperature_K)};
}

WholeValveSample single(const sensor::WholeValveSample<double>& in) {
  return {static_cast<float>(in.time_step_s),      static_cast<float>(in.current_a_A),
          static_cast<float>(in.current_b_A),      static_cast<float>(in.voltage_a_V),
          static_cast<float>(in.voltage_b_V),      static_cast<float>(in.position_m),
          static_cast<float>(in.oil_temperature_K)};
}

/// Calls `each` with every sample, in the form of one direction and as it was timed.
template <class Each>
void for_each_sample(recording::Reader& reader, Each&& each) {
  recording::SampleBlock block;
  double last_s = 0;
  bool begun = false;
  while (reader.next(block)) {
    const estimation::Columns columns = estimation::sensor_columns(block);
    for (std::size_t k = 0; k < block.rows; ++k) {
      const estimation::TimedSample timed = columns[k];
      each(sensor::Sample<double>{begun ? timed.time_s - last_s : 0.0, timed.current_A, timed.voltage_V,
                                  timed.position_m, timed.oil_temperature_K},
           timed);
      last_s = timed.time_s;
      begun = true;
    }
  }
}

/// Half-open, half-lifted: every 100 ms something else happens to a valve that was at work.
std::vector<Sample> disturbances(Sample steady, double stroke_m) {
  std::vector<Sample> samples;
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
  return samples;
}

/// Dither on the current of a valve that rests, travels and rests again, at several frequencies.
std::vector<Sample> dithered(Sample steady, double stroke_m) {
  std::vector<Sample> samples;
  steady.time_step_s = 1e-3F;
  const auto stroke = static_cast<float>(stroke_m);
  for (int k = 0; k < 6000; ++k) {
    Sample sample = steady;
    const float frequency_Hz = 90.0F + 35.0F * static_cast<float>(k / 2000);
    const float wave = std::sin(6.2832F * frequency_Hz * 1e-3F * static_cast<float>(k));
    sample.current_A *= 1.0F + (k % 2000 < 1000 ? 0.05F : 0.12F) * wave;
    sample.position_m += 3e-6F * wave;
    const int part = k / 500 % 4;  // rests, opens, rests, closes
    const float share = static_cast<float>(k % 500) / 500.0F;
    const std::array<float, 4> travelled = {0.0F, share, 1.0F, 1.0F - share};
    sample.position_m += 0.3F * stroke * travelled[static_cast<std::size_t>(part)];
    sample.oil_temperature_K -= 0.0068F * static_cast<float>(k);  // as oil does, and out of the map
    samples.push_back(sample);
  }
  return samples;
}

/// What follows a recording, of a valve half open.
std::vector<Sample> hardships(const Sample& steady, double stroke_m) {
  std::vector<Sample> samples = disturbances(steady, stroke_m);
  const std::vector<Sample> more = dithered(steady, stroke_m);
  samples.insert(samples.end(), more.begin(), more.end());
  return samples;
}

constexpr float left_m = 300e-6F;  ///< the spool has left the centre
constexpr float reached_m = 20e-6F;
constexpr float nothing = 1e-6F;   ///< of a current [A] that has faded away
constexpr float fading_s = 0.05F;  ///< time constant of the current of the coil that was left

/// One direction's samples to both sides in turn.
std::vector<WholeValveSample> to_both_sides(const std::vector<Sample>& samples) {
  std::vector<WholeValveSample> out;
  bool side_a = false, left = false;
  float current_A = 0, voltage_V = 0, idle_A = 0, idle_V = 0;
  for (const Sample& in : samples) {
    if (in.position_m > left_m) left = true;
    if (left && in.position_m < reached_m) {
      side_a = !side_a;
      left = false;
      idle_A = current_A, idle_V = voltage_V;
    }
    const float kept = std::exp(-in.time_step_s / fading_s);
    idle_A *= kept, idle_V *= kept;
    if (std::abs(idle_A) < nothing) idle_A = idle_V = 0;
    if (in.current_A == in.current_A) current_A = in.current_A;
    if (in.voltage_V == in.voltage_V) voltage_V = in.voltage_V;
    out.push_back({in.time_step_s, side_a ? in.current_A : idle_A, side_a ? idle_A : in.current_A,
                   side_a ? in.voltage_V : idle_V, side_a ? idle_V : in.voltage_V,
                   side_a ? -in.position_m : in.position_m, in.oil_temperature_K});
  }
  return out;
}

void append(std::string& bytes, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xFFU);
}

template <std::size_t Count>
void append(std::string& bytes, const std::array<float, Count>& numbers) {
  for (const float number : numbers) append(bytes, std::bit_cast<std::uint32_t>(number));
}

/// `golden`: flow rates [m3/s] of all samples; the first `recorded` of them are the recording.
template <class AnySample>
std::string packed(const std::vector<AnySample>& samples, std::size_t recorded, const std::vector<double>& golden) {
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(samples.size()));
  append(bytes, static_cast<std::uint32_t>(recorded));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    append(bytes, std::bit_cast<std::array<float, sizeof(AnySample) / sizeof(float)>>(samples[k]));
    append(bytes, std::array{static_cast<float>(golden[k])});
  }
  return bytes;
}

template <class AnySample>
void cut(std::vector<AnySample>& samples) {
  const std::size_t most = most_bytes / (sizeof(AnySample) + sizeof(float));
  if (samples.size() > most) samples.resize(most);
}

std::string packed_direction(const model::Model& model, estimation::Estimator estimator, recording::Reader& reader) {
  std::vector<Sample> samples;
  for_each_sample(reader, [&](const auto& sample, const auto&) { samples.push_back(single(sample)); });
  cut(samples);
  const std::size_t recorded = samples.size();
  const std::vector<Sample> added = hardships(samples[recorded / 2], model.valve.stroke_m);
  samples.insert(samples.end(), added.begin(), added.end());
  if (estimator == estimation::Estimator::observer) {
    return packed(
        samples, recorded,
        estimation::stepped_flows(model.observer.value().parameters, sensor::ObserverState<double>{}, samples));
  }
  return packed(samples, recorded,
                estimation::stepped_flows(sensor::laid_out(model.condensed.parameters),
                                          sensor::CondensedState<double>{}, samples));
}

std::string packed_whole(const model::Model& model, estimation::Estimator estimator, recording::Reader& reader) {
  const bool both = reader.has(recording::Channel::current_a);
  std::vector<Sample> own;
  std::vector<WholeValveSample> samples;
  for_each_sample(reader, [&](const auto& sample, const auto& timed) {
    own.push_back(single(sample));
    if (both) samples.push_back(single(estimation::whole_valve_sample(sample, timed)));
  });
  if (!both) samples = to_both_sides(own);
  cut(samples);
  const std::size_t recorded = samples.size();
  const auto half_open = std::find_if(
      own.begin(), own.end(), [&](const Sample& sample) { return sample.position_m > 0.3 * model.valve.stroke_m; });
  const std::vector<WholeValveSample> added = to_both_sides(hardships(*half_open, model.valve.stroke_m));
  samples.insert(samples.end(), added.begin(), added.end());
  const model::Direction& a = model.p_to_a.value();
  if (estimator == estimation::Estimator::observer) {
    const sensor::WholeValveParameters<double> valve{&model.observer.value().parameters,
                                                     &a.observer.value().parameters};
    return packed(samples, recorded, estimation::stepped_flows(valve, sensor::WholeValveState<double>{}, samples));
  }
  const auto tables_b = sensor::laid_out(model.condensed.parameters),
             tables_a = sensor::laid_out(a.condensed.parameters);
  return packed(samples, recorded,
                estimation::stepped_flows(sensor::WholeCondensedTables<double>{&tables_b, &tables_a},
                                          sensor::WholeCondensedState<double>{}, samples));
}

}  // namespace

std::string packed_run(const model::Model& model, estimation::Estimator estimator,
                       const std::filesystem::path& recording) {
  const auto reader = estimation::open_sensor_channels(recording, estimation::sensor_channels(model, {}));
  return model.whole() ? packed_whole(model, estimator, *reader) : packed_direction(model, estimator, *reader);
}

}  // namespace spoolflow::cortex_m
