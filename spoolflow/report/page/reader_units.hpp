#pragma once
/// The reader's units. Sections and figures are made in L/min, bar, mm, degrees Celsius and newtons; what the reader
/// asked for instead is put in at the edge, where a page takes them in, so that no place can forget it.
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/page/html_table.hpp"

namespace spoolflow::report {

/// One unit that a reader may ask for. Shown value = factor * made value + offset.
struct ReaderUnit {
  std::string_view asked;  ///< as it is asked for: "gal/min"
  std::string_view shown;  ///< as it is written on the page
  double factor = 1, offset = 0;
};

/// The units of a quantity; the first is the one in which pages are made. Their order is that of web/src/units.ts.
struct ReaderQuantity {
  std::string_view name;  ///< of the page's chooser
  std::array<ReaderUnit, 3> units;
};
[[nodiscard]] const std::array<ReaderQuantity, 5>& reader_quantities();

struct UnknownUnit : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

class ReaderUnits {
 public:
  /// As pages are made.
  ReaderUnits() = default;
  /// One name a quantity at most. Throws UnknownUnit.
  explicit ReaderUnits(const std::vector<std::string>& asked);

  /// What stands for `made`, "bar" say; the same unit with factor 1 where there is no choice.
  [[nodiscard]] ReaderUnit instead_of(std::string_view made) const;
  /// Every number of the text before a unit, "5 to 70 bar" too, outside of tags, scripts and style sheets.
  [[nodiscard]] std::string markup(std::string_view html) const;
  /// Titles in brackets tell the units: "Position [mm]", "[L/min / % FS]".
  [[nodiscard]] Figure of(Figure figure) const;
  [[nodiscard]] BarChart of(BarChart chart) const;
  [[nodiscard]] HtmlTable of(HtmlTable table) const;
  /// Attributes of the page's root by which its script begins in these units.
  [[nodiscard]] std::string attributes() const;

 private:
  [[nodiscard]] bool as_made() const { return chosen_ == std::array<std::size_t, 5>{}; }
  [[nodiscard]] std::string text(std::string_view text) const;

  std::array<std::size_t, 5> chosen_{};
};

}  // namespace spoolflow::report
