#include "spoolflow/validation/metrics.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::validation {
namespace {

constexpr double moving_rate_per_s = 0.01;  // share of the stroke a second
constexpr double open_share = 0.01;
constexpr double reversal_s = 2.0;

/// Marks the samples within `reversal_s` of any turn.
std::vector<bool> near_turns(std::span<const double> time_s, const std::vector<double>& turns_s) {
  std::vector<bool> near(time_s.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    while (next < turns_s.size() && turns_s[next] < time_s[k]) ++next;
    near[k] = (next < turns_s.size() && turns_s[next] - time_s[k] <= reversal_s) ||
              (next > 0 && time_s[k] - turns_s[next - 1] <= reversal_s);
  }
  return near;
}

Phases phases_of_rate(std::span<const double> time_s, std::span<const double> share, const std::vector<double>& rate) {
  Phases out;
  std::vector<double> turns_s;
  for (std::size_t k = 0; k < rate.size(); ++k) {
    const bool moving = std::abs(rate[k]) > moving_rate_per_s;
    out.moving.push_back(moving);
    out.rest.push_back(!moving && share[k] > open_share);
    if (k == 0) continue;
    if ((moving != out.moving[k - 1] && share[k] > 0.5) || rate[k] * rate[k - 1] < 0) turns_s.push_back(time_s[k]);
  }
  out.reversal = near_turns(time_s, turns_s);
  return out;
}

std::vector<double> selected(const std::vector<double>& errors, const std::vector<bool>& phase) {
  std::vector<double> out;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (phase[k] && !std::isnan(errors[k])) out.push_back(errors[k]);
  }
  return out;
}

}  // namespace

ErrorFigures error_figures(std::vector<double> errors) {
  ErrorFigures out;
  out.samples = errors.size();
  if (errors.empty()) return out;
  const auto n = static_cast<double>(errors.size());
  double squares = 0;
  for (double& error : errors) {
    out.bias += error / n;
    squares += error * error;
    error = std::abs(error);
  }
  out.rms = std::sqrt(squares / n);
  const auto p95 =
      errors.begin() + static_cast<std::ptrdiff_t>(std::min(errors.size() - 1, static_cast<std::size_t>(0.95 * n)));
  std::nth_element(errors.begin(), p95, errors.end());
  out.p95 = *p95;
  out.largest = *std::max_element(p95, errors.end());
  return out;
}

Phases phases_of_command(std::span<const double> time_s, std::span<const double> position_set) {
  std::vector<double> rate(time_s.size(), 0.0);
  for (std::size_t k = 1; k < rate.size(); ++k) {
    rate[k] = (position_set[k] - position_set[k - 1]) / std::max(time_s[k] - time_s[k - 1], 1e-9);
  }
  return phases_of_rate(time_s, position_set, rate);
}

Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m, double stroke_m) {
  constexpr double window_s = 0.2;
  const std::size_t n = time_s.size();
  std::vector<double> share(n, 0.0);
  std::vector<double> rate(n, 0.0);
  double smooth = 0;
  bool started = false;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = position_m[k] / stroke_m;
    if (!std::isnan(x)) {
      const double step_s = k == 0 ? 0 : time_s[k] - time_s[k - 1];
      smooth = started ? smooth + (x - smooth) * step_s / (0.5 * window_s + step_s) : x;
      started = true;
    }
    share[k] = smooth;
  }
  std::size_t before = 0;
  for (std::size_t k = 1; k < n; ++k) {
    while (before + 1 < k && time_s[k] - time_s[before] > window_s) ++before;
    rate[k] = (share[k] - share[before]) / std::max(time_s[k] - time_s[before], 1e-9);
    if (std::abs(rate[k]) <= moving_rate_per_s) rate[k] = 0;  // noise has no direction that could turn
  }
  Phases out = phases_of_rate(time_s, share, rate);
  out.from_measured_position = true;
  return out;
}

Metrics compare(const Comparison& comparison, const Phases& phases, double full_scale_m3_per_s) {
  const std::size_t n = comparison.estimate_m3_per_s.size();
  std::vector<double> errors(n);
  std::vector<double> all;
  std::vector<double> of_reading;
  Metrics out;
  std::size_t inside = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double reference = comparison.reference_m3_per_s[k];
    errors[k] = comparison.estimate_m3_per_s[k] - reference;
    if (std::isnan(errors[k])) continue;
    all.push_back(errors[k]);
    if (std::abs(reference) > 0.1 * full_scale_m3_per_s) of_reading.push_back(errors[k] / reference);
    inside += comparison.lower_m3_per_s[k] <= reference && reference <= comparison.upper_m3_per_s[k] ? 1 : 0;
    out.band_mean_width_m3_per_s += comparison.upper_m3_per_s[k] - comparison.lower_m3_per_s[k];
  }
  if (!all.empty()) {
    out.band_coverage = static_cast<double>(inside) / static_cast<double>(all.size());
    out.band_mean_width_m3_per_s /= static_cast<double>(all.size());
  }
  out.all = error_figures(std::move(all));
  out.moving = error_figures(selected(errors, phases.moving));
  out.rest = error_figures(selected(errors, phases.rest));
  out.reversal = error_figures(selected(errors, phases.reversal));
  out.share_of_reading = error_figures(std::move(of_reading));
  return out;
}

std::vector<double> lagged(std::span<const double> time_s, std::span<const double> values, double lag_s) {
  std::vector<double> out(values.begin(), values.end());
  for (std::size_t k = 1; k < out.size(); ++k) {
    const double step_s = time_s[k] - time_s[k - 1];
    const double share = lag_s > 0 ? 1 - std::exp(-step_s / lag_s) : 1;
    out[k] = out[k - 1] + share * (values[k] - out[k - 1]);
  }
  return out;
}

}  // namespace spoolflow::validation
