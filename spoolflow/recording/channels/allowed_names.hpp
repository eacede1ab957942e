#pragma once
/// Names as messages show them.
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

/// "; did you mean 'position'?" for a misspelt name or one that was cut short, or nothing where no allowed name is near
/// (a third of its letters).
[[nodiscard]] std::string did_you_mean(std::string_view written, const std::vector<std::string>& allowed);

/// "a, b, c"; a long list is cut and says how many more there are.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

/// "PLACE: unknown key 'KEY' in TABLE; did you mean 'OTHER'?; allowed: a, b, c".
[[nodiscard]] std::string unknown_key(std::string_view place, std::string_view key, std::string_view table,
                                      const std::vector<std::string>& allowed);

}  // namespace spoolflow::recording
