#pragma once
/// What of a file is not read, reported where it is looked for.
#include <string>
#include <utility>
#include <vector>

namespace spoolflow::recording {

struct UnreadPart {
  std::string column;  ///< as a channel map would name it; empty: of the file as a whole
  std::string what;    ///< why, with its remedy: "channel 'rig/note' holds text, which is not read; write it as ..."
};

/// The first ones of a file, in its order: as many as a message holds.
inline void keep(std::vector<UnreadPart>& all, UnreadPart part) {
  constexpr std::size_t most = 256;
  if (all.size() < most) all.push_back(std::move(part));
}

}  // namespace spoolflow::recording
