#pragma once
/// Steady lines in the spectrum of a run's position and coil currents, which a machine makes and a valve's work does
/// not.
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spoolflow::plausibility {

/// A line of a spectrum: amplitude in the unit of its signal.
struct SpectralLine {
  double frequency_Hz, amplitude;
};

/// Power in bins of equal width from 0 Hz on; empty: of too short a run.
struct Spectrum {
  double sample_rate_Hz = 0, bin_Hz = 0;
  std::vector<double> power{};
  double point_noise = 0;  ///< standard deviation of the noise of means over 2 ms, in which short spikes do not count

  /// The line between these frequencies [Hz] that stands highest over its neighbours, if by `line_over_neighbours` at
  /// least. Near `passed` [Hz] none is looked for.
  [[nodiscard]] std::optional<SpectralLine> line(double least_Hz, double most_Hz, std::span<const double> passed) const;

  /// Of what stands at a frequency [Hz] that the spectrum holds, as of a line.
  [[nodiscard]] double amplitude(double frequency_Hz) const;

  /// Standard deviation of the samples' noise, in the unit of the signal, if all of it were as between these
  /// frequencies [Hz]; NaN where the spectrum does not reach so far.
  [[nodiscard]] double noise(double least_Hz, double most_Hz) const;
};

/// The median spectrum of a signal over pieces of four seconds, in bounded memory: what does not go on in half of them
/// does not show.
class MedianSpectrum {
 public:
  MedianSpectrum();
  ~MedianSpectrum();
  MedianSpectrum(MedianSpectrum&&) noexcept;
  MedianSpectrum& operator=(MedianSpectrum&&) noexcept;

  /// The next samples of a run, as many times [s] as values; a piece with a missing value or a gap is left out. Samples
  /// more than 4 ms apart say nothing.
  void take(std::span<const double> time_s, std::span<const double> value);

  /// Empty of a run of fewer pieces.
  [[nodiscard]] Spectrum median(std::size_t fewest_pieces = 8) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Position, currents and voltages of one run.
struct SteadyLines {
  MedianSpectrum position{};                  ///< [m]
  std::array<MedianSpectrum, 2> current{};    ///< [A] of the coil, or of both
  std::array<MedianSpectrum, 2> voltage{};    ///< [V] likewise
  std::array<double, 2> largest_current_A{};  ///< of each
};

/// What is known of the valve.
struct SteadyValve {
  double position_noise_m;                 ///< of a sample
  std::array<double, 2> resistance_Ohm{};  ///< of each coil; 0: not known
};

/// Whether the current's spectrum is known, from so many pieces, and none of dither.
[[nodiscard]] bool free_of_dither(const SteadyLines& run, std::size_t fewest_pieces = 8);

/// In words what shakes the spool, and what beats in a coil's current beside dither and what follows from it: a line of
/// the position of the valve's noise, beside dither 2.5 times that, of a current of a thousandth of its largest value
/// at least, beside dither of four. Below 15 Hz a current moves the spool, too, and one beats whose voltage is less
/// than the resistance asks for. Empty: none.
[[nodiscard]] std::vector<std::string> steady_line_findings(const SteadyLines& run, const SteadyValve& valve);

/// In words a coil's current whose means over 2 ms hold white noise of 0.45 % of the largest current, from 150 Hz on
/// and in three quarters of the time. Empty: none.
[[nodiscard]] std::string noisy_current(const SteadyLines& run);

/// In words the channel, position or current, that holds less beyond 150 Hz than noise does: half of
/// `position_noise_m`, of a current 0.02 % of its largest value, and falling. Empty: none.
[[nodiscard]] std::string low_pass_finding(const SteadyLines& run, double position_noise_m);

}  // namespace spoolflow::plausibility
