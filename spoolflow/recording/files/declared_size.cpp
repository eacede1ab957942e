#include "spoolflow/recording/files/declared_size.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

void DeclaredSize::add(const std::string& name, std::uint64_t rows, std::uint64_t columns, std::uint64_t number_bytes) {
  constexpr double mebibyte = 1 << 20;
  constexpr double always_bytes = 16 * mebibyte;
  constexpr double times = 200;
  declared_bytes_ += static_cast<double>(rows) * static_cast<double>(columns) * static_cast<double>(number_bytes);
  if (declared_bytes_ <= always_bytes + times * static_cast<double>(file_bytes_)) return;
  throw RecordingError(
      fmt::format("{}: up to '{}' it declares {:.4g} MiB of numbers in a file of {:.3g} MiB, more than {} MiB and {} "
                  "times its size: it is damaged, sparse, or hostile; record it again, or save it without "
                  "compression",
                  file_, name, declared_bytes_ / mebibyte, static_cast<double>(file_bytes_) / mebibyte,
                  always_bytes / mebibyte, times));
}

}  // namespace spoolflow::recording
