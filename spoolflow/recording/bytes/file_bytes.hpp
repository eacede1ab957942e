#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace spoolflow::recording {

/// The bytes of a file that is open, read from wherever they stand.
class FileBytes {
 public:
  /// Throws RecordingError where it cannot be opened.
  explicit FileBytes(const std::filesystem::path& file);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Whether `count` bytes stand there.
  [[nodiscard]] bool holds(std::uint64_t at, std::uint64_t count) const { return at <= size_ && count <= size_ - at; }
  /// Fills `out` with the bytes from `at` on. Throws RecordingError where the file ends before, std::runtime_error
  /// where the device fails.
  void read(std::uint64_t at, std::span<std::uint8_t> out) const;

 private:
  std::string name_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace spoolflow::recording
