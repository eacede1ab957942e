#include "spoolflow/validation/metrics.hpp"

#include <algorithm>
#include <cmath>

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
  const auto add_all = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add_all(error_m3_per_s_, others.error_m3_per_s_);
  add_all(width_m3_per_s_, others.width_m3_per_s_);
  add_all(bits_, others.bits_);
  add_all(share_of_reading_, others.share_of_reading_);
}

GroupFigures ComparedSamples::group(std::uint8_t bit) const {
  GroupFigures out;
  std::vector<float> errors;
  std::size_t inside = 0;
  double width_m3_per_s = 0;
  for (std::size_t k = 0; k < bits_.size(); ++k) {
    if ((bits_[k] & bit) == 0) continue;
    errors.push_back(error_m3_per_s_[k]);
    width_m3_per_s += width_m3_per_s_[k];
    inside += (bits_[k] & inside_bit) != 0 ? 1 : 0;
  }
  if (errors.empty()) return out;
  const auto n = static_cast<double>(errors.size());
  out.band_coverage = static_cast<double>(inside) / n;
  out.band_mean_width_m3_per_s = width_m3_per_s / n;
  out.error = error_figures(std::move(errors));
  return out;
}

Metrics ComparedSamples::metrics() const {
  return {group(any_bit),
          group(moving_bit),
          group(rest_bit),
          group(reversal_bit),
          group(p_to_b_bit),
          group(p_to_a_bit),
          error_figures(share_of_reading_)};
}

}  // namespace spoolflow::validation
