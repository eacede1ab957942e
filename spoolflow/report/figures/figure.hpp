#pragma once
/// A figure as a plain description: panels above each other that share the x axis. How it looks is decided where it is
/// drawn (svg_figure.hpp) and in the page's style sheet. An axis that names its quantity has SI values and is drawn in
/// the reader's unit; one that names none is drawn as it is.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/report/text/text.hpp"

namespace spoolflow::report {

enum class Shape { line, dashed, dots, area };

/// Something drawn over x. NaN breaks lines and areas.
struct Mark {
  Shape shape = Shape::line;
  std::string tone = "ink";         ///< a colour of the style sheet: ink, soft, observer, condensed, a to d
  std::optional<double> ramp = {};  ///< instead of a tone: 0 to 1 along a family of lines
  Text name = {};                   ///< in the legend; empty: not there
  Text end_label = {};              ///< beside the last point
  double width_px = 1.6;
  std::vector<double> x = {}, y = {};
  std::vector<double> y_upper = {};  ///< areas only: they lie between y and y_upper
};

/// Where the k-th of n lines stands in its family.
[[nodiscard]] inline double ramp(std::size_t k, std::size_t n) {
  return n < 2 ? 0.5 : static_cast<double>(k) / static_cast<double>(n - 1);
}

/// A stretch of a timeline; `share` of it has the property.
struct Span {
  double from, to, share;
};

/// One line of a timeline.
struct Row {
  std::string label;
  std::string tone;
  std::vector<Span> spans = {};
};

/// A coloured rectangle of a heat map.
struct Cell {
  double x_from, x_to, y_from, y_to;
  int heat;  ///< 0 to 7, a colour of the style sheet
};

/// One pair of axes: marks over cells, or the rows of a timeline.
struct Panel {
  Text title;                                ///< "Flow rate"; without a quantity with its unit: "Gain [%]"
  std::optional<units::Kind> quantity = {};  ///< of y; its unit is written behind the title
  std::string title_end = {};                ///< behind the unit
  double height_px = 220;
  std::optional<double> lowest = {}, highest = {};  ///< else from the data; marks beyond are cut off
  std::vector<Cell> cells = {};
  std::vector<Mark> marks = {};
  std::vector<Row> rows = {};
};

/// A number written beside an axis.
struct AxisMark {
  double at;
  std::string text;
};

struct Figure {
  std::string description;  ///< for screen readers
  Text x_title;
  std::optional<units::Kind> x_quantity = {};
  std::optional<double> x_lowest = {}, x_highest = {};
  std::vector<AxisMark> x_marks = {};  ///< in the drawing's unit; else round numbers
  std::vector<Panel> panels = {};
};

/// Values in another unit, for drawing.
template <class Number>
[[nodiscard]] std::vector<double> scaled(const std::vector<Number>& values, double factor, double offset = 0) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const Number value : values) out.push_back(static_cast<double>(value) * factor + offset);
  return out;
}

}  // namespace spoolflow::report
