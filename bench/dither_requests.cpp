/// The rig's electronics obey the sensor's request for dither, in closed loop: random duty cycles of a virtual valve,
/// the observer at 1 kHz on what its instruments show, against the plant's true flow.
///
///     spoolflow campaign size_6 -o size_6 && spoolflow calibrate size_6/campaign.toml -o size_6.json
///     dither_requests size_6.json size_6 [KEY=NUMBER ...]
///
/// VALVE is a preset or a valve file, as of `spoolflow campaign`. Keys: runs, seconds, highest (amplitude, % of the
/// rated current; permanent dither has it, too), lowest, frequency (Hz), wanted (half width of the band, % of the rated
/// flow), request, pause (s).
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/on_rig_valve.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/sensor/dither_request.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace {

using namespace spoolflow;
using bench::Settings;
using Observer = sensor::ObserverParameters<double>;

/// Errors of all runs together.
struct Figures {
  std::vector<double> errors_percent;
  double inside = 0, dithered = 0, width_percent = 0;

  void print(const char* name) {
    std::sort(errors_percent.begin(), errors_percent.end());
    const auto samples = static_cast<double>(errors_percent.size());
    const double p95 = errors_percent[static_cast<std::size_t>(0.95 * samples)];
    fmt::print("{:<20}{:>8.2f}{:>8.2f}{:>10.1f}{:>10.2f}{:>12.1f}\n", name, p95, errors_percent.back(),
               100 * inside / samples, width_percent / samples, 100 * dithered / samples);
  }
};

/// What the electronics make of one step of the observer.
using Decision = std::function<rig::Dither(const sensor::ObserverState<double>&, double time_step_s)>;

/// One duty cycle; the observer is reset.
void run(const model::Model& model, const rig::ValveUnderTest& valve, const rig::BenchRun& course, std::uint64_t seed,
         const Decision& decide, Figures& figures) {
  sensor::ObserverState<double> state{};
  std::vector<sensor::Estimate<double>> answers;
  double before_s = 0;
  const auto dither = [&](const rig::MeasuredSample& measured) {
    const sensor::Sample<double> sample{measured.time_s - before_s, measured.current_A, measured.voltage_V,
                                        measured.position_m, measured.oil_temperature_K};
    before_s = measured.time_s;
    answers.push_back(step(model.observer->parameters, state, sample));
    const rig::Dither next = decide(state, sample.time_step_s);
    figures.dithered += next.amplitude_A > 0 ? 1 : 0;
    return next;
  };
  const rig::Simulation simulation = rig::simulate(valve, course, seed, {.with_truth = true, .dither = dither});
  const std::vector<double>& flow_L_min = simulation.truth["flow_L_min"];
  const double per_full_scale = 100 / model.valve.rated_flow_m3_per_s;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const sensor::Estimate<double>& answer = answers[k];
    const double truth_m3_per_s = flow_L_min[k] / 6e4;
    figures.errors_percent.push_back(per_full_scale * std::abs(answer.flow_m3_per_s - truth_m3_per_s));
    figures.width_percent += per_full_scale * (answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s);
    figures.inside +=
        answer.flow_lower_m3_per_s <= truth_m3_per_s && truth_m3_per_s <= answer.flow_upper_m3_per_s ? 1 : 0;
  }
}

void compare(const model::Model& model, const rig::ValveUnderTest& valve, Settings set) {
  const double percent_A = 0.01 * valve.rating.current_A;
  const sensor::DitherRequestParameters<double> limits{0.01 * set["wanted"] * model.valve.rated_flow_m3_per_s,
                                                       percent_A * set["lowest"],
                                                       percent_A * set["highest"],
                                                       set["frequency"],
                                                       set["request"],
                                                       set["pause"]};
  const Observer& observer = model.observer->parameters;
  Figures without, on_request, permanent;
  for (int k = 1; k <= static_cast<int>(set["runs"]); ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    const rig::BenchRun course = plan(rig::DutyCycleProtocol{.conditions = {}, .duration_s = set["seconds"]}, seed);
    const rig::Dither none{.amplitude_A = 0, .frequency_Hz = limits.frequency_Hz};
    run(
        model, valve, course, seed, [&](const auto&, double) { return none; }, without);
    sensor::DitherRequestState<double> memory{};
    const auto obey = [&](const sensor::ObserverState<double>& state, double time_step_s) -> rig::Dither {
      const sensor::DitherRequest<double> asked = request_dither(limits, memory, observer, state, time_step_s);
      return asked.active ? rig::Dither{.amplitude_A = asked.amplitude_A, .frequency_Hz = asked.frequency_Hz} : none;
    };
    run(model, valve, course, seed, obey, on_request);
    const rig::Dither always{.amplitude_A = limits.highest_amplitude_A, .frequency_Hz = limits.frequency_Hz};
    run(
        model, valve, course, seed, [&](const auto&, double) { return always; }, permanent);
  }
  fmt::print("Errors and mean width of the band, % of the rated flow.\n");
  fmt::print("{:<20}{:>8}{:>8}{:>10}{:>10}{:>12}\n", "", "p95", "max", "inside %", "width", "dithered %");
  without.print("without dither");
  on_request.print("on request");
  permanent.print("permanent dither");
}

}  // namespace

int main(int argc, char** argv) {
  return spoolflow::bench::on_rig_valve("dither_requests", argc, argv,
                                        {{"runs", 3},
                                         {"seconds", 60},
                                         {"lowest", 3},
                                         {"highest", 12},
                                         {"frequency", 125},
                                         {"wanted", 5},
                                         {"request", 0.3},
                                         {"pause", 0}},
                                        [](const auto&... each) { compare(each...); });
}
