#include "addons/live/sources/csv_stream.hpp"

#include <exception>
#include <utility>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::live {

std::vector<estimation::TimedSample> samples_of(const recording::SampleBlock& block) {
  const estimation::Columns columns = estimation::sensor_columns(block);
  std::vector<estimation::TimedSample> samples;
  samples.reserve(block.rows);
  for (std::size_t k = 0; k < block.rows; ++k) samples.push_back(columns[k]);
  return samples;
}

std::uint64_t read_csv(std::unique_ptr<recording::InputBytes> input, const recording::ReadOptions& options,
                       std::uint64_t next, Intake& intake) {
  try {
    recording::ReadOptions channels = options;
    channels.assumed.clear();  // of what the sender has not got nothing is said
    const auto reader = estimation::open_sensor_channels(std::move(input), channels);
    intake.set_trouble({});
    intake.set_unread(reader->notes().resampled);
    recording::SampleBlock block;
    std::uint64_t left_out = 0;
    while (reader->next(block)) {
      intake.count_unreadable(reader->notes().left_out - std::exchange(left_out, reader->notes().left_out));
      next += block.rows;
      intake.push({.samples = samples_of(block), .after = {.next = next}, .arrived_ns = steady_ns()});
    }
  } catch (const std::exception& error) {  // a header of rubbish, a connection that broke
    intake.set_trouble(error.what());
  }
  return next;
}

}  // namespace spoolflow::live
