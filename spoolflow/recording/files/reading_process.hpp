#pragma once
/// A process of few rights beside this one, which reads a file and answers in messages.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <sys/types.h>

#include "spoolflow/recording/files/few_rights.hpp"

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

class ReadingProcess {
 public:
  /// Starts `work` in a child of this process with the limits, connected to this one. Nothing that `work` changes is
  /// seen here but what it sends and memory that both share. Throws std::runtime_error where no process can be started.
  ReadingProcess(const ReadingLimits& limits, const std::function<void(Connection&)>& work);
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
