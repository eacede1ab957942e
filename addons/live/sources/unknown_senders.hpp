#pragma once
/// Who sends samples of a valve that the site does not know.
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace spoolflow::live {

/// Pieces of an id that no valve of the site has, from one sender.
struct UnknownSender {
  std::string valve;                       ///< as it came; bytes beyond printable ASCII as '?'
  std::string sender;                      ///< numeric address, or the topic
  std::int64_t first_ms = 0, last_ms = 0;  ///< when they came, since 1970-01-01 UTC
  std::uint64_t pieces = 0;                ///< datagrams, messages
};

/// For any thread.
class UnknownSenders {
 public:
  static constexpr std::size_t most = 32;  ///< further ones take the place of those that are silent for longest

  void note(const std::string& valve, const std::string& sender);
  /// In the order in which they were seen first.
  [[nodiscard]] std::vector<UnknownSender> all() const;

 private:
  mutable std::mutex mutex_;
  std::vector<UnknownSender> seen_;
};

}  // namespace spoolflow::live
