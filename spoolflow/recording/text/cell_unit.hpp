#pragma once
/// Cells whose number has a unit or an SI prefix behind it: "10 mA", "25.1m", "4.7u".
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {

/// A number's text, and what stands behind it: a known unit or a prefix alone.
struct CellParts {
  std::string_view number, suffix;
};
/// Nothing where the cell is a bare number or no such text.
[[nodiscard]] std::optional<CellParts> split_cell(std::string_view cell);

/// Whether a cell is a number, bare, with its thousands grouped or with such a suffix.
[[nodiscard]] bool measures(std::string_view cell);

/// The unit that a cell states; nothing for a prefix alone.
[[nodiscard]] std::optional<units::Unit> unit_in_cell(std::string_view cell);

/// The unit of a column's numbers as the file states it, in the name, beside it or in the cells.
[[nodiscard]] std::optional<units::Unit> unit_of(const FileColumn& column);

enum class Suffix : std::uint8_t { understood, none, ambiguous, prefix_twice, other_quantity };

/// The number of a cell with a suffix in `unit`, that of its column: "10 mA" is 0.01 in A. A prefix alone multiplies
/// the column's unit; "m" may be milli or metre where that unit is not known or a length, and a prefix before a unit
/// that has one itself says nothing for sure.
[[nodiscard]] Suffix read_measured(std::string_view cell, char point, const std::optional<units::Unit>& unit,
                                   double& value);

/// Why such a cell is not understood and what to write instead, as the end of a message that names its place.
[[nodiscard]] std::string suffix_fault(Suffix fault, std::string_view cell, const std::optional<units::Unit>& unit);

}  // namespace spoolflow::recording
