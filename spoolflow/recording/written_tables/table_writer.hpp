#pragma once
/// A table of numbers with one column of flags, written a block of rows at a time in any of the formats: memory does
/// not grow with the rows. Names of columns and units are alike in all.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spoolflow::recording {

struct NumberColumn {
  std::string name;  ///< letters, digits and underscores, begun by a letter: a variable's name in MATLAB, at most 31
  std::string unit;
  std::string meaning;  ///< a few words for people
  int decimals;         ///< in CSV; the other formats hold the whole number
};

struct FlagName {
  std::uint32_t bit;
  std::string name;  ///< as a column's
};

struct TableHead {
  std::string name;                   ///< of the table, as a column's
  std::vector<NumberColumn> numbers;  ///< the first is the time [s]
  std::string flags;                  ///< the name of the last column
  std::vector<FlagName> flag_names;
  std::function<std::string_view(std::uint32_t)> flag_text;  ///< the names of the set bits; must stay until asked again
  std::vector<std::pair<std::string, std::string>> notes{};  ///< of the whole table: what made it and from what
};

/// Columns of one length.
struct TableRows {
  std::vector<std::vector<double>> numbers;  ///< as in the head; NaN where there is none
  std::vector<std::uint32_t> flags;
  [[nodiscard]] std::size_t count() const { return flags.size(); }
};

class TableWriter {
 public:
  virtual ~TableWriter() = default;
  virtual void write(const TableRows& rows) = 0;
  /// Sends what was written to whoever reads along; formats that are read as a whole keep it.
  virtual void hand_over() {}
  /// The file is whole after it. Without it the output is to be thrown away.
  virtual void finish() = 0;
};

}  // namespace spoolflow::recording
