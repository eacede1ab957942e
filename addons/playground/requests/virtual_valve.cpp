#include "addons/playground/requests/virtual_valve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/protocol.hpp"

namespace spoolflow::playground {
namespace {

/// What the run records; its courses are drawn on while it works.
rig::BenchRun waiting_run(const rig::ValveUnderTest& valve) {
  rig::RampsProtocol ramps;
  rig::BenchRun run = rig::plan(rig::Protocol(ramps), valve, 1);
  run.position_set = rig::Course(0);
  run.pressure_difference_Pa = rig::Course(ValveSettings().pressure_difference_Pa);
  run.oil_temperature_C = rig::Course(ValveSettings().oil_temperature_C);
  return run;
}

/// The course goes on as it was until now and from there to the value, in that time.
void turn(rig::Course& course, double now_s, double value, double duration_s) {
  if (course.last() == value) return;
  if (course.duration_s() < now_s) course.hold(now_s - course.duration_s());
  course.ramp_for(value, duration_s);
}

}  // namespace

VirtualValve::VirtualValve(model::Model model, std::uint64_t seed)
    : model_(std::move(model)),
      valve_(rig::as_built(rig::valve_preset("size_6"))),
      run_(waiting_run(valve_)),
      bench_(std::make_unique<rig::RunningBench>(valve_, run_, seed)),
      sensor_(estimation::running_sensor(model_, estimation::best_estimator(model_))) {}

void VirtualValve::take(const ValveSettings& settings) {
  constexpr double command_s = 0.02, pressure_s = 0.05, warming_K_per_s = 10;
  const double now_s = bench_->time_s();
  turn(run_.position_set, now_s, std::clamp(settings.command, 0.0, 1.0), command_s);
  turn(run_.pressure_difference_Pa, now_s, std::clamp(settings.pressure_difference_Pa, 0.0, 100e5), pressure_s);
  const double oil_C = std::clamp(settings.oil_temperature_C, 10.0, 90.0);
  turn(run_.oil_temperature_C, now_s, oil_C, std::abs(oil_C - run_.oil_temperature_C.at(now_s)) / warming_K_per_s);
  dither_ = valve_.electronics.dither;
  dither_.amplitude_A = std::clamp(settings.dither_amplitude_A, 0.0, 0.5);
  dither_.frequency_Hz = std::clamp(settings.dither_frequency_Hz, 20.0, 400.0);
  wear_.edge_rounding_m = std::clamp(settings.edge_rounding_m, 0.0, 8e-5);
  wear_.friction_factor = std::clamp(settings.friction_factor, 0.2, 5.0);
}

std::vector<PlayedSample> VirtualValve::work(const ValveSettings& settings, double duration_s) {
  take(settings);
  std::vector<PlayedSample> out;
  std::optional<estimation::TimedSample> measured;
  rig::SimulationOptions options{.keeps_recording = false};
  options.dither = [this](const rig::MeasuredSample&) { return dither_; };
  options.age = [this](double, rig::PlantParameters& plant) {
    const rig::PlantParameters now = rig::worn(valve_.plant, wear_);
    plant.edge_PA = now.edge_PA, plant.edge_PB = now.edge_PB, plant.edge_AT = now.edge_AT, plant.edge_BT = now.edge_BT;
    plant.spool_friction = now.spool_friction;
    plant.solenoid_a.friction = now.solenoid_a.friction;
    plant.solenoid_b.friction = now.solenoid_b.friction;
  };
  options.each_sample = [&](const rig::MeasuredSample& sample) {
    measured = {sample.time_s, sample.current_A, sample.voltage_V, sample.position_m, sample.oil_temperature_K};
  };
  const double end_s = bench_->time_s() + duration_s;
  const double roundoff_s = 1e-9;
  while (bench_->time_s() < end_s - roundoff_s) {
    if (!bench_->tick(recording_, options)) continue;
    const sensor::Estimate<double> answer = sensor_.step(*measured);
    out.push_back({.time_s = measured->time_s,
                   .flow_m3_per_s = answer.flow_m3_per_s,
                   .flow_lower_m3_per_s = answer.flow_lower_m3_per_s,
                   .flow_upper_m3_per_s = answer.flow_upper_m3_per_s,
                   .true_flow_m3_per_s = bench_->truth().flow_m3_per_s,
                   .position_m = measured->position_m,
                   .current_A = measured->current_A,
                   .status = answer.status});
  }
  return out;
}

}  // namespace spoolflow::playground
