#pragma once
/// Times of samples that a file states by a beginning and a step instead of a column of times.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace spoolflow::recording {

/// Even steps from sample `first` on, up to the next stretch.
struct EvenStretch {
  std::uint64_t first = 0;
  double begin_s = 0, step_s = 0;

  bool operator==(const EvenStretch&) const = default;
};

/// Stretches of even steps: one of a recording without a pause, several where it was stopped and went on, or where its
/// rate changed. Empty: the file states no times.
class EvenTimes {
 public:
  EvenTimes() = default;
  EvenTimes(double begin_s, double step_s) : stretches_{{0, begin_s, step_s}} {}

  [[nodiscard]] bool empty() const { return stretches_.empty(); }
  [[nodiscard]] const std::vector<EvenStretch>& stretches() const { return stretches_; }
  void add(const EvenStretch& stretch) { stretches_.push_back(stretch); }

  /// [s]; of no times 0.
  [[nodiscard]] double at(std::uint64_t sample) const {
    if (stretches_.empty()) return 0;
    const auto after = stretches_.size() == 1 ? stretches_.end()
                                              : std::ranges::upper_bound(stretches_, sample, {}, &EvenStretch::first);
    const EvenStretch& in = after == stretches_.begin() ? stretches_.front() : *(after - 1);
    return in.begin_s + static_cast<double>(sample - in.first) * in.step_s;
  }

  /// From sample `first` on the time is said to be `begin_s`. A beginning within half a step of where the samples
  /// before end continues them. So does one that lies up to ten steps before: the clock of the program that wrote it is
  /// read to no better than that, and no sample is taken before the one that it follows.
  void go_on(const EvenStretch& next) {
    constexpr double overlap_steps = 10;
    if (stretches_.empty()) return add({0, next.begin_s, next.step_s});
    const double late_s = next.begin_s - at(next.first);
    const bool on_time = late_s <= next.step_s / 2 && late_s >= -overlap_steps * next.step_s;
    if (!on_time) return add(next);
    if (next.step_s != stretches_.back().step_s) add({next.first, at(next.first), next.step_s});
  }

  bool operator==(const EvenTimes&) const = default;

 private:
  std::vector<EvenStretch> stretches_;
};

}  // namespace spoolflow::recording
