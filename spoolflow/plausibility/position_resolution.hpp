#pragma once
/// How finely a run's position is recorded: its noise, and the steps in which it comes.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spoolflow::plausibility {

class PositionResolution {
 public:
  /// The next samples of a run, as many times [s] as positions [m]; where either is missing (NaN) they say nothing.
  void take(std::span<const double> time_s, std::span<const double> position_m);

  /// Standard deviation of white noise [m], from differences of fourth order, to which a spool's motion adds nearly
  /// nothing; of the stretches of the run that are not shaken by dither, half have less. NaN where there are fewer than
  /// some 500 samples of such, or they are more than 5 ms apart, in which a spool slips further.
  [[nodiscard]] double noise_m() const;
  /// The smallest change from sample to sample but none [m]; 0 where nothing ever changes.
  [[nodiscard]] double step_m() const;

 private:
  void judge_stretch();
  double lower_quartile();

  std::vector<double> stretch_;                      ///< samples of which nothing is known yet
  std::vector<double> noise_m_;                      ///< of each stretch
  std::vector<double> differences_, fourth_, near_;  ///< memory
  double quartile_m_ = 0;                            ///< of the last stretch
  double least_noise_m_ = 0;                         ///< of all stretches
  double least_change_m_ = 0;
  double first_s_ = 0, last_s_ = 0;
  std::uint64_t samples_ = 0;
};

/// In words a position that is recorded more coarsely than in the campaign, of `noise_m` (0: not known): the sensor
/// takes its steps for motion, and does not see a slow spool move beneath its noise. Empty: none.
[[nodiscard]] std::string coarse_position(const PositionResolution& resolution, double noise_m);

}  // namespace spoolflow::plausibility
