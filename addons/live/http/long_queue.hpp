#pragma once
/// Answers that take long wait for a thread of their own: so many of all and of one address, and no more.
#include <map>
#include <mutex>
#include <string>

namespace spoolflow::live {

class LongQueue {
 public:
  static constexpr int most = 8, most_of_one = 4;

  /// False where there is no room: the answer is to be asked for later.
  [[nodiscard]] bool enter(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    const auto found = of_peer_.find(peer);
    if (waiting_ >= most || (found != of_peer_.end() && found->second >= most_of_one)) return false;
    ++waiting_;
    ++of_peer_[peer];
    return true;
  }
  void leave(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    --waiting_;
    const auto found = of_peer_.find(peer);
    if (--found->second == 0) of_peer_.erase(found);
  }

 private:
  std::mutex mutex_;
  int waiting_ = 0;
  std::map<std::string, int> of_peer_;
};

}  // namespace spoolflow::live
