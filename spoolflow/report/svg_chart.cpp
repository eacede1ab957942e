#include "spoolflow/report/svg_chart.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/html_text.hpp"

namespace spoolflow::report {
namespace {

constexpr double left = 62, right = 18, top = 14, bottom = 46;

struct Frame {
  double x0, x1, y0, y1;  ///< data ranges
  double width, height;

  [[nodiscard]] double px(double x) const { return left + (x - x0) / (x1 - x0) * (width - left - right); }
  [[nodiscard]] double py(double y) const { return height - bottom - (y - y0) / (y1 - y0) * (height - top - bottom); }
};

struct Extent {
  double lowest = INFINITY;
  double highest = -INFINITY;

  void take(const std::vector<double>& values) {
    for (const double v : values) {
      if (!std::isfinite(v)) continue;
      lowest = std::min(lowest, v);
      highest = std::max(highest, v);
    }
  }
  void settle() {
    if (lowest > highest) lowest = 0, highest = 1;
    if (lowest == highest) lowest -= 0.5, highest += 0.5;
  }
};

Frame frame_of(const Chart& chart) {
  Extent x;
  Extent y;
  for (const Series& series : chart.series) x.take(series.x), y.take(series.y);
  for (const Band& band : chart.bands) x.take(band.x), y.take(band.lower), y.take(band.upper);
  x.settle();
  y.settle();
  const double margin = 0.04 * (y.highest - y.lowest);
  return {x.lowest,
          x.highest,
          chart.y_lowest.value_or(y.lowest >= 0 && y.lowest < 0.3 * y.highest ? 0 : y.lowest - margin),
          chart.y_highest.value_or(y.highest + margin),
          chart.width,
          chart.height};
}

std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
}

void draw_axes(std::string& out, const Chart& chart, const Frame& frame) {
  const auto x_ticks = round_ticks(frame.x0, frame.x1, std::max(3, static_cast<int>(chart.width / 110)));
  const auto y_ticks = round_ticks(frame.y0, frame.y1, std::max(3, static_cast<int>(chart.height / 55)));
  const double x_step = x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1;
  const double y_step = y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1;
  for (const double y : y_ticks) {
    out += fmt::format(R"(<line class="{}" x1="{}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)", y == 0 ? "zero" : "grid",
                       left, frame.width - right, frame.py(y), frame.py(y));
    out += fmt::format(R"(<text class="tick" text-anchor="end" x="{}" y="{:.1f}">{}</text>)", left - 7, frame.py(y) + 4,
                       tick_text(y, y_step));
  }
  for (const double x : x_ticks) {
    out += fmt::format(R"(<line class="grid" x1="{:.1f}" x2="{:.1f}" y1="{}" y2="{:.1f}"/>)", frame.px(x), frame.px(x),
                       top, frame.height - bottom);
    out += fmt::format(R"(<text class="tick" text-anchor="middle" x="{:.1f}" y="{:.1f}">{}</text>)", frame.px(x),
                       frame.height - bottom + 17, tick_text(x, x_step));
  }
  out += fmt::format(R"(<text class="label" text-anchor="middle" x="{:.1f}" y="{:.1f}">{}</text>)",
                     0.5 * (left + frame.width - right), frame.height - 8, html_text(chart.x_label));
  out += fmt::format(
      R"svg(<text class="label" text-anchor="middle" transform="translate(14 {:.1f}) rotate(-90)">{}</text>)svg",
      0.5 * (top + frame.height - bottom), html_text(chart.y_label));
}

void draw_band(std::string& out, const Band& band, const Frame& frame) {
  const std::size_t n = band.x.size();
  if (n < 2) return;
  out += fmt::format(R"(<path class="band c{}" d="M)", band.colour);
  for (std::size_t k = 0; k < n; ++k)
    out += fmt::format("{:.1f} {:.1f}L", frame.px(band.x[k]), frame.py(band.upper[k]));
  for (std::size_t k = n; k-- > 0;)
    out += fmt::format("{:.1f} {:.1f}{}", frame.px(band.x[k]), frame.py(band.lower[k]), k == 0 ? "Z" : "L");
  out += "\"/>";
}

void draw_series(std::string& out, const Series& series, const Frame& frame) {
  if (series.stroke == Stroke::dots) {
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.y[k])) continue;
      out += fmt::format(R"(<circle class="dot c{}" cx="{:.1f}" cy="{:.1f}" r="2.4"/>)", series.colour,
                         frame.px(series.x[k]), frame.py(series.y[k]));
    }
    return;
  }
  const char* style = series.stroke == Stroke::dashed ? " dashed" : (series.stroke == Stroke::thin ? " thin" : "");
  out += fmt::format(R"(<path class="line c{}{}" d=")", series.colour, style);
  bool pen_down = false;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!std::isfinite(series.x[k]) || !std::isfinite(series.y[k])) {
      pen_down = false;
      continue;
    }
    out += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', frame.px(series.x[k]), frame.py(series.y[k]));
    pen_down = true;
  }
  out += "\"/>";
  if (!series.label_at_end.empty() && !series.x.empty()) {
    out += fmt::format(R"(<text class="mark" x="{:.1f}" y="{:.1f}">{}</text>)", frame.px(series.x.back()) + 4,
                       frame.py(series.y.back()) + 4, html_text(series.label_at_end));
  }
}

std::string legend_of(const Chart& chart) {
  std::string out;
  const auto entry = [&](const std::string& name, const char* kind, int colour) {
    if (!name.empty())
      out += fmt::format(R"(<span><i class="key {} c{}"></i>{}</span>)", kind, colour, html_text(name));
  };
  for (const Series& series : chart.series) {
    entry(series.name, series.stroke == Stroke::dashed ? "dashed" : (series.stroke == Stroke::dots ? "dots" : "solid"),
          series.colour);
  }
  for (const Band& band : chart.bands) entry(band.name, "area", band.colour);
  return out.empty() ? out : "<div class=\"legend\">" + out + "</div>";
}

}  // namespace

std::vector<double> round_ticks(double lowest, double highest, int wanted) {
  const double rough = (highest - lowest) / std::max(1, wanted);
  const double magnitude = std::pow(10.0, std::floor(std::log10(rough)));
  double step = magnitude;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    step = factor * magnitude;
    if (step >= rough * (1 - 1e-9)) break;
  }
  std::vector<double> ticks;
  for (double k = std::ceil(lowest / step - 1e-9); k * step <= highest + 1e-9 * step; k += 1) ticks.push_back(k * step);
  return ticks;
}

Decimated decimate(const std::vector<double>& x, const std::vector<double>& y, std::size_t columns) {
  if (x.size() <= 4 * columns) return {x, y};
  Decimated out;
  const double width = (x.back() - x.front()) / static_cast<double>(columns);
  std::size_t k = 0;
  for (std::size_t column = 0; column < columns && k < x.size(); ++column) {
    const double until = column + 1 == columns ? INFINITY : x.front() + width * static_cast<double>(column + 1);
    std::size_t lowest = k;
    std::size_t highest = k;
    const std::size_t begin = k;
    for (; k < x.size() && x[k] <= until; ++k) {
      if (!(y[k] >= y[lowest])) lowest = k;
      if (!(y[k] <= y[highest])) highest = k;
    }
    if (k == begin) continue;
    for (const std::size_t kept : {std::min(lowest, highest), std::max(lowest, highest)}) {
      out.x.push_back(x[kept]);
      out.y.push_back(y[kept]);
      if (lowest == highest) break;
    }
  }
  return out;
}

std::string svg_of(const Chart& chart) {
  const Frame frame = frame_of(chart);
  std::string out = legend_of(chart);
  out += fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", chart.width, chart.height,
                     html_text(chart.description));
  draw_axes(out, chart, frame);
  for (const Band& band : chart.bands) draw_band(out, band, frame);
  for (const Series& series : chart.series) draw_series(out, series, frame);
  out += "</svg>\n";
  return out;
}

}  // namespace spoolflow::report
