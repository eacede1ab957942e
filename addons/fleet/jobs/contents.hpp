#pragma once
/// Files by the SHA-256 of their content, packed in chunks of a megabyte, each whole or not at all.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "addons/fleet/jobs/piece.hpp"
#include "addons/fleet/store/postgresql.hpp"

namespace spoolflow::fleet {

/// One frame of zstd. `level`: 1 to 19, slower and smaller the higher.
[[nodiscard]] std::vector<std::uint8_t> packed(std::string_view content, int level);

/// Keeps it unless it is there. `name`: as in PieceFile. Throws ServerAway, ServerRefuses.
[[nodiscard]] PieceFile keep(Session& session, const std::string& name, const std::string& content);
/// Throws PieceError where the fleet has it not, or has something else under that hash.
[[nodiscard]] std::string content_of(Session& session, const PieceFile& file);

/// The whole file. Throws std::runtime_error where it cannot be read.
[[nodiscard]] std::string whole_file(const std::filesystem::path& file);

}  // namespace spoolflow::fleet
