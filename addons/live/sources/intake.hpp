#pragma once
/// The bounded queue between the source of one valve and its consumer. A source never waits for a slow consumer
/// (but one that can, such as a replay as fast as may be): what finds no room is dropped and counted.
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "addons/live/sources/sample_block.hpp"

namespace spoolflow::live {

class Intake {
 public:
  static constexpr std::size_t most_samples = 16384;  ///< 16 s at 1 kHz, 1.6 MB

  /// `arrived` is called, in the source's thread, when samples are there after there were none.
  explicit Intake(std::function<void()> arrived) : arrived_(std::move(arrived)) {}

  /// Drops the block where there is no room for it.
  void push(SampleBlock&& block);
  /// Waits for room; returns false where the stop came first.
  bool push_waiting(SampleBlock&& block, const std::stop_token& stop);
  /// All that is there, in order; never waits. `blocks` is emptied first.
  void take(std::vector<SampleBlock>& blocks);

  /// Samples that came in whole and were dropped on the way to it.
  void count_dropped(std::uint64_t samples) { received_ += samples, dropped_ += samples; }
  void count_repeated(std::uint64_t samples) { repeated_ += samples; }
  void count_unreadable(std::uint64_t pieces) { unreadable_ += pieces; }
  void count_connection() { ++connections_; }
  /// What is wrong with the source at present, as the page shows it; empty: nothing.
  void set_trouble(std::string trouble);
  [[nodiscard]] std::string trouble() const;
  /// Which columns of the sender may be meant and are not read; empty: none.
  void set_unread(std::string columns);
  [[nodiscard]] std::string unread() const;
  [[nodiscard]] IntakeCounters counters() const;
  /// Whether nothing waits to be worked on.
  [[nodiscard]] bool empty() const;

 private:
  void append(SampleBlock&& block);

  std::function<void()> arrived_;
  mutable std::mutex mutex_;
  std::condition_variable_any room_;
  std::vector<SampleBlock> blocks_;
  std::size_t waiting_ = 0;  ///< samples in `blocks_`
  std::string trouble_, unread_;
  std::atomic<std::uint64_t> received_ = 0, dropped_ = 0, lost_ = 0, repeated_ = 0, unreadable_ = 0, connections_ = 0;
};

/// Nanoseconds of the steady clock.
[[nodiscard]] std::int64_t steady_ns();
/// Milliseconds since 1970-01-01 UTC.
[[nodiscard]] std::int64_t wall_ms();

}  // namespace spoolflow::live
