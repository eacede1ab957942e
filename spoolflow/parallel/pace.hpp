#pragma once
/// Waits that a stop ends.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace spoolflow::parallel {

using SteadyTime = std::chrono::steady_clock::time_point;

/// Waits until then; returns false where the stop came first.
inline bool wait_until(SteadyTime time, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  never.wait_until(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}
inline bool wait_for(std::chrono::milliseconds time, const std::stop_token& stop) {
  return wait_until(std::chrono::steady_clock::now() + time, stop);
}

}  // namespace spoolflow::parallel
