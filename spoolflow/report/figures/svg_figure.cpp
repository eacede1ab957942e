#include "spoolflow/report/figures/svg_figure.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/figures/plot_frame.hpp"
#include "spoolflow/report/figures/reader_axes.hpp"
#include "spoolflow/report/figures/svg_mark.hpp"
#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {
namespace {

constexpr double title_px = 24;  ///< above a panel
constexpr double gap_px = 14;    ///< between a panel and the next one's title
constexpr double x_axis_px = 40;
constexpr double bar_row_px = 27;  ///< a name, and its bar below it
constexpr double row_name_px = 15;

double height_of(const Panel& panel, const Layout& layout) {
  return panel.rows.empty() ? panel.height_px * layout.height_share
                            : bar_row_px * static_cast<double>(panel.rows.size());
}

std::string text(double x, double y, const char* style, const char* anchor, const std::string& what) {
  return fmt::format(R"(<text class="{}" text-anchor="{}" x="{:.1f}" y="{:.1f}">{}</text>)", style, anchor, x, y,
                     html_text(what));
}

void draw_y_axis(std::string& out, const PlotFrame& frame) {
  const Ticks ticks = round_ticks(frame.y_lowest, frame.y_highest, std::max(2, static_cast<int>(frame.height() / 42)));
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    const double y = frame.y_px(ticks.at[k]);
    out += fmt::format(R"(<path class="{}" d="M{:.1f} {:.1f}H{:.1f}"/>)", ticks.at[k] == 0 ? "zero" : "grid",
                       frame.left, y, frame.right);
    out += text(frame.left - 7, y + 4, "tick", "end", ticks.text[k]);
  }
}

void draw_rows(std::string& out, const Panel& panel, const PlotFrame& frame) {
  for (std::size_t r = 0; r < panel.rows.size(); ++r) {
    const Row& row = panel.rows[r];
    const double top = frame.top + bar_row_px * static_cast<double>(r);
    out += fmt::format(R"(<path class="grid" d="M{:.1f} {:.1f}H{:.1f}"/>)", frame.left, top + row_name_px + 4.5,
                       frame.right);
    for (const Span& span : row.spans) {
      const double x = frame.x_px(span.from);
      out += fmt::format(R"(<rect class="{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" opacity="{:.2f}"/>)",
                         row.tone, x, top + row_name_px, std::max(1.0, frame.x_px(span.to) - x), 9.0,
                         0.25 + 0.75 * span.share);
    }
    out += text(frame.left + 1, top + row_name_px - 4, "rowlabel", "start", row.label);
  }
}

void draw_cells(std::string& out, const Panel& panel, const PlotFrame& frame) {
  for (const Cell& cell : panel.cells) {
    const double x = frame.x_px(cell.x_from);
    const double y = frame.y_px(cell.y_to);
    out += fmt::format(R"(<rect class="h{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", cell.heat, x, y,
                       frame.x_px(cell.x_to) - x + 0.3, frame.y_px(cell.y_from) - y + 0.3);
  }
}

void draw_x_axis(std::string& out, const Figure& figure, const PlotFrame& frame, const Ticks& ticks) {
  out += fmt::format(R"(<path class="axis" d="M{:.1f} {:.1f}H{:.1f}"/>)", frame.left, frame.bottom, frame.right);
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    const double x = frame.x_px(ticks.at[k]);
    out += fmt::format(R"(<path class="axis" d="M{:.1f} {:.1f}v4"/>)", x, frame.bottom);
    out += text(x, frame.bottom + 17, "tick", "middle", ticks.text[k]);
  }
  out += text(0.5 * (frame.left + frame.right), frame.bottom + 35, "label", "middle", figure.x_title.str());
}

void draw_panel(std::string& out, const Panel& panel, const PlotFrame& frame, const Ticks& x_ticks,
                const std::string& clip) {
  out += text(frame.left, frame.top - 9, "title", "start", panel.title.str());
  for (const double x : x_ticks.at) {
    out += fmt::format(R"(<path class="grid" d="M{:.1f} {:.1f}V{:.1f}"/>)", frame.x_px(x), frame.top, frame.bottom);
  }
  out += fmt::format(R"(<clipPath id="{}"><rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/></clipPath>)",
                     clip, frame.left, frame.top - 2, frame.right - frame.left, frame.height() + 4);
  if (panel.rows.empty()) draw_y_axis(out, frame);
  out += fmt::format(R"svg(<g clip-path="url(#{})">)svg", clip);
  draw_cells(out, panel, frame);
  for (const Mark& mark : panel.marks) draw_mark(out, mark, frame);
  draw_rows(out, panel, frame);
  out += "</g>";
  draw_end_labels(out, panel.marks, frame);
}

}  // namespace

std::string svg_of(const Figure& described, const Layout& layout, const std::string& id, const ReaderUnits& units) {
  const Figure figure = in_units(described, units);
  double height = 2 + x_axis_px;
  for (const Panel& panel : figure.panels) height += title_px + height_of(panel, layout) + gap_px;
  std::string out = fmt::format(R"(<svg viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="{}">)", layout.width_px,
                                height, html_text(figure.description));
  const PlotWidth width = plot_width(figure, layout.width_px);
  Ticks x_ticks =
      round_ticks(width.x_lowest, width.x_highest, std::max(3, static_cast<int>((width.right - width.left) / 95)));
  if (!figure.x_marks.empty()) x_ticks = {};
  for (const AxisMark& mark : figure.x_marks) {
    if (mark.at < width.x_lowest || mark.at > width.x_highest) continue;
    x_ticks.at.push_back(mark.at);
    x_ticks.text.push_back(mark.text);
  }
  double top = 2;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    top += title_px;
    const PlotFrame frame = plot_frame(panel, width, top, top + height_of(panel, layout));
    draw_panel(out, panel, frame, x_ticks, fmt::format("{}-{}", id, p));
    top = frame.bottom + gap_px;
    if (p + 1 == figure.panels.size()) draw_x_axis(out, figure, frame, x_ticks);
  }
  return out + "</svg>\n";
}

std::string legend_of(const Figure& figure, const ReaderUnits& units) {
  std::vector<std::string> names;
  std::string out;
  for (const Panel& panel : figure.panels) {
    for (const Mark& mark : panel.marks) {
      const std::string name = mark.name.in(units);
      if (name.empty() || std::ranges::find(names, name) != names.end()) continue;
      names.push_back(name);
      out += fmt::format(R"(<span><svg class="key" viewBox="0 0 26 12" aria-hidden="true">{}</svg>{}</span>)",
                         key_of(mark), html_text(name));
    }
  }
  return out.empty() ? out : "<div class=\"legend\">" + out + "</div>";
}

}  // namespace spoolflow::report
