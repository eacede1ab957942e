#include "spoolflow/validation/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace spoolflow::validation {
namespace {

constexpr std::uint8_t moving_bit = 1, rest_bit = 2, reversal_bit = 4, inside_bit = 8, any_bit = 16, p_to_b_bit = 32,
                       p_to_a_bit = 64;
constexpr double reading_from_share_of_full_scale = 0.1;

}  // namespace

ErrorFigures error_figures(std::vector<float> errors) {
  ErrorFigures out;
  out.samples = errors.size();
  if (errors.empty()) return out;
  const auto n = static_cast<double>(errors.size());
  double sum = 0;
  double squares = 0;
  for (float& error : errors) {
    sum += error;
    squares += static_cast<double>(error) * error;
    error = std::abs(error);
  }
  out.bias = sum / n;
  out.rms = std::sqrt(squares / n);
  const auto p95 =
      errors.begin() + static_cast<std::ptrdiff_t>(std::min(errors.size() - 1, static_cast<std::size_t>(0.95 * n)));
  std::nth_element(errors.begin(), p95, errors.end());
  out.p95 = *p95;
  out.largest = *std::max_element(p95, errors.end());
  return out;
}

ErrorFigures error_figures_of_runs(const std::vector<std::vector<float>>& runs) {
  ErrorFigures out;
  double counted = 0;
  std::vector<std::pair<float, float>> weighed;  // magnitude, weight
  for (const std::vector<float>& errors : runs) {
    if (errors.empty()) continue;
    const ErrorFigures each = error_figures(errors);
    out.samples += each.samples;
    out.bias += each.bias;
    out.rms += each.rms * each.rms;
    out.largest = std::max(out.largest, each.largest);
    const auto weight = 1 / static_cast<float>(each.samples);
    for (const float error : errors) weighed.emplace_back(std::abs(error), weight);
    ++counted;
  }
  if (counted == 0) return out;
  out.bias /= counted;
  out.rms = std::sqrt(out.rms / counted);
  std::ranges::sort(weighed);
  double below = 0;
  for (const auto& [magnitude, weight] : weighed) {
    out.p95 = magnitude;
    below += weight;
    if (below > 0.95 * counted) break;
  }
  return out;
}

void ComparedSamples::add(const ComparedSample& sample) {
  const double error = sample.estimate_m3_per_s - sample.reference_m3_per_s;
  const bool inside =
      sample.lower_m3_per_s <= sample.reference_m3_per_s && sample.reference_m3_per_s <= sample.upper_m3_per_s;
  error_m3_per_s_.push_back(static_cast<float>(error));
  width_m3_per_s_.push_back(static_cast<float>(sample.upper_m3_per_s - sample.lower_m3_per_s));
  bits_.push_back(static_cast<std::uint8_t>(any_bit | (sample.moving ? moving_bit : 0) | (sample.rest ? rest_bit : 0) |
                                            (sample.reversal ? reversal_bit : 0) | (inside ? inside_bit : 0) |
                                            (sample.p_to_b ? p_to_b_bit : 0) | (sample.p_to_a ? p_to_a_bit : 0)));
  if (std::abs(sample.reference_m3_per_s) > reading_from_share_of_full_scale * full_scale_m3_per_s_) {
    share_of_reading_.push_back(static_cast<float>(error / sample.reference_m3_per_s));
  }
}

void ComparedSamples::append(const ComparedSamples& others) {
  if (!bits_.empty()) {
    ends_.push_back(bits_.size());
    ends_of_reading_.push_back(share_of_reading_.size());
  }
  const auto add_all = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add_all(error_m3_per_s_, others.error_m3_per_s_);
  add_all(width_m3_per_s_, others.width_m3_per_s_);
  add_all(bits_, others.bits_);
  add_all(share_of_reading_, others.share_of_reading_);
}

GroupFigures ComparedSamples::group(std::uint8_t bit, Weigh weigh) const {
  GroupFigures out;
  std::vector<std::vector<float>> runs(1);
  std::size_t inside = 0;
  double width_m3_per_s = 0, counted = 0;
  const auto end_run = [&] {
    if (runs.back().empty()) return;
    const auto n = static_cast<double>(runs.back().size());
    out.band_coverage += static_cast<double>(inside) / n;
    out.band_mean_width_m3_per_s += width_m3_per_s / n;
    ++counted;
    inside = 0, width_m3_per_s = 0;
    runs.emplace_back();
  };
  std::size_t run = 0;
  for (std::size_t k = 0; k < bits_.size(); ++k) {
    if (weigh == Weigh::runs && run < ends_.size() && k == ends_[run]) end_run(), ++run;
    if ((bits_[k] & bit) == 0) continue;
    runs.back().push_back(error_m3_per_s_[k]);
    width_m3_per_s += width_m3_per_s_[k];
    inside += (bits_[k] & inside_bit) != 0 ? 1 : 0;
  }
  end_run();
  if (counted == 0) return out;
  out.band_coverage /= counted;
  out.band_mean_width_m3_per_s /= counted;
  out.error = weigh == Weigh::runs ? error_figures_of_runs(runs) : error_figures(std::move(runs.front()));
  return out;
}

ErrorFigures ComparedSamples::reading(Weigh weigh) const {
  if (weigh == Weigh::samples) return error_figures(share_of_reading_);
  std::vector<std::vector<float>> runs;
  std::size_t begin = 0;
  const auto add_until = [&](std::size_t end) {
    runs.emplace_back(share_of_reading_.begin() + static_cast<std::ptrdiff_t>(begin),
                      share_of_reading_.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  };
  for (const std::size_t end : ends_of_reading_) add_until(end);
  add_until(share_of_reading_.size());
  return error_figures_of_runs(runs);
}

Metrics ComparedSamples::metrics(Weigh weigh) const {
  return {group(any_bit, weigh),    group(moving_bit, weigh), group(rest_bit, weigh), group(reversal_bit, weigh),
          group(p_to_b_bit, weigh), group(p_to_a_bit, weigh), reading(weigh)};
}

}  // namespace spoolflow::validation
