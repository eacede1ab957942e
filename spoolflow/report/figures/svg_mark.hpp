#pragma once
/// Lines, areas and dots as SVG text.
#include <string>

#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/figures/plot_frame.hpp"

namespace spoolflow::report {

/// Lines over rising x that have more points than the drawing has pixels are thinned to two points a pixel, peaks kept.
void draw_mark(std::string& out, const Mark& mark, const PlotFrame& frame);
/// The labels beside the marks' last points; one that would touch another is left out.
void draw_end_labels(std::string& out, const std::vector<Mark>& marks, const PlotFrame& frame);
/// A sample of the mark, 26 by 12, for the legend.
[[nodiscard]] std::string key_of(const Mark& mark);

}  // namespace spoolflow::report
