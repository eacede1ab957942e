#include "spoolflow/analysis/point_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::analysis {
namespace {

using estimation::Estimator;
using uncertainty::PointFunction;
using uncertainty::WorkingPoint;

/// Counts finished pieces of work and reports the share, one thread at a time.
class Counted {
 public:
  Counted(std::size_t total, const std::function<void(double)>& progress) : total_(total), progress_(progress) {}
  void one_more() {
    const std::lock_guard lock(mutex_);
    progress_(static_cast<double>(++done_) / static_cast<double>(total_));
  }

 private:
  std::mutex mutex_;
  std::size_t total_;
  std::size_t done_ = 0;
  const std::function<void(double)>& progress_;
};

PointResult at_point(const model::Model& model, Estimator estimator, const WorkingPoint& point,
                     const uncertainty::Inputs& inputs, const Scenario& scenario, std::uint64_t number) {
  PointResult out;
  out.estimator = estimator;
  out.point = point;
  const auto function = PointFunction::at(model, estimator, point);
  if (!function) return out;
  uncertainty::SeededNumbers none(0, "");
  out.reachable = true;
  out.current_A = function->current_A();
  out.position_reading_m = function->position_reading_m();
  out.flow_m3_per_s = (*function)({}, none);
  out.budget = function->budget(inputs);
  const TrialSettings& trials = scenario.monte_carlo;
  out.check = monte_carlo(*function, out.budget,
                          {.trials = static_cast<std::size_t>(trials.trials),
                           .adaptive = trials.adaptive,
                           .most_trials = static_cast<std::size_t>(trials.most_trials),
                           .digits = static_cast<int>(trials.digits)},
                          uncertainty::mixed_bits(scenario.seed) + number);
  out.stated = stated_interval(out.budget, out.flow_m3_per_s, out.check);
  return out;
}

std::vector<double> spread_evenly(double from, double to, double count) {
  std::vector<double> out;
  for (double k = 0; k < count; ++k) out.push_back(from + (to - from) * (k + 0.5) / count);
  return out;
}

MapCell cell_at(const model::Model& model, Estimator estimator, const WorkingPoint& point,
                const uncertainty::Inputs& inputs) {
  MapCell out;
  const auto function = PointFunction::at(model, estimator, point);
  if (!function) return out;
  constexpr int noise_runs = 12;  // for a picture
  const uncertainty::Budget budget = function->budget(inputs, noise_runs);
  const auto largest = std::max_element(budget.lines.begin(), budget.lines.end(),
                                        [](const auto& a, const auto& b) { return a.share < b.share; });
  uncertainty::SeededNumbers none(0, "");
  return {true, (*function)({}, none), budget.expanded_m3_per_s, largest->input.quantity, largest->share};
}

}  // namespace

std::vector<WorkingPoint> working_points(const model::Model& model, const PointSettings& settings) {
  const double temperature_K = std::isnan(settings.oil_temperature_C) ? uncertainty::map_temperature_K(model)
                                                                      : units::K_from_degC(settings.oil_temperature_C);
  std::vector<double> pressures_Pa;
  for (const double bar : settings.pressure_differences_bar) pressures_Pa.push_back(units::Pa_from_bar(bar));
  if (pressures_Pa.empty()) {
    const model::Range& range = model.condensed.pressure_difference_Pa;
    for (const double share : {0.15, 0.45, 0.85}) {
      pressures_Pa.push_back(units::Pa_from_bar(std::round(units::bar_from_Pa(share * range.upper))));
    }
  }
  std::vector<WorkingPoint> out;
  for (std::size_t p = 0; p < settings.positions_percent.size(); ++p) {
    const double position_m = 0.01 * settings.positions_percent[p] * model.valve.stroke_m;
    for (std::size_t d = 0; d < pressures_Pa.size(); ++d) {
      if (settings.pairs && d != p) continue;
      out.push_back({position_m, pressures_Pa[d], temperature_K, !settings.closing});
    }
  }
  return out;
}

std::vector<PointResult> analyse_points(const model::Model& model, const Scenario& scenario, unsigned workers,
                                        const std::function<void(double)>& progress) {
  const std::vector<WorkingPoint> points = working_points(model, scenario.points);
  const auto figures = instrument_figures(scenario.instruments);
  const std::vector<Estimator> estimators = estimation::all_estimators(model);
  std::vector<uncertainty::Inputs> inputs;
  for (const Estimator estimator : estimators) inputs.push_back(uncertainty::inputs_of(model, estimator, figures));
  std::vector<PointResult> out(estimators.size() * points.size());
  Counted counted(out.size(), progress);
  parallel::for_each(out.size(), workers, [&](std::size_t k) {
    const std::size_t e = k / points.size();
    out[k] = at_point(model, estimators[e], points[k % points.size()], inputs[e], scenario, k);
    counted.one_more();
  });
  return out;
}

std::vector<OperatingMap> operating_maps(const model::Model& model, const Scenario& scenario, unsigned workers,
                                         const std::function<void(double)>& progress) {
  const auto figures = instrument_figures(scenario.instruments);
  const double temperature_K = working_points(model, scenario.points).front().oil_temperature_K;
  std::vector<OperatingMap> out;
  for (const Estimator estimator : estimation::all_estimators(model)) {
    OperatingMap map{
        estimator,
        spread_evenly(std::max(0.0, model.condensed.parameters.closed_below_m), model.valve.stroke_m,
                      std::floor(scenario.map.positions)),
        spread_evenly(model.condensed.pressure_difference_Pa.lower, model.condensed.pressure_difference_Pa.upper,
                      std::floor(scenario.map.pressure_differences)),
        {}};
    map.cells.resize(map.position_m.size() * map.pressure_difference_Pa.size());
    out.push_back(std::move(map));
  }
  const std::size_t cells = out.front().cells.size();
  Counted counted(out.size() * cells, progress);
  for (OperatingMap& map : out) {
    const uncertainty::Inputs inputs = uncertainty::inputs_of(model, map.estimator, figures);
    const std::size_t columns = map.position_m.size();
    parallel::for_each(cells, workers, [&](std::size_t k) {
      map.cells[k] = cell_at(model, map.estimator,
                             {map.position_m[k % columns], map.pressure_difference_Pa[k / columns], temperature_K,
                              !scenario.points.closing},
                             inputs);
      counted.one_more();
    });
  }
  return out;
}

}  // namespace spoolflow::analysis
