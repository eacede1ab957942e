#include "spoolflow/calibration/type/spool_track.hpp"

namespace spoolflow::calibration {
namespace {

/// Of even motion one way until friction has its full size [m].
constexpr double settling_travel_m = 4e-5;
/// A shorter rest [s] is part of a motion.
constexpr double least_rest_s = 0.05;

}  // namespace

Doing SpoolTrack::next(const sensor::ObserverState<double>& state, sensor::Status status,
                       const sensor::Sample<double>& sample, double position_m) {
  const sensor::Motion motion = state.position.motion;
  const bool usable = sensor::unusable(sample) == sensor::Status::none &&
                      !sensor::has(status, sensor::Status::dithered | sensor::Status::position_fault);
  const double speed_m_per_s = std::abs(state.position.velocity_m_per_s);
  const bool between_ends = position_m > end_share * stroke_m_ && position_m < (1 - end_share) * stroke_m_;
  const bool full =
      pressurised_ ? passes(usable, sample.time_step_s, position_m) : moves_evenly(usable, motion, position_m);
  Doing out{pressurised_ ? static_cast<int>(passage_.way()) : direction_, false, false, 0};
  out.slides = usable && full && speed_m_per_s < fastest_sliding_m_per_s && between_ends;
  out.metered = usable && speed_m_per_s < fastest_metered_m_per_s && between_ends && position_m > closed_below_m_;
  if (usable && rested_s_ > least_rest_s && motion != sensor::Motion::rest) out.broke_after_s = rested_s_;
  rested_s_ = motion == sensor::Motion::rest ? state.friction.rest_s : 0;
  ++sample_;
  return out;
}

bool SpoolTrack::passes(bool usable, double step_s, double position_m) {
  time_s_ += step_s;
  if (!usable) passage_.begin(time_s_, position_m, 0);
  ended_ = !usable || !passage_.goes_on(sample_, time_s_, position_m);
  return passage_.worn();
}

bool SpoolTrack::moves_evenly(bool usable, sensor::Motion motion, double position_m) {
  const int now = motion == sensor::Motion::opening ? 1 : motion == sensor::Motion::closing ? -1 : 0;
  travelled_m_ = now == direction_ && usable ? travelled_m_ + now * (position_m - position_m_) : 0;
  direction_ = now;
  position_m_ = position_m;
  return now != 0 && travelled_m_ > settling_travel_m;
}

}  // namespace spoolflow::calibration
