#include "spoolflow/monitor/trend.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spoolflow::monitor {
namespace {

CoursePoint joined(const CoursePoint& a, const CoursePoint& b) {
  const float share = b.windows / (a.windows + b.windows);
  return {a.time_h + share * (b.time_h - a.time_h), a.value + share * (b.value - a.value), a.windows + b.windows};
}

/// Weighted least squares from point `first` on; its deviations follow from the scatter about it.
Line line_from(const Course& course, std::size_t first) {
  double weight = 0, time_h = 0, value = 0;
  for (std::size_t k = first; k < course.count; ++k) {
    const CoursePoint& point = course.point[k];
    weight += point.windows;
    time_h += point.windows * point.time_h;
    value += point.windows * point.value;
  }
  time_h /= weight;
  value /= weight;
  double square = 0, cross = 0;
  for (std::size_t k = first; k < course.count; ++k) {
    const CoursePoint& point = course.point[k];
    square += point.windows * (point.time_h - time_h) * (point.time_h - time_h);
    cross += point.windows * (point.time_h - time_h) * (point.value - value);
  }
  Line out;
  if (!(square > 0)) return out;
  out.slope_per_h = cross / square;
  double residual = 0;
  for (std::size_t k = first; k < course.count; ++k) {
    const CoursePoint& point = course.point[k];
    const double off = point.value - value - out.slope_per_h * (point.time_h - time_h);
    residual += point.windows * off * off;
  }
  const double scatter2 = residual / static_cast<double>(course.count - first - 2);
  const double ahead_h = course.point[course.count - 1].time_h - time_h;
  out.slope_deviation = std::sqrt(scatter2 / square);
  out.now = value + out.slope_per_h * ahead_h;
  out.now_deviation = std::sqrt(scatter2 / weight + ahead_h * ahead_h * scatter2 / square);
  return out;
}

}  // namespace

void follow(Course& course, double time_h, double value) {
  if (course.count > 0 && course.point[course.count - 1].windows < course.windows_a_point) {
    CoursePoint& last = course.point[course.count - 1];
    last = joined(last, {static_cast<float>(time_h), static_cast<float>(value), 1});
    return;
  }
  if (course.count == course_points) {
    for (std::size_t k = 0; 2 * k < course_points; ++k)
      course.point[k] = joined(course.point[2 * k], course.point[2 * k + 1]);
    course.count = course_points / 2;
    course.windows_a_point *= 2;
  }
  course.point[course.count++] = {static_cast<float>(time_h), static_cast<float>(value), 1};
}

Line line_through(const Course& course, double spread) {
  Line best;
  double most = trend_deviations;
  for (std::size_t first = 0; first + least_trend_points <= course.count; ++first) {
    Line line = line_from(course, first);
    const double span_h = course.point[course.count - 1].time_h - course.point[first].time_h;
    if (!(std::abs(line.slope_per_h) * span_h > least_trend_spreads * spread)) continue;
    const double deviations = std::abs(line.slope_per_h) / std::max(line.slope_deviation, 1e-12);
    if (deviations < most) continue;
    most = deviations;
    best = line;
    best.there = true;
  }
  return best;
}

TimeToLimit time_to(const Line& line, double limit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double towards = limit > 0 ? 1 : -1;
  const auto time_h = [&](double ahead, double slope_per_h) {
    if (ahead <= 0) return 0.0;
    return slope_per_h > 0 ? ahead / slope_per_h : never;
  };
  const double ahead = towards * (limit - line.now), slope = towards * line.slope_per_h;
  const double ahead_95 = 2 * line.now_deviation, slope_95 = 2 * line.slope_deviation;
  return {time_h(ahead - ahead_95, slope + slope_95), time_h(ahead, slope), time_h(ahead + ahead_95, slope - slope_95)};
}

}  // namespace spoolflow::monitor
