#pragma once
/// Samples as CSV rows with a header, as recordings have it, from whatever is open: what connections and pipes share.
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "addons/live/sources/intake.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"
#include "spoolflow/recording/read_options.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::live {

/// The samples of a block of a recording, in its order.
[[nodiscard]] std::vector<estimation::TimedSample> samples_of(const recording::SampleBlock& block);

/// Hands every row to the intake as soon as it is there, until the input ends. A header that cannot be used ends it at
/// once, with what is wrong reported to the intake. `next`: sequence number of the first row; returns that after the
/// last.
std::uint64_t read_csv(std::unique_ptr<recording::InputBytes> input, const recording::ReadOptions& options,
                       std::uint64_t next, Intake& intake);

}  // namespace spoolflow::live
