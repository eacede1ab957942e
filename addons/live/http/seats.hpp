#pragma once
/// The connections that there may be, of all and of one address.
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace spoolflow::live {

class Seats {
 public:
  static constexpr int most = 256, most_of_one = 64;

  /// A connection's place, free again when it is destroyed.
  class Seat {
   public:
    Seat(Seats& of, std::string peer) : of_(&of), peer_(std::move(peer)) {}
    ~Seat() {
      if (of_ != nullptr) of_->leave(peer_);
    }
    Seat(Seat&& other) noexcept : of_(std::exchange(other.of_, nullptr)), peer_(std::move(other.peer_)) {}
    Seat& operator=(Seat&&) = delete;
    [[nodiscard]] const std::string& peer() const { return peer_; }

   private:
    Seats* of_;
    std::string peer_;
  };

  /// Nothing where all are taken. Those of this machine, proxies among them, count among all alone.
  [[nodiscard]] std::optional<Seat> take(const std::string& peer, bool is_local) {
    const std::lock_guard lock(mutex_);
    if (taken_ >= most || (!is_local && of_peer_[peer] >= most_of_one)) return std::nullopt;
    ++taken_;
    ++of_peer_[peer];
    return std::optional<Seat>(std::in_place, *this, peer);
  }

 private:
  void leave(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    --taken_;
    const auto found = of_peer_.find(peer);
    if (--found->second == 0) of_peer_.erase(found);
  }
  std::mutex mutex_;
  int taken_ = 0;
  std::map<std::string, int> of_peer_;
};

}  // namespace spoolflow::live
