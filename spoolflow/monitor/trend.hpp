#pragma once
/// The course of one magnitude over the windows, and whether it has a trend: a straight line through the last part of
/// it whose slope is beyond chance. Of fixed size: where it is full, neighbours are joined, so that it spans all time
/// and keeps the newest as fine as the oldest.
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "spoolflow/monitor/condition.hpp"

namespace spoolflow::monitor {

inline constexpr std::size_t course_points = 24;
/// A trend is given from so many points on, ...
inline constexpr std::size_t least_trend_points = 6;
/// ... where the slope is so many of its standard deviations; the part of the course with the most is taken, so that
/// the limit lies higher than for a single line, ...
inline constexpr double trend_deviations = 6;
/// ... and where the line changes by so many spreads of healthy valves: less is how operation differs.
inline constexpr double least_trend_spreads = 1.5;

/// A mean over `windows` windows.
struct CoursePoint {
  float time_h;  ///< of watched time
  float value;   ///< in usual_fault
  float windows;
};

struct Course {
  std::array<CoursePoint, course_points> point{};
  std::uint32_t count = 0;
  float windows_a_point = 1;  ///< that a full point has
};
static_assert(std::is_trivially_copyable_v<Course>);

/// One window's value.
void follow(Course& course, double time_h, double value);

/// The line through the most significant part of the course. `now` and `slope_per_h` in the course's own unit, each
/// with one standard deviation.
struct Line {
  bool there = false;
  double now = 0, now_deviation = 0;
  double slope_per_h = 0, slope_deviation = 0;
};
/// `spread`: one standard deviation of healthy valves, in the course's unit.
[[nodiscard]] Line line_through(const Course& course, double spread);

/// When the line reaches `limit`, in hours from its end, with the interval in which it does so in 95 % of cases as far
/// by slope and level; infinite where it may never. 0 where it is beyond already.
struct TimeToLimit {
  double earliest_h, expected_h, latest_h;
};
[[nodiscard]] TimeToLimit time_to(const Line& line, double limit);

}  // namespace spoolflow::monitor
