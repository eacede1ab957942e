#include "addons/live/sources/rig_source.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::live {
namespace {

constexpr double shift_s = 1800;  ///< of work that is planned at a time
constexpr double piece_s = 0.01;  ///< of samples that are handed over together, of the time in which they come
constexpr std::size_t largest_block = 1024;
constexpr double ages_every_s = 1;

struct Stopped {};

rig::Protocol strokes(bool whole) {
  constexpr double stroke_s = 43;
  rig::RampsProtocol ramps;
  ramps.pressure_differences_bar.assign(static_cast<std::size_t>(shift_s / stroke_s), 60);
  ramps.hold_s = 1;
  if (whole) ramps.second_peak_percent = -100;
  return ramps;
}

rig::Protocol work(RigWork kind, bool whole) {
  if (kind == RigWork::strokes) return strokes(whole);
  rig::DutyCycleProtocol duty;
  duty.duration_s = shift_s;
  duty.lowest_percent = whole ? -100 : 0;
  duty.lowest_pressure_bar = 20;
  return duty;
}

estimation::TimedSample timed(const rig::MeasuredSample& in, double added_s) {
  estimation::TimedSample out{in.time_s + added_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K};
  if (!std::isnan(in.current_b_A)) {
    out.current_A = in.current_b_A;
    out.voltage_V = in.voltage_b_V;
    out.current_a_A = in.current_a_A;
    out.voltage_a_V = in.voltage_a_V;
  }
  return out;
}

}  // namespace

rig::PlantParameters aged(const rig::PlantParameters& plant, const Ageing& ageing, double worked_s) {
  const double share = std::clamp((worked_s - ageing.after_s) / ageing.over_s, 0.0, 1.0);
  rig::Wear wear = ageing.until;
  wear.edge_rounding_m *= share;
  wear.friction_factor = 1 + share * (wear.friction_factor - 1);
  wear.spring_relaxation *= share;
  wear.shorted_turns_fraction *= share;
  wear.added_resistance_ohm *= share;
  return rig::worn(plant, wear);
}

RigSource::RigSource(RigSettings settings, SourcePosition after, Intake& intake)
    : settings_(std::move(settings)), next_(after.next), intake_(intake) {
  intake_.count_connection();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void RigSource::run(const std::stop_token& stop) {
  const rig::ValveUnderTest valve = rig::as_built(settings_.valve);
  const parallel::SteadyTime begin = std::chrono::steady_clock::now();
  const double period_s = 0.001;
  double worked_s = static_cast<double>(next_) * period_s;  // before this start of the program, too: wear stays
  const double before_s = worked_s;
  try {
    for (std::uint64_t shift = 0;; ++shift) {
      const double added_s = worked_s;
      const std::uint64_t seed = settings_.seed + 1000 * (next_ + shift);
      const rig::BenchRun run = rig::plan(work(settings_.work, valve.whole), valve, seed);
      SampleBlock block;
      rig::PlantParameters plant = valve.plant;
      bool begun = false;
      double last_aged_s = -2 * ages_every_s;
      rig::SimulationOptions options{.keeps_recording = false};
      options.each_sample = [&](const rig::MeasuredSample& sample) {
        block.samples.push_back(timed(sample, added_s));
        ++next_;
        worked_s = block.samples.back().time_s + period_s;
        const double length_s = block.samples.back().time_s - block.samples.front().time_s;
        if (length_s < piece_s * settings_.speed && block.samples.size() < largest_block) return;
        const auto due = std::chrono::duration<double>((worked_s - before_s) / settings_.speed);
        if (!parallel::wait_until(begin + std::chrono::duration_cast<std::chrono::nanoseconds>(due), stop))
          throw Stopped();
        block.after.next = next_;
        block.arrived_ns = steady_ns();
        intake_.push(std::exchange(block, {}));
      };
      options.age = [&](double time_s, rig::PlantParameters& now) {
        if (!begun) plant = now;
        begun = true;
        if (time_s - last_aged_s < ages_every_s) return;
        last_aged_s = time_s;
        now = aged(plant, settings_.ageing, added_s + time_s);
      };
      (void)rig::simulate(valve, run, seed, options);
    }
  } catch (const Stopped&) {  // wanted
  } catch (const std::exception& error) {
    intake_.set_trouble(error.what());
  }
}

}  // namespace spoolflow::live
