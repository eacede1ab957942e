#pragma once
/// A file or standard input, read line by line through one buffer of bounded size.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

class ByteSource {
 public:
  /// "-" is standard input. Throws RecordingError where the file cannot be opened or is a folder.
  explicit ByteSource(const std::filesystem::path& file);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// The next line without its line end, valid until the next call; nothing at the end of the file. Throws
  /// RecordingError for a line of more than 16 MiB.
  [[nodiscard]] bool next_line(std::string_view& line);
  /// Share of the file read so far; nothing for a pipe.
  [[nodiscard]] std::optional<double> progress() const;

 private:
  bool refill();

  std::string name_;
  int descriptor_;
  std::uint64_t size_ = 0;  ///< 0 where unknown
  std::uint64_t read_ = 0;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool at_end_ = false;
};

}  // namespace spoolflow::recording
