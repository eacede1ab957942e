#pragma once
/// A course of a valve put together from what spools do: slide, rest, slip.
#include <vector>

#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::sensor {

class Course {
 public:
  explicit Course(const ValveInstant& begin) : knots_{{0, begin}} {}

  /// Slides evenly; friction has its full size and the sign of the velocity.
  Course& slide(double to_m, double duration_s) {
    ValveInstant now = last();
    now.friction_share = to_m > now.position_m ? 1 : -1;
    knots_.push_back({end_s(), now});  // where the spool rested with another friction, it breaks away here
    now.position_m = to_m;
    return add(now, duration_s);
  }
  /// Rests while friction and pressure difference go evenly to these; the contact gives way by its stiffness.
  Course& rest(double duration_s, double to_share, double to_Pa) {
    ValveInstant now = last();
    const double friction_N = ClosedFormValve::spool_friction_N(now.pressure_difference_Pa, now.oil_temperature_K);
    now.position_m += (to_share - now.friction_share) * friction_N / ClosedFormValve::contact_stiffness_N_per_m;
    now.friction_share = to_share;
    now.pressure_difference_Pa = to_Pa;
    return add(now, duration_s);
  }
  Course& rest(double duration_s, double to_share) { return rest(duration_s, to_share, last().pressure_difference_Pa); }
  /// Breaks away and comes to rest some milliseconds later with less friction.
  Course& slip(double to_m, double duration_s) {
    ValveInstant now = last();
    now.friction_share *= 0.4;
    now.position_m = to_m;
    return add(now, duration_s);
  }
  /// The pressure difference goes evenly to this while the spool slides on at its pace.
  Course& slide(double to_m, double duration_s, double to_Pa) {
    slide(to_m, duration_s);
    knots_.back().instant.pressure_difference_Pa = to_Pa;
    return *this;
  }

  [[nodiscard]] double end_s() const { return knots_.back().time_s; }
  [[nodiscard]] const ValveInstant& last() const { return knots_.back().instant; }

  ValveInstant operator()(double time_s) const;

 private:
  struct Knot {
    double time_s;
    ValveInstant instant;
  };

  Course& add(const ValveInstant& to, double duration_s) {
    knots_.push_back({end_s() + duration_s, to});
    return *this;
  }

  std::vector<Knot> knots_;
};

/// Errors of an answer against the truth, and how often its band held it.
struct Judgement {
  double largest = 0;  ///< error over full scale
  double sum_of_squares = 0, sum_of_widths = 0;
  int samples = 0, inside = 0;

  void add(const Estimate<double>& answer, double truth_m3_per_s, double full_scale_m3_per_s) {
    const double error = (answer.flow_m3_per_s - truth_m3_per_s) / full_scale_m3_per_s;
    largest = std::max(largest, std::abs(error));
    sum_of_squares += error * error;
    sum_of_widths += (answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s) / full_scale_m3_per_s;
    inside += answer.flow_lower_m3_per_s <= truth_m3_per_s && truth_m3_per_s <= answer.flow_upper_m3_per_s ? 1 : 0;
    ++samples;
  }
  [[nodiscard]] double rms() const { return std::sqrt(sum_of_squares / samples); }
  [[nodiscard]] double coverage() const { return static_cast<double>(inside) / samples; }
  [[nodiscard]] double mean_width() const { return sum_of_widths / samples; }
};

}  // namespace spoolflow::sensor
