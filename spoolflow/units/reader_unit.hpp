#pragma once
/// The units in which readers may have each kind of quantity: the one table behind `--units`, the pages and their
/// script (web/src/units.ts is written from it).
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "spoolflow/units/quantity.hpp"

namespace spoolflow::units {

/// Shown value = factor * usual value + offset.
struct ReaderUnit {
  std::string_view asked = {};  ///< as it is asked for: "gal/min"; empty where it cannot be
  std::string_view shown = {};  ///< as it is written on a page
  double factor = 1, offset = 0;
  int decimals = 0;                 ///< of what a plot reads out
  std::string_view full_name = {};  ///< in the page's chooser and on its plots, where it is not as `shown`
};

/// The units of one kind; the first is the usual one, in which pages are where nobody asked for another.
struct ReaderQuantity {
  Kind kind;
  std::string_view name;     ///< in the page's chooser
  std::string_view SI_unit;  ///< as models and descriptions name it
  bool plotted;              ///< the page's script has plots of it
  std::array<ReaderUnit, 3> units;

  /// How many there are.
  [[nodiscard]] constexpr std::size_t count() const {
    std::size_t out = 0;
    while (out < units.size() && !units[out].shown.empty()) ++out;
    return out;
  }
};

/// In the order of Kind.
[[nodiscard]] std::span<const ReaderQuantity> reader_quantities();
[[nodiscard]] const ReaderQuantity& reader_quantity(Kind kind);
inline constexpr std::size_t kind_count = 9;

/// The value in the usual unit of its kind: 60 of a pressure of 6e6 Pa.
[[nodiscard]] double usual(Quantity quantity);
/// The kind whose SI unit or usual unit is named so; nothing for "%", "um" and all others.
[[nodiscard]] std::optional<Kind> kind_in(std::string_view unit);

}  // namespace spoolflow::units
