#pragma once
/// Where data stand on the drawing.
#include <string>
#include <vector>

#include "spoolflow/report/figures/figure.hpp"

namespace spoolflow::report {

/// Where an axis is marked, and with what.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> text;  ///< as many decimals as the step needs
};

/// Round numbers (1, 2 or 5 times a power of ten apart) that divide [lowest, highest] into about `wanted` steps;
/// two of them at least.
[[nodiscard]] Ticks round_ticks(double lowest, double highest, int wanted);

/// The x axis that all panels of a figure share; pixels from left to right.
struct PlotWidth {
  double left, right;
  double x_lowest, x_highest;
};
[[nodiscard]] PlotWidth plot_width(const Figure& figure, double width_px);

/// The room of one panel: pixels and the data ranges that fill them.
struct PlotFrame {
  double left, right, top, bottom;
  double x_lowest, x_highest, y_lowest, y_highest;

  [[nodiscard]] double height() const { return bottom - top; }
  [[nodiscard]] double x_px(double x) const { return left + (x - x_lowest) / (x_highest - x_lowest) * (right - left); }
  [[nodiscard]] double y_px(double y) const {
    return bottom - (y - y_lowest) / (y_highest - y_lowest) * (bottom - top);
  }
};
[[nodiscard]] PlotFrame plot_frame(const Panel& panel, const PlotWidth& width, double top, double bottom);

}  // namespace spoolflow::report
