#pragma once
/// Writes rows of numbers and words as CSV, fast: fixed decimals by integer arithmetic into one buffer.
#include <iosfwd>
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
  void text(std::string_view text);
  void end_row();
  /// Hands what is buffered to the stream.
  void flush();

 private:
  void separate();
  void room(std::size_t bytes);

  std::ostream& out_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  bool row_begun_ = false;
};

}  // namespace spoolflow::recording
