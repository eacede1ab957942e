#include "spoolflow/recording/channels/allowed_names.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/nearest_name.hpp"

namespace spoolflow::recording {

std::string did_you_mean(std::string_view written, const std::vector<std::string>& allowed) {
  constexpr std::size_t longest_name = 200;  // beyond, it is no misspelt name
  if (written.empty() || written == "?" || written.size() > longest_name || allowed.empty()) return {};
  const auto longer = std::ranges::find_if(allowed, [written](const std::string& name) {
    return written.size() >= 4 && name.starts_with(written);  // often a unit left out
  });
  if (longer != allowed.end()) return fmt::format("; did you mean '{}'?", *longer);
  const std::string_view nearest = nearest_name(written, allowed);
  if (edit_distance(written, nearest) > std::max<std::size_t>(1, written.size() / 3)) return {};
  return fmt::format("; did you mean '{}'?", nearest);
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 24;
  std::string out = fmt::format("{}", fmt::join(names.begin(), names.begin() + std::min(shown, names.size()), ", "));
  if (names.size() > shown) out += fmt::format(" and {} more", names.size() - shown);
  return out;
}

std::string unknown_key(std::string_view place, std::string_view key, std::string_view table,
                        const std::vector<std::string>& allowed) {
  return fmt::format("{}: unknown key '{}' in {}{}; allowed: {}", place, key, table, did_you_mean(key, allowed),
                     listed(allowed));
}

}  // namespace spoolflow::recording
