#pragma once
/// The files from which accounts and certificate were read: whether they have changed since. Copies are written in
/// pieces: a change counts once the files have been left alone from one look to the next.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace spoolflow::live {

class SettingsWatch {
 public:
  using Files = std::vector<std::filesystem::path>;
  explicit SettingsWatch(Files files) : files_(std::move(files)), read_(stamps()), seen_(read_) {}

  /// To be asked every second or so; true once after each change.
  [[nodiscard]] bool changed() {
    Stamps now = stamps();
    const bool settled = now == seen_;
    seen_ = std::move(now);
    if (!settled || seen_ == read_) return false;
    read_ = seen_;
    return true;
  }
  /// Other files from now on, as they are now.
  void follow(Files files) {
    if (files == files_) return;
    files_ = std::move(files);
    read_ = seen_ = stamps();
  }

 private:
  /// Of one file; nothing where there is none.
  using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
  using Stamps = std::vector<Stamp>;
  [[nodiscard]] Stamps stamps() const {
    Stamps out;
    for (const std::filesystem::path& file : files_) {
      std::error_code missing, unsized;
      const auto time = std::filesystem::last_write_time(file, missing);
      const auto size = std::filesystem::file_size(file, unsized);
      out.push_back(missing || unsized ? Stamp() : Stamp({time, size}));
    }
    return out;
  }

  Files files_;
  Stamps read_, seen_;
};

}  // namespace spoolflow::live
