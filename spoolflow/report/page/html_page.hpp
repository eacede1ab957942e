#pragma once
/// One self-contained page: style sheet and script inside, no network. Without script it shows the same, standing
/// still. Texts, tables and figures are written out in the reader's units here; markup made outside asks `units()`.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/figures/svg_figure.hpp"
#include "spoolflow/report/page/html_table.hpp"
#include "spoolflow/report/text/text.hpp"

namespace spoolflow::report {

/// The style sheet of every page: light, dark, print, narrow screens. Its source is web/src/style.
[[nodiscard]] std::string_view page_style();

/// The script of every page: colours and units of the reader's choice, plots that zoom. Its source is web/src.
[[nodiscard]] std::string_view page_script();

/// A figure with the sentence below it. `legend` replaces the legend made from the figure. `live`: data with which the
/// page's script puts plots that zoom in the figure's place (trace_json.cpp); print keeps the figure.
struct CaptionedFigure {
  Figure figure;
  Text caption = {};
  std::string legend = {};
  std::string live = {};
};

class HtmlPage {
 public:
  /// `kind` stands above the title, `origin` below it: where and when the page was made.
  HtmlPage(std::string kind, std::string title, std::string origin, ReaderUnits units = {});

  /// What stands beside the title: "full scale 80 L/min".
  void headline(const Text& facts);
  /// What the page says before all.
  void verdict(const Text& sentence);
  /// A list; nothing where there are none.
  void remarks(std::span<const Text> remarks);
  /// The contents stand here; else below the title.
  void contents() { contents_at_ = body_.size(); }
  void section(std::string_view heading);  ///< appears in the contents
  void subsection(const Text& heading);    ///< does not
  /// A section; until end_part() the sections that follow stand in it, as subsections.
  void part(std::string_view heading);
  void end_part() { in_part_ = false; }
  void paragraph(const Text& text);
  void note(const Text& text);  ///< small print
  void html(std::string_view markup) { body_ += markup; }
  void table(const HtmlTable& table) { body_ += table.str(units_); }
  [[nodiscard]] const ReaderUnits& units() const { return units_; }
  /// Over the whole width; drawn a second time for narrow screens, so that its text keeps its size.
  void figure(const CaptionedFigure& figure);
  /// Two beside each other where there is room; drawn twice as well.
  void pair(const std::vector<CaptionedFigure>& figures);
  void chart(const CaptionedChart& chart) { body_ += figure_of(chart, units_); }
  void pair(const std::vector<CaptionedChart>& charts) { body_ += pair_of(charts, units_); }
  [[nodiscard]] std::string str() const;

 private:
  /// Legend, and the drawing for wide and for narrow screens.
  [[nodiscard]] std::string drawings(const CaptionedFigure& figure, const Layout& layout) const;
  [[nodiscard]] std::string caption(const Text& text);

  std::string kind_, title_, origin_;
  ReaderUnits units_;
  std::string body_;
  std::string contents_;
  std::optional<std::size_t> contents_at_;  ///< place in the body
  std::string headline_;                    ///< markup
  int sections_ = 0;
  bool in_part_ = false;
  int figures_ = 0;
};

}  // namespace spoolflow::report
