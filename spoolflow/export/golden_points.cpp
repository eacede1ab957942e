#include "spoolflow/export/golden_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "spoolflow/estimation/bare_steps.hpp"
#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/numerics/crossing.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::exports {

using estimation::stepped;
using estimation::stepped_flows;

namespace {

constexpr double time_step_s = 1e-3;
constexpr int golden_samples = 1200;
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

struct Corner {
  double time_s;
  double share;  ///< of the stroke or of the largest force
};

/// The share at a time, straight between corners.
template <std::size_t Count>
double course(const std::array<Corner, Count>& corners, double time_s) {
  for (std::size_t k = 1; k < Count; ++k) {
    const Corner& from = corners[k - 1];
    const Corner& to = corners[k];
    if (time_s < to.time_s)
      return from.share + (to.share - from.share) * (time_s - from.time_s) / (to.time_s - from.time_s);
  }
  return corners.back().share;
}

double position_share(double time_s) {
  static constexpr std::array<Corner, 10> corners{{{0.00, 0.00},
                                                   {0.05, 0.00},
                                                   {0.40, 0.80},
                                                   {0.50, 0.80},
                                                   {0.51, 0.78},
                                                   {0.60, 0.78},
                                                   {0.80, 0.35},
                                                   {0.90, 0.35},
                                                   {1.00, 0.60},
                                                   {1.20, 0.00}}};
  return course(corners, time_s);
}

double pressure_share(double time_s) {
  static constexpr std::array<Corner, 6> corners{
      {{0.0, 0.5}, {0.3, 0.5}, {0.35, 0.8}, {0.7, 0.8}, {0.72, 0.4}, {1.2, 0.6}}};
  return course(corners, time_s);
}

/// The current at which the magnetic force has this size, within the map's range.
double balancing_current_A(const sensor::MagneticForce<double>& magnetic_force, double position_m, double force_N) {
  const auto& axis = magnetic_force.map.row_axis;
  return numerics::crossing({axis.first, axis.at(sensor::force_map_currents - 1)}, force_N,
                            [&](double current_A) { return magnetic_force.at(current_A, position_m).value; });
}

/// A small even noise, the same on every machine; within -1 to 1.
class Noise {
 public:
  double operator()() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<double>(state_ >> 8U) / (1U << 23U) - 1.0;
  }

 private:
  std::uint32_t state_ = 12345;
};

std::vector<sensor::Sample<float>> strokes(const model::Model& model) {
  const auto& condensed = model.condensed.parameters;
  const double oil_temperature_K = model.condensed.oil_temperature_K.value_or(313.15);
  std::vector<sensor::Sample<float>> out;
  Noise noise;
  for (int k = 0; k < golden_samples; ++k) {
    const double time_s = k * time_step_s;
    const double position_m = position_share(time_s) * model.valve.stroke_m;
    const double before_m = position_share(time_s - time_step_s) * model.valve.stroke_m;
    const double direction = position_m > before_m ? 1.0 : (position_m < before_m ? -1.0 : 0.0);
    double flow_force_N = pressure_share(time_s) * condensed.flow_rate.largest_force_N.at(position_m).value;
    double friction_N = condensed.friction_half_width_N.at(position_m).value;
    if (model.observer) {
      const auto& edge = model.observer->parameters.edge;
      const auto point =
          edge.at(oil_temperature_K, pressure_share(time_s) * edge.highest_pressure_difference_Pa(), position_m);
      flow_force_N = point.flow_force_N;
      friction_N = point.friction_N;
    }
    const double force_N = condensed.spring.at(position_m).value + flow_force_N + direction * friction_N;
    const double current_A = balancing_current_A(condensed.magnetic_force, position_m, force_N);
    const double voltage_V =
        current_A * (model.observer ? model.observer->parameters.actuator.coil_resistance.resistance_Ohm : 0.0);
    out.push_back({static_cast<float>(k == 0 ? 0.0 : time_step_s), static_cast<float>(current_A + 2e-3 * noise()),
                   static_cast<float>(voltage_V + 0.02 * noise()), static_cast<float>(position_m + 1e-6 * noise()),
                   static_cast<float>(oil_temperature_K + 0.1 * noise())});
  }
  for (std::size_t k = 540; k < 560; ++k) out[k].position_m += static_cast<float>(0.1 * model.valve.stroke_m);
  out[700].position_m = missing;
  for (std::size_t k = 850; k < 870; ++k) out[k].voltage_V = missing;
  return out;
}

constexpr std::size_t fading_samples = 150;

/// Both directions' strokes, one behind the other. While the second begins, the first solenoid's current fades away.
std::vector<sensor::WholeValveSample<float>> whole_strokes(const model::Model& model) {
  std::vector<sensor::WholeValveSample<float>> out;
  for (const auto& in : strokes(model::of_direction(model, "b"))) {
    out.push_back({in.time_step_s, 0.0F, in.current_A, 0.0F, in.voltage_V, in.position_m, in.oil_temperature_K});
  }
  const sensor::WholeValveSample<float> left = out[golden_samples / 2];
  const std::vector<sensor::Sample<float>> other = strokes(model::of_direction(model, "a"));
  for (std::size_t k = 0; k < other.size(); ++k) {
    const auto& in = other[k];
    const float share = k < fading_samples ? 1.0F - static_cast<float>(k) / fading_samples : 0.0F;
    out.push_back({static_cast<float>(time_step_s), in.current_A, share * left.current_b_A, in.voltage_V,
                   share * left.voltage_b_V, -in.position_m, in.oil_temperature_K});
  }
  return out;
}

/// One direction's parameters in one precision.
template <class T>
struct DirectionParameters {
  sensor::CondensedTables<T> condensed;
  sensor::ObserverParameters<T> observer{};  ///< where the model has one
};

DirectionParameters<double> in_double(const model::Condensed& condensed,
                                      const std::optional<model::Observer>& observer) {
  DirectionParameters<double> out{sensor::laid_out(condensed.parameters)};
  if (observer) out.observer = observer->parameters;
  return out;
}

DirectionParameters<float> in_single(const DirectionParameters<double>& parameters) {
  return {single_precision(parameters.condensed), single_precision(parameters.observer)};
}

/// Of all samples: the condensed sensor's flow rates [m3/s], and the best sensor's answers.
template <class T>
struct Answers {
  std::vector<T> condensed;
  std::vector<sensor::Estimate<T>> best;
};

template <class T>
Answers<T> answers(const DirectionParameters<T>& parameters, bool has_observer,
                   const std::vector<sensor::Sample<float>>& samples) {
  return {stepped_flows(parameters.condensed, sensor::CondensedState<T>{}, samples),
          has_observer ? stepped(parameters.observer, sensor::ObserverState<T>{}, samples)
                       : stepped(parameters.condensed, sensor::CondensedState<T>{}, samples)};
}

template <class T>
Answers<T> answers(const DirectionParameters<T>& b, const DirectionParameters<T>& a, bool has_observer,
                   const std::vector<sensor::WholeValveSample<float>>& samples) {
  const sensor::WholeCondensedTables<T> tables{&b.condensed, &a.condensed};
  const sensor::WholeValveParameters<T> valve{&b.observer, &a.observer};
  return {stepped_flows(tables, sensor::WholeCondensedState<T>{}, samples),
          has_observer ? stepped(valve, sensor::WholeValveState<T>{}, samples)
                       : stepped(tables, sensor::WholeCondensedState<T>{}, samples)};
}

template <class Sample>
std::vector<GoldenPoint<Sample>> joined(const std::vector<Sample>& samples, const Answers<double>& answers) {
  std::vector<GoldenPoint<Sample>> points;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const sensor::Estimate<double>& best = answers.best[k];
    points.push_back({samples[k], answers.condensed[k], best.flow_m3_per_s, best.flow_lower_m3_per_s,
                      best.flow_upper_m3_per_s, best.status});
  }
  return points;
}

template <class Sample>
std::vector<Sample> samples_of(const std::vector<GoldenPoint<Sample>>& points) {
  std::vector<Sample> samples;
  for (const GoldenPoint<Sample>& point : points) samples.push_back(point.sample);
  return samples;
}

template <class Sample>
SinglePrecisionError largest_error(const model::Model& model, const std::vector<GoldenPoint<Sample>>& points,
                                   const Answers<float>& answers) {
  SinglePrecisionError largest{0, 0};
  const double percent = 100.0 / model.valve.rated_flow_m3_per_s;
  for (std::size_t k = 0; k < points.size(); ++k) {
    largest.condensed_percent =
        std::max(largest.condensed_percent, percent * std::abs(answers.condensed[k] - points[k].condensed_m3_per_s));
    largest.best_percent =
        std::max(largest.best_percent, percent * std::abs(answers.best[k].flow_m3_per_s - points[k].best_m3_per_s));
  }
  return largest;
}

}  // namespace

std::vector<DirectionPoint> golden_points(const model::Model& model) {
  const std::vector<sensor::Sample<float>> inputs = strokes(model);
  return joined(inputs, answers(in_double(model.condensed, model.observer), model.has_observer(), inputs));
}

std::vector<WholeValvePoint> whole_golden_points(const model::Model& model) {
  const std::vector<sensor::WholeValveSample<float>> inputs = whole_strokes(model);
  const model::Direction& a = model.p_to_a.value();
  return joined(inputs, answers(in_double(model.condensed, model.observer), in_double(a.condensed, a.observer),
                                model.has_observer(), inputs));
}

SinglePrecisionError single_precision_error(const model::Model& model, const std::vector<DirectionPoint>& points) {
  const auto parameters = in_single(in_double(model.condensed, model.observer));
  return largest_error(model, points, answers(parameters, model.has_observer(), samples_of(points)));
}

SinglePrecisionError single_precision_error(const model::Model& model, const std::vector<WholeValvePoint>& points) {
  const model::Direction& a = model.p_to_a.value();
  const auto b_parameters = in_single(in_double(model.condensed, model.observer));
  const auto a_parameters = in_single(in_double(a.condensed, a.observer));
  return largest_error(model, points, answers(b_parameters, a_parameters, model.has_observer(), samples_of(points)));
}

}  // namespace spoolflow::exports
