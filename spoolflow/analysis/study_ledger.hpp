#pragma once
/// What a study that may be interrupted does with each run that is done, and by what it knows its own runs again.
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::analysis {

/// Counts finished runs, has them saved now and then, and reports progress.
class Ledger {
 public:
  /// Gets all finished runs as text every now and then.
  struct Saving {
    double interval_s;
    const std::function<void(const std::string&)>& save;
  };
  /// `open` runs are to be done. `state` is all that is finished, as text; `progress` gets the share of the open ones.
  Ledger(std::size_t open, const Saving& saving, std::function<std::string()> state,
         std::function<void(double)> progress)
      : open_(open), saving_(saving), state_(std::move(state)), progress_(std::move(progress)) {}
  /// `keep` puts the result where `state` finds it. From any thread.
  void finished(const std::function<void()>& keep) {
    const std::lock_guard lock(mutex_);
    keep();
    ++done_;
    const Clock::time_point now = Clock::now();
    if (std::chrono::duration<double>(now - saved_).count() >= saving_.interval_s) {
      saved_ = now;
      saving_.save(state_());
    }
    progress_(static_cast<double>(done_) / static_cast<double>(open_));
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t open_, done_ = 0;
  Saving saving_;
  std::function<std::string()> state_;
  std::function<void(double)> progress_;
  std::mutex mutex_;
  Clock::time_point saved_ = Clock::now();
};

/// Every number below an aggregate that describes itself, exactly.
template <class Aggregate>
[[nodiscard]] std::string exact_text(const Aggregate& aggregate) {
  std::string out;
  const auto write = [&](std::string_view path, const rig::Parameter&, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
      out += fmt::format("{} {:a}\n", path, value);
    } else {
      for (const double each : value) out += fmt::format("{} {:a}\n", path, each);
    }
  };
  rig::for_each_parameter(aggregate, write);
  return out;
}

}  // namespace spoolflow::analysis
