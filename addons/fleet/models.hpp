#pragma once
/// Model files by their content's hash, each read once for all valves that share it.
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::fleet {

/// A model file as it travels and is kept: compressed.
[[nodiscard]] std::vector<std::uint8_t> pack_model(const std::string& text);
/// Nothing where these are no bytes of pack_model, or of more than 64 MB.
[[nodiscard]] std::optional<std::string> unpack_model(std::span<const std::uint8_t> packed);

/// Safe to be used from any thread.
class Models {
 public:
  [[nodiscard]] std::optional<live::SharedModel> find(const std::string& sha256) const;
  /// Takes a file's content in. Throws ModelError where it is none of this program; nothing where the bytes are not
  /// those of that hash.
  std::optional<live::SharedModel> add(const std::string& sha256, std::span<const std::uint8_t> packed);

 private:
  mutable std::mutex mutex_;
  std::map<std::string, live::SharedModel> models_;
};

}  // namespace spoolflow::fleet
