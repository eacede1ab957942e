#include "spoolflow/report/figures/bar_chart.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/figures/plot_frame.hpp"
#include "spoolflow/report/figures/reader_axes.hpp"
#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {
namespace {

constexpr double row_px = 25;
constexpr double top_px = 8;
constexpr double axis_px = 40;
constexpr double wide_px = 1064, half_px = 510, narrow_px = 360;

/// Where things stand.
struct Frame {
  double left, right, bottom, lowest, highest;

  [[nodiscard]] double x(double value) const {
    return left + (std::clamp(value, lowest, highest) - lowest) / (highest - lowest) * (right - left);
  }
};

double reach(const Bar::Length& length) {
  return std::max(length.value, length.upper.value_or(length.value));
}

Frame frame_of(const BarChart& chart, double width_px) {
  std::size_t longest_name = 0;
  std::size_t longest_text = 0;
  double highest = chart.lowest;
  for (const Bar& bar : chart.bars) {
    longest_name = std::max(longest_name, bar.name.size());
    longest_text = std::max(longest_text, bar.text.str().size());
    highest = std::max({highest, reach(bar.solid), bar.pale ? reach(*bar.pale) : highest});
  }
  if (!(highest > chart.lowest)) highest = chart.lowest + 1;
  const double letter_px = 8;  // as large as texts are in print
  return {std::min(0.62 * width_px, 14 + letter_px * static_cast<double>(longest_name)),
          width_px - 14 - letter_px * static_cast<double>(longest_text),
          top_px + row_px * static_cast<double>(chart.bars.size()), chart.lowest, chart.highest.value_or(highest)};
}

std::string whisker(const Frame& frame, const Bar::Length& length, double y) {
  if (!length.lower || !length.upper) return {};
  const double from = frame.x(*length.lower);
  const double to = frame.x(*length.upper);
  return fmt::format(
      R"(<path class="axis" style="stroke:var(--ink);stroke-width:1.3" d="M{0:.1f} {2:.1f}H{1:.1f}M{0:.1f} {3:.1f}v6M{1:.1f} {3:.1f}v6"/>)",
      from, to, y, y - 3);
}

std::string rectangle(const Frame& frame, const Bar::Length& length, double y, double height, const std::string& look) {
  const double zero = frame.x(0);
  const double end = frame.x(length.value);
  return fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" {}/>)", std::min(zero, end), y,
                     std::max(std::abs(end - zero), 0.5), height, look);
}

void draw_axis(std::string& out, const BarChart& chart, const Frame& frame, double width_px) {
  const Ticks ticks = round_ticks(frame.lowest, frame.highest, frame.right - frame.left > 300 ? 6 : 3);
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    const double x = frame.x(ticks.at[k]);
    out += fmt::format(R"(<path class="grid" d="M{0:.1f} {1}V{2:.1f}"/>)", x, top_px, frame.bottom);
    out += fmt::format(R"(<text class="tick" text-anchor="middle" x="{:.1f}" y="{:.1f}">{}</text>)", x,
                       frame.bottom + 15, ticks.text[k]);
  }
  out += fmt::format(R"(<text class="label" text-anchor="middle" x="{:.1f}" y="{:.1f}">{}</text>)", 0.5 * width_px,
                     frame.bottom + 33, html_text(chart.axis));
}

void draw_bar(std::string& out, const Frame& frame, const Bar& bar, double y) {
  const std::string tone = fmt::format("style=\"fill:var(--{})\"", bar.tone);
  if (bar.pale) {
    out +=
        rectangle(frame, *bar.pale, y + 4, row_px - 8, fmt::format("style=\"fill:var(--{});opacity:.28\"", bar.tone));
    out += rectangle(frame, bar.solid, y + 8, row_px - 16, tone);
    out += whisker(frame, *bar.pale, y + 5.5) + whisker(frame, bar.solid, y + row_px - 7.5);
  } else {
    out += rectangle(frame, bar.solid, y + 5, row_px - 10, tone);
    out += whisker(frame, bar.solid, y + 0.5 * row_px);
  }
  const double middle = y + 0.5 * row_px + 4;
  out += fmt::format(R"(<text class="title" style="font-weight:400" text-anchor="end" x="{:.1f}" y="{:.1f}">{}</text>)",
                     frame.left - 8, middle, html_text(bar.name));
  out += fmt::format(R"x(<text class="tick" style="fill:var(--ink)" x="{:.1f}" y="{:.1f}">{}</text>)x", frame.right + 8,
                     middle, html_text(bar.text.str()));
}

std::string captioned(const CaptionedChart& each, double room_px, const ReaderUnits& units) {
  return fmt::format(
      "<figure>{}<div class=\"wide\">{}</div><div class=\"narrow\">{}</div><figcaption>{}</figcaption></figure>\n",
      each.legend, svg_of(each.chart, room_px, units), svg_of(each.chart, narrow_px, units),
      html_text(each.caption.in(units)));
}

}  // namespace

BarChart in_units(BarChart chart, const ReaderUnits& units) {
  const ReaderAxis axis(chart.quantity, units);
  chart.axis = axis.titled(chart.axis);
  for (Bar& bar : chart.bars) {
    for (Bar::Length* length : {&bar.solid, bar.pale ? &*bar.pale : nullptr}) {
      if (length == nullptr) continue;
      axis.turn(length->value);
      axis.turn(length->lower);
      axis.turn(length->upper);
    }
    bar.text = bar.text.in(units);
  }
  axis.turn(chart.lowest);
  axis.turn(chart.highest);
  return chart;
}

std::string svg_of(const BarChart& described, double width_px, const ReaderUnits& units) {
  const BarChart chart = in_units(described, units);
  const Frame frame = frame_of(chart, width_px);
  std::string out = fmt::format(R"(<svg class="bars" viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="{}">)",
                                width_px, frame.bottom + axis_px, html_text(chart.description));
  draw_axis(out, chart, frame, width_px);
  double y = top_px;
  for (const Bar& bar : chart.bars) {
    draw_bar(out, frame, bar, y);
    y += row_px;
  }
  const double zero = frame.x(0);
  out += fmt::format(R"(<path class="axis" d="M{0:.1f} {1}V{2:.1f}"/></svg>)", zero, top_px, frame.bottom);
  return out;
}

std::string figure_of(const CaptionedChart& each, const ReaderUnits& units) {
  return captioned(each, wide_px, units);
}

std::string pair_of(const std::vector<CaptionedChart>& charts, const ReaderUnits& units) {
  std::string out = "<div class=\"pair\">";
  for (const CaptionedChart& each : charts) {
    out += captioned(each, half_px, units);
  }
  return out + "</div>\n";
}

}  // namespace spoolflow::report
