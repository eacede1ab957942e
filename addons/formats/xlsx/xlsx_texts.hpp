#pragma once
/// The texts that a workbook keeps once for all its cells (shared strings).
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "addons/formats/xlsx/xlsx_archive.hpp"

namespace spoolflow::recording {

class XlsxTexts {
 public:
  XlsxTexts() = default;
  /// `part`: empty where the workbook has none. Throws RecordingError where it is damaged, or holds more than 64 MiB.
  XlsxTexts(XlsxArchive& archive, const std::string& part);
  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  /// The one with that number, from 0 on; must be below size().
  [[nodiscard]] std::string_view at(std::size_t number) const {
    const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
    return std::string_view(all_).substr(begin, ends_[number] - begin);
  }

 private:
  std::string all_{};
  std::vector<std::size_t> ends_{};
};

}  // namespace spoolflow::recording
