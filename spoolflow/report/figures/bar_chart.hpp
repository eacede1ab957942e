#pragma once
/// Horizontal bars with their names, drawn as SVG text.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/report/text/text.hpp"

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
  Text text;  ///< the value, as it is to be read
};

struct BarChart {
  std::string description;                   ///< for screen readers
  std::string axis;                          ///< what is drawn; without a quantity with its unit
  std::optional<units::Kind> quantity = {};  ///< of SI lengths; its unit is written behind the axis' name
  std::vector<Bar> bars;
  double lowest = 0;
  std::optional<double> highest = {};  ///< else from the bars; what goes beyond is cut off
};

/// As it is drawn: SI lengths in the unit of their quantity, texts written out.
[[nodiscard]] BarChart in_units(BarChart chart, const ReaderUnits& units);

/// Text keeps its size whatever the width.
[[nodiscard]] std::string svg_of(const BarChart& chart, double width_px, const ReaderUnits& units);

/// A figure over the whole width, drawn a second time for narrow screens. `legend` is markup.
struct CaptionedChart {
  BarChart chart;
  Text caption;
  std::string legend = {};
};
[[nodiscard]] std::string figure_of(const CaptionedChart& each, const ReaderUnits& units);
/// Charts beside each other where there is room, one caption below each.
[[nodiscard]] std::string pair_of(const std::vector<CaptionedChart>& charts, const ReaderUnits& units);

}  // namespace spoolflow::report
