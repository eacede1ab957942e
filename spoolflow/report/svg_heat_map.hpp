#pragma once
#include <string>
#include <vector>

namespace spoolflow::report {

/// A map of cells over two axes, coloured from low to high with a scale beside it.
struct HeatMap {
  std::string x_label, y_label, value_label, description;
  std::vector<double> x, y;   ///< cell centres, equally spaced
  std::vector<double> value;  ///< value[row of y][column of x], row after row of y
  double highest = 1;         ///< values above take the last colour
  double width = 880, height = 300;
};

[[nodiscard]] std::string svg_of(const HeatMap& map);

}  // namespace spoolflow::report
