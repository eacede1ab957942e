#pragma once
/// How wrong an estimate is against a reference flow, and how honest its band.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace spoolflow::validation {

/// Figures of a set of errors, in the errors' unit. `p95` is the 95th percentile of the magnitudes: the one that
/// int(0.95 n) of n do not reach.
struct ErrorFigures {
  std::size_t samples = 0;
  double p95 = 0;
  double rms = 0;
  double largest = 0;
  double bias = 0;
};

/// No samples: all zero.
[[nodiscard]] ErrorFigures error_figures(std::vector<float> errors);
/// Of several runs, each with the same weight: means of the runs' biases and mean squares; `p95` is the magnitude below
/// which lie 95 % of the weight.
[[nodiscard]] ErrorFigures error_figures_of_runs(const std::vector<std::vector<float>>& runs);

/// One group of samples: its errors [m3/s] and what the 95 % band made of it.
struct GroupFigures {
  ErrorFigures error;
  double band_coverage = 0;  ///< share of the samples inside the band
  double band_mean_width_m3_per_s = 0;
};

/// What weighs alike when several runs are judged together.
enum class Weigh { samples, runs };

struct Metrics {
  GroupFigures all, moving, rest, reversal;
  GroupFigures p_to_b, p_to_a;    ///< of a whole valve by the direction of the measured flow
  ErrorFigures share_of_reading;  ///< error over reference, where the reference is above a tenth of full scale
};

/// One sample with reference flow.
struct ComparedSample {
  double estimate_m3_per_s, lower_m3_per_s, upper_m3_per_s;
  double reference_m3_per_s;
  bool moving, rest, reversal;
  bool p_to_b = false, p_to_a = false;
};

/// Samples of one or several runs, kept for exact percentiles: about 12 bytes each. Figures of which runs weigh alike
/// count each run's samples of a group for one over their number: a long run says no more than a short one.
class ComparedSamples {
 public:
  explicit ComparedSamples(double full_scale_m3_per_s) : full_scale_m3_per_s_(full_scale_m3_per_s) {}
  void add(const ComparedSample& sample);
  void append(const ComparedSamples& others);
  [[nodiscard]] std::size_t size() const { return error_m3_per_s_.size(); }
  [[nodiscard]] Metrics metrics(Weigh weigh = Weigh::samples) const;

 private:
  [[nodiscard]] GroupFigures group(std::uint8_t bit, Weigh weigh) const;
  [[nodiscard]] ErrorFigures reading(Weigh weigh) const;

  double full_scale_m3_per_s_;
  std::vector<float> error_m3_per_s_;
  std::vector<float> width_m3_per_s_;
  std::vector<std::uint8_t> bits_;
  std::vector<float> share_of_reading_;
  /// Where each run's samples end, but for the last run's.
  std::vector<std::size_t> ends_, ends_of_reading_;
};

}  // namespace spoolflow::validation
