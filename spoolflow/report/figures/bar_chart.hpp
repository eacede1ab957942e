#pragma once
/// Horizontal bars with their names, drawn as SVG text.
#include <optional>
#include <string>
#include <vector>

namespace spoolflow::report {

/// One line of a chart. `pale` is a second, wider bar behind the first; whiskers are a confidence interval.
struct Bar {
  struct Length {
    double value = 0;
    std::optional<double> lower = {}, upper = {};
  };
  std::string name;
  std::string tone;  ///< a colour of the style sheet
  Length solid;
  std::optional<Length> pale = {};
  std::string text;  ///< the value, as it is to be read
};

struct BarChart {
  std::string description;  ///< for screen readers
  std::string axis;         ///< what is drawn, with its unit
  std::vector<Bar> bars;
  double lowest = 0;
  std::optional<double> highest = {};  ///< else from the bars; what goes beyond is cut off
};

/// Text keeps its size whatever the width.
[[nodiscard]] std::string svg_of(const BarChart& chart, double width_px);

/// A figure over the whole width, drawn a second time for narrow screens. `legend` is markup.
[[nodiscard]] std::string figure_of(const BarChart& chart, const std::string& caption, const std::string& legend = {});
/// Charts beside each other where there is room, one caption below each.
struct CaptionedChart {
  BarChart chart;
  std::string caption;
};
[[nodiscard]] std::string pair_of(const std::vector<CaptionedChart>& charts);

}  // namespace spoolflow::report
