#pragma once
/// Line charts as SVG text: axes with round ticks, units, a legend; colours are classes that the page's style sheet
/// sets, so the same figure is right in light and dark and in print.
#include <optional>
#include <string>
#include <vector>

namespace spoolflow::report {

/// Line styles of a series.
enum class Stroke { solid, dashed, thin, dots };

struct Series {
  std::string name;       ///< empty: not in the legend
  std::vector<double> x;  ///< rising or not; NaN breaks the line
  std::vector<double> y;
  int colour = 0;  ///< 0 to 7: a categorical colour; 8: muted
  Stroke stroke = Stroke::solid;
  std::string label_at_end;  ///< written at the last point, for families of lines
};

/// An area between two lines.
struct Band {
  std::string name;
  std::vector<double> x, lower, upper;
  int colour = 0;
};

struct Chart {
  std::string x_label, y_label;  ///< with their units
  std::string description;       ///< for screen readers
  std::vector<Band> bands;
  std::vector<Series> series;
  std::optional<double> y_lowest, y_highest;  ///< else from the data
  double width = 880, height = 300;
};

[[nodiscard]] std::string svg_of(const Chart& chart);

/// Round numbers that divide [lowest, highest] into about `wanted` steps.
[[nodiscard]] std::vector<double> round_ticks(double lowest, double highest, int wanted);

/// Keeps at most `columns` pairs of smallest and largest y per stretch of x, so that peaks survive. Longer vectors
/// only; x must rise.
struct Decimated {
  std::vector<double> x, y;
};
[[nodiscard]] Decimated decimate(const std::vector<double>& x, const std::vector<double>& y, std::size_t columns);

}  // namespace spoolflow::report
