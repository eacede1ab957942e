#pragma once
/// What a sandboxed process does that reads a file for this one.
#include <csignal>
#include <cstdint>
#include <string>
#include <string_view>

#include "spoolflow/recording/files/sandbox.hpp"

namespace spoolflow::recording {

/// One end of a connection between two processes.
class Connection {
 public:
  /// The descriptor stays the caller's.
  explicit Connection(int descriptor) : descriptor_(descriptor) {}

  /// False where the other end is gone.
  bool send(std::uint32_t kind, std::string_view content);
  /// False where the other end is gone, or where its message is longer than 64 MiB.
  bool receive(std::uint32_t& kind, std::string& content);

 private:
  int descriptor_;
};

/// What a child is to do: bytes, a descriptor and the address of a function, which a process that was forked from this
/// one can be reported by a message.
struct ReadingOrder {
  using Work = void (*)(const ReadingOrder& order, Connection& parent);
  Work work;  ///< done with the limits, after all rights were given up
  ReadingLimits limits;
  std::string bytes{};  ///< what `work` makes of them
  int memory = -1;      ///< descriptor of memory that `work` shares with whoever gave the order; -1: none
};

/// Leaves interruptions to the process that asks, at whose end its children end, and crashes to the system: no handler
/// of another process runs here, once the signals are those of `mask` again.
void settle_signals(const sigset_t& mask);

/// The child's whole life, connected by that descriptor; its signals are settled.
[[noreturn]] void live_as_reader(const ReadingOrder& order, int connection);

}  // namespace spoolflow::recording
