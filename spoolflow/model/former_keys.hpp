#pragma once
/// Keys of older model files, which are read and never written.
#include <array>
#include <string_view>

namespace spoolflow::model {

struct FormerKey {
  std::string_view key;  ///< in the older file
  std::string_view now;  ///< what it is called
  bool squared;          ///< the older file holds the square root
};
inline constexpr std::array former_keys{FormerKey{"least_liveliness", "least_process_noise", true},
                                        FormerKey{"first_liveliness", "first_process_noise", false}};

}  // namespace spoolflow::model
