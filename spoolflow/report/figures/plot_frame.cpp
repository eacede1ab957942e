#include "spoolflow/report/figures/plot_frame.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {

Ticks round_ticks(double lowest, double highest, int wanted) {
  Ticks out;
  if (!(highest > lowest)) return out;
  const double rough = (highest - lowest) / std::max(1, wanted);
  const double magnitude = std::pow(10.0, std::floor(std::log10(rough)));
  const auto first = [&](double step) { return std::ceil(lowest / step - 1e-9); };
  const auto last = [&](double step) { return std::floor(highest / step + 1e-9); };
  double step = magnitude;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    if (factor > 1 && last(factor * magnitude) - first(factor * magnitude) < 1) break;  // a single mark shows no scale
    step = factor * magnitude;
    if (step >= rough * (1 - 1e-9)) break;
  }
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  for (double k = first(step); k <= last(step); k += 1) {
    out.at.push_back(k * step);
    out.text.push_back(fixed(k * step, decimals));
  }
  return out;
}

namespace {

/// The smallest and largest of finite numbers.
struct Extent {
  double lowest = INFINITY;
  double highest = -INFINITY;

  void take(double value) {
    if (!std::isfinite(value)) return;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  void take(const std::vector<double>& values) {
    for (const double value : values) take(value);
  }
  /// Room for an axis even where nothing or one value was seen.
  void settle() {
    if (lowest > highest) lowest = 0, highest = 1;
    if (lowest == highest) lowest -= 0.5, highest += 0.5;
  }
};

}  // namespace

PlotWidth plot_width(const Figure& figure, double width_px) {
  Extent x;
  bool end_labels = false;
  for (const Panel& panel : figure.panels) {
    for (const Mark& mark : panel.marks) {
      x.take(mark.x);
      end_labels = end_labels || !mark.end_label.empty();
    }
    for (const Cell& cell : panel.cells) x.take(cell.x_from), x.take(cell.x_to);
    for (const Row& row : panel.rows) {
      for (const Span& span : row.spans) x.take(span.from), x.take(span.to);
    }
  }
  if (figure.x_lowest) x.lowest = *figure.x_lowest;
  if (figure.x_highest) x.highest = *figure.x_highest;
  x.settle();
  return {44, width_px - (end_labels ? 54 : 12), x.lowest, x.highest};
}

PlotFrame plot_frame(const Panel& panel, const PlotWidth& width, double top, double bottom) {
  Extent y;
  for (const Mark& mark : panel.marks) y.take(mark.y), y.take(mark.y_upper);
  for (const Cell& cell : panel.cells) y.take(cell.y_from), y.take(cell.y_to);
  y.settle();
  const double margin = panel.cells.empty() ? 0.05 * (y.highest - y.lowest) : 0;
  const bool from_zero = y.lowest >= 0 && y.lowest < 0.4 * y.highest;
  return {width.left,
          width.right,
          top,
          bottom,
          width.x_lowest,
          width.x_highest,
          panel.lowest.value_or(from_zero ? 0 : y.lowest - margin),
          panel.highest.value_or(y.highest + margin)};
}

}  // namespace spoolflow::report
