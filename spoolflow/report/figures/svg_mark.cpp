#include "spoolflow/report/figures/svg_mark.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/validation/trace.hpp"

namespace spoolflow::report {
namespace {

/// class="…", and where along its family the mark stands.
std::string look_of(const Mark& mark, const char* kind) {
  if (mark.ramp) return fmt::format(R"(class="{} ramp" style="--m:{:.0f}%")", kind, 100 * *mark.ramp);
  return fmt::format(R"(class="{} {}")", kind, mark.tone);
}

struct Points {
  std::vector<double> x, y;
};

Points drawn_points(const Mark& mark, const PlotFrame& frame) {
  const auto columns = static_cast<std::size_t>(std::max(50.0, frame.right - frame.left));
  if (mark.x.size() <= 2 * columns || !std::is_sorted(mark.x.begin(), mark.x.end())) return {mark.x, mark.y};
  const std::vector<float> y(mark.y.begin(), mark.y.end());
  const validation::Line thin = validation::thinned(mark.x, y, columns / 2);
  return {thin.time_s, {thin.value.begin(), thin.value.end()}};
}

void draw_line(std::string& out, const Mark& mark, const PlotFrame& frame) {
  const Points points = drawn_points(mark, frame);
  out += fmt::format(R"(<path {}{} stroke-width="{:.1f}" d=")", look_of(mark, "line"),
                     mark.shape == Shape::dashed ? " stroke-dasharray=\"5 3.5\"" : "", mark.width_px);
  bool pen_down = false;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const bool there = std::isfinite(points.x[k]) && std::isfinite(points.y[k]);
    if (there)
      out += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', frame.x_px(points.x[k]), frame.y_px(points.y[k]));
    pen_down = there;
  }
  out += "\"/>";
}

/// One closed outline from point `begin` to before `end`.
void draw_outline(std::string& out, const Mark& mark, const PlotFrame& frame, std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  for (std::size_t k = begin; k < end; ++k) {
    out += fmt::format("{}{:.1f} {:.1f}", k == begin ? 'M' : 'L', frame.x_px(mark.x[k]), frame.y_px(mark.y_upper[k]));
  }
  for (std::size_t k = end; k-- > begin;) {
    out += fmt::format("L{:.1f} {:.1f}", frame.x_px(mark.x[k]), frame.y_px(mark.y[k]));
  }
  out += "Z";
}

void draw_area(std::string& out, const Mark& mark, const PlotFrame& frame) {
  out += fmt::format("<path {} d=\"", look_of(mark, "area"));
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= mark.x.size(); ++k) {
    const bool there = k < mark.x.size() && std::isfinite(mark.y[k]) && std::isfinite(mark.y_upper[k]);
    if (there) continue;
    draw_outline(out, mark, frame, begin, k);
    begin = k + 1;
  }
  out += "\"/>";
}

void draw_dots(std::string& out, const Mark& mark, const PlotFrame& frame) {
  out += fmt::format("<path {} stroke-width=\"{:.1f}\" d=\"", look_of(mark, "dots"), mark.width_px);
  for (std::size_t k = 0; k < mark.x.size(); ++k) {
    if (!std::isfinite(mark.y[k])) continue;
    out += fmt::format("M{:.1f} {:.1f}h0", frame.x_px(mark.x[k]), frame.y_px(mark.y[k]));
  }
  out += "\"/>";
}

}  // namespace

void draw_mark(std::string& out, const Mark& mark, const PlotFrame& frame) {
  switch (mark.shape) {
    case Shape::line:
    case Shape::dashed:
      draw_line(out, mark, frame);
      break;
    case Shape::area:
      draw_area(out, mark, frame);
      break;
    case Shape::dots:
      draw_dots(out, mark, frame);
      break;
  }
}

void draw_end_labels(std::string& out, const std::vector<Mark>& marks, const PlotFrame& frame) {
  constexpr double line_px = 13;
  constexpr double label_px = 46;
  struct Place {
    double x, y;
  };
  std::vector<Place> taken;
  for (const Mark& mark : marks) {
    if (mark.end_label.empty() || mark.x.empty()) continue;
    const Place place{frame.x_px(mark.x.back()) + 5, frame.y_px(mark.y.back()) + 4};
    const bool free = std::ranges::none_of(taken, [&](const Place& other) {
      return std::abs(other.y - place.y) < line_px && std::abs(other.x - place.x) < label_px;
    });
    if (!free) continue;
    taken.push_back(place);
    out += fmt::format(R"(<text class="mark" x="{:.1f}" y="{:.1f}">{}</text>)", place.x, place.y,
                       html_text(mark.end_label.str()));
  }
}

std::string key_of(const Mark& mark) {
  switch (mark.shape) {
    case Shape::area:
      return fmt::format(R"(<rect {} x="1" y="1" width="24" height="10"/>)", look_of(mark, "area"));
    case Shape::dots:
      return fmt::format(R"(<path {} stroke-width="{:.1f}" d="M13 6h0"/>)", look_of(mark, "dots"),
                         std::max(5.0, mark.width_px));
    case Shape::line:
    case Shape::dashed:
      break;
  }
  return fmt::format(R"(<path {}{} stroke-width="{:.1f}" d="M1 6H25"/>)", look_of(mark, "line"),
                     mark.shape == Shape::dashed ? " stroke-dasharray=\"5 3.5\"" : "", std::max(1.6, mark.width_px));
}

}  // namespace spoolflow::report
