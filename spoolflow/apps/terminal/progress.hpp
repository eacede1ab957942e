#pragma once
/// A line on the terminal that says how far the work is.
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace spoolflow::apps {

/// What the line says.
struct ProgressState {
  std::string task;             ///< "estimating"
  std::optional<double> share;  ///< 0 to 1; absent where the length is unknown (a pipe)
  std::uint64_t samples = 0;    ///< 0: not counted
  double elapsed_s = 0;
};

/// "estimating  43 % [########            ]  1.2 M samples  2.1 M/s  0:12 left", at most 79 characters for a task
/// of 20.
[[nodiscard]] std::string progress_line(const ProgressState& state);

/// Shows the line on standard error while it lives: only where that is a terminal, unless quiet, at most ten times a
/// second, from half a second on. The line is cleared at the end.
class Progress {
 public:
  Progress(std::string task, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap; to be called once a block of samples.
  void update(std::optional<double> share, std::uint64_t samples = 0);
  /// Another part of the work, and how far the whole is.
  void update(std::string task, double share) {
    this->task(std::move(task));
    update(share);
  }
  /// The work goes on to another part of itself; shares keep counting over the whole.
  void task(std::string task);

 private:
  using Clock = std::chrono::steady_clock;
  ProgressState state_;
  bool shown_;  ///< whether there is anybody to show it to
  bool drawn_ = false;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point next_ = begun_ + std::chrono::milliseconds(500);
};

}  // namespace spoolflow::apps
