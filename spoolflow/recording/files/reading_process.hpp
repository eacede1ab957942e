#pragma once
/// A sandboxed process beside this one, which reads a file and answers in messages.
#include <string>
#include <sys/types.h>

#include "spoolflow/recording/files/reading_child.hpp"

namespace spoolflow::recording {

class ReadingProcess {
 public:
  /// Starts a child of this process that works on the order, connected to this one: from the fork server, or where
  /// there is none by fork() of this process, which then must have one thread. Nothing that the child changes is seen
  /// here but what it sends and the memory of the order. Throws std::runtime_error where no process can be started.
  explicit ReadingProcess(const ReadingOrder& order);
  /// Ends the child wherever it is.
  ~ReadingProcess();
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;

  [[nodiscard]] Connection& connection() { return connection_; }
  [[nodiscard]] ::pid_t id() const { return child_; }
  /// How the child came to its end, once its connection is gone: "crashed (Segmentation fault)", "needed more than 20 s
  /// of computing".
  [[nodiscard]] std::string end();

 private:
  ReadingLimits limits_;
  ::pid_t child_ = -1;
  int descriptor_ = -1;
  Connection connection_{-1};
};

}  // namespace spoolflow::recording
