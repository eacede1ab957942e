#pragma once
/// Load cells, pressure sensors, thermometers and the coil's shunt and voltage divider: instruments whose errors are of
/// one kind.
///
///     reading = quantised(lag((1 + gain) true + offset) + noise)
#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// Error figures of one instrument in the unit of its quantity.
struct TransducerErrors {
  double gain_error = 0.0;
  double offset = 0.0;
  double time_constant_s = 0.0;
  double noise = 0.0;  ///< standard deviation of one reading
  double resolution = 0.0;
};

/// One instrument at work.
class Transducer {
 public:
  Transducer(const TransducerErrors& errors, std::uint64_t seed, std::string_view name, double value)
      : errors_(errors), noise_(seed, name), lagged_(value) {}

  /// The signal follows the true value for `dt_s`.
  void follow(double value, double dt_s) { lagged_ = lagged(lagged_, value, dt_s, errors_.time_constant_s, lag_); }
  /// One reading; `noise_share` below 1 for a mean over several conversions.
  [[nodiscard]] double reading(double noise_share = 1.0) {
    const double signal = (1 + errors_.gain_error) * lagged_ + errors_.offset;
    return quantised(signal + noise_share * errors_.noise * noise_.normal(), errors_.resolution);
  }

 private:
  TransducerErrors errors_;
  Noise noise_;
  LagMemory lag_;
  double lagged_;
};

}  // namespace spoolflow::rig
