#pragma once
/// The state of a monitored valve, as one piece hands it to the next, bit for bit.
#include <string>

#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// Bytes for programs of this version on machines of this kind.
[[nodiscard]] std::string bytes_of(const Watched& watched);
/// Throws fleet::PieceError.
[[nodiscard]] Watched read_watched(const std::string& bytes);

}  // namespace spoolflow::apps
