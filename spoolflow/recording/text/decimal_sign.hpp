#pragma once
/// Which sign a CSV file writes before decimals.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

/// A cell that looks as if its mark groups thousands.
struct GroupedCell {
  std::size_t column;
  std::string text;
};

/// The decimal sign of a file, comma or point, from the cells of its first lines.
class DecimalSign {
 public:
  explicit DecimalSign(const std::vector<std::size_t>& wanted) {
    for (const std::size_t column : wanted) columns_[column];
  }
  /// Whole lines that come after those looked at before.
  void look_at(std::string_view lines, char delimiter);
  /// Nothing where all numbers so far are whole.
  [[nodiscard]] std::optional<char> found() const;
  /// The first cell of a column in which that sign only ever stands before groups of three digits, beside whole numbers
  /// of up to three digits: 951 and 1,088. Whether that is 1088 or 1.088 cannot be known.
  [[nodiscard]] std::optional<GroupedCell> grouped() const;

 private:
  static constexpr std::size_t enough = 64;
  /// What a column's cells say of one mark.
  struct Cells {
    std::size_t whole = 0, grouped = 0, decimal = 0;
    std::string first{};  ///< of the grouped ones
  };
  std::array<std::size_t, 2> marked_{};  ///< cells with a point, with a comma
  std::map<std::size_t, std::array<Cells, 2>> columns_{};
};

}  // namespace spoolflow::recording
