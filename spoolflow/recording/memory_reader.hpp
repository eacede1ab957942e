#pragma once
/// Recordings that are no files, such as columns in memory.
#include <memory>
#include <string>

#include "spoolflow/recording/read_options.hpp"
#include "spoolflow/recording/resampled_table.hpp"

namespace spoolflow::recording {

class Reader;

/// As open_reader() of a file; `open` makes the table from its first row on, as often as it is called, and `name`
/// stands in messages.
[[nodiscard]] std::unique_ptr<Reader> open_reader(const OpenAgain& open, const ReadOptions& options,
                                                  const std::string& name);

}  // namespace spoolflow::recording
