#pragma once
/// What the calibrated maps leave of the bench strokes, over position: for the calibration page.
#include <vector>

#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/evidence.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/force_maps.hpp"
#include "spoolflow/sensor/metering_edge.hpp"

namespace spoolflow::calibration {

/// Gathers deviations by position over the stroke.
class ResidualProfile {
 public:
  explicit ResidualProfile(double stroke_m) : stroke_m_(stroke_m), bins_(bins), sums_(bins) {}
  /// A NaN deviation or position (missing samples) is passed over.
  void add(double position_m, double deviation_N);
  /// Of those positions that were met; rounded to millinewtons.
  [[nodiscard]] model::MapResidual at(double held, double oil_temperature_K) const;

 private:
  static constexpr std::size_t bins = 24;
  double stroke_m_;
  std::vector<FitResidual> bins_;
  std::vector<double> sums_;
};

/// Axial force less spring, flow force and friction of its direction, each sample at its own pressure difference. The
/// recording is one of `axial_force_map`, its positions free of drift.
[[nodiscard]] std::vector<model::MapResidual> axial_force_residuals(const recording::Recording& recording,
                                                                    const sensor::Spring<double>& spring,
                                                                    const sensor::MeteringEdge<double>& edge,
                                                                    double stroke_m);

}  // namespace spoolflow::calibration
