#pragma once
/// Writes rows of numbers and words as CSV, fast: fixed decimals by integer arithmetic, three or eight digits at once,
/// into one buffer.
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

/// Values are rounded to the nearest at their decimals, halves away from zero; NaN is an empty cell.
class CsvWriter {
 public:
  explicit CsvWriter(std::ostream& out);
  /// Flushes what is buffered; errors are the stream's.
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  void header(const std::vector<std::string>& names);
  /// `decimals` 0 to 9.
  void number(double value, int decimals);
  struct FixedColumn {
    const double* values;
    unsigned decimals;  ///< 0 to 9
  };
  /// The numbers of one row of these columns.
  void numbers(std::span<const FixedColumn> columns, std::size_t row);
  void text(std::string_view text);
  /// What text() writes, for words that come again and again.
  [[nodiscard]] static std::string cell(std::string_view text);
  void put(std::string_view cell);
  void end_row();
  /// Hands what is buffered to the stream.
  void flush();

 private:
  char* room(std::size_t bytes);
  void make_room(std::size_t bytes);
  char* separated(char* at);
  void used_to(const char* end);

  std::ostream& out_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  bool row_begun_ = false;
};

}  // namespace spoolflow::recording
