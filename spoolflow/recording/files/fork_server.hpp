#pragma once
/// Where children come from once this process has threads.
#include <mutex>
#include <sys/types.h>

#include "spoolflow/recording/files/reading_child.hpp"

namespace spoolflow::recording {

/// Whether fork() is safe here: a child has one thread, and what another one had locked at that instant (memory, a
/// library's own state) stays locked in it for ever. True where the system does not state how many there are. Waits up
/// to a second for threads that were joined and are about to leave.
[[nodiscard]] bool may_fork();

/// A process with one thread and nothing open, forked before this one had a second thread. It forks the children that
/// read, as children of this process. While there is one, every ReadingProcess comes from it. It ends with its object,
/// or with this process however that ends.
class ForkServer {
 public:
  /// Where the system has no further process, start() reports it. Throws std::logic_error where this process has
  /// threads already, or a fork server.
  ForkServer();
  /// No thread asks it any more. Children that were started live on.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  /// The one there is, or null.
  [[nodiscard]] static ForkServer* present();
  [[nodiscard]] ::pid_t id() const { return process_; }

  /// A child that works on the order, its end of the connection being that descriptor; -1 and errno where there is
  /// none. From any thread.
  [[nodiscard]] ::pid_t start(const ReadingOrder& order, int connection);

 private:
  std::mutex mutex_;  ///< one order at a time
  ::pid_t process_ = -1;
  int socket_ = -1;
  int failure_ = 0;  ///< errno of what kept it from being started
};

}  // namespace spoolflow::recording
