/// How small a fault may be that the monitor still finds: valves of the virtual rig with one fault each, judged by
/// the model of the healthy valve, one hundred strokes a case, without a baseline.
///
///     monitor_limits VALVE=MODEL.json [VALVE=MODEL.json ...] [KEY=NUMBER ...]
///
/// VALVE is PRESET or PRESET:SEED (drawn from a series), MODEL.json what `campaign` and `calibrate` make of it. Case k
/// takes valve k modulo their number and has its own noise, strokes, pressure differences and oil temperature. Of each
/// fault the smallest level is sought by halving that is found, raised and with its own cause first, in all cases but
/// one of twenty. With band=1 instead: how far the sensor's band holds while faults of usual size are raised, and the
/// band widened by what the monitor says, against the true flow; one run a valve and fault. Keys: cases; strokes;
/// dithered (0, 1; both if absent); fault (its number, or that after the last for healthy valves; all if absent);
/// alarms (wanted a year); amplitude (of the dither, A), frequency (Hz); slowest, fastest (of the strokes, % of the
/// stroke/s); lowest, highest (level that is tried, in the unit of the fault).
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/monitor.hpp"
#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace {

using namespace spoolflow;
using Settings = std::map<std::string, double>;

struct Valve {
  std::string name;
  rig::ValveUnderTest healthy;  ///< before spread and wear
  model::Model model;
  double rated_bar;
};

struct FaultKind {
  const char* name;
  const char* unit;
  monitor::Fault cause;
  std::vector<double> levels;
  void (*apply)(rig::ValveUnderTest& valve, double level);
};

void weaken(rig::ValveUnderTest& valve, double percent) {
  for (rig::Spring* spring : {&valve.plant.spring_a, &valve.plant.spring_b}) {
    spring->preload_N *= 1 - 0.01 * percent;
    spring->rate_N_per_m *= 1 - 0.0055 * percent;
  }
}

const std::vector<FaultKind>& kinds() {
  using monitor::Fault;
  using Tested = rig::ValveUnderTest;
  static const std::vector<FaultKind> all{
      {"friction",
       "% more",
       Fault::friction,
       {20, 30, 40, 50, 60, 80, 100, 150},
       [](Tested& valve, double level) { valve.wear.friction_factor = 1 + 0.01 * level; }},
      {"edge rounding",
       "um",
       Fault::edge_wear,
       {15, 20, 25, 30, 35, 40, 45, 50, 60, 75},
       [](Tested& valve, double level) { valve.wear.edge_rounding_m = 1e-6 * level; }},
      {"spring preload (rate 0.55 of it)", "% less", Fault::spring, {4, 5, 6, 7, 8, 9, 10, 12, 15, 20}, weaken},
      {"shorted turns",
       "%",
       Fault::coil,
       {2, 2.5, 3, 3.5, 4, 5, 6, 8, 12},
       [](Tested& valve, double level) { valve.wear.shorted_turns_fraction = 0.01 * level; }},
      {"resistance",
       "% more",
       Fault::coil,
       {20, 30, 35, 40, 45, 50, 60, 70, 80},
       [](Tested& valve, double level) {
         valve.wear.added_resistance_ohm = 0.01 * level * valve.plant.solenoid_b.coil.resistance_20C_ohm;
       }},
      {"position zero, up",
       "um",
       Fault::position_sensor,
       {12, 15, 18, 20, 25, 30, 35, 40, 50, 60},
       [](Tested& valve, double level) { valve.instruments.lvdt.zero_offset_m += 1e-6 * level; }},
      {"position zero, down",
       "um",
       Fault::position_sensor,
       {12, 15, 18, 20, 25, 30, 35, 40, 50, 60},
       [](Tested& valve, double level) { valve.instruments.lvdt.zero_offset_m -= 1e-6 * level; }}};
  return all;
}

/// Strokes there and back, each pair at its own pressure difference.
rig::BenchRun strokes(const Valve& valve, const Settings& set, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto share = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  rig::RampsProtocol ramps;
  const auto pairs = static_cast<std::size_t>(std::lround(0.5 * set.at("strokes")));
  ramps.pressure_differences_bar.clear();
  for (std::size_t k = 0; k < pairs; ++k)
    ramps.pressure_differences_bar.push_back(valve.rated_bar * (0.4 + 0.6 * share()));
  ramps.rate_percent_per_s = set.at("slowest") * std::pow(set.at("fastest") / set.at("slowest"), share());
  ramps.hold_s = 0.3;
  ramps.pause_s = 0.5;
  ramps.conditions.oil_temperature_start_C = ramps.conditions.oil_temperature_end_C = 40 + 20 * share();
  return plan(ramps);
}

struct Outcome {
  bool found = false, raised = false;
  double strokes = 0;
};

struct Decided {};

/// One valve through its strokes, until something is raised.
Outcome run(const Valve& valve, const rig::ValveUnderTest& faulty, const Settings& set, std::uint64_t seed,
            std::optional<monitor::Fault> cause) {
  estimation::RunningSensor sensor = estimation::running_sensor(valve.model, estimation::Estimator::observer);
  monitor::Monitor watch(valve.model, {set.at("alarms")});
  Outcome out;
  double windows = 0;
  const auto judge = [&] {
    const std::vector<monitor::Cause> causes = watch.causes();
    out.raised = watch.condition() != monitor::Ne107::good;
    out.found = out.raised && cause && !causes.empty() && causes.front().fault == *cause;
    out.strokes = static_cast<double>(watch.usage().strokes);
  };
  rig::SimulationOptions options{.keeps_recording = false};
  options.each_sample = [&](const rig::MeasuredSample& in) {
    const estimation::TimedSample sample{in.time_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K};
    watch.take(sample, sensor.step(sample));
    if (watch.judged_windows() == windows) return;
    windows = watch.judged_windows();
    judge();
    if (cause ? out.found : out.raised) throw Decided();
  };
  try {
    (void)rig::simulate(rig::as_built(faulty), strokes(valve, set, seed), seed, options);
    watch.finish();
    judge();
  } catch (const Decided&) {  // early
  }
  return out;
}

struct Bench {
  std::vector<Valve> valves;
  Settings set;

  [[nodiscard]] rig::ValveUnderTest tested(std::size_t valve, bool dithered) const {
    rig::ValveUnderTest out = valves[valve].healthy;
    out.electronics.dither.amplitude_A = dithered ? set.at("amplitude") : 0;
    out.electronics.dither.frequency_Hz = set.at("frequency");
    return out;
  }

  struct Found {
    int cases = 0, found = 0;
    double strokes = 0;  ///< of those found, in the mean
  };
  /// Ends once more than one of twenty was missed.
  [[nodiscard]] Found level(const FaultKind& kind, double level, bool dithered) const {
    const int all = static_cast<int>(set.at("cases"));
    Found out;
    for (int k = 0; k < all && out.cases - out.found <= all / 20; ++k) {
      const std::size_t which = static_cast<std::size_t>(k) % valves.size();
      rig::ValveUnderTest faulty = tested(which, dithered);
      kind.apply(faulty, level);
      const Outcome one = run(valves[which], faulty, set, 4000 + static_cast<std::uint64_t>(k), kind.cause);
      ++out.cases;
      out.found += one.found ? 1 : 0;
      out.strokes += one.found ? one.strokes : 0;
    }
    out.strokes /= std::max(out.found, 1);
    return out;
  }

  void seek(FaultKind kind, bool dithered) const {
    std::erase_if(kind.levels, [&](double level) { return level < set.at("lowest") || level > set.at("highest"); });
    if (kind.levels.empty()) throw std::runtime_error("there is no level between lowest and highest");
    const int all = static_cast<int>(set.at("cases"));
    std::size_t low = 0, high = kind.levels.size();  // found from `high` on
    std::map<std::size_t, Found> seen;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const Found found = seen[middle] = level(kind, kind.levels[middle], dithered);
      fmt::print("  {} {} {} {}: {} of {} found, after {:.0f} strokes\n", dithered ? "dithered" : "still", kind.name,
                 kind.unit, kind.levels[middle], found.found, found.cases, found.strokes);
      std::fflush(stdout);
      (found.cases - found.found <= all / 20 ? high : low) =
          found.cases - found.found <= all / 20 ? middle : middle + 1;
    }
    if (high == kind.levels.size()) {
      fmt::print("{:<9} {:<34} more than {} {}\n", dithered ? "dithered" : "still", kind.name, kind.levels.back(),
                 kind.unit);
    } else {
      fmt::print("{:<9} {:<34} {} {}: {} of {}, after {:.0f} strokes in the mean\n", dithered ? "dithered" : "still",
                 kind.name, kind.levels[high], kind.unit, seen[high].found, seen[high].cases, seen[high].strokes);
    }
    std::fflush(stdout);
  }

  /// One run with the fault: while something is raised.
  void band(const Valve& valve, FaultKind kind, double level) const {
    struct Band {
      double lower_m3_per_s, upper_m3_per_s;
    };
    struct Answer {
      bool raised;
      Band estimate, widened;
    };
    std::vector<Answer> answers;
    rig::ValveUnderTest faulty = tested(static_cast<std::size_t>(&valve - valves.data()), false);
    kind.apply(faulty, level);
    estimation::RunningSensor sensor = estimation::running_sensor(valve.model, estimation::Estimator::observer);
    monitor::Monitor watch(valve.model, {set.at("alarms")});
    monitor::Doubt doubt;
    double windows = 0;
    rig::SimulationOptions options{.with_truth = true, .keeps_recording = false};
    options.each_sample = [&](const rig::MeasuredSample& in) {
      const estimation::TimedSample sample{in.time_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K};
      const sensor::Estimate<double> estimate = sensor.step(sample);
      const auto wide = monitor::widened(valve.model, doubt, sample, watch.state().oil_temperature_K, estimate);
      answers.push_back({doubt.any(),
                         {estimate.flow_lower_m3_per_s, estimate.flow_upper_m3_per_s},
                         {wide.flow_lower_m3_per_s, wide.flow_upper_m3_per_s}});
      watch.take(sample, estimate);
      if (watch.judged_windows() != windows) doubt = watch.doubt();
      windows = watch.judged_windows();
    };
    const rig::Simulation done = rig::simulate(rig::as_built(faulty), strokes(valve, set, 4000), 4000, options);
    const std::vector<double>& flow_L_min = done.truth["flow_L_min"];
    double raised = 0;
    std::array<double, 2> within{}, half_width{};
    for (std::size_t k = 0; k < answers.size(); ++k) {
      if (!answers[k].raised) continue;
      ++raised;
      const std::array<Band, 2> bands{answers[k].estimate, answers[k].widened};
      for (std::size_t b = 0; b < bands.size(); ++b) {
        const double flow_m3_per_s = flow_L_min.at(k) / 60e3;
        within[b] += flow_m3_per_s >= bands[b].lower_m3_per_s && flow_m3_per_s <= bands[b].upper_m3_per_s ? 1 : 0;
        half_width[b] += 0.5 * (bands[b].upper_m3_per_s - bands[b].lower_m3_per_s);
      }
    }
    const double share = 100 / std::max(raised, 1.0), full_scale = share / valve.model.valve.rated_flow_m3_per_s;
    fmt::print(
        "{:<16} {:<32} {} {}: raised {:.0f} % of the time; in the band {:.0f} to {:.0f} %; {:.1f} to {:.1f} % FS\n",
        valve.name, kind.name, level, kind.unit, 100 * raised / static_cast<double>(answers.size()), share * within[0],
        share * within[1], full_scale * half_width[0], full_scale * half_width[1]);
    std::fflush(stdout);
  }

  void healthy(bool dithered) const {
    const int all = static_cast<int>(set.at("cases"));
    int raised = 0;
    for (int k = 0; k < all; ++k) {
      const std::size_t which = static_cast<std::size_t>(k) % valves.size();
      raised +=
          run(valves[which], tested(which, dithered), set, 4000 + static_cast<std::uint64_t>(k), {}).raised ? 1 : 0;
    }
    fmt::print("{:<9} {:<34} {} of {} raised\n", dithered ? "dithered" : "still", "healthy", raised, all);
    std::fflush(stdout);
  }
};

Valve read_valve(const std::string& name, const std::string& file) {
  const std::size_t colon = name.find(':');
  Valve out{name, rig::read_valve_and_campaign(name.substr(0, colon)).valve, model::read_model(file), 0};
  if (colon != std::string::npos) {
    out.healthy.seed = std::stoull(name.substr(colon + 1));
    out.healthy.spread.amount = 1;
  }
  out.rated_bar = out.healthy.rating.pressure_difference_bar;
  return out;
}

Bench bench_of(int argc, char** argv) {
  Bench out{{},
            {{"cases", 20},
             {"strokes", 100},
             {"dithered", -1},
             {"fault", -1},
             {"band", 0},
             {"alarms", 1},
             {"amplitude", 0.1},
             {"frequency", 120},
             {"slowest", 15},
             {"fastest", 60},
             {"lowest", 0},
             {"highest", 1e9}}};
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) throw std::runtime_error(argument + " is no VALVE=MODEL.json or KEY=NUMBER");
    const std::string key = argument.substr(0, equals), value = argument.substr(equals + 1);
    const auto known = out.set.find(key);
    if (known == out.set.end()) {
      out.valves.push_back(read_valve(key, value));
    } else if (std::from_chars(value.data(), value.data() + value.size(), known->second).ptr !=
               value.data() + value.size()) {
      throw std::runtime_error(argument + " ends in no number");
    }
  }
  if (out.valves.empty()) throw std::runtime_error("name at least one VALVE=MODEL.json");
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Bench bench = bench_of(argc, argv);
    if (bench.set.at("band") > 0) {
      constexpr std::array<double, 7> usual{50, 45, 11, 4,
                                            0,  25, 25};  // by kind; resistance takes nothing off the band
      for (const Valve& valve : bench.valves) {
        for (std::size_t k = 0; k < usual.size(); ++k) {
          if (usual[k] > 0) bench.band(valve, kinds()[k], usual[k]);
        }
      }
      return 0;
    }
    for (const bool dithered : {false, true}) {
      if (bench.set.at("dithered") >= 0 && dithered != (bench.set.at("dithered") > 0)) continue;
      const double fault = bench.set.at("fault");
      if (fault < 0 || fault == static_cast<double>(kinds().size())) bench.healthy(dithered);
      for (std::size_t k = 0; k < kinds().size(); ++k) {
        if (fault >= 0 && static_cast<double>(k) != fault) continue;
        bench.seek(kinds()[k], dithered);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "monitor_limits: {}\n", error.what());
    return 1;
  }
  return 0;
}
