#include "spoolflow/report/svg_heat_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/html_text.hpp"
#include "spoolflow/report/svg_chart.hpp"

namespace spoolflow::report {
namespace {

/// From pale to dark, even in lightness (after viridis, reversed): readable in print and by the colour-blind.
std::string colour_of(double share) {
  constexpr std::array<std::array<double, 3>, 6> stops{
      {{253, 231, 37}, {122, 209, 81}, {34, 168, 132}, {42, 120, 142}, {65, 68, 135}, {68, 1, 84}}};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(low);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(std::lround(stops[low][c] + part * (stops[low + 1][c] - stops[low][c])));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace

std::string svg_of(const HeatMap& map) {
  constexpr double left = 62, right = 110, top = 14, bottom = 46;
  const double plot_width = map.width - left - right;
  const double plot_height = map.height - top - bottom;
  const double cell_width = plot_width / static_cast<double>(map.x.size());
  const double cell_height = plot_height / static_cast<double>(map.y.size());
  const double x_step = map.x[1] - map.x[0];
  const double y_step = map.y[1] - map.y[0];
  const auto px = [&](double x) { return left + ((x - map.x[0]) / x_step + 0.5) * cell_width; };
  const auto py = [&](double y) { return map.height - bottom - ((y - map.y[0]) / y_step + 0.5) * cell_height; };
  std::string out = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", map.width, map.height,
                                html_text(map.description));
  for (std::size_t r = 0; r < map.y.size(); ++r) {
    for (std::size_t c = 0; c < map.x.size(); ++c) {
      out += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)",
                         px(map.x[c]) - 0.5 * cell_width, py(map.y[r]) - 0.5 * cell_height, cell_width + 0.4,
                         cell_height + 0.4, colour_of(map.value[r * map.x.size() + c] / map.highest));
    }
  }
  for (const double x : round_ticks(map.x.front(), map.x.back(), 8)) {
    out += fmt::format(R"(<text class="tick" text-anchor="middle" x="{:.1f}" y="{:.1f}">{:g}</text>)", px(x),
                       map.height - bottom + 17, x);
  }
  for (const double y : round_ticks(map.y.front(), map.y.back(), 6)) {
    out += fmt::format(R"(<text class="tick" text-anchor="end" x="{}" y="{:.1f}">{:g}</text>)", left - 7, py(y) + 4, y);
  }
  out += fmt::format(R"(<text class="label" text-anchor="middle" x="{:.1f}" y="{:.1f}">{}</text>)",
                     left + 0.5 * plot_width, map.height - 8, html_text(map.x_label));
  out += fmt::format(
      R"svg(<text class="label" text-anchor="middle" transform="translate(14 {:.1f}) rotate(-90)">{}</text>)svg",
      top + 0.5 * plot_height, html_text(map.y_label));
  constexpr int shades = 24;
  const double scale_x = map.width - right + 24;
  for (int k = 0; k < shades; ++k) {
    out += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="14" height="{:.1f}" fill="{}"/>)", scale_x,
                       top + plot_height * (shades - 1 - k) / shades, plot_height / shades + 0.4,
                       colour_of((k + 0.5) / shades));
  }
  for (const double v : round_ticks(0, map.highest, 4)) {
    const bool last = v > map.highest * 0.999;
    out += fmt::format(R"(<text class="tick" x="{:.1f}" y="{:.1f}">{:g}{}</text>)", scale_x + 20,
                       top + plot_height * (1 - v / map.highest) + 4, v, last ? "+" : "");
  }
  out += fmt::format(
      R"svg(<text class="label" text-anchor="middle" transform="translate({:.1f} {:.1f}) rotate(-90)">{}</text>)svg",
      scale_x + 70, top + 0.5 * plot_height, html_text(map.value_label));
  out += "</svg>\n";
  return out;
}

}  // namespace spoolflow::report
