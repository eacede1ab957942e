#pragma once
/// The planned course of one set value over a bench run: holds, ramps, sines and sweeps one after the other.
#include <vector>

namespace spoolflow::rig {

/// Piecewise course of a set value; the unit is the value's own. Before its start it holds the first value, after its
/// end the last one.
class Course {
 public:
  explicit Course(double start_value = 0) : last_(start_value), start_(start_value) {}

  Course& hold(double duration_s) { return ramp_for(last_, duration_s); }
  /// Straight line to `value` in `duration_s`; zero is a step.
  Course& ramp_for(double value, double duration_s);
  /// Straight line to `value` at `rate_per_s` > 0, in the value's unit a second.
  Course& ramp_at(double value, double rate_per_s);
  Course& step_to(double value) { return ramp_for(value, 0); }

  struct Sine {
    double amplitude;
    double amplitude_end;  ///< reached linearly at the end
    double frequency_Hz;
    double frequency_end_Hz;  ///< reached exponentially at the end: equal time an octave
    double duration_s;
  };
  /// Swings about the value reached so far and returns to it; starts upwards.
  Course& sine(const Sine& sine);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double last() const { return last_; }
  [[nodiscard]] double at(double time_s) const;

 private:
  struct Segment {
    double begin_s;
    double end_s;
    double from;
    double to;
    double amplitude;
    double amplitude_end;
    double frequency_Hz;
    double frequency_end_Hz;
  };
  std::vector<Segment> segments_;
  double duration_s_ = 0;
  double last_;
  double start_;
};

}  // namespace spoolflow::rig
