#include "spoolflow/plausibility/steady_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <string_view>
#include <unsupported/Eigen/FFT>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/signals/fourth_difference.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

constexpr std::size_t piece = 2048;  ///< points of a spectrum
constexpr double point_s = 0.002;    ///< between them: means of the samples
constexpr std::size_t bins = piece / 2;
constexpr std::size_t most_pieces = 128;  ///< kept; then every second one, and every second one of those to come
constexpr std::size_t own_bins = 4, neighbour_bins = 24;  ///< either side of a line, which a Hann window spreads
constexpr double longest_step_s = 0.004, uneven = 1.5;    ///< of the time between samples
constexpr double lowest_beat_Hz = 1, lowest_Hz = 15, highest_Hz = 120, highest_dither_Hz = 240, lowest_dither_Hz = 60;
constexpr double near_Hz = 1;
constexpr int most_harmonics = 30;
constexpr double dither_share = 0.01;  ///< of the largest current
constexpr std::array before_Hz{70.0, 120.0}, beyond_Hz{150.0, 190.0}, far_Hz{200.0, 235.0};

const std::vector<double>& window() {
  static const std::vector<double> hann = [] {
    std::vector<double> out(piece);
    for (std::size_t k = 0; k < piece; ++k)
      out[k] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / piece);
    return out;
  }();
  return hann;
}

}  // namespace

struct MedianSpectrum::Parts {
  Eigen::FFT<double> transform;
  std::vector<double> points, windowed;
  std::vector<std::complex<double>> spectrum;
  std::vector<std::vector<float>> power;  ///< of each kept piece, in each bin, and behind them its points' noise
  std::size_t stride = 1, passed = 0;     ///< one of so many pieces is kept; those since the last
  double last_s = NAN, step_s = NAN, first_s = NAN;
  double kept_s = 0;  ///< of all pieces, and
  std::uint64_t kept_samples = 0;
  double sum = 0;
  std::size_t in_sum = 0, samples_a_point = 0, samples_of_point = 0;

  void begin_again() {
    points.clear();
    sum = 0;
    in_sum = samples_a_point = 0;
    step_s = first_s = NAN;
  }

  void add(double time_s, double value) {
    const double now_step_s = time_s - last_s;
    last_s = time_s;
    const bool is_even = now_step_s > 0 && now_step_s < longest_step_s && std::isfinite(value);
    if (!is_even || (samples_a_point > 0 && (now_step_s > uneven * step_s || uneven * now_step_s < step_s))) {
      begin_again();
      if (!is_even) return;
    }
    if (samples_a_point == 0) {
      step_s = now_step_s;
      samples_a_point = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(point_s / step_s)));
    }
    if (std::isnan(first_s)) first_s = time_s;
    sum += value;
    if (++in_sum < samples_a_point) return;
    points.push_back(sum / static_cast<double>(in_sum));
    sum = 0;
    in_sum = 0;
    if (points.size() == piece) keep();
  }

  [[nodiscard]] double noise_of_points() const {
    std::vector<double> sizes;
    for (std::size_t k = 4; k < piece; ++k) sizes.push_back(std::abs(fourth_difference(&points[k - 4])));
    return white_noise(numerics::quantile(std::move(sizes), 0.25));
  }

  void keep() {
    kept_s += last_s - first_s;
    kept_samples += piece * samples_a_point - 1;
    samples_of_point = samples_a_point;
    first_s = NAN;
    if (passed++ % stride == 0) {
      // A straight line through both ends goes, so that a stroke shows no line.
      constexpr std::size_t at_end = 25;
      double first = 0, last = 0;
      for (std::size_t k = 0; k < at_end; ++k) {
        first += points[k] / at_end;
        last += points[piece - 1 - k] / at_end;
      }
      windowed.resize(piece);
      for (std::size_t k = 0; k < piece; ++k)
        windowed[k] = window()[k] * (points[k] - first - (last - first) * static_cast<double>(k) / (piece - 1));
      transform.fwd(spectrum, windowed);
      std::vector<float>& kept = power.emplace_back(bins + 1);
      for (std::size_t k = 0; k < bins; ++k) kept[k] = static_cast<float>(std::norm(spectrum[k]));
      kept[bins] = static_cast<float>(noise_of_points());
      if (power.size() == most_pieces) {
        for (std::size_t k = 1; 2 * k < most_pieces; ++k) power[k] = std::move(power[2 * k]);
        power.resize(most_pieces / 2);
        stride *= 2;
      }
    }
    points.clear();
  }
};

MedianSpectrum::MedianSpectrum() : parts_(std::make_unique<Parts>()) {}
MedianSpectrum::~MedianSpectrum() = default;
MedianSpectrum::MedianSpectrum(MedianSpectrum&&) noexcept = default;
MedianSpectrum& MedianSpectrum::operator=(MedianSpectrum&&) noexcept = default;

void MedianSpectrum::take(std::span<const double> time_s, std::span<const double> value) {
  if (value.size() != time_s.size()) return;
  for (std::size_t k = 0; k < value.size(); ++k) parts_->add(time_s[k], value[k]);
}

Spectrum MedianSpectrum::median(std::size_t fewest_pieces) const {
  const auto& pieces = parts_->power;
  if (pieces.size() < fewest_pieces) return {};
  const double rate_Hz = static_cast<double>(parts_->kept_samples) / parts_->kept_s;
  // Points of samples that are no whole fraction of them apart stand further or closer.
  Spectrum out{rate_Hz, rate_Hz / (static_cast<double>(parts_->samples_of_point) * piece), std::vector<double>(bins)};
  std::vector<double> one(pieces.size());
  for (std::size_t k = 0; k <= bins; ++k) {
    for (std::size_t each = 0; each < pieces.size(); ++each) one[each] = pieces[each][k];
    (k < bins ? out.power[k] : out.point_noise) = numerics::median(one);
  }
  return out;
}

std::optional<SpectralLine> Spectrum::line(double least_Hz, double most_Hz, std::span<const double> passed) const {
  std::optional<SpectralLine> best;
  double highest = line_over_neighbours;
  for (std::size_t k = own_bins; k + own_bins < power.size(); ++k) {
    const double frequency_Hz = static_cast<double>(k) * bin_Hz;
    if (frequency_Hz < least_Hz || frequency_Hz > most_Hz) continue;
    if (std::ranges::any_of(passed, [&](double other) { return std::abs(other - frequency_Hz) < near_Hz; })) continue;
    std::vector<double> beside;
    for (std::size_t j = k > neighbour_bins ? k - neighbour_bins : 1;
         j <= std::min(k + neighbour_bins, power.size() - 1); ++j)
      if (j + own_bins <= k || j >= k + own_bins) beside.push_back(power[j]);
    const double over = power[k] / std::max(numerics::median(beside), 1e-300);
    if (over < highest) continue;
    highest = over;
    // A Hann window's peak is a parabola of the power's logarithm.
    const double left = std::log(power[k - 1]), here = std::log(power[k]), right = std::log(power[k + 1]);
    const double curvature = left - 2 * here + right;
    const double beside_bins = curvature < 0 ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5) : 0;
    best = {frequency_Hz + beside_bins * bin_Hz, amplitude(frequency_Hz)};
  }
  return best;
}

double Spectrum::amplitude(double frequency_Hz) const {
  return 4 * std::sqrt(power.at(static_cast<std::size_t>(std::lround(frequency_Hz / bin_Hz)))) / piece;
}

double Spectrum::noise(double least_Hz, double most_Hz) const {
  if (!(most_Hz < bin_Hz * static_cast<double>(power.size()))) return std::nan("");
  const auto at = [&](double Hz) { return power.begin() + static_cast<std::ptrdiff_t>(Hz / bin_Hz); };
  constexpr double window_power = 0.375 * piece, median_over_mean = std::numbers::ln2;
  const double samples_a_point = sample_rate_Hz / (bin_Hz * piece);
  return std::sqrt(numerics::median({at(least_Hz), at(most_Hz)}) / (window_power * median_over_mean) * samples_a_point);
}

std::string noisy_current(const SteadyLines& run) {
  const double largest_A = std::ranges::max(run.largest_current_A);
  for (const MedianSpectrum& coil : run.current) {
    const Spectrum current = coil.median();
    const double samples_a_point = current.sample_rate_Hz * point_s,
                 beyond_A = current.noise(beyond_Hz[0], beyond_Hz[1]), far_A = current.noise(far_Hz[0], far_Hz[1]);
    const double noise_A = std::min(std::min(beyond_A, far_A) / std::sqrt(samples_a_point), current.point_noise);
    if (!(noise_A > noisy_current_share * largest_A) || far_A < falling_share * beyond_A) continue;
    return fmt::format(
        "current comes with noise of {:.2g} mA as its mean over 2 ms, {:.1f} % of its largest value: the iron's "
        "hysteresis is taken to follow it, so that errors grow and the band is too narrow; shield its line, or record "
        "means over a millisecond of a faster converter",
        1e3 * noise_A, 100 * noise_A / largest_A);
  }
  return {};
}

std::string low_pass_finding(const SteadyLines& run, double position_noise_m) {
  const auto words = [](std::string_view channel, std::string_view held) {
    return fmt::format(
        "{} holds no noise beyond 150 Hz ({}): a low-pass of an amplifier or of the recorder takes it away, and with "
        "it "
        "dither and short slips of the spool, so that the answer is wrong and its band too narrow; switch the filters "
        "of position and current off, or to 500 Hz and more, and record it again",
        channel, held);
  };
  const auto falls = [](const Spectrum& of) {
    return of.noise(far_Hz[0], far_Hz[1]) < falling_share * of.noise(beyond_Hz[0], beyond_Hz[1]);
  };
  const Spectrum position = run.position.median();
  const double left_m = position.noise(beyond_Hz[0], beyond_Hz[1]);
  if (left_m < low_pass_share * position_noise_m && falls(position))
    return words("position", fmt::format("{:.2g} um, and the model's valve was calibrated with {:.2g} um",
                                         units::mm_from_m(left_m) * 1e3, units::mm_from_m(position_noise_m) * 1e3));
  for (std::size_t coil = 0; coil < run.current.size(); ++coil) {
    const Spectrum current = run.current[coil].median();
    const double left_A = current.noise(beyond_Hz[0], beyond_Hz[1]);
    if (left_A < low_pass_current_share * run.largest_current_A[coil] && falls(current) &&
        current.noise(far_Hz[0], far_Hz[1]) < low_pass_current_fall * current.noise(before_Hz[0], before_Hz[1]))
      return words("current", fmt::format("{:.2g} mA", 1e3 * left_A));
  }
  return {};
}

namespace {

/// Dither, and where sampling folds its harmonics to [Hz]. It also mixes with the pump's usual ripple.
std::vector<double> dither_lines(const SteadyLines& run, const std::array<Spectrum, 2>& current) {
  std::vector<double> out;
  for (std::size_t coil = 0; coil < current.size(); ++coil) {
    const auto dither = current[coil].line(lowest_dither_Hz, highest_dither_Hz, {});
    if (!dither || dither->amplitude < dither_share * run.largest_current_A[coil]) continue;
    for (const double rate_Hz : {current[coil].sample_rate_Hz, 1 / point_s}) {
      for (int harmonic = 1; harmonic <= most_harmonics; ++harmonic) {
        const double at_Hz = harmonic * dither->frequency_Hz;
        out.push_back(std::abs(at_Hz - rate_Hz * std::round(at_Hz / rate_Hz)));
      }
    }
  }
  return out;
}

/// A line of the current that no voltage drives: whatever inductance and motion do, a coil's impedance is no less than
/// its resistance.
std::optional<SpectralLine> undriven_line(const Spectrum& current, const Spectrum& voltage, double resistance_Ohm,
                                          std::span<const double> passed) {
  const auto line = current.line(lowest_beat_Hz, lowest_Hz, passed);
  if (!line || voltage.power.size() != current.power.size() || !(resistance_Ohm > 0)) return std::nullopt;
  const bool driven =
      voltage.amplitude(line->frequency_Hz) > undriven_share * resistance_Ohm * current.amplitude(line->frequency_Hz);
  return driven ? std::nullopt : line;
}

}  // namespace

bool free_of_dither(const SteadyLines& run, std::size_t fewest_pieces) {
  const std::array<Spectrum, 2> current{run.current[0].median(fewest_pieces), run.current[1].median(fewest_pieces)};
  return !current[0].power.empty() && dither_lines(run, current).empty();
}

std::vector<std::string> steady_line_findings(const SteadyLines& run, const SteadyValve& valve) {
  const Spectrum position = run.position.median();
  const std::array current{run.current[0].median(), run.current[1].median()};
  const std::vector<double> passed = dither_lines(run, current);
  std::vector<std::string> out;
  if (const auto line = position.line(lowest_Hz, highest_Hz, passed);
      line && line->amplitude > (passed.empty() ? 1 : beside_dither) * valve.position_noise_m) {
    out.push_back(fmt::format(
        "position shakes at {:.1f} Hz by {:.2g} um all along: the machine's vibration, or the pump's ripple "
        "as sampling shows it; the band knows of it what [environment] declares: vibration_g, ripple_bar",
        line->frequency_Hz, units::mm_from_m(line->amplitude) * 1e3));
  }
  const std::size_t shaken = out.size();
  for (std::size_t coil = 0; coil < current.size() && out.size() == shaken; ++coil) {
    const double largest_A = run.largest_current_A[coil];
    const double least_A = (passed.empty() ? beat_share : beat_beside_dither) * largest_A;
    const auto add = [&](const std::optional<SpectralLine>& beat, std::string_view though) {
      if (!beat || beat->amplitude < least_A) return;
      out.push_back(fmt::format(
          "current beats at {:.1f} Hz by {:.2g} mA all along {}: its PWM is sampled at instants; average over a period "
          "or sample in step with it, or declare [environment] pwm_ripple_percent = {:.2g} or more",
          beat->frequency_Hz, beat->amplitude * 1e3, though, 200 * beat->amplitude / largest_A));
    };
    add(undriven_line(current[coil], run.voltage[coil].median(), valve.resistance_Ohm[coil], passed),
        "without a voltage that drives it");
    if (out.empty()) add(current[coil].line(lowest_Hz, highest_Hz, passed), "while the position does not");
  }
  return out;
}

}  // namespace spoolflow::plausibility
