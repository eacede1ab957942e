#include "spoolflow/rig/bench/protocol.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace spoolflow::rig {
namespace {

RampsProtocol temperature_sweep() {
  return {.conditions = {.oil_temperature_start_C = 30, .oil_temperature_end_C = 75},
          .pressure_differences_bar = {50, 50, 50, 50, 50}};
}

/// Moves that last some milliseconds, seen by the fast recorder.
DutyCycleProtocol fast_motion() {
  return {.conditions = {.sample_rate_Hz = 10000},
          .duration_s = 20,
          .lowest_percent = 15,
          .highest_percent = 95,
          .slowest_percent_per_s = 100,
          .fastest_percent_per_s = 4000,
          .longest_hold_s = 0.3,
          .lowest_pressure_bar = 20,
          .highest_pressure_bar = 70,
          .longest_pressure_hold_s = 3};
}

SolenoidRating solenoid_rating(const ValveUnderTest& valve) {
  return {.rated_current_A = valve.rating.current_A,
          .rated_voltage_V = valve.rating.current_A * valve.electronics.current.feed_forward_ohm,
          .stroke_m = valve.plant.spool.stroke_m};
}

/// A whole valve's operation: signed flow, the difference of the open path, both coils.
void make_whole(BenchRun& run) {
  using recording::Channel;
  run.whole_valve = true;
  std::vector<Channel> channels;
  for (const Channel channel : run.channels) {
    if (channel == Channel::current) {
      channels.insert(channels.end(), {Channel::current_a, Channel::current_b});
    } else if (channel == Channel::voltage) {
      channels.insert(channels.end(), {Channel::voltage_a, Channel::voltage_b});
    } else {
      channels.push_back(channel);
    }
  }
  run.channels = std::move(channels);
}

}  // namespace

const std::vector<NamedProtocol>& protocols() {
  static const std::vector<NamedProtocol> all{
      {"spring", "the axial-force bench without pressure", spring_protocol()},
      {"solenoid_force_map", "a carriage moves the armature to and fro at each held current",
       SolenoidForceMapProtocol{}},
      {"solenoid_dynamic", "current loops, sines and voltage steps at held positions", SolenoidDynamicProtocol{}},
      {"axial_force_map", "an external drive opens and closes the spool at each pressure difference",
       AxialForceProtocol{}},
      {"unpressurised_strokes", "two slow strokes and a fast one by the valve's own solenoid, pump off",
       unpressurised_protocol()},
      {"metering", "a slow stroke by the valve's own solenoid at each pressure difference, beside a flow meter",
       FlowBenchProtocol{}},
      {"ramps", "triangles with holds, one for each pressure difference", RampsProtocol{}},
      {"temperature_sweep", "triangles while the oil warms", temperature_sweep()},
      {"steps", "set positions one after the other", StepsProtocol{}},
      {"sine", "a sine on the set position, or a sweep", SineProtocol{}},
      {"duty_cycle", "random ramps and holds, random pressure steps", DutyCycleProtocol{}},
      {"fast_motion", "the duty cycle's moves within milliseconds, recorded at 10 kHz", fast_motion()},
      {"pressure_steps", "steps of the pressure difference while the spool rests", PressureStepsProtocol{}},
  };
  return all;
}

Protocol protocol_named(std::string_view name) {
  for (const NamedProtocol& protocol : protocols()) {
    if (protocol.name == name) {
      return protocol.settings;
    }
  }
  throw std::out_of_range("no protocol is named " + std::string(name));
}

bool is_bench_test(const Protocol& protocol) {
  return std::holds_alternative<AxialForceProtocol>(protocol) ||
         std::holds_alternative<SolenoidForceMapProtocol>(protocol) ||
         std::holds_alternative<SolenoidDynamicProtocol>(protocol) ||
         std::holds_alternative<FlowBenchProtocol>(protocol);
}

BenchRun plan(const Protocol& protocol, const ValveUnderTest& valve, std::uint64_t seed) {
  struct Plan {
    const ValveUnderTest& valve;
    std::uint64_t seed;
    BenchRun operator()(AxialForceProtocol settings) const {
      if (valve.whole && !settings.load) settings.load = LoadKind::held_path;
      return plan(settings, valve.plant.spool.stroke_m);
    }
    BenchRun operator()(const SolenoidForceMapProtocol& settings) const {
      return plan(settings, solenoid_rating(valve));
    }
    BenchRun operator()(const SolenoidDynamicProtocol& settings) const {
      return plan(settings, solenoid_rating(valve));
    }
    BenchRun operator()(FlowBenchProtocol settings) const {
      if (valve.whole && !settings.load) settings.load = LoadKind::held_path;
      return plan(settings);
    }
    BenchRun operator()(const RampsProtocol& settings) const { return plan(settings); }
    BenchRun operator()(const StepsProtocol& settings) const { return plan(settings); }
    BenchRun operator()(const SineProtocol& settings) const { return plan(settings); }
    BenchRun operator()(const DutyCycleProtocol& settings) const { return plan(settings, seed); }
    BenchRun operator()(const PressureStepsProtocol& settings) const { return plan(settings); }
  };
  BenchRun run = std::visit(Plan{valve, seed}, protocol);
  if (valve.whole && !is_bench_test(protocol)) make_whole(run);
  return run;
}

}  // namespace spoolflow::rig
