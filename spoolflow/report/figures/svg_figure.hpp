#pragma once
/// Draws figures as SVG text. Colours are classes of the page's style sheet, so the same drawing is right in light, in
/// dark and in print.
#include <string>

#include "spoolflow/report/figures/figure.hpp"

namespace spoolflow::report {

/// The room a drawing has; text keeps its size in it.
struct Layout {
  double width_px = 1060;
  double height_share = 1;  ///< of the panels' heights
};

/// `id` is unique on the page (it names the drawing's clip paths).
[[nodiscard]] std::string svg_of(const Figure& figure, const Layout& layout, const std::string& id,
                                 const ReaderUnits& units = {});

/// The names in the figure with their line styles, as HTML; empty where nothing is named.
[[nodiscard]] std::string legend_of(const Figure& figure, const ReaderUnits& units = {});

}  // namespace spoolflow::report
