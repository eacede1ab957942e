#pragma once
#include <cstdint>
#include <string>

namespace spoolflow::recording {

/// The numbers that a file says it holds, against its own size: at most 16 MiB and 200 times the file (deflate packs
/// noise three times, slow signals as integers some 20 times; a thousand times is only for the like of zeros).
class DeclaredSize {
 public:
  /// `file`: for messages.
  DeclaredSize(std::string file, std::uint64_t file_bytes) : file_(std::move(file)), file_bytes_(file_bytes) {}

  /// One vector or matrix more, with the bytes of one of its numbers as the file stores them. Throws RecordingError
  /// where all together are out of proportion.
  void add(const std::string& name, std::uint64_t rows, std::uint64_t columns, std::uint64_t number_bytes);

 private:
  std::string file_;
  std::uint64_t file_bytes_;
  double declared_bytes_ = 0;
};

}  // namespace spoolflow::recording
