#pragma once
/// Runs a command as a user would and reports what it cost.
#include <string>
#include <sys/types.h>
#include <vector>

namespace spoolflow::bench {

struct Cost {
  double wall_s;
  double cpu_s;  ///< user and system
  double peak_rss_MiB;
};

/// A running command; its standard input and output are files, or pipes of which this end is held.
class ChildProcess {
 public:
  struct Ends {
    int input = -1;   ///< becomes standard input; -1: /dev/null
    int output = -1;  ///< becomes standard output; -1: /dev/null
  };
  ChildProcess(const std::vector<std::string>& command, Ends ends);

  /// Waits. Throws std::runtime_error where the command did not end with status 0.
  Cost finish();

 private:
  std::string name_;
  pid_t process_;
  double begun_s_;
};

}  // namespace spoolflow::bench
