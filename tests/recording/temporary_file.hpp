#pragma once
/// A file that exists while a test runs.
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace spoolflow::recording {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name, std::string_view content = {})
      : folder_(std::filesystem::temp_directory_path() /
                ("spoolflow_recording_" + std::to_string(::getpid()) + "_" + std::to_string(++count()))) {
    std::filesystem::create_directories(folder_);
    path_ = folder_ / name;
    if (!content.empty()) write(content);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code failure;
    std::filesystem::remove_all(folder_, failure);
  }

  void write(std::string_view content) const {
    std::ofstream(path_, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  static int& count() {
    static int files = 0;
    return files;
  }
  std::filesystem::path folder_;
  std::filesystem::path path_;
};

}  // namespace spoolflow::recording
