#include "spoolflow/rig/bench/running_bench.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace spoolflow::rig {

namespace {

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

/// What the machine adds; `share` of the held difference is left by its actuator.
void disturb(PlantInput& input, const Machine& machine, const Spool& spool, double share, double time_s) {
  const double ripple_Pa = pump_ripple_Pa(machine.ripple, time_s);
  input.held_pressure_difference_Pa = share * (input.held_pressure_difference_Pa + ripple_Pa);
  input.supply_pressure_Pa += ripple_Pa;
  const double mass_kg = spool.spool_mass_kg + 2 * spool.armature_mass_kg;
  input.foreign_force_N = vibration_force_N(machine.vibration, mass_kg, time_s);
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

ValveUnderTest on_bench(ValveUnderTest valve, const BenchRun& run) {
  valve.plant.arrangement = run.arrangement;
  if (run.load) valve.plant.load.kind = *run.load;
  if (!run.valve_dithers) valve.electronics.dither.amplitude_A = 0;
  return valve;
}

Instruments instruments_of(const ValveUnderTest& valve, const BenchRun& run) {
  Instruments out = valve.instruments;
  out.lvdt.fault_rate_per_s += run.position_faults_per_s;
  return out;
}

}  // namespace

RunningBench::RunningBench(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed)
    : run_(run),
      tested_(on_bench(valve, run)),
      instruments_(instruments_of(valve, run)),
      input_(surroundings_at_start(run, tested_.plant.supply)),
      state_(plant_at_rest(tested_.plant, input_)),
      truth_(observe(tested_.plant, state_, input_)),
      panel_(instruments_, seed, run, truth_, input_.oil_temperature_C),
      coil_supply_(tested_, run, seed),
      actuator_(run.machine.actuator_end),
      sample_rate_(run.sample_rate_Hz),
      test_(run.test) {}

double RunningBench::time_s() const {
  return static_cast<double>(tick_) * electronics_period_s;
}

void RunningBench::store_sample(recording::Recording& recording, const SimulationOptions& options, double time_s) {
  panel_.store(recording, run_.channels,
               {.time_s = time_s,
                .position = run_.position_set.at(time_s),
                .current_A = run_.current_A.at(time_s),
                .pressure_difference_Pa = run_.pressure_difference_Pa.at(time_s),
                .test = test_.at(time_s, 0)});
  hand_over(options, run_, time_s, recording, coil_supply_, tested_.plant);
  truth_.time_s = time_s;
}

bool RunningBench::tick(recording::Recording& recording, const SimulationOptions& options) {
  PlantOutput truth;
  if (wants_truth()) truth = observe(tested_.plant, state_, input_);
  const bool sampled = begin(wants_truth() ? &truth : nullptr, recording, options);
  step(tested_.plant, state_, input_, electronics_period_s);
  follow();
  return sampled;
}

bool RunningBench::begin(const PlantOutput* truth, recording::Recording& recording, const SimulationOptions& options) {
  const double now_s = time_s();
  if (truth != nullptr) {
    truth_ = *truth;
    panel_.follow_plant(truth_, input_.oil_temperature_C,
                        static_cast<double>(tick_ - observed_) * electronics_period_s);
    observed_ = tick_;
    input_.oil_temperature_C = run_.oil_temperature_C.at(now_s);
  }
  surround(input_, run_, tested_.plant.supply, now_s);
  disturb(input_, run_.machine, tested_.plant.spool, actuator_.share(now_s, truth_.flow_m3_per_s, electronics_period_s),
          now_s);
  const bool sampled = samples();
  if (sampled) {
    store_sample(recording, options, now_s);
    next_sample_ = tick_ + sample_ticks(sample_rate_.at(now_s, 1000));
  }
  voltages_ = coil_supply_.next(now_s, panel_.lvdt, state_);
  input_.voltage_a_V = voltages_.a_V;
  input_.voltage_b_V = voltages_.b_V;
  return sampled;
}

void RunningBench::end(const PlantState& state) {
  state_.position_m = state.position_m;
  state_.solenoid_a.flux_linkage_Wb = state.solenoid_a.flux_linkage_Wb;
  state_.solenoid_a.flux_Wb = state.solenoid_a.flux_Wb;
  state_.solenoid_b.flux_linkage_Wb = state.solenoid_b.flux_linkage_Wb;
  state_.solenoid_b.flux_Wb = state.solenoid_b.flux_Wb;
  follow();
}

void RunningBench::follow() {
  panel_.lvdt.follow(state_.position_m, input_.oil_temperature_C, electronics_period_s);
  panel_.follow_coils({.current_a_A = winding_current_A(tested_.plant.solenoid_a, state_.solenoid_a),
                       .current_b_A = winding_current_A(tested_.plant.solenoid_b, state_.solenoid_b),
                       .voltage_a_V = voltages_.a_V,
                       .voltage_b_V = voltages_.b_V});
  ++tick_;
}

}  // namespace spoolflow::rig
