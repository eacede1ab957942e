#include "spoolflow/apps/terminal/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace spoolflow::apps {
namespace {

std::string duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string count(double number) {
  if (number >= 1e9) return fmt::format("{:.1f} G", number / 1e9);
  if (number >= 1e6) return fmt::format("{:.1f} M", number / 1e6);
  if (number >= 1e3) return fmt::format("{:.1f} k", number / 1e3);
  return fmt::format("{:.0f}", number);
}

}  // namespace

std::string progress_line(const ProgressState& state) {
  std::string line = state.task;
  const double share = std::clamp(state.share.value_or(0.0), 0.0, 1.0);
  const auto samples = static_cast<double>(state.samples);
  if (state.share) {
    const auto filled = static_cast<std::size_t>(16 * share);
    line += fmt::format(" {:3.0f} % [{:<16}]", std::floor(100 * share), std::string(filled, '#'));
  } else if (state.samples > 0) {
    line += fmt::format("  {} samples", count(samples));
  }
  if (state.samples > 0 && state.elapsed_s > 0) line += fmt::format("  {} samples/s", count(samples / state.elapsed_s));
  if (share > 0) line += fmt::format("  {} left", duration(state.elapsed_s * (1 - share) / share));
  return line;
}

Progress::Progress(std::string task, bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {
  state_.task = std::move(task);
}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(std::optional<double> share, std::uint64_t samples) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  state_.share = share;
  state_.samples = samples;
  state_.elapsed_s = std::chrono::duration<double>(now - begun_).count();
  fmt::print(stderr, "\r{}\033[K", progress_line(state_));
  drawn_ = true;
}

void Progress::task(std::string task) {
  state_.task = std::move(task);
}

}  // namespace spoolflow::apps
