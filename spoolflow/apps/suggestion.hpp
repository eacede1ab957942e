#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::apps {

/// Steps from one word to the other: insert, delete, replace a letter, or swap two neighbours.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'calibrate'?" for a misspelt word, or nothing where no candidate is near (a third of its letters).
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace spoolflow::apps
