#include "spoolflow/validation/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "spoolflow/validation/stretches.hpp"

namespace spoolflow::validation {
namespace {

using Complex = std::complex<double>;
using Fourier = Eigen::FFT<double>;

constexpr double highest_rate_Hz = 500;
constexpr double longest_window_s = 8.2;
constexpr double fewest_windows = 5;
constexpr double bands_a_decade = 10;
constexpr double lowest_coherence = 0.8;
constexpr std::size_t fewest_bands = 6;
constexpr double fewest_averages = 8;  // below, the coherence of noise is high by chance

/// Values at even steps, by straight lines between samples; NaN in gaps.
std::vector<double> at_even_steps(std::span<const double> time_s, std::span<const float> values, double step_s) {
  std::vector<double> out;
  const double longest_s = longest_step_s(time_s);
  std::size_t k = 1;
  for (double t = time_s.front(); t <= time_s.back(); t = time_s.front() + step_s * static_cast<double>(out.size())) {
    while (k + 1 < time_s.size() && time_s[k] < t) ++k;
    const double between_s = time_s[k] - time_s[k - 1];
    const double share = between_s > 0 ? (t - time_s[k - 1]) / between_s : 1;
    out.push_back(between_s > longest_s ? std::numeric_limits<double>::quiet_NaN()
                                        : values[k - 1] + share * (values[k] - values[k - 1]));
  }
  return out;
}

/// Sums of the spectra over all windows, one entry a frequency.
struct Spectra {
  std::vector<double> reference, estimate;
  std::vector<Complex> cross;
  double windows = 0;
};

/// The spectrum of one window (Hann), without its mean, up to half the sample rate.
std::vector<Complex> windowed(Fourier& fourier, const std::vector<double>& values, std::size_t begin,
                              std::size_t length) {
  double mean = 0;
  for (std::size_t k = 0; k < length; ++k) mean += values[begin + k] / static_cast<double>(length);
  std::vector<double> window;
  for (std::size_t k = 0; k < length; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length);
    window.push_back((values[begin + k] - mean) * 0.5 * (1 - std::cos(angle)));
  }
  std::vector<Complex> out;
  fourier.fwd(out, window);
  return out;
}

Spectra spectra_of(const std::vector<double>& reference, const std::vector<double>& estimate, std::size_t length) {
  Spectra out{std::vector<double>(length / 2), std::vector<double>(length / 2), std::vector<Complex>(length / 2), 0};
  Fourier fourier(Fourier::impl_type(), Fourier::HalfSpectrum);
  for (std::size_t begin = 0; begin + length <= reference.size(); begin += length / 2) {
    const auto unknown = [&](const std::vector<double>& values) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(begin);
      return std::any_of(from, from + static_cast<std::ptrdiff_t>(length),
                         [](double value) { return std::isnan(value); });
    };
    if (unknown(reference) || unknown(estimate)) continue;
    const std::vector<Complex> x = windowed(fourier, reference, begin, length);
    const std::vector<Complex> y = windowed(fourier, estimate, begin, length);
    for (std::size_t k = 0; k < length / 2; ++k) {
      out.reference[k] += std::norm(x[k]);
      out.estimate[k] += std::norm(y[k]);
      out.cross[k] += std::conj(x[k]) * y[k];
    }
    ++out.windows;
  }
  return out;
}

/// Bands of frequencies from the lowest on, as far as the flow explains the estimate.
std::vector<FrequencyPoint> coherent_bands(const Spectra& spectra, double resolution_Hz, double reference_lag_s) {
  std::vector<FrequencyPoint> out;
  const double ratio = std::pow(10, 1 / bands_a_decade);
  double previous_phase_rad = 0;
  for (double from = 2; from * ratio < static_cast<double>(spectra.cross.size()) / 2;) {
    const auto begin = static_cast<std::size_t>(std::ceil(from));
    const auto end = std::max(begin + 1, static_cast<std::size_t>(std::ceil(from * ratio)));
    from = std::max(from * ratio, static_cast<double>(end));
    double reference = 0;
    double estimate = 0;
    Complex cross = 0;
    for (std::size_t k = begin; k < end; ++k) {
      reference += spectra.reference[k];
      estimate += spectra.estimate[k];
      cross += spectra.cross[k];
    }
    if (spectra.windows * static_cast<double>(end - begin) < fewest_averages) continue;
    const double coherence = std::norm(cross) / (reference * estimate);
    if (!(coherence >= lowest_coherence)) break;
    const double frequency_Hz = 0.5 * static_cast<double>(begin + end - 1) * resolution_Hz;
    const Complex lag = 1.0 / Complex(1, 2 * std::numbers::pi * frequency_Hz * reference_lag_s);
    const Complex response = cross / reference * lag;
    double phase_rad = std::arg(response);
    while (phase_rad - previous_phase_rad > std::numbers::pi) phase_rad -= 2 * std::numbers::pi;
    previous_phase_rad = phase_rad;
    out.push_back({frequency_Hz, std::abs(response), phase_rad, coherence});
  }
  return out;
}

std::optional<double> corner_of(const std::vector<FrequencyPoint>& points) {
  const double low = (points[0].gain + points[1].gain + points[2].gain) / 3;
  const double corner = low / std::numbers::sqrt2;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].gain > corner) continue;
    const double share = std::clamp((points[k - 1].gain - corner) / (points[k - 1].gain - points[k].gain), 0.0, 1.0);
    return points[k - 1].frequency_Hz * std::pow(points[k].frequency_Hz / points[k - 1].frequency_Hz, share);
  }
  return std::nullopt;
}

}  // namespace

std::optional<FrequencyResponse> frequency_response(const FrequencyInput& input) {
  if (input.time_s.size() < 100) return std::nullopt;
  const double duration_s = input.time_s.back() - input.time_s.front();
  if (!(duration_s > 0)) return std::nullopt;
  const double rate_Hz = std::min(highest_rate_Hz, static_cast<double>(input.time_s.size() - 1) / duration_s);
  const double window_s = std::min(longest_window_s, duration_s / fewest_windows);
  const auto length = static_cast<std::size_t>(std::exp2(std::floor(std::log2(window_s * rate_Hz))));
  if (length < 64) return std::nullopt;
  const Spectra spectra = spectra_of(at_even_steps(input.time_s, input.reference, 1 / rate_Hz),
                                     at_even_steps(input.time_s, input.estimate, 1 / rate_Hz), length);
  FrequencyResponse out{coherent_bands(spectra, rate_Hz / static_cast<double>(length), input.reference_lag_s),
                        std::nullopt};
  if (out.points.size() < fewest_bands) return std::nullopt;
  out.corner_Hz = corner_of(out.points);
  return out;
}

}  // namespace spoolflow::validation
