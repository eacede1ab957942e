#pragma once
/// The body of a block: times and channels of its samples as columns of whole numbers, each written as its difference
/// to the one before.
#include <cstdint>
#include <span>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::fleet {

/// Of how many bytes a column is at most, for each sample.
inline constexpr std::size_t longest_number = 10;

/// How a body is to be read.
struct ColumnLayout {
  std::uint16_t channels = 0;   ///< bits of block_channels; another channel is NaN throughout
  std::int64_t first_time = 0;  ///< steps of time_step_s of the first sample that has a time
  std::int64_t period = 0;      ///< steps from sample to sample, more or less
  std::size_t samples = 0;
};

[[nodiscard]] ColumnLayout layout_of(std::span<const estimation::TimedSample> samples);
[[nodiscard]] std::vector<std::uint8_t> write_columns(const ColumnLayout& layout,
                                                      std::span<const estimation::TimedSample> samples);
/// False where the bytes are no such body; `samples` is then worthless.
[[nodiscard]] bool read_columns(const ColumnLayout& layout, std::span<const std::uint8_t> bytes,
                                std::vector<estimation::TimedSample>& samples);

}  // namespace spoolflow::fleet
