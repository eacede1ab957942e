#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/monitor.hpp"

namespace spoolflow::apps {

/// What a correction starts from.
struct Monitored {
  const model::Model& model;
  std::string model_sha256;                       ///< of its file
  std::vector<std::filesystem::path> recordings;  ///< files that can be read again, for their checksums
  std::vector<std::uint64_t> samples;             ///< of each
  std::string tool_version;
};

/// The model with what was found put right, and from which recordings (monitor::adapted). Throws ModelError where there
/// is nothing to correct, or too much.
[[nodiscard]] model::Model corrected_model(const Monitored& from, const monitor::Monitor& watch);

}  // namespace spoolflow::apps
