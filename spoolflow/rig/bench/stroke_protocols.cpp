#include "spoolflow/rig/bench/stroke_protocols.hpp"

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {

AxialForceProtocol spring_protocol() {
  return {.pressure_differences_bar = {0}, .oil_temperature_C = 25};
}

BenchRun plan(const AxialForceProtocol& protocol, double stroke_m) {
  using recording::Channel;
  BenchRun run;
  run.arrangement = Arrangement::axial_force_bench;
  run.coil_feed = CoilFeed::none;
  run.load = protocol.load;
  const double rate_m_per_s = stroke_m * protocol.rate_percent_per_s / 100;
  for (const double level_bar : protocol.pressure_differences_bar) {
    const double from_s = run.motion_m.duration_s();
    run.motion_m.ramp_at(stroke_m, rate_m_per_s).hold(protocol.hold_s).ramp_at(0, rate_m_per_s).hold(protocol.hold_s);
    run.pressure_difference_Pa.step_to(units::Pa_from_bar(level_bar)).hold(run.motion_m.duration_s() - from_s);
  }
  run.last_for({.duration_s = run.motion_m.duration_s(),
                .sample_rate_Hz = protocol.sample_rate_Hz,
                .oil_temperature_start_C = protocol.oil_temperature_C,
                .oil_temperature_end_C = protocol.oil_temperature_C + protocol.temperature_rise_K});
  run.channels = {Channel::time,
                  Channel::pressure_difference_set,
                  Channel::pressure_upstream,
                  Channel::pressure_downstream,
                  Channel::oil_temperature,
                  Channel::position,
                  Channel::axial_force,
                  Channel::flow};
  return run;
}

FlowBenchProtocol unpressurised_protocol() {
  return {.pressure_differences_bar = {0, 0}, .fast_rate_percent_per_s = 50, .sample_rate_Hz = 1000};
}

BenchRun plan(const FlowBenchProtocol& protocol) {
  BenchRun run;
  run.valve_dithers = false;  // strokes are sampled too slowly to resolve it
  run.load = protocol.load;
  const auto stroke = [&](double level_bar, double rate_percent_per_s) {
    const double from_s = run.position_set.duration_s(), rate_per_s = rate_percent_per_s / 100;
    run.position_set.hold(protocol.hold_s)
        .ramp_at(1, rate_per_s)
        .hold(protocol.hold_s)
        .ramp_at(0, rate_per_s)
        .hold(protocol.hold_s);
    run.pressure_difference_Pa.step_to(units::Pa_from_bar(level_bar)).hold(run.position_set.duration_s() - from_s);
  };
  for (const double level_bar : protocol.pressure_differences_bar) stroke(level_bar, protocol.rate_percent_per_s);
  if (protocol.fast_rate_percent_per_s > 0)
    stroke(protocol.pressure_differences_bar.back(), protocol.fast_rate_percent_per_s);
  run.last_for({.duration_s = run.position_set.duration_s(),
                .sample_rate_Hz = protocol.sample_rate_Hz,
                .oil_temperature_start_C = protocol.oil_temperature_C,
                .oil_temperature_end_C = protocol.oil_temperature_C + protocol.temperature_rise_K});
  run.channels = metered_channels();
  return run;
}

}  // namespace spoolflow::rig
