#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::apps {

/// "; did you mean 'calibrate'?" for a misspelt word, or nothing where no candidate is near (a third of its letters).
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace spoolflow::apps
