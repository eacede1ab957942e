#include "addons/fleet/transport/retired_subscriptions.hpp"

#include <nats/nats.h>
#include <vector>

namespace spoolflow::fleet {
namespace {

/// A message is handed over within microseconds where a thread is not put aside. The newest ones stay whatever their
/// age: a program that was stopped for long has a reader that stood in the middle.
constexpr std::chrono::seconds keeps_for{10};
constexpr std::size_t keeps_at_least = 64;

}  // namespace

RetiredSubscriptions::~RetiredSubscriptions() {
  for (const Retired& one : all_) natsSubscription_Destroy(one.handle);
}

void RetiredSubscriptions::add(natsSubscription* handle) {
  (void)natsSubscription_Unsubscribe(handle);
  const auto now = std::chrono::steady_clock::now();
  std::vector<natsSubscription*> old;
  {
    const std::lock_guard lock(mutex_);
    all_.push_back({handle, now});
    while (all_.size() > keeps_at_least && now - all_.front().since > keeps_for) {
      old.push_back(all_.front().handle);
      all_.pop_front();
    }
  }
  for (natsSubscription* const one : old) natsSubscription_Destroy(one);
}

}  // namespace spoolflow::fleet
