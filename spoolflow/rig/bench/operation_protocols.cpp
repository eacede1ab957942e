#include "spoolflow/rig/bench/operation_protocols.hpp"

#include <cmath>

#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

/// Completes a run whose courses are planned, under those conditions.
BenchRun under(const OperationConditions& conditions, BenchRun run, double duration_s) {
  run.last_for(
      {duration_s, conditions.sample_rate_Hz, conditions.oil_temperature_start_C, conditions.oil_temperature_end_C});
  run.supply_pressure_Pa = Course(units::Pa_from_bar(conditions.supply_pressure_bar));
  run.supply_follows_difference = conditions.supply_follows_difference;
  run.position_faults_per_s = conditions.position_faults_per_s;
  run.channels = metered_channels();
  if (conditions.port_pressures) {
    run.channels.insert(run.channels.end(),
                        {Channel::pressure_p, Channel::pressure_a, Channel::pressure_b, Channel::pressure_t});
  }
  return run;
}

/// As long as its position course.
BenchRun under(const OperationConditions& conditions, BenchRun run) {
  const double duration_s = run.position_set.duration_s();
  return under(conditions, std::move(run), duration_s);
}

double share(double percent) {
  return percent / 100;
}

}  // namespace

BenchRun plan(const RampsProtocol& protocol) {
  BenchRun run;
  const double rate_per_s = share(protocol.rate_percent_per_s);
  for (const double level_bar : protocol.pressure_differences_bar) {
    const double from_s = run.position_set.duration_s();
    std::vector<double> peaks_percent{protocol.peak_percent};
    if (protocol.second_peak_percent != 0) peaks_percent.push_back(protocol.second_peak_percent);
    for (const double peak_percent : peaks_percent) {
      run.position_set.hold(protocol.pause_s)
          .ramp_at(share(peak_percent), rate_per_s)
          .hold(protocol.hold_s)
          .ramp_at(0, rate_per_s)
          .hold(protocol.pause_s);
    }
    run.pressure_difference_Pa.step_to(units::Pa_from_bar(level_bar)).hold(run.position_set.duration_s() - from_s);
  }
  return under(protocol.conditions, std::move(run));
}

BenchRun plan(const StepsProtocol& protocol) {
  BenchRun run;
  run.position_set.hold(0.2);
  for (const double position_percent : protocol.positions_percent) {
    run.position_set.ramp_at(share(position_percent), share(protocol.rate_percent_per_s)).hold(protocol.hold_s);
  }
  run.pressure_difference_Pa = Course(units::Pa_from_bar(protocol.pressure_difference_bar));
  return under(protocol.conditions, std::move(run));
}

BenchRun plan(const SineProtocol& protocol) {
  BenchRun run;
  run.position_set.hold(0.5).ramp_for(share(protocol.centre_percent), 1).hold(1);
  run.position_set.sine({.amplitude = share(protocol.amplitude_percent),
                         .amplitude_end = share(protocol.amplitude_percent),
                         .frequency_Hz = protocol.frequency_start_Hz,
                         .frequency_end_Hz = protocol.frequency_end_Hz,
                         .duration_s = protocol.sweep_s});
  run.position_set.hold(1).ramp_for(0, 1).hold(0.5);
  run.pressure_difference_Pa = Course(units::Pa_from_bar(protocol.pressure_difference_bar));
  return under(protocol.conditions, std::move(run));
}

BenchRun plan(const DutyCycleProtocol& protocol, std::uint64_t seed) {
  BenchRun run;
  Noise positions(seed, "duty cycle positions");
  const double rate_span = natural_logarithm(protocol.fastest_percent_per_s / protocol.slowest_percent_per_s);
  // A valve that opens to both sides begins in its centre, where its springs hold it before the run.
  run.position_set = Course(share(std::fmax(protocol.lowest_percent, std::fmin(0.0, protocol.highest_percent))));
  run.position_set.hold(0.5);
  while (run.position_set.duration_s() < protocol.duration_s) {
    const double to_percent = positions.uniform(protocol.lowest_percent, protocol.highest_percent);
    const double rate_percent_per_s = protocol.slowest_percent_per_s * exponential(rate_span * positions.uniform());
    run.position_set.ramp_at(share(to_percent), share(rate_percent_per_s));
    run.position_set.hold(positions.uniform(0.1, std::fmax(0.1, protocol.longest_hold_s)));
  }
  Noise pressures(seed, "duty cycle pressures");
  run.pressure_difference_Pa = Course(units::Pa_from_bar(protocol.lowest_pressure_bar));
  run.pressure_difference_Pa.hold(0.5);
  while (run.pressure_difference_Pa.duration_s() < protocol.duration_s) {
    const double to_bar = pressures.uniform(protocol.lowest_pressure_bar, protocol.highest_pressure_bar);
    run.pressure_difference_Pa.ramp_for(units::Pa_from_bar(to_bar), pressures.uniform(0.05, 0.8));
    run.pressure_difference_Pa.hold(
        pressures.uniform(0.1 * protocol.longest_pressure_hold_s, protocol.longest_pressure_hold_s));
  }
  if (protocol.lowest_load_N != 0 || protocol.highest_load_N != 0) {
    Noise loads(seed, "duty cycle loads");
    run.load_force_N.hold(0.5);
    while (run.load_force_N.duration_s() < protocol.duration_s) {
      run.load_force_N.ramp_for(loads.uniform(protocol.lowest_load_N, protocol.highest_load_N),
                                loads.uniform(0.2, 1.0));
      run.load_force_N.hold(loads.uniform(0.1 * protocol.longest_pressure_hold_s, protocol.longest_pressure_hold_s));
    }
  }
  return under(protocol.conditions, std::move(run), protocol.duration_s);
}

BenchRun plan(const PressureStepsProtocol& protocol) {
  BenchRun run;
  run.pressure_difference_Pa = Course(units::Pa_from_bar(protocol.pressure_differences_bar.front()));
  run.position_set.hold(0.5);
  for (const double position_percent : protocol.positions_percent) {
    run.position_set.ramp_at(share(position_percent), 0.5).hold(1);
    run.pressure_difference_Pa.hold(run.position_set.duration_s() - run.pressure_difference_Pa.duration_s());
    for (const double level_bar : protocol.pressure_differences_bar) {
      run.pressure_difference_Pa.step_to(units::Pa_from_bar(level_bar)).hold(protocol.hold_s);
    }
    run.position_set.hold(run.pressure_difference_Pa.duration_s() - run.position_set.duration_s());
  }
  run.position_set.ramp_at(0, 0.5).hold(0.5);
  return under(protocol.conditions, std::move(run));
}

}  // namespace spoolflow::rig
