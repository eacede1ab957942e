#include "spoolflow/rig/bench/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/rig/bench/coil_supply.hpp"
#include "spoolflow/rig/bench/instrument_panel.hpp"

namespace spoolflow::rig {
namespace {

/// How often the slow instruments follow and the oil's temperature is set, between samples.
constexpr std::int64_t ticks_per_slow_update = 10;

/// Surroundings over the period that begins at `time_s`.
void surround(PlantInput& input, const BenchRun& run, const Supply& supply, double time_s) {
  input.held_pressure_difference_Pa = run.pressure_difference_Pa.at(time_s);
  input.supply_pressure_Pa = run.supply_follows_difference ? supply.tank_pressure_Pa + input.held_pressure_difference_Pa
                                                           : run.supply_pressure_Pa.at(time_s);
  input.load_force_N = run.load_force_N.at(time_s);
  if (run.arrangement != Arrangement::valve) {
    const double to_m = run.motion_m.at(time_s + electronics_period_s);
    const double speed_m_per_s = (to_m - run.motion_m.at(time_s)) / electronics_period_s;
    input.motion = PrescribedMotion{.position_m = to_m, .velocity_m_per_s = speed_m_per_s};
  }
}

PlantInput surroundings_at_start(const BenchRun& run, const Supply& supply) {
  PlantInput input;
  surround(input, run, supply, 0);
  input.oil_temperature_C = run.oil_temperature_C.at(0);
  if (input.motion) {
    input.motion = PrescribedMotion{.position_m = run.motion_m.at(0)};
  }
  return input;
}

/// Ticks of the electronics between samples at that rate.
std::int64_t sample_ticks(double rate_Hz) {
  const double ticks = 1 / (rate_Hz * electronics_period_s);
  if (std::abs(ticks - std::round(ticks)) > 1e-6 || ticks < 0.5) {
    throw SettingsError(
        fmt::format("sample_rate_Hz = {} does not divide the electronics' {} Hz; choose 10000, 5000, "
                    "2000, 1000, 500, 200 or 100",
                    rate_Hz, 1 / electronics_period_s));
  }
  return std::llround(ticks);
}

/// The newest row of a recording.
MeasuredSample measured(const recording::Recording& recording, const BenchRun& run, double time_s) {
  using recording::Channel;
  const auto newest = [&](Channel channel) {
    const bool recorded = std::find(run.channels.begin(), run.channels.end(), channel) != run.channels.end();
    return recorded ? recording[channel].back() : std::nan("");
  };
  return {.time_s = time_s,
          .current_A = newest(Channel::current),
          .voltage_V = newest(Channel::voltage),
          .current_a_A = newest(Channel::current_a),
          .current_b_A = newest(Channel::current_b),
          .voltage_a_V = newest(Channel::voltage_a),
          .voltage_b_V = newest(Channel::voltage_b),
          .position_m = newest(Channel::position),
          .oil_temperature_K = newest(Channel::oil_temperature)};
}

/// The newest sample to whoever wants each as it comes, and what they make of dither and plant.
void hand_over(const SimulationOptions& options, const BenchRun& run, double time_s, recording::Recording& recording,
               CoilSupply& coil_supply, PlantParameters& plant) {
  if (options.dither) coil_supply.set_dither(options.dither(measured(recording, run, time_s)));
  if (options.age) options.age(time_s, plant);
  if (options.each_sample) options.each_sample(measured(recording, run, time_s));
  if (options.keeps_recording) return;
  for (const recording::Channel channel : run.channels) recording.column(channel).clear();
}

/// The truth first: see read_scenario.
Simulation nothing_yet(bool whole_valve) {
  GroundTruth truth(whole_valve);
  return {.recording = {}, .truth = std::move(truth)};
}

}  // namespace

Simulation simulate(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed,
                    const SimulationOptions& options) {
  ValveUnderTest tested = valve;
  PlantParameters& plant = tested.plant;
  plant.arrangement = run.arrangement;
  if (run.load) plant.load.kind = *run.load;
  Instruments instruments = valve.instruments;
  instruments.lvdt.fault_rate_per_s += run.position_faults_per_s;

  PlantInput input = surroundings_at_start(run, plant.supply);
  PlantState state = plant_at_rest(plant, input);
  PlantOutput truth = observe(plant, state, input);
  InstrumentPanel panel(instruments, seed, run, truth, input.oil_temperature_C);
  CoilSupply coil_supply(tested, run, seed);
  SpanReader<double> sample_rate(run.sample_rate_Hz);
  SpanReader<double> test(run.test);

  Simulation out = nothing_yet(run.whole_valve);
  const std::int64_t end = std::llround(run.duration_s() / electronics_period_s);
  const std::int64_t ticks_per_report = std::max<std::int64_t>(1, end / 200);
  std::int64_t next_sample = 0, observed = 0;
  for (std::int64_t tick = 0; tick < end; ++tick) {
    const double time_s = static_cast<double>(tick) * electronics_period_s;
    const bool samples = tick == next_sample;
    if (samples || tick % ticks_per_slow_update == 0) {
      truth = observe(plant, state, input);
      panel.follow_plant(truth, input.oil_temperature_C, static_cast<double>(tick - observed) * electronics_period_s);
      observed = tick;
      input.oil_temperature_C = run.oil_temperature_C.at(time_s);
    }
    surround(input, run, plant.supply, time_s);
    if (samples) {
      panel.store(out.recording, run.channels,
                  {.time_s = time_s,
                   .position = run.position_set.at(time_s),
                   .current_A = run.current_A.at(time_s),
                   .pressure_difference_Pa = input.held_pressure_difference_Pa,
                   .test = test.at(time_s, 0)});
      hand_over(options, run, time_s, out.recording, coil_supply, plant);
      if (options.with_truth) {
        truth.time_s = time_s;
        out.truth.add(truth);
      }
      next_sample = tick + sample_ticks(sample_rate.at(time_s, 1000));
    }
    if (options.progress && tick % ticks_per_report == 0) {
      options.progress(static_cast<double>(tick) / static_cast<double>(end));
    }
    const SolenoidVoltages voltages = coil_supply.next(time_s, panel.lvdt, state);
    input.voltage_a_V = voltages.a_V;
    input.voltage_b_V = voltages.b_V;
    step(plant, state, input, electronics_period_s);
    panel.lvdt.follow(state.position_m, input.oil_temperature_C, electronics_period_s);
    panel.follow_coils({.current_a_A = winding_current_A(plant.solenoid_a, state.solenoid_a),
                        .current_b_A = winding_current_A(plant.solenoid_b, state.solenoid_b),
                        .voltage_a_V = voltages.a_V,
                        .voltage_b_V = voltages.b_V});
  }
  return out;
}

}  // namespace spoolflow::rig
