#pragma once
/// JSON text and its limits, held before it is parsed.
#include <cstddef>
#include <istream>
#include <string>

#include <nlohmann/json.hpp>

namespace spoolflow::model {

inline constexpr std::size_t largest_json_bytes = std::size_t{64} << 20;  ///< a model has half a megabyte
inline constexpr std::size_t deepest_json = 64;                           ///< objects and lists within each other

/// The whole text of a file, as far as it may be long: one byte beyond the limit where it is longer.
[[nodiscard]] std::string read_json_text(std::istream& in);

/// Throws ModelError where it is no text, or longer or nests deeper than the limits; text in quotes does not count.
void require_json_limits(const std::string& text, const std::string& file);

/// Within these limits; is_discarded() where it is no JSON. Compiled here alone: a parser takes seconds of a build.
[[nodiscard]] nlohmann::ordered_json parsed_json(const std::string& text, const std::string& file);

}  // namespace spoolflow::model
