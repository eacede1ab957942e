#pragma once
/// What the user should know of a recording as it was read, and of a band before it is relied on.
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::apps {

/// Where the model, of `file`, is of a type and of none of its units: a line that says so, and how a unit gets its own.
/// Empty: it is not.
[[nodiscard]] std::string type_note(const model::Model& model, const std::string& file);

/// Where the model's environment leaves nothing open, as on a bench: a line that says so, and how a machine is
/// declared. Empty: it leaves something open, or the model has no observer.
[[nodiscard]] std::string bench_note(const model::Model& model);

/// How many of the samples have the time of the one before; of most of them also why they may.
[[nodiscard]] std::string repeated_times_text(std::uint64_t repeated, std::uint64_t samples);

/// What was met while reading, a line each; empty where all was well.
[[nodiscard]] std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file);

}  // namespace spoolflow::apps
