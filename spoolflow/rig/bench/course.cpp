#include "spoolflow/rig/bench/course.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {

Course& Course::ramp_for(double value, double duration_s) {
  if (duration_s > 0) {
    segments_.push_back({.begin_s = duration_s_,
                         .end_s = duration_s_ + duration_s,
                         .from = last_,
                         .to = value,
                         .amplitude = 0,
                         .amplitude_end = 0,
                         .frequency_Hz = 0,
                         .frequency_end_Hz = 0});
    duration_s_ += duration_s;
  }
  last_ = value;
  return *this;
}

Course& Course::ramp_at(double value, double rate_per_s) {
  return ramp_for(value, std::abs(value - last_) / rate_per_s);
}

Course& Course::sine(const Sine& sine) {
  segments_.push_back({.begin_s = duration_s_,
                       .end_s = duration_s_ + sine.duration_s,
                       .from = last_,
                       .to = last_,
                       .amplitude = sine.amplitude,
                       .amplitude_end = sine.amplitude_end,
                       .frequency_Hz = sine.frequency_Hz,
                       .frequency_end_Hz = sine.frequency_end_Hz});
  duration_s_ += sine.duration_s;
  return *this;
}

double Course::at(double time_s) const {
  if (segments_.empty()) {
    return last_;
  }
  if (time_s < segments_.front().begin_s) {
    return start_;
  }
  if (time_s >= duration_s_) {
    return last_;
  }
  const auto ends_after = [](double time, const Segment& candidate) { return time < candidate.end_s; };
  const Segment& segment = *std::upper_bound(segments_.begin(), segments_.end(), time_s, ends_after);
  const double duration_s = segment.end_s - segment.begin_s;
  const double since_s = time_s - segment.begin_s;
  const double share = since_s / duration_s;
  const double line = segment.from + (segment.to - segment.from) * share;
  if (segment.amplitude == 0 && segment.amplitude_end == 0) {
    return line;
  }
  // Phase of a sweep whose frequency grows exponentially: the integral of f0 (f1/f0)^(t/T).
  const double octaves = natural_logarithm(segment.frequency_end_Hz / segment.frequency_Hz);
  const double cycles = std::abs(octaves) < 1e-9
                            ? segment.frequency_Hz * since_s
                            : segment.frequency_Hz * duration_s / octaves * (exponential(octaves * share) - 1);
  const double amplitude = segment.amplitude + (segment.amplitude_end - segment.amplitude) * share;
  return line + amplitude * sine_of_turns(cycles);
}

}  // namespace spoolflow::rig
