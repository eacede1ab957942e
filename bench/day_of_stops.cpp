/// A day of stops: a virtual valve moves and rests by turns under a pressure difference that changes, for 24 hours of
/// simulated time, while bursts of missing samples hit its signals. One sensor goes through all of it, against the
/// plant's true flow: the share of samples inside the 95 % band, of the whole, of the worst four hours in a row, of the
/// samples without a fault, and of those whose answer is held; with and without the bursts.
///
///     spoolflow campaign size_6 -o size_6 && spoolflow calibrate size_6/campaign.toml -o size_6.json
///     day_of_stops size_6.json size_6 [KEY=NUMBER ...]
///
/// VALVE is a preset or a valve file, as of `spoolflow campaign`. Keys: hours; seed; rest (longest rest of the spool,
/// s), pressure_rest (longest rest of the pressure difference, s), every (mean time between bursts, s), shortest,
/// longest (burst, s; by orders of magnitude evenly between).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
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
using Column = std::vector<double>;

constexpr double piece_s = 600, hour_s = 3600, sample_s = 1e-3;

/// Samples inside the band, of how many, by hour.
struct Coverage {
  std::vector<double> inside, of;

  void count(double time_s, bool holds) {
    const auto hour = static_cast<std::size_t>(time_s / hour_s);
    inside.resize(std::max(inside.size(), hour + 1));
    of.resize(inside.size());
    inside[hour] += holds ? 1 : 0;
    ++of[hour];
  }
  [[nodiscard]] double percent(std::size_t from, std::size_t hours) const {
    double holding = 0, all = 0;
    for (std::size_t hour = from; hour < std::min(from + hours, of.size()); ++hour)
      holding += inside[hour], all += of[hour];
    return all > 0 ? 100 * holding / all : 0;
  }
  [[nodiscard]] double percent() const { return percent(0, of.size()); }
  [[nodiscard]] double samples() const { return std::accumulate(of.begin(), of.end(), 0.0); }
  [[nodiscard]] double worst_percent(std::size_t hours) const {
    double worst = 100;
    for (std::size_t from = 0; from == 0 || from + hours <= of.size(); ++from)
      worst = std::min(worst, percent(from, hours));
    return worst;
  }
};

/// Parameters are numbers and nothing else.
std::vector<sensor::ObserverParameters<float>> in_single(const sensor::ObserverParameters<double>& valve) {
  constexpr std::size_t count = sizeof valve / sizeof(double);
  using Doubles = std::array<double, count>;
  using Floats = std::array<float, count>;
  const auto doubles = std::bit_cast<Doubles>(valve);
  Floats floats;
  for (std::size_t k = 0; k < count; ++k) floats[k] = static_cast<float>(doubles[k]);
  return {std::bit_cast<sensor::ObserverParameters<float>>(floats)};
}

/// The observer as firmware runs it.
class SingleSensor {
 public:
  explicit SingleSensor(const sensor::ObserverParameters<double>& valve) : valve_(in_single(valve)) {}
  sensor::Estimate<double> step(const estimation::TimedSample& sample) {
    const sensor::Sample<double> next = times_.next(sample).sample;
    const sensor::Sample<float> single{static_cast<float>(next.time_step_s), static_cast<float>(next.current_A),
                                       static_cast<float>(next.voltage_V), static_cast<float>(next.position_m),
                                       static_cast<float>(next.oil_temperature_K)};
    const auto& answer = sensor::step(valve_.front(), state_, single);
    return {answer.flow_m3_per_s, answer.flow_lower_m3_per_s, answer.flow_upper_m3_per_s, 0, 0, 0, 0, 0, answer.status};
  }

 private:
  std::vector<sensor::ObserverParameters<float>> valve_;
  sensor::ObserverState<float> state_{};
  estimation::SampleTimes times_;
};

/// One sensor's day.
template <class Sensor>
struct Day {
  const char* name;
  Sensor sensor;
  Coverage all{}, without_fault{}, held{};
  double width_m3_per_s = 0, held_width_m3_per_s = 0;

  void step(const estimation::TimedSample& sample, double truth_m3_per_s) {
    const sensor::Estimate<double> answer = sensor.step(sample);
    const bool holds = answer.flow_lower_m3_per_s <= truth_m3_per_s && truth_m3_per_s <= answer.flow_upper_m3_per_s;
    const double width = answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s;
    all.count(sample.time_s, holds);
    width_m3_per_s += width;
    if ((static_cast<std::uint32_t>(answer.status) & sensor::fault_bits) == 0)
      without_fault.count(sample.time_s, holds);
    if (has(answer.status, sensor::Status::sample_missing)) {
      held.count(sample.time_s, holds);
      held_width_m3_per_s += width;
    }
  }
  void print(double rated_m3_per_s) const {
    const double samples = all.samples();
    const auto share = [&](double width, double of) { return of > 0 ? 100 * width / of / rated_m3_per_s : 0; };
    fmt::print("{:<16}{:>8.2f}{:>12.2f}{:>15.2f}{:>15.2f}{:>8.1f}{:>9.2f}{:>15.2f}{:>8.1f}\n", name, all.percent(),
               all.worst_percent(4), without_fault.percent(), 100 * without_fault.samples() / samples,
               share(width_m3_per_s, samples), held.percent(), 100 * held.samples() / samples,
               share(held_width_m3_per_s, held.samples()));
  }
};

/// Which signals are missing, and until when.
class Bursts {
 public:
  Bursts(std::uint64_t seed, Settings& set)
      : engine_(seed), every_s_(set["every"]), shortest_s_(set["shortest"]), longest_s_(set["longest"]) {
    next_s_ = until_s_ = wait_s();
  }
  estimation::TimedSample hit(estimation::TimedSample sample) {
    if (sample.time_s >= next_s_) {
      until_s_ = next_s_ + shortest_s_ * std::pow(longest_s_ / shortest_s_, share());
      next_s_ = until_s_ + wait_s();
      const std::uint64_t kind = engine_() % 8;
      for (std::size_t k = 0; k < missing_.size(); ++k) missing_[k] = kind >= missing_.size() || kind == k;
    }
    if (sample.time_s >= until_s_) return sample;
    const std::array<double*, 4> signals{&sample.current_A, &sample.voltage_V, &sample.position_m,
                                         &sample.oil_temperature_K};
    for (std::size_t k = 0; k < missing_.size(); ++k)
      if (missing_[k]) *signals[k] = std::numeric_limits<double>::quiet_NaN();
    return sample;
  }

 private:
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double wait_s() { return -every_s_ * std::log(1 - share()); }

  std::mt19937_64 engine_;
  double every_s_, shortest_s_, longest_s_, next_s_ = 0, until_s_ = 0;
  std::array<bool, 4> missing_{};
};

/// Moves and rests that begin and end closed.
rig::BenchRun stops(const Settings& set, std::uint64_t seed) {
  rig::DutyCycleProtocol protocol{.conditions = {}, .duration_s = piece_s - 2};
  protocol.lowest_percent = 0;
  protocol.longest_hold_s = set.at("rest");
  protocol.longest_pressure_hold_s = set.at("pressure_rest");
  rig::BenchRun run = plan(protocol, seed);
  const rig::Course wandering = run.position_set;
  rig::Course closing(0);
  constexpr double point_s = 0.01;
  for (double time_s = point_s; time_s < protocol.duration_s; time_s += point_s)
    closing.ramp_for(wandering.at(time_s), point_s);
  run.position_set = closing.ramp_for(0, 1).hold(1);
  run.sample_rate_Hz = {{piece_s, 1 / sample_s}};
  return run;
}

void live_through(const model::Model& model, const rig::ValveUnderTest& valve, Settings set) {
  const auto* observer = &model.observer.value().parameters;
  const double rated = model.valve.rated_flow_m3_per_s;
  Day<estimation::RunningSensor> plain{"without bursts", {observer, rated}}, hit{"with bursts", {observer, rated}};
  Day<SingleSensor> single{"with, single", SingleSensor(*observer)};
  const auto seed = static_cast<std::uint64_t>(set["seed"]);
  Bursts bursts(seed, set);
  const auto pieces = static_cast<std::uint64_t>(std::lround(set["hours"] * hour_s / piece_s));
  for (std::uint64_t piece = 0; piece < pieces; ++piece) {
    const std::uint64_t piece_seed = 1000 * seed + piece;
    const rig::Simulation run = rig::simulate(valve, stops(set, piece_seed), piece_seed, {.with_truth = true});
    const auto& measured = run.recording;
    const Column& truth_L_min = run.truth["flow_L_min"];
    for (std::size_t k = 0; k < truth_L_min.size(); ++k) {
      const auto of = [&](recording::Channel channel) { return measured[channel][k]; };
      using recording::Channel;
      const estimation::TimedSample sample{static_cast<double>(piece) * piece_s + of(Channel::time),
                                           of(Channel::current), of(Channel::voltage), of(Channel::position),
                                           of(Channel::oil_temperature)};
      plain.step(sample, truth_L_min[k] / 6e4);
      const estimation::TimedSample missing = bursts.hit(sample);
      hit.step(missing, truth_L_min[k] / 6e4);
      single.step(missing, truth_L_min[k] / 6e4);
    }
  }
  fmt::print("{} hours, share inside the 95 % band and its mean width in % of the rated flow\n", set["hours"]);
  fmt::print("{:<16}{:>8}{:>12}{:>15}{:>15}{:>8}{:>9}{:>15}{:>8}\n", "", "all", "worst 4 h", "without fault",
             "those, of all", "width", "held", "those, of all", "width");
  plain.print(rated);
  hit.print(rated);
  single.print(rated);
}

}  // namespace

int main(int argc, char** argv) {
  return spoolflow::bench::on_rig_valve("day_of_stops", argc, argv,
                                        {{"hours", 24},
                                         {"seed", 1},
                                         {"rest", 30},
                                         {"pressure_rest", 20},
                                         {"every", 5},
                                         {"shortest", 1e-3},
                                         {"longest", 2}},
                                        [](const auto&... each) { live_through(each...); });
}
