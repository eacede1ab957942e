#pragma once
/// A valve's parameters apart from code: the bytes of a flash page, as spoolflow/sensor/parameter_image lays them down.
#include <cstdint>
#include <string>
#include <string_view>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// What the bytes hold beside the model, and which of its sensors they hold.
struct ImageContents {
  std::string_view tool_version;
  std::uint64_t created_s;  ///< since 1970 in UTC
  bool condensed = true;
  bool observer = true;  ///< where the model has one
};

/// The same model and contents give the same bytes. Throws std::invalid_argument where a number of the model does not
/// fit into single precision, or where nothing is left to be held.
[[nodiscard]] std::string parameter_image(const model::Model& model, const ImageContents& contents);

}  // namespace spoolflow::exports
