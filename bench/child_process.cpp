#include "bench/child_process.hpp"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace spoolflow::bench {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, Ends ends)
    : name_(command.front()), process_(-1), begun_s_(now_s()) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("cannot start " + name_);
  if (process_ > 0) return;
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(ends.input < 0 ? nothing : ends.input, STDIN_FILENO);
  ::dup2(ends.output < 0 ? nothing : ends.output, STDOUT_FILENO);
  ::execvp(arguments.front(), arguments.data());
  ::_exit(127);
}

Cost ChildProcess::finish() {
  int status = 0;
  rusage usage{};
  if (::wait4(process_, &status, 0, &usage) != process_ || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format("{} failed (wait status {})", name_, status));
  }
  return {.wall_s = now_s() - begun_s_,
          .cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime),
          .peak_rss_MiB = static_cast<double>(usage.ru_maxrss) / 1024};
}

}  // namespace spoolflow::bench
