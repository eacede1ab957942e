#include "spoolflow/validation/run_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spoolflow/validation/stretches.hpp"
#include "spoolflow/validation/trace.hpp"

namespace spoolflow::validation {
namespace {

/// Takes the samples of each stretch together.
class Tracer {
 public:
  Tracer(std::span<const double> time_s, std::size_t samples_per_stretch)
      : stretches_(stretches_of_samples(time_s, samples_per_stretch)), every_sample_(samples_per_stretch == 1) {}

  /// `value_at(k)`: of sample k.
  template <class ValueAt>
  [[nodiscard]] TracedChannel channel(const ValueAt& value_at) const {
    TracedChannel out;
    out.lowest = edge(value_at, [](float a, float b) { return std::fmin(a, b); });  // fmin and fmax pass over NaN
    if (!every_sample_) out.highest = edge(value_at, [](float a, float b) { return std::fmax(a, b); });
    return out;
  }
  template <class Number>
  [[nodiscard]] TracedChannel column(const std::vector<Number>& values) const {
    if (values.empty()) return {};
    return channel([&](std::size_t k) { return static_cast<float>(values[k]); });
  }
  [[nodiscard]] std::vector<float> lowest(const std::vector<float>& values) const {
    return edge([&](std::size_t k) { return values[k]; }, [](float a, float b) { return std::fmin(a, b); });
  }
  [[nodiscard]] std::vector<float> highest(const std::vector<float>& values) const {
    return edge([&](std::size_t k) { return values[k]; }, [](float a, float b) { return std::fmax(a, b); });
  }
  [[nodiscard]] std::vector<std::uint32_t> status(const std::vector<sensor::Status>& values) const {
    static_assert(sensor::status_names.size() <= 32);
    std::vector<std::uint32_t> out;
    for (const Stretch& stretch : stretches_) {
      sensor::Status any = sensor::Status::none;
      for (std::size_t k = stretch.begin; k < stretch.end; ++k) any |= values[k];
      std::uint32_t places = 0;
      for (std::size_t n = 0; n < sensor::status_names.size(); ++n) {
        if (sensor::has(any, sensor::status_names[n].bit)) places |= 1U << n;
      }
      out.push_back(places);
    }
    return out;
  }
  [[nodiscard]] std::vector<double> times(std::span<const double> time_s) const {
    std::vector<double> out;
    for (const Stretch& stretch : stretches_) {
      const bool gap = stretch.begin == stretch.end;
      out.push_back(gap ? 0.5 * (time_s[stretch.begin - 1] + time_s[stretch.begin]) : time_s[stretch.begin]);
    }
    return out;
  }

 private:
  template <class ValueAt, class Farther>
  [[nodiscard]] std::vector<float> edge(const ValueAt& value_at, const Farther& farther) const {
    std::vector<float> out;
    out.reserve(stretches_.size());
    for (const Stretch& stretch : stretches_) {
      float value = no_value;
      for (std::size_t k = stretch.begin; k < stretch.end; ++k) value = farther(value, value_at(k));
      out.push_back(value);
    }
    return out;
  }

  std::vector<Stretch> stretches_;
  bool every_sample_;
};

TracedEstimator traced(const Tracer& tracer, const RunSamples& run, const Answers& answers, bool leading) {
  TracedEstimator out{};
  out.estimator = answers.estimator;
  out.flow_m3_per_s = tracer.column(answers.flow_m3_per_s);
  out.pressure_difference_Pa = tracer.column(answers.pressure_difference_Pa);
  if (!run.reference_m3_per_s.empty()) {
    out.error_m3_per_s =
        tracer.channel([&](std::size_t k) { return answers.flow_m3_per_s[k] - run.reference_m3_per_s[k]; });
  }
  if (!leading) return out;
  out.lower_m3_per_s = tracer.lowest(answers.lower_m3_per_s);
  out.upper_m3_per_s = tracer.highest(answers.upper_m3_per_s);
  out.magnetic_force_N = tracer.column(answers.magnetic_force_N);
  out.spring_force_N = tracer.column(answers.spring_force_N);
  out.flow_force_N = tracer.column(answers.flow_force_N);
  out.friction_force_N = tracer.column(answers.friction_force_N);
  const auto spring_and_flow_N = [&](std::size_t k) { return answers.spring_force_N[k] + answers.flow_force_N[k]; };
  out.spring_and_flow_N = tracer.channel(spring_and_flow_N);
  out.all_forces_N = tracer.channel([&](std::size_t k) { return spring_and_flow_N(k) + answers.friction_force_N[k]; });
  out.status = tracer.status(answers.status);
  return out;
}

/// Numbers that one sample takes: a column each, and what the leading estimator adds.
std::size_t values_a_sample(const RunSamples& run) {
  constexpr std::size_t of_every_run = 2;        // time, position
  constexpr std::size_t of_leading = 9;          // band, forces and their stack, status
  constexpr std::size_t of_every_estimator = 2;  // flow, pressure difference
  const std::size_t reference = run.reference_m3_per_s.empty() ? 0 : 1;
  std::size_t others = 0;
  for (const auto* column : {&run.pressure_difference_Pa, &run.current_A, &run.voltage_V, &run.oil_temperature_K}) {
    others += column->empty() ? 0 : 1;
  }
  return of_every_run + of_leading + reference + others + run.answers.size() * (of_every_estimator + reference);
}

}  // namespace

RunTrace run_trace(const RunSamples& run, std::size_t values) {
  const std::size_t most_samples = std::max<std::size_t>(1, values / values_a_sample(run));
  const std::size_t samples = run.time_s.size();
  RunTrace out;
  // Lowest and highest take twice the room of one value.
  if (samples > most_samples) out.samples_per_stretch = (2 * samples + most_samples - 1) / most_samples;
  const Tracer tracer(run.time_s, out.samples_per_stretch);
  out.time_s = tracer.times(run.time_s);
  out.reference_m3_per_s = tracer.column(run.reference_m3_per_s);
  out.position_m = tracer.column(run.position_m);
  out.pressure_difference_Pa = tracer.column(run.pressure_difference_Pa);
  out.current_A = tracer.column(run.current_A);
  out.voltage_V = tracer.column(run.voltage_V);
  out.oil_temperature_K = tracer.column(run.oil_temperature_K);
  for (const Answers& answers : run.answers) {
    out.estimators.push_back(traced(tracer, run, answers, &answers == &run.answers.back()));
  }
  return out;
}

}  // namespace spoolflow::validation
