#pragma once
/// Subscriptions that nobody reads any more, until nothing on its way to them can arrive: up to libnats 3.5.0 the
/// thread that reads a connection holds a subscription without a reference while it hands a message over (nats.c issue
/// 637), and writes into freed memory where another thread destroys it meanwhile.
#include <chrono>
#include <deque>
#include <mutex>

struct __natsSubscription;

namespace spoolflow::fleet {

/// Safe to be used from any thread. To be destroyed behind the closing of the connection, which ends its reader.
class RetiredSubscriptions {
 public:
  RetiredSubscriptions() = default;
  ~RetiredSubscriptions();
  RetiredSubscriptions(const RetiredSubscriptions&) = delete;
  RetiredSubscriptions& operator=(const RetiredSubscriptions&) = delete;

  /// Takes one over, ends it, and destroys those of long ago.
  void add(__natsSubscription* handle);

 private:
  struct Retired {
    __natsSubscription* handle;
    std::chrono::steady_clock::time_point since;
  };
  std::mutex mutex_;
  std::deque<Retired> all_;  ///< the oldest first
};

}  // namespace spoolflow::fleet
