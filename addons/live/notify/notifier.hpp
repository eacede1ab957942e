#pragma once
/// Sends messages of alarms to those whom the site's file names. Each receiver has a thread of its own, which looks at
/// the alarm list once a second: nothing that a receiver does holds up samples, page or other receivers.
#include <memory>
#include <string>
#include <vector>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

class Notifier {
 public:
  /// Goes on with what the store says that each receiver has; without it, alarms that are listed are known. The
  /// engine outlives it.
  explicit Notifier(Engine& engine);
  /// What waits is tried once more, for 3 s at most; what does not go out becomes an event, and the store keeps it.
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

 private:
  struct Receiver;
  std::vector<std::unique_ptr<Receiver>> receivers_;
};

}  // namespace spoolflow::live
