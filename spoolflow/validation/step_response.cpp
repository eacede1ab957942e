#include "spoolflow/validation/step_response.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/numerics/median.hpp"

namespace spoolflow::validation {
namespace {

constexpr double smallest_share = 0.1;  // of full scale, within change_s
constexpr double steady_share = 0.1;    // of the step, that the reference may wander before and after
constexpr double change_s = 0.2;
constexpr double before_s = 0.2;
constexpr double after_s = 0.4;
constexpr double followed_share = 0.5;
constexpr double course_step_s = 0.005;

/// Samples of one run by time.
class Samples {
 public:
  explicit Samples(const RunSamples& run) : time_s_(run.time_s) {}

  [[nodiscard]] std::size_t at(double time_s) const {
    return static_cast<std::size_t>(std::lower_bound(time_s_.begin(), time_s_.end(), time_s) - time_s_.begin());
  }
  /// NaN without a sample in it.
  [[nodiscard]] double mean(const std::vector<float>& values, double from_s, double to_s) const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = at(from_s); k < time_s_.size() && time_s_[k] < to_s; ++k) {
      if (std::isnan(values[k])) continue;
      sum += values[k];
      ++count;
    }
    return sum / static_cast<double>(count);
  }
  /// When the values first pass `level`, interpolated between two samples; NaN where they never do.
  [[nodiscard]] double crossing_s(const std::vector<float>& values, double from_s, double to_s, double level,
                                  bool rising) const {
    for (std::size_t k = std::max<std::size_t>(1, at(from_s)); k < time_s_.size() && time_s_[k] <= to_s; ++k) {
      const double last = values[k - 1];
      const double now = values[k];
      if (rising ? now < level : now > level) continue;
      if (now == last || (rising ? last >= level : last <= level)) return time_s_[k];
      return time_s_[k - 1] + (time_s_[k] - time_s_[k - 1]) * (level - last) / (now - last);
    }
    return std::nan("");
  }
  [[nodiscard]] double value(const std::vector<float>& values, double time_s) const {
    const std::size_t k = std::clamp<std::size_t>(at(time_s), 1, time_s_.size() - 1);
    const double step_s = time_s_[k] - time_s_[k - 1];
    const double share = step_s > 0 ? std::clamp((time_s - time_s_[k - 1]) / step_s, 0.0, 1.0) : 1;
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }
  [[nodiscard]] const std::vector<double>& time_s() const { return time_s_; }

 private:
  const std::vector<double>& time_s_;
};

/// The levels between which something steps.
struct Levels {
  double before, after;
  [[nodiscard]] double change() const { return after - before; }
  [[nodiscard]] double at(double share) const { return before + share * change(); }
};

/// Before and after a step whose middle is passed at `half_s`.
Levels levels_about(const Samples& samples, const std::vector<float>& values, double half_s) {
  return {samples.mean(values, half_s - change_s - before_s, half_s - change_s),
          samples.mean(values, half_s + 0.5 * after_s, half_s + after_s)};
}

struct Step {
  double half_s;  ///< when the reference passes the middle
  Levels reference;
};

/// Where the reference starts to change at `from_s`, if that is a step.
std::optional<Step> step_at(const Samples& samples, const std::vector<float>& reference, double from_s,
                            double full_scale_m3_per_s) {
  const double end_s = from_s + change_s;
  const Levels levels{samples.mean(reference, from_s - 0.5 * before_s, from_s),
                      samples.mean(reference, end_s, end_s + 0.5 * after_s)};
  if (!(std::abs(levels.change()) > smallest_share * full_scale_m3_per_s)) return std::nullopt;
  const double wander = steady_share * std::abs(levels.change());
  const double earlier = samples.mean(reference, from_s - before_s, from_s - 0.5 * before_s);
  const double later = samples.mean(reference, end_s + 0.5 * after_s, end_s + after_s);
  if (!(std::abs(earlier - levels.before) < wander && std::abs(later - levels.after) < wander)) return std::nullopt;
  const bool rising = levels.change() > 0;
  const double about_s = samples.crossing_s(reference, from_s, end_s + after_s, levels.at(0.5), rising);
  const Levels settled = levels_about(samples, reference, about_s);
  const double half_s = samples.crossing_s(reference, from_s, end_s + after_s, settled.at(0.5), rising);
  if (std::isnan(half_s)) return std::nullopt;
  return Step{half_s, settled};
}

std::vector<Step> steps_of(const Samples& samples, const std::vector<float>& reference, double full_scale_m3_per_s) {
  constexpr double stride_s = 0.02;
  std::vector<Step> out;
  if (samples.time_s().size() < 100) return out;
  const double last_s = samples.time_s().back() - change_s - after_s;
  for (double from_s = samples.time_s().front() + before_s; from_s < last_s; from_s += stride_s) {
    if (const auto step = step_at(samples, reference, from_s, full_scale_m3_per_s)) {
      out.push_back(*step);
      from_s += change_s + after_s;
    }
  }
  return out;
}

double rise_s(const Samples& samples, const std::vector<float>& values, const Step& step, const Levels& levels) {
  const bool rising = levels.change() > 0;
  const double from_s = step.half_s - change_s;
  const double to_s = step.half_s + after_s;
  return samples.crossing_s(values, from_s, to_s, levels.at(0.9), rising) -
         samples.crossing_s(values, from_s, to_s, levels.at(0.1), rising);
}

/// The mean of all courses, each from 0 to 1.
class MeanCourse {
 public:
  void add(const Samples& samples, const std::vector<float>& values, const Step& step, const Levels& levels) {
    if (sums_.empty()) sums_.assign(times_s().size(), 0.0);
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      sums_[k] += (samples.value(values, step.half_s + times_s()[k]) - levels.before) / levels.change();
    }
    ++count_;
  }
  [[nodiscard]] std::vector<float> mean() const {
    std::vector<float> out;
    for (const double sum : sums_) out.push_back(static_cast<float>(sum / static_cast<double>(count_)));
    return out;
  }
  [[nodiscard]] static const std::vector<double>& times_s() {
    static const std::vector<double> times = [] {
      std::vector<double> out;
      for (double t = -change_s; t < after_s; t += course_step_s) out.push_back(t);
      return out;
    }();
    return times;
  }

 private:
  std::vector<double> sums_;
  std::size_t count_ = 0;
};

StepAnswer answer(const Samples& samples, const Answers& answers, const std::vector<Step>& steps) {
  const std::vector<float>& flow = answers.flow_m3_per_s;
  std::vector<double> delays_s;
  std::vector<double> rises_s;
  std::vector<double> overshoots;
  MeanCourse course;
  for (const Step& step : steps) {
    const Levels own = levels_about(samples, flow, step.half_s);
    const double share = own.change() / step.reference.change();
    if (!(share > followed_share)) continue;
    const bool rising = own.change() > 0;
    delays_s.push_back(samples.crossing_s(flow, step.half_s - change_s, step.half_s + after_s, own.at(0.5), rising) -
                       step.half_s);
    rises_s.push_back(rise_s(samples, flow, step, own));
    double farthest = 0;
    for (std::size_t k = samples.at(step.half_s); k < samples.at(step.half_s + after_s); ++k) {
      farthest = std::max(farthest, (flow[k] - own.after) / own.change());
    }
    overshoots.push_back(farthest);
    course.add(samples, flow, step, own);
  }
  return {answers.estimator,
          delays_s.size(),
          numerics::median(delays_s),
          numerics::median(rises_s),
          numerics::median(overshoots),
          course.mean()};
}

}  // namespace

std::optional<StepResponse> step_response(const RunSamples& run, double full_scale_m3_per_s) {
  if (run.reference_m3_per_s.empty()) return std::nullopt;
  const Samples samples(run);
  const std::vector<Step> steps = steps_of(samples, run.reference_m3_per_s, full_scale_m3_per_s);
  if (steps.empty()) return std::nullopt;
  StepResponse out{steps.size(), 0, MeanCourse::times_s(), {}, {}};
  std::vector<double> rises_s;
  MeanCourse course;
  for (const Step& step : steps) {
    rises_s.push_back(rise_s(samples, run.reference_m3_per_s, step, step.reference));
    course.add(samples, run.reference_m3_per_s, step, step.reference);
  }
  out.reference_rise_s = numerics::median(rises_s);
  out.reference_course = course.mean();
  for (const Answers& answers : run.answers) out.answers.push_back(answer(samples, answers, steps));
  return out;
}

}  // namespace spoolflow::validation
