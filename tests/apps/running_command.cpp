#include "tests/apps/running_command.hpp"

#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace spoolflow::apps {

RunningCommand::RunningCommand(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> owned{"spoolflow"};
  owned.insert(owned.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& word : owned) words.push_back(word.data());
  words.push_back(nullptr);
  std::array<int, 2> input{};
  if (::pipe2(input.data(), O_CLOEXEC) != 0 || ::pipe2(output_.data(), O_CLOEXEC) != 0 ||
      ::pipe2(message_.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(input[0], STDIN_FILENO);
    ::dup2(output_[1], STDOUT_FILENO);
    ::dup2(message_[1], STDERR_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(SPOOLFLOW_COMMAND, words.data());
    ::_exit(127);
  }
  ::close(input[0]);
  ::close(output_[1]);
  ::close(message_[1]);
  input_ = input[1];
}

RunningCommand::~RunningCommand() {
  close_input();
  if (process_ > 0) {
    signal(SIGKILL);
    wait();
  }
  ::close(output_[0]);
  ::close(message_[0]);
}

void RunningCommand::send(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = ::write(input_, text.data(), text.size());
    if (written <= 0) throw std::runtime_error("the command reads no more");
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void RunningCommand::close_input() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
}

std::string RunningCommand::line(int descriptor, std::string& begun) {
  constexpr int longest_wait_ms = 30000;
  for (;;) {
    if (const std::size_t end = begun.find('\n'); end != std::string::npos) {
      std::string out = begun.substr(0, end);
      begun.erase(0, end + 1);
      return out;
    }
    pollfd waiting{descriptor, POLLIN, 0};
    std::array<char, 4096> bytes;
    if (::poll(&waiting, 1, longest_wait_ms) <= 0) return std::exchange(begun, {});
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got <= 0) return std::exchange(begun, {});
    begun.append(bytes.data(), static_cast<std::size_t>(got));
  }
}

void RunningCommand::signal(int number) const {
  if (process_ > 0) ::kill(process_, number);
}

int RunningCommand::wait() {
  int status = 0;
  ::waitpid(std::exchange(process_, -1), &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace spoolflow::apps
