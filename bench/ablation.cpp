/// What each part of the observer brings: the same runs with one part at a time taken away, and at other sampling
/// rates. Run: ablation MODEL.json RECORDING TRUTH…   Prints 95th percentile and largest error [% FS] against the true
/// flow, and the share inside the band. TRUTH has time and flow at the same instants.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/validation/metrics.hpp"

namespace {

using namespace spoolflow;
using recording::Channel;
using Parameters = sensor::ObserverParameters<double>;

/// What is done to the sensor and to its inputs.
struct Variant {
  const char* name;
  std::function<void(Parameters&)> change = [](Parameters&) {};
  bool voltage = true;
  bool temperature = true;
  std::size_t every = 1;      ///< sample of the recording
  bool over_periods = false;  ///< current and voltage as means over the last period of dither
};

std::vector<Variant> variants() {
  return {
      {.name = "all parts"},
      {.name = "no magnetic hysteresis",
       .change =
           [](Parameters& valve) {
             valve.actuator.coil.hysteresis.stiffness.fill(0);
             valve.actuator.coil.hysteresis.stiffness_increase.fill(0);
           }},
      {.name = "no eddy currents",
       .change =
           [](Parameters& valve) {
             valve.actuator.coil.eddy_currents.classical_A_per_V = 0;
             valve.actuator.coil.eddy_currents.excess_A_per_rootV = 0;
           }},
      {.name = "dither not found", .change = [](Parameters& valve) { valve.largest_current_A = 1e3; }},
      {.name = "means over periods, not friction's envelope", .over_periods = true},
      {.name = "loads: pressure taken as all but held",
       .change =
           [](Parameters& valve) {
             valve.pressure.sliding_drift_Pa_per_sqrt_s *= 0.1;
             valve.pressure.resting_drift_Pa_per_sqrt_s *= 0.1;
           }},
      {.name = "no moving mass", .change = [](Parameters& valve) { valve.moving_mass_kg = 1e-3; }},
      {.name = "no voltage", .voltage = false},
      {.name = "no oil temperature", .temperature = false},
      {.name = "no drift of the position sensor",
       .change = [](Parameters& valve) { valve.position_sensor.drift_m_per_K = 0; }},
      {.name = "no position faults",
       .change = [](Parameters& valve) { valve.position_sensor.hardest_acceleration_m_per_s2 = 1e5; }},
      {.name = "friction as on the bench",
       .change =
           [](Parameters& valve) {
             valve.friction.operation_ratio = 1;
             valve.pressure.ratio_deviation = 1e-3;
           }},
      {.name = "friction ratio not followed",
       .change = [](Parameters& valve) { valve.pressure.ratio_deviation = 1e-3; }},
      {.name = "no growth of stiction at rest", .change = [](Parameters& valve) { valve.friction.ageing_ratio = 1; }},
      {.name = "no pre-sliding", .change = [](Parameters& valve) { valve.friction.contact_stiffness_N_per_m = 1e10; }},
      {.name = "every second sample", .every = 2},
      {.name = "every fifth sample", .every = 5},
  };
}

/// Every so many samples of a column; none of one that is not used.
std::vector<double> thinned(const std::vector<double>& column, const Variant& variant, bool used = true) {
  std::vector<double> out;
  for (std::size_t k = 0; used && k < column.size(); k += variant.every) out.push_back(column[k]);
  return out;
}

/// Means over the last whole period of the current's dither, as the sensor's own search finds it; as it is where there
/// is none.
std::vector<double> over_periods(const std::vector<double>& values, const std::vector<double>& current_A,
                                 const std::vector<double>& time_s, double largest_current_A) {
  sensor::DitherState<double> state;
  if (!current_A.empty()) sensor::begin(state, current_A.front());
  std::vector<double> out = values;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step_s = time_s[k] - time_s[k - 1];
    const bool dithered = sensor::follow_dither(state, current_A[k], largest_current_A, step_s).present;
    if (!dithered || !(state.period_s > 0) || !(step_s > 0)) continue;
    const std::size_t count = std::clamp<std::size_t>(std::lround(state.period_s / step_s), 1, k);
    double sum = 0;
    for (std::size_t back = 0; back < count; ++back) sum += values[k - back];
    out[k] = sum / static_cast<double>(count);
  }
  return out;
}

/// A recording and the flow itself.
struct Run {
  recording::Recording recording;
  std::vector<double> true_m3_per_s;
};

validation::GroupFigures run(const model::Model& model, const Run& judged, const Variant& variant) {
  const recording::Recording& recording = judged.recording;
  Parameters valve = model.observer->parameters;
  variant.change(valve);
  const auto column = [&](Channel channel, bool used = true) {
    return thinned(recording.column(channel), variant, used);
  };
  const std::vector<double> time_s = column(Channel::time), position_m = column(Channel::position),
                            temperature_K = column(Channel::oil_temperature, variant.temperature);
  std::vector<double> current_A = column(Channel::current), voltage_V = column(Channel::voltage, variant.voltage);
  if (variant.over_periods) {
    voltage_V = over_periods(voltage_V, current_A, time_s, valve.largest_current_A);
    current_A = over_periods(current_A, current_A, time_s, valve.largest_current_A);
  }
  const std::vector<double> reference = thinned(judged.true_m3_per_s, variant);
  validation::ComparedSamples compared(model.valve.rated_flow_m3_per_s);
  estimation::RunningSensor sensor(&valve, model.valve.rated_flow_m3_per_s);
  estimation::run(sensor, estimation::Columns{time_s, current_A, voltage_V, position_m, temperature_K},
                  [&](std::size_t k, const sensor::Estimate<double>& estimate) {
                    if (!std::isfinite(reference[k])) return;
                    compared.add({estimate.flow_m3_per_s, estimate.flow_lower_m3_per_s, estimate.flow_upper_m3_per_s,
                                  reference[k], false, false, false});
                  });
  return compared.metrics().all;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4 || argc % 2 != 0) {
    fmt::print(stderr, "usage: ablation MODEL.json RECORDING TRUTH…\n");
    return 2;
  }
  const model::Model model = model::read_model(argv[1]);
  if (!model.observer) {
    fmt::print(stderr, "{}: the model is not calibrated for the observer\n", argv[1]);
    return 2;
  }
  std::vector<Run> runs;
  fmt::print("{:<46}", "p95 / max [% FS], inside the band [%]");
  for (int k = 2; k < argc; k += 2) {
    recording::ReadOptions options = estimation::sensor_channels(model, {});
    recording::ReadOptions of_truth;
    of_truth.required = {Channel::time, Channel::flow};
    const recording::Recording truth = recording::read_recording(argv[k + 1], of_truth);
    runs.push_back({recording::read_recording(argv[k], options), truth.column(Channel::flow)});
    fmt::print("{:>22}", std::filesystem::path(argv[k]).stem().string());
  }
  fmt::print("\n");
  for (const Variant& variant : variants()) {
    fmt::print("{:<46}", variant.name);
    for (const Run& judged : runs) {
      const validation::GroupFigures figures = run(model, judged, variant);
      const double percent = 100 / model.valve.rated_flow_m3_per_s;
      fmt::print("{:>10.2f} /{:5.1f} {:5.1f}", figures.error.p95 * percent, figures.error.largest * percent,
                 100 * figures.band_coverage);
    }
    fmt::print("\n");
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "ablation: {}\n", error.what());
  return 1;
}
