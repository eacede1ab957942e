#include "spoolflow/monitor/signatures.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/monitor/correction.hpp"

namespace spoolflow::monitor {
namespace {

/// Half of the steps for slopes.
constexpr double pressure_step_share = 0.03;
constexpr double position_step_m = 5e-6;
constexpr double current_step_A = 0.01;
/// A flatter force map determines no current.
constexpr double least_force_slope_N_A = 1;
/// The flow force's rise over the opening is read at this share of the stroke behind the edge.
constexpr double rise_share = 0.15;
/// Where the edge opens, its rounding's force rises over this length [m] about the calibrated opening.
constexpr double rounding_rise_m = 60e-6;
constexpr double rounding_begins_m = 20e-6;
/// Standard deviation of friction at an event about its limit, as a share of it, of all else [N], and of what ageing
/// adds, as a share of that.
constexpr double limit_scatter_share = 0.06;
constexpr double force_scatter_N = 0.25;
constexpr double ageing_scatter_share = 0.15;
/// Under dither friction is identified by its swing alone: as a share of its limit.
constexpr double dithered_scatter_share = 0.25;

struct Limit {
  double sliding_N;
  double aged_N;
};

/// The healthy model at one event.
class EventModel {
 public:
  EventModel(const sensor::ObserverParameters<double>& valve, const ForceEvent& event)
      : valve_(valve),
        event_(event),
        x_(std::max(event.position_m, closed_stop_m(valve))),
        aged_(event.kind == EventKind::dithered ? 1.0 : sensor::ageing(valve.friction, event.rested_s)),
        armature_N_(valve.actuator.friction_N.at(event.current_A, x_).value),
        highest_Pa_(valve.edge.highest_pressure_difference_Pa()) {}

  [[nodiscard]] double position_m() const { return x_; }
  [[nodiscard]] double highest_Pa() const { return highest_Pa_; }
  [[nodiscard]] Limit limit(double pressure_Pa) const {
    const sensor::EdgePoint<double> edge = valve_.edge.at(event_.oil_temperature_K, pressure_Pa, x_);
    const double spool_N = edge.friction_N + edge.friction_per_pressure_N_Pa * beyond_Pa(pressure_Pa);
    return {spool_N + armature_N_, aged_ * spool_N + armature_N_};
  }
  [[nodiscard]] double flow_force_N(double pressure_Pa, double position_m) const {
    const sensor::EdgePoint<double> edge = valve_.edge.at(event_.oil_temperature_K, pressure_Pa, position_m);
    return edge.flow_force_N + edge.flow_force_per_pressure_N_Pa * beyond_Pa(pressure_Pa);
  }
  [[nodiscard]] double magnetic_force_N(double current_A, double position_m) const {
    return valve_.actuator.magnetic_force.at(current_A, position_m).value;
  }
  [[nodiscard]] double net_force_N(double pressure_Pa, double position_m) const {
    return magnetic_force_N(event_.current_A, position_m) - valve_.spring.at(position_m).value -
           flow_force_N(pressure_Pa, position_m);
  }
  /// Over the current [N/A], > 0.
  [[nodiscard]] double force_slope_N_A() const {
    return std::max((magnetic_force_N(event_.current_A + current_step_A, x_) -
                     magnetic_force_N(event_.current_A - current_step_A, x_)) /
                        (2 * current_step_A),
                    least_force_slope_N_A);
  }
  /// Half the loop's width in force without friction of the armature.
  [[nodiscard]] double magnetic_half_width_N() const {
    return std::max(valve_.actuator.magnetic_force.hysteresis_half_width_N.at(event_.current_A).value - armature_N_,
                    0.0);
  }
  [[nodiscard]] double conductance(double pressure_Pa, double position_m) const {
    return valve_.edge.at(event_.oil_temperature_K, pressure_Pa, position_m).conductance;
  }

 private:
  [[nodiscard]] double beyond_Pa(double pressure_Pa) const { return std::max(pressure_Pa - highest_Pa_, 0.0); }
  const sensor::ObserverParameters<double>& valve_;
  const ForceEvent& event_;
  double x_, aged_, armature_N_, highest_Pa_;
};

/// What each magnitude does to the net force [N].
Magnitudes slopes(const sensor::ObserverParameters<double>& valve, double stroke_m, const ForceEvent& event,
                  const EventModel& model, double p, double friction_N) {
  const double x = model.position_m();
  const double opens_m = valve.closed_below_m;
  const double behind_m = rise_share * stroke_m;
  const double rise_N_per_m = model.flow_force_N(p, opens_m + behind_m) / behind_m;
  const double open = std::clamp((x - opens_m + rounding_begins_m) / rounding_rise_m, 0.0, 1.0);
  const double stop_m = closed_stop_m(valve);
  const double preload_N = valve.spring.at(stop_m).value;
  const double rate_N = valve.spring.at(stop_m + stroke_m).value - preload_N;
  const double low_m = std::max(x - position_step_m, stop_m);
  const double per_position_N_m =
      (model.net_force_N(p, x + position_step_m) - model.net_force_N(p, low_m)) / (x + position_step_m - low_m);
  Magnitudes out{};
  const auto put = [&](Magnitude magnitude, double slope) {
    out[index(magnitude)] = slope * usual_fault[index(magnitude)];
  };
  put(Magnitude::friction, event.kind == EventKind::dithered ? 0.0 : friction_N);
  put(Magnitude::edge_rounding, rise_N_per_m * open);
  put(Magnitude::preload_loss, -preload_N);
  put(Magnitude::rate_loss, -rate_N * (x - stop_m) / stroke_m);
  put(Magnitude::shorted_turns, event.current_A * model.force_slope_N_A());
  put(Magnitude::position_zero, per_position_N_m);
  return out;
}

}  // namespace

Explained explain(const sensor::ObserverParameters<double>& valve, double stroke_m, const ForceEvent& event,
                  double pressure_difference_Pa) {
  const EventModel model(valve, event);
  const double x = model.position_m();
  const double step_Pa = pressure_step_share * model.highest_Pa();
  const double p = std::clamp(pressure_difference_Pa, step_Pa, extrapolated_share * model.highest_Pa());
  const double operation = valve.friction.operation_ratio;
  const Limit at_p = model.limit(p);
  const bool dithered = event.kind == EventKind::dithered;
  const double friction_N = dithered ? event.friction_N : event.direction * operation * at_p.aged_N;

  Explained out{};
  out.residual_N = event.net_force_N - model.flow_force_N(p, x) - friction_N;
  out.per_pressure_N_Pa = (model.flow_force_N(p + step_Pa, x) - model.flow_force_N(p - step_Pa, x)) / (2 * step_Pa);
  if (!dithered) {
    out.per_pressure_N_Pa += event.direction * operation *
                             (model.limit(p + step_Pa).aged_N - model.limit(p - step_Pa).aged_N) / (2 * step_Pa);
  }
  out.friction_limit_N = at_p.aged_N;
  out.ageing_N = at_p.aged_N - at_p.sliding_N;
  const double most = model.conductance(p, stroke_m);
  const double share = most > 0 ? model.conductance(p, x) / most : 0.0;
  out.load_slope_N = out.per_pressure_N_Pa * p * share * share;
  const double scatter_N = (dithered ? dithered_scatter_share : limit_scatter_share) * at_p.aged_N;
  out.noise_N = std::sqrt(scatter_N * scatter_N + force_scatter_N * force_scatter_N +
                          std::pow(ageing_scatter_share * std::max(out.ageing_N, 0.0), 2));
  const double slope_N_A = model.force_slope_N_A();
  out.current_off_A = model.net_force_N(p, x) / slope_N_A;
  out.half_width_A = (std::abs(friction_N) + model.magnetic_half_width_N()) / slope_N_A;
  out.slope_N = slopes(valve, stroke_m, event, model, p, friction_N);
  return out;
}

}  // namespace spoolflow::monitor
