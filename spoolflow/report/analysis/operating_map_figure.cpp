#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/figures/heat_scale.hpp"
#include "spoolflow/report/figures/plot_frame.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using analysis::MapCell;
using analysis::OperatingMap;

/// In % FS.
constexpr HeatScale heat_scale({0, 0.5, 1, 2, 4, 8, 16, 32});
/// Of groups, in the order in which they are met; each cell also carries the group's letters.
constexpr std::array<const char*, 6> tones{"a", "condensed", "c", "d", "b", "soft"};

constexpr double map_width_px = 510, height_px = 330, left_px = 44, right_px = 500, upper_px = 8, bottom_px = 286;

/// "FR" for friction, "FM" for force map.
std::string letters_of(std::string_view group) {
  const std::size_t space = group.find_first_of(" -");
  std::string out{group[0], space == std::string_view::npos ? group[1] : group[space + 1]};
  for (char& letter : out) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return out;
}

/// Where the cells stand: the axes run from half a cell before the first grid point to half a cell past the last.
struct Grid {
  const std::vector<double>& values;
  double per_SI, begin_px, end_px;

  [[nodiscard]] double step() const { return values.size() > 1 ? values[1] - values[0] : values[0]; }
  [[nodiscard]] double lowest() const { return per_SI * (values.front() - 0.5 * step()); }
  [[nodiscard]] double highest() const { return per_SI * (values.back() + 0.5 * step()); }
  [[nodiscard]] double px(double value) const {
    return begin_px + (value - lowest()) / (highest() - lowest()) * (end_px - begin_px);
  }
  [[nodiscard]] double edge_px(std::size_t k) const {
    return begin_px + static_cast<double>(k) / static_cast<double>(values.size()) * (end_px - begin_px);
  }
};

/// Draws axes and, for every cell of the map, what `look` and `text` say.
template <class Look, class Text>
std::string drawn(const OperatingMap& map, const ReaderUnits& units, const std::string& description, const Look& look,
                  const Text& text) {
  const Grid x{map.position_m, units.value(units::length(1)), left_px, right_px};
  const Grid y{map.pressure_difference_Pa, units.value(units::pressure(1)), bottom_px, upper_px};
  std::string out = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", map_width_px, height_px,
                                html_text(description));
  const std::size_t columns = map.position_m.size();
  const bool room = x.edge_px(1) - x.edge_px(0) > 15 && y.edge_px(0) - y.edge_px(1) > 12;
  for (std::size_t k = 0; k < map.cells.size(); ++k) {
    const MapCell& cell = map.cells[k];
    if (!cell.reachable) continue;
    const std::size_t c = k % columns;
    const std::size_t r = k / columns;
    out += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" {}/>)", x.edge_px(c),
                       y.edge_px(r + 1), x.edge_px(c + 1) - x.edge_px(c) + 0.3, y.edge_px(r) - y.edge_px(r + 1) + 0.3,
                       look(cell));
    const std::string written = room ? text(cell) : std::string();
    if (written.empty()) continue;
    out += fmt::format(
        R"x(<text text-anchor="middle" style="font-size:9px;fill:var(--paper)" x="{:.1f}" y="{:.1f}">{}</text>)x",
        0.5 * (x.edge_px(c) + x.edge_px(c + 1)), 0.5 * (y.edge_px(r) + y.edge_px(r + 1)) + 3, written);
  }
  const Ticks across = round_ticks(x.lowest(), x.highest(), 6);
  for (std::size_t k = 0; k < across.at.size(); ++k) {
    out += fmt::format(R"(<text class="tick" text-anchor="middle" x="{:.1f}" y="{}">{}</text>)", x.px(across.at[k]),
                       bottom_px + 16, across.text[k]);
  }
  const Ticks up = round_ticks(y.lowest(), y.highest(), 6);
  for (std::size_t k = 0; k < up.at.size(); ++k) {
    out += fmt::format(R"(<text class="tick" text-anchor="end" x="{}" y="{:.1f}">{}</text>)", left_px - 6,
                       y.px(up.at[k]) + 4, up.text[k]);
  }
  out += fmt::format(R"(<path class="axis" d="M{0} {1}V{2}H{3}"/>)", left_px, upper_px, bottom_px, right_px);
  out += fmt::format(R"(<text class="label" text-anchor="middle" x="{}" y="{}">Position [{}]</text></svg>)",
                     0.5 * (left_px + right_px), bottom_px + 36, units.unit(units::Kind::length).shown);
  return out;
}

/// Groups that dominate anywhere, the most frequent first.
std::vector<std::string_view> groups_of(const OperatingMap& map) {
  std::vector<std::pair<std::string_view, int>> counts;
  for (const MapCell& cell : map.cells) {
    if (!cell.reachable) continue;
    const std::string_view group = uncertainty::about(cell.dominant).group;
    const auto found = std::ranges::find_if(counts, [&](const auto& c) { return c.first == group; });
    if (found == counts.end()) {
      counts.emplace_back(group, 1);
    } else {
      ++found->second;
    }
  }
  std::ranges::stable_sort(counts, [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string_view> out;
  for (const auto& [group, count] : counts) out.push_back(group);
  return out;
}

}  // namespace

std::string operating_map_figures(const OperatingMap& map, double full_scale_m3_per_s, const ReaderUnits& units) {
  const std::string name(sensor_name(map.estimator));
  const std::string_view pressure = units.unit(units::Kind::pressure).shown;
  const std::vector<std::string_view> groups = groups_of(map);
  const auto tone_of = [&](const MapCell& cell) {
    const std::string_view group = uncertainty::about(cell.dominant).group;
    const auto place = static_cast<std::size_t>(std::ranges::find(groups, group) - groups.begin());
    return fmt::format("style=\"fill:var(--{})\"", tones[std::min(place, tones.size() - 1)]);
  };
  const std::string heat = drawn(
      map, units, name + ": expanded uncertainty over position and pressure difference",
      [&](const MapCell& cell) {
        return fmt::format("class=\"h{}\"", heat_scale.colour(100 * cell.expanded_m3_per_s / full_scale_m3_per_s));
      },
      [](const MapCell&) { return std::string(); });
  const std::string dominant =
      drawn(map, units,
            name + ": group of inputs with the largest share of the variance, over position and pressure difference",
            tone_of, [](const MapCell& cell) { return letters_of(uncertainty::about(cell.dominant).group); });
  std::string legend = "<div class=\"heat\"><span>Counts most:</span>";
  for (std::size_t k = 0; k < groups.size(); ++k) {
    legend += colour_key(fmt::format("style=\"fill:var(--{})\"", tones[std::min(k, tones.size() - 1)]),
                         fmt::format("{} {}", letters_of(groups[k]), groups[k]));
  }
  legend += "</div>";
  return fmt::format(
      "<div class=\"pair\"><figure>{}<p class=\"soft\" style=\"margin:0 0 0 44px\">Pressure difference [{}]</p>{}"
      "<figcaption>The {}: expanded uncertainty (95 %). Empty: outside the calibrated maps.</figcaption></figure>\n"
      "<figure>{}<p class=\"soft\" style=\"margin:0 0 0 44px\">Pressure difference [{}]</p>{}"
      "<figcaption>The {}: which group of inputs has the largest share of the variance.</figcaption></figure></div>\n",
      heat_scale.legend("Expanded uncertainty, % FS"), pressure, heat, name, legend, pressure, dominant, name);
}

}  // namespace spoolflow::report
