#include "spoolflow/uncertainty/distribution.hpp"

#include <cmath>
#include <numbers>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace spoolflow::uncertainty {
namespace {

// Double is enough; long double would take several times as long.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

std::string_view name(Distribution distribution) {
  switch (distribution) {
    case Distribution::rectangular:
      return "rectangular";
    case Distribution::two_point:
      return "two-point";
    case Distribution::normal:
      break;
  }
  return "normal";
}

double deviation_per_half_width(Distribution distribution) {
  switch (distribution) {
    case Distribution::rectangular:
      return 1 / std::numbers::sqrt3;
    case Distribution::two_point:
      return 1;
    case Distribution::normal:
      break;
  }
  return 1 / 1.959963984540054;
}

double quantile(Distribution distribution, double probability) {
  switch (distribution) {
    case Distribution::rectangular:
      return std::numbers::sqrt3 * (2 * probability - 1);
    case Distribution::two_point:
      return probability < 0.5 ? -1 : 1;
    case Distribution::normal:
      break;
  }
  return normal_quantile(probability);
}

double normal_quantile(double probability) {
  return boost::math::quantile(boost::math::normal_distribution<double, InDouble>(), probability);
}

double normal_share_below(double value) {
  return 0.5 * std::erfc(-value / std::numbers::sqrt2);
}

double coverage_factor_95(double degrees_of_freedom) {
  const boost::math::students_t_distribution<double, InDouble> student(degrees_of_freedom);
  return boost::math::quantile(boost::math::complement(student, 0.025));
}

}  // namespace spoolflow::uncertainty
