#pragma once
/// How well the observer does on operating runs, and what of it may be turned to do better.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {

/// What of an operating recording shows a parameter.
enum class ShownBy {
  any_run,
  undithered_rest,  ///< rest without dither
  score,            ///< it shows where the score depends on it
};

/// Copies of the parameters, a whole valve's other direction among them, in which one thread tries values.
class OperationTrial {
 public:
  OperationTrial(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs);
  OperationTrial(const OperationTrial& from) : OperationTrial(from.parameters(), from.runs_) {}
  OperationTrial& operator=(const OperationTrial&) = delete;
  ~OperationTrial() = default;

  [[nodiscard]] sensor::ObserverParameters<double>& parameters() { return directions_.front(); }
  [[nodiscard]] const sensor::ObserverParameters<double>& parameters() const { return directions_.front(); }
  /// Of the other direction; only where a run has one.
  [[nodiscard]] sensor::ObserverParameters<double>& other() { return directions_.back(); }
  /// With the copy of the other direction.
  [[nodiscard]] const std::vector<OperatingRun>& runs() const { return runs_; }

 private:
  std::vector<sensor::ObserverParameters<double>> directions_;
  std::vector<OperatingRun> runs_;
};

/// A parameter that operation shows, with the range that is searched.
struct OperationParameter {
  const char* name;  ///< with its SI unit as suffix
  double& (*in)(OperationTrial&);
  double lowest, highest;
  ShownBy shown_by;
};

/// All but that of the other direction, see identifiable_parameters.hpp.
[[nodiscard]] std::vector<OperationParameter> operation_parameters();

/// What the observer answered beside the reference, summed up.
struct OperationOutcome {
  double interval_score = 0;  ///< sum [m3/s]
  FitResidual error;
  std::size_t inside = 0;

  /// Share of the samples with the reference inside the band.
  [[nodiscard]] double coverage() const {
    return static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(1, error.samples));
  }

  /// See operation_score.
  [[nodiscard]] double score(double full_scale_m3_per_s) const;
};

/// Weight of the RMS error beside the interval score.
inline constexpr double weight_of_error = 4;

/// In stretches of `stretch_s`, each recording starts a new one.
[[nodiscard]] std::vector<OperationOutcome> replay_stretches(const sensor::ObserverParameters<double>& parameters,
                                                             const std::vector<OperatingRun>& runs, double stretch_s);
[[nodiscard]] OperationOutcome together(const std::vector<OperationOutcome>& stretches);
/// Of all recordings, in one piece each.
[[nodiscard]] OperationOutcome replay_whole(const sensor::ObserverParameters<double>& parameters,
                                            const std::vector<OperatingRun>& runs);

/// Mean interval score of the 95 % band (Winkler 1972; Gneiting and Raftery 2007, eq. 43: its width, and 40 times
/// what the reference lies outside) plus four times the RMS error, as a share of full scale. Small where the estimate
/// is close and the band as narrow as it may be. Infinite where there is nothing to compare.
[[nodiscard]] double operation_score(const OperationTrial& trial, double full_scale_m3_per_s);

}  // namespace spoolflow::calibration
