#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {

ValveInstant Course::operator()(double time_s) const {
  if (knots_.size() == 1) return knots_[0].instant;
  // The knot behind this time, or the last.
  const auto behind = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, time_s,
                                       [](double time, const Knot& knot) { return time < knot.time_s; });
  const auto& [from_s, from] = *(behind - 1);
  const auto& [to_s, to] = *behind;
  if (!(to_s > from_s)) return to;
  const double share = std::clamp((time_s - from_s) / (to_s - from_s), 0.0, 1.0);
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  return {between(from.position_m, to.position_m), between(from.pressure_difference_Pa, to.pressure_difference_Pa),
          between(from.friction_share, to.friction_share), between(from.oil_temperature_K, to.oil_temperature_K)};
}

}  // namespace spoolflow::sensor
