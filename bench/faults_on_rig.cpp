/// Faults of the signals put in at random while a virtual valve works, against the plant's true flow: how many are
/// reported and how soon, the share of samples inside the 95 % band while a fault stands and in the second after it,
/// how long the answer stays off, and how many faults are reported where there is none.
///
///     spoolflow campaign size_6 -o size_6 && spoolflow calibrate size_6/campaign.toml -o size_6.json
///     faults_on_rig size_6.json size_6 [KEY=NUMBER ...]
///
/// VALVE is a preset or a valve file, as of `spoolflow campaign`. Keys: runs (of each kind of operation); seed; every
/// (mean time between faults, s); rate (samples per second).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/on_rig_valve.hpp"
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace {

using namespace spoolflow;
using bench::Settings;
using estimation::TimedSample;
using sensor::Status;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
/// A report later than this after a fault's end belongs to something else [s].
constexpr double late_s = 0.3;
/// The answer is back where it differs from that without faults by less than this share of the rated flow, ...
constexpr double back_share = 0.02;
/// ... which is looked for so long [s]. The next fault does not begin before.
constexpr double after_s = 2;

enum class Kind { spike, jump, shift, stuck, no_position, no_current, zero_current, no_voltage, temperature };

struct FaultKind {
  Kind kind;
  const char* name;
  double shortest_s, longest_s;
  Status reported;
};
constexpr std::array fault_kinds{
    FaultKind{Kind::spike, "position: one sample off by 0.1 to 1 mm", 0, 0, Status::position_fault},
    FaultKind{Kind::jump, "position: off by 0.1 to 1 mm, 5 to 200 ms", 5e-3, 0.2, Status::position_fault},
    FaultKind{Kind::shift, "position: off by 0.1 to 1 mm, 0.5 to 1.5 s", 0.5, 1.5, Status::position_fault},
    FaultKind{Kind::stuck, "position stands still, 50 ms to 1 s", 0.05, 1, Status::position_fault},
    FaultKind{Kind::no_position, "position missing, 2 to 200 ms", 2e-3, 0.2, Status::sample_missing},
    FaultKind{Kind::no_current, "current missing, 2 to 200 ms", 2e-3, 0.2, Status::sample_missing},
    FaultKind{Kind::zero_current, "current reads zero, 50 ms to 1 s", 0.05, 1, Status::coil_fault},
    FaultKind{Kind::no_voltage, "voltage reads zero, 0.2 to 1.5 s", 0.2, 1.5, Status::coil_fault},
    FaultKind{Kind::temperature, "temperature off by 30 to 200 K, 0.1 to 1.5 s", 0.1, 1.5, Status::temperature_fault},
};

struct Fault {
  double begin_s, end_s;
  double size;  ///< -1 to 1, no less than a tenth
};

/// Uniform numbers that are the same everywhere.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  /// By orders of magnitude evenly.
  double orders(double low, double high) { return low > 0 ? low * std::pow(high / low, share()) : 0; }
  double sign() { return share() < 0.5 ? -1 : 1; }

 private:
  std::mt19937_64 engine_;
};

std::vector<Fault> faults(const FaultKind& kind, Chance& chance, double from_s, double to_s, double every_s) {
  std::vector<Fault> out;
  for (double time_s = from_s + chance.between(0, every_s); time_s < to_s;) {
    const double end_s = time_s + chance.orders(kind.shortest_s, kind.longest_s);
    out.push_back({time_s, end_s, chance.sign() * chance.between(0.1, 1)});
    time_s = end_s + after_s - every_s * std::log(1 - chance.share());
  }
  return out;
}

/// `held`: the position when the fault began.
TimedSample hit(TimedSample sample, const FaultKind& kind, const Fault& fault, double held_m) {
  switch (kind.kind) {
    case Kind::spike:
    case Kind::jump:
    case Kind::shift:
      sample.position_m += 1e-3 * fault.size;
      break;
    case Kind::stuck:
      sample.position_m = held_m;
      break;
    case Kind::no_position:
      sample.position_m = missing;
      break;
    case Kind::no_current:
      sample.current_A = missing;
      break;
    case Kind::zero_current:
      sample.current_A = 0;
      break;
    case Kind::no_voltage:
      sample.voltage_V = 0;
      break;
    case Kind::temperature:
      sample.oil_temperature_K += std::copysign(30 + 170 * (std::abs(fault.size) - 0.1) / 0.9, fault.size);
      break;
  }
  return sample;
}

/// Samples inside the band, of how many.
struct Share {
  double inside = 0, of = 0;
  void count(bool holds) {
    inside += holds ? 1 : 0;
    ++of;
  }
  [[nodiscard]] std::string percent() const { return of > 0 ? fmt::format("{:.1f}", 100 * inside / of) : "-"; }
};

struct Outcome {
  int faults = 0, reported = 0;
  std::vector<double> reported_after_s{}, back_after_s{};
  Share during{}, after{};
  double largest_error = 0;  ///< while it stands, share of the rated flow
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return missing;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// One run as recorded, and what the sensor answers without faults.
struct Run {
  std::vector<TimedSample> samples;
  std::vector<double> truth_m3_per_s;
  std::vector<sensor::Estimate<double>> sound;
};

bool holds(const sensor::Estimate<double>& answer, double truth) {
  return answer.flow_lower_m3_per_s <= truth && truth <= answer.flow_upper_m3_per_s;
}

void put_in(const model::Model& model, const Run& run, const FaultKind& kind, Chance& chance, double every_s,
            Outcome& out) {
  const double rated = model.valve.rated_flow_m3_per_s;
  const std::vector<Fault> all =
      faults(kind, chance, run.samples.front().time_s + 3, run.samples.back().time_s - after_s, every_s);
  estimation::RunningSensor sensor(&model.observer.value().parameters, rated);
  std::size_t next = 0;
  double held_m = 0, reported_s = missing, off_s = 0;
  bool in_fault = false;
  const auto close = [&] {
    const Fault& fault = all[next++];
    ++out.faults;
    if (!std::isnan(reported_s)) {
      ++out.reported;
      out.reported_after_s.push_back(reported_s - fault.begin_s);
    }
    out.back_after_s.push_back(off_s);
    reported_s = missing;
    off_s = 0;
    in_fault = false;
  };
  for (std::size_t k = 0; k < run.samples.size(); ++k) {
    TimedSample sample = run.samples[k];
    if (next < all.size() && sample.time_s > all[next].end_s + after_s && in_fault) close();
    const bool near = next < all.size() && sample.time_s >= all[next].begin_s;
    // One sample at least.
    const bool stands = near && (sample.time_s < all[next].end_s || !in_fault);
    if (stands) {
      if (!in_fault) held_m = sample.position_m;
      in_fault = true;
      sample = hit(sample, kind, all[next], held_m);
    }
    const sensor::Estimate<double> answer = sensor.step(sample);
    if (!near) continue;
    const Fault& fault = all[next];
    const bool inside = holds(answer, run.truth_m3_per_s[k]);
    if (stands) {
      out.during.count(inside);
      out.largest_error = std::max(out.largest_error, std::abs(answer.flow_m3_per_s - run.truth_m3_per_s[k]) / rated);
    } else if (sample.time_s < fault.end_s + 1) {
      out.after.count(inside);
    }
    if (!stands && std::abs(answer.flow_m3_per_s - run.sound[k].flow_m3_per_s) > back_share * rated)
      off_s = sample.time_s - fault.end_s;
    if (std::isnan(reported_s) && sample.time_s < fault.end_s + late_s && has(answer.status, kind.reported) &&
        !has(run.sound[k].status, kind.reported))
      reported_s = sample.time_s;
  }
  if (in_fault) close();
}

std::vector<Run> sound_runs(const model::Model& model, const rig::ValveUnderTest& valve, Settings& set) {
  std::vector<rig::BenchRun> plans;
  const auto seed = static_cast<std::uint64_t>(set["seed"]);
  const auto runs = static_cast<std::uint64_t>(set["runs"]);
  for (std::uint64_t k = 0; k < runs; ++k) {
    rig::DutyCycleProtocol duty{.conditions = {}, .duration_s = 60};
    plans.push_back(plan(duty, 100 * seed + k));
    duty.slowest_percent_per_s = 300;
    duty.fastest_percent_per_s = 30000;
    duty.longest_hold_s = 0.5;
    plans.push_back(plan(duty, 100 * seed + 50 + k));
    plans.push_back(plan(rig::StepsProtocol{}));
    plans.push_back(plan(rig::SineProtocol{}));
    plans.push_back(plan(rig::RampsProtocol{}));
  }
  std::vector<Run> out;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    rig::BenchRun& planned = plans[p];
    for (rig::Span<double>& rate : planned.sample_rate_Hz) rate.value = set["rate"];
    const rig::Simulation simulated = rig::simulate(valve, planned, 1000 * seed + p, {.with_truth = true});
    const auto& truth_L_min = simulated.truth["flow_L_min"];
    Run run;
    estimation::RunningSensor sensor(&model.observer.value().parameters, model.valve.rated_flow_m3_per_s);
    for (std::size_t k = 0; k < truth_L_min.size(); ++k) {
      using recording::Channel;
      const auto of = [&](Channel channel) { return simulated.recording[channel][k]; };
      run.samples.push_back({of(Channel::time), of(Channel::current), of(Channel::voltage), of(Channel::position),
                             of(Channel::oil_temperature)});
      run.truth_m3_per_s.push_back(truth_L_min[k] / 6e4);
      run.sound.push_back(sensor.step(run.samples.back()));
    }
    out.push_back(std::move(run));
  }
  return out;
}

/// Faults that are reported where there is none.
void print_false(const std::vector<Run>& runs) {
  double hours = 0;
  for (const Run& run : runs) hours += (run.samples.back().time_s - run.samples.front().time_s) / 3600;
  fmt::print("sound signals, {:.2f} h of {} runs:\n", hours, runs.size());
  for (const auto& [status, name] :
       {std::pair{Status::position_fault, "position_fault"}, std::pair{Status::coil_fault, "coil_fault"},
        std::pair{Status::temperature_fault, "temperature_fault"}}) {
    int episodes = 0;
    double samples = 0, all = 0;
    Share inside;
    for (const Run& run : runs) {
      bool before = false;
      for (std::size_t k = 0; k < run.sound.size(); ++k) {
        const bool reported = has(run.sound[k].status, status);
        episodes += reported && !before ? 1 : 0;
        before = reported;
        ++all;
        if (!reported) continue;
        ++samples;
        inside.count(holds(run.sound[k], run.truth_m3_per_s[k]));
      }
    }
    fmt::print("  {:<18} {} times, {:.4f} % of the samples, inside the band while reported {} %\n", name, episodes,
               100 * samples / all, inside.percent());
  }
}

void meet_faults(const model::Model& model, const rig::ValveUnderTest& valve, Settings set) {
  const std::vector<Run> runs = sound_runs(model, valve, set);
  print_false(runs);
  Share sound;
  for (const Run& run : runs)
    for (std::size_t k = 0; k < run.sound.size(); ++k) sound.count(holds(run.sound[k], run.truth_m3_per_s[k]));
  fmt::print("  inside the band without faults {} %\n\n", sound.percent());
  fmt::print(
      "| fault | times | reported | after, median ms | inside the band while it stands | in the second after | off by "
      "more than {:.0f} % so long after, 50 %; 95 % ms | largest error, % |\n|---|---|---|---|---|---|---|---|\n",
      100 * back_share);
  for (const FaultKind& kind : fault_kinds) {
    Chance chance(static_cast<std::uint64_t>(set["seed"]) * 31 + static_cast<std::uint64_t>(kind.kind));
    Outcome out;
    for (const Run& run : runs) put_in(model, run, kind, chance, set["every"], out);
    fmt::print("| {} | {} | {:.1f} % | {:.0f} | {} % | {} % | {:.0f}; {:.0f} | {:.0f} |\n", kind.name, out.faults,
               100.0 * out.reported / std::max(1, out.faults), 1e3 * quantile(out.reported_after_s, 0.5),
               out.during.percent(), out.after.percent(), 1e3 * quantile(out.back_after_s, 0.5),
               1e3 * quantile(out.back_after_s, 0.95), 100 * out.largest_error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return spoolflow::bench::on_rig_valve("faults_on_rig", argc, argv,
                                        {{"runs", 4}, {"seed", 1}, {"every", 3}, {"rate", 1000}},
                                        [](const auto&... each) { meet_faults(each...); });
}
