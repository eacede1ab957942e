#pragma once
/// Where a unit's spool moves so that its forces, its friction and its flow are known.
#include <cmath>
#include <cstddef>

#include "spoolflow/calibration/numerics/passage.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {

/// A spool that moves faster [m/s] gives no row of force, ...
inline constexpr double fastest_sliding_m_per_s = 0.03;
/// ... faster than that no row of flow, which would show the meter's lag rather than the edge.
inline constexpr double fastest_metered_m_per_s = 2e-3;
/// So close to either end [share of the stroke] stops may carry force, and a spool that overshoots leaves the maps.
inline constexpr double end_share = 0.015;

/// What the spool does at a sample.
struct Doing {
  int direction;         ///< 1 opening, -1 closing, else 0
  bool slides;           ///< friction has its full size away from both stops: in the mean, if it sticks and slips
  bool metered;          ///< slow enough for a flow meter, the edge open
  double broke_after_s;  ///< > 0: it broke away after this rest
};

/// Finds it from the state of the type's sensor, sample by sample. Under pressure every passage counts, evenly or by
/// sticking and slipping; without, even motion alone: slips drive the iron through small loops there, which the
/// sensor's loop makes too wide, and beside which friction is small.
class SpoolTrack {
 public:
  SpoolTrack(const sensor::ObserverParameters<double>& type, double stroke_m, bool pressurised)
      : closed_below_m_(type.closed_below_m), stroke_m_(stroke_m), pressurised_(pressurised) {}

  /// The next sample, the sensor's state and status after it, and the position without drift.
  Doing next(const sensor::ObserverState<double>& state, sensor::Status status, const sensor::Sample<double>& sample,
             double position_m);
  /// Where the last passage went on; what came after is none where it `ended()`.
  [[nodiscard]] std::size_t went_on() const { return passage_.went_on(); }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  bool passes(bool usable, double step_s, double position_m);
  bool moves_evenly(bool usable, sensor::Motion motion, double position_m);

  double closed_below_m_, stroke_m_;
  bool pressurised_;
  Passage passage_;
  std::size_t sample_ = 0;
  bool ended_ = false;
  int direction_ = 0;
  double time_s_ = 0, travelled_m_ = 0, position_m_ = NAN, rested_s_ = 0;
};

}  // namespace spoolflow::calibration
