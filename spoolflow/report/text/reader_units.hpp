#pragma once
/// The units that a page's reader asked for with `--units`. Sections hand over quantities
/// (spoolflow/units/quantity.hpp); they are written out and drawn in these units at the edge, where a page takes them
/// in.
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "spoolflow/units/reader_unit.hpp"

namespace spoolflow::report {

struct UnknownUnit : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

class ReaderUnits {
 public:
  /// The usual ones.
  ReaderUnits() = default;
  /// One name a quantity at most. Throws UnknownUnit.
  explicit ReaderUnits(const std::vector<std::string>& asked);

  [[nodiscard]] const units::ReaderUnit& unit(units::Kind kind) const;
  /// The quantity's value in its unit.
  [[nodiscard]] double value(units::Quantity quantity) const;
  /// Attributes of a page's root by which its script begins in these units.
  [[nodiscard]] std::string attributes() const;

 private:
  std::array<std::size_t, units::kind_count> chosen_{};
};

/// The unit names that `--units` takes: "L/min|m3/h|gal/min, bar|…".
[[nodiscard]] std::string choice_of_units();

}  // namespace spoolflow::report
