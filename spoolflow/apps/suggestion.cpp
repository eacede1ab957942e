#include "spoolflow/apps/suggestion.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/nearest_name.hpp"

namespace spoolflow::apps {

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return {};
  const std::string_view nearest = recording::nearest_name(word, candidates);
  if (3 * recording::edit_distance(word, nearest) > std::max(word.size(), nearest.size())) return {};
  return fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace spoolflow::apps
