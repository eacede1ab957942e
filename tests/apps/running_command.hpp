#pragma once
/// The built command while it runs: one writes to it, reads what it has written so far, and ends it.
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace spoolflow::apps {

class RunningCommand {
 public:
  /// Starts it in `folder`; `arguments` are those behind the command's name.
  RunningCommand(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  /// Kills it where it still runs.
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  /// To its standard input.
  void send(std::string_view text) const;
  void close_input();
  /// The next line of its standard output or standard error, without its end; waits for it, at most half a minute.
  /// Empty where nothing more comes.
  [[nodiscard]] std::string output_line() { return line(output_[0], output_begun_); }
  [[nodiscard]] std::string message_line() { return line(message_[0], message_begun_); }
  void signal(int number) const;
  /// Waits for its end; exit status, or 128 + the signal that ended it.
  int wait();

 private:
  static std::string line(int descriptor, std::string& begun);

  pid_t process_ = -1;
  int input_ = -1;
  std::array<int, 2> output_{}, message_{};
  std::string output_begun_, message_begun_;
};

}  // namespace spoolflow::apps
