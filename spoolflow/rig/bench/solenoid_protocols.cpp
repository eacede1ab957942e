#include "spoolflow/rig/bench/solenoid_protocols.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::rig {
namespace {

using recording::Channel;

BenchRun on_solenoid_bench(double ambient_temperature_C) {
  BenchRun run;
  run.arrangement = Arrangement::solenoid_bench;
  run.coil_feed = CoilFeed::bench_amplifier;
  run.oil_temperature_C = Course(ambient_temperature_C);
  return run;
}

/// Keeps the plan's parts in step: what no command moves holds until now.
class DynamicPlan {
 public:
  DynamicPlan(BenchRun& run, const SolenoidRating& rating) : run_(run), rating_(rating) {}

  Course& current() { return run_.current_A; }
  double amperes(double percent) const { return rating_.rated_current_A * percent / 100; }

  /// Everything that `current` has planned since the last call is test `number`, stored at `rate_Hz`.
  void close(double number, double rate_Hz) {
    const double now_s = run_.current_A.duration_s();
    run_.voltage_V.hold(now_s - run_.voltage_V.duration_s());
    run_.sample_rate_Hz.push_back({now_s, rate_Hz});
    run_.test.push_back({now_s, number});
    run_.voltage_held.push_back({now_s, false});
  }
  void close_voltage_test(double number, double rate_Hz) {
    const double now_s = run_.voltage_V.duration_s();
    run_.current_A.hold(now_s - run_.current_A.duration_s());
    run_.sample_rate_Hz.push_back({now_s, rate_Hz});
    run_.test.push_back({now_s, number});
    run_.voltage_held.push_back({now_s, true});
  }

 private:
  BenchRun& run_;
  const SolenoidRating& rating_;
};

void slow_loops(DynamicPlan& plan, const SolenoidDynamicProtocol& protocol) {
  const double slow_rate_Hz = protocol.slow_rate_Hz;
  plan.current().ramp_for(plan.amperes(protocol.major_loop_percent), 6).ramp_for(0, 6);
  plan.close(1, slow_rate_Hz);
  for (const double share : {0.25, 0.5, 0.75}) {
    plan.current().ramp_for(plan.amperes(share * protocol.major_loop_percent), 3).ramp_for(0, 3);
  }
  plan.close(2, slow_rate_Hz);
  plan.current()
      .step_to(plan.amperes(protocol.bias_percent))
      .sine({.amplitude = plan.amperes(protocol.minor_loop_percent),
             .amplitude_end = 0,
             .frequency_Hz = 1,
             .frequency_end_Hz = 1,
             .duration_s = 10});
  plan.close(3, slow_rate_Hz);
}

void sines(DynamicPlan& plan, const SolenoidDynamicProtocol& protocol) {
  for (const double frequency_Hz : protocol.sine_frequencies_Hz) {
    // Whole cycles, rounded to the slowest sample period so that the next part starts on a sample.
    const double duration_s = std::ceil(std::max(0.4, 10 / frequency_Hz) / 0.005) * 0.005;
    plan.current().sine({.amplitude = plan.amperes(protocol.sine_percent),
                         .amplitude_end = plan.amperes(protocol.sine_percent),
                         .frequency_Hz = frequency_Hz,
                         .frequency_end_Hz = frequency_Hz,
                         .duration_s = duration_s});
  }
  plan.close(4, 5000);
}

}  // namespace

BenchRun plan(const SolenoidForceMapProtocol& protocol, const SolenoidRating& rating) {
  BenchRun run = on_solenoid_bench(protocol.ambient_temperature_C);
  const double levels = std::round(protocol.current_levels);
  const double travel_m = rating.stroke_m * protocol.travel_percent / 100;
  const double speed_m_per_s = rating.stroke_m * protocol.carriage_percent_per_s / 100;
  const double rate_A_per_s = rating.rated_current_A * protocol.current_rate_percent_per_s / 100;
  for (double level = 1; level <= levels; ++level) {
    run.current_A.ramp_at(rating.rated_current_A * level / levels, rate_A_per_s);
    run.motion_m.hold(run.current_A.duration_s() - run.motion_m.duration_s());
    run.motion_m.ramp_at(travel_m, speed_m_per_s).hold(protocol.hold_s).ramp_at(0, speed_m_per_s);
    run.current_A.hold(run.motion_m.duration_s() - run.current_A.duration_s());
  }
  run.dither = {.amplitude_A = rating.rated_current_A * protocol.dither_percent / 100,
                .frequency_Hz = protocol.dither_frequency_Hz};
  run.sample_rate_Hz = {{run.motion_m.duration_s(), protocol.sample_rate_Hz}};
  run.channels = {Channel::time,    Channel::current_set, Channel::current,
                  Channel::voltage, Channel::position,    Channel::force};
  return run;
}

BenchRun plan(const SolenoidDynamicProtocol& protocol, const SolenoidRating& rating) {
  BenchRun run = on_solenoid_bench(protocol.ambient_temperature_C);
  DynamicPlan plan(run, rating);
  run.motion_m = Course(rating.stroke_m * protocol.positions_percent.front() / 100);
  const double carriage_s = 0.005;  // the currentless armature is pushed on between two samples
  for (const double position_percent : protocol.positions_percent) {
    const double position_m = rating.stroke_m * position_percent / 100;
    if (run.current_A.duration_s() > 0) {
      run.motion_m.hold(run.current_A.duration_s() - run.motion_m.duration_s() - carriage_s);
      run.motion_m.ramp_for(position_m, carriage_s);
    }
    slow_loops(plan, protocol);
    sines(plan, protocol);
    run.voltage_V.step_to(rating.rated_voltage_V * protocol.upper_voltage_percent / 100).hold(0.15);
    run.voltage_V.step_to(rating.rated_voltage_V * protocol.lower_voltage_percent / 100).hold(0.15);
    plan.close_voltage_test(5, 10000);
    run.current_A.step_to(plan.amperes(protocol.bias_percent)).ramp_for(0, 0.3);
    // Currentless until the next whole multiple of 0.1 s, so that files read well.
    const double rest_s = 0.1 + std::ceil(run.current_A.duration_s() * 10 - 1e-6) / 10 - run.current_A.duration_s();
    run.current_A.hold(rest_s);
    plan.close(6, protocol.slow_rate_Hz);
  }
  run.dither = {.amplitude_A = rating.rated_current_A * protocol.dither_percent / 100,
                .frequency_Hz = protocol.dither_frequency_Hz};
  run.channels = {Channel::time, Channel::test, Channel::current, Channel::voltage, Channel::position, Channel::force};
  return run;
}

}  // namespace spoolflow::rig
