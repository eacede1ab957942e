#pragma once
/// A CSV recording repeated as often as wanted, its time going on.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::bench {

class EndlessRecording {
 public:
  /// The file's first column must be time_s. Throws std::runtime_error.
  explicit EndlessRecording(const std::string& file);

  /// The header once, then rows until at least `bytes` are written to the descriptor; returns the number of rows.
  std::uint64_t write(int descriptor, std::uint64_t bytes) const;

 private:
  struct Row {
    double time_s;
    std::string_view rest;  ///< from the first comma on
  };
  std::string text_;
  std::string_view header_;
  std::vector<Row> rows_;
  double period_s_ = 0;
};

}  // namespace spoolflow::bench
