#pragma once
/// How to dither a calibrated valve: what each amplitude and frequency of the coil current's dither does to the band at
/// rest and to the flow, by the model's own solenoid, friction and metering edge.
#include <optional>
#include <vector>

#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/uncertainty/operating_point.hpp"

namespace spoolflow::analysis {

/// Course of the coil current over a period of dither. A square's edges take `square_edge_s`: no supply moves a coil's
/// current at once.
enum class DitherShape { sine, square };

inline constexpr double square_edge_s = 1e-3;
/// How long the spool has rested where the band without dither is stated [s]: contacts grow stronger meanwhile.
inline constexpr double stated_rest_s = 10;
/// Damping of the contacts in pre-sliding, as a share of the critical: that of dry metal joints, assumed.
inline constexpr double contact_damping_share = 0.3;
/// What is left of slow sliding friction at speed, as a share of it: mixed friction goes over into fluid friction. No
/// bench of the campaign measures it; assumed from the range of Armstrong-Helouvry 1994, on the side of more motion.
inline constexpr double moving_friction_share = 0.6;
/// Half of that fall is reached at this speed [m/s], assumed likewise.
inline constexpr double mixed_friction_m_per_s = 4e-3;
/// As a share of an amplitude, so much more must keep the limit, too. Where friction gives way the spool's motion leaps
/// up, and the position control answers the motion: the faster that is, the later its answer comes, and from some
/// hundred hertz on it feeds the motion instead of damping it. Measured on the rig's presets, both shapes, 80 to 240 Hz
/// (bench/dither_limit_on_rig.py, docs/rig.md): the least below the first frequency, the most above the second, evenly
/// between.
inline constexpr double least_amplitude_reserve = 0.15;
inline constexpr double most_amplitude_reserve = 1;
inline constexpr double least_reserve_Hz = 120;
inline constexpr double most_reserve_Hz = 200;
[[nodiscard]] constexpr double amplitude_reserve(double frequency_Hz) {
  const double share = (frequency_Hz - least_reserve_Hz) / (most_reserve_Hz - least_reserve_Hz);
  const double within = share < 0 ? 0 : share > 1 ? 1 : share;
  return least_amplitude_reserve + within * (most_amplitude_reserve - least_amplitude_reserve);
}
/// A smaller amplitude is preferred where its band is wider by no more than this share of the band without dither.
inline constexpr double small_gain_share = 0.05;

/// What is asked. Amplitudes are half of peak to peak of the coil current as it is measured; what the electronics must
/// be asked for is larger by what its current control leaves out.
struct DitherQuestion {
  PointSettings points{};
  double most_amplitude_share = 0.15;  ///< of the largest current, (0, 0.5]
  int amplitudes = 31;                 ///< from 0, at least 2
  double lowest_frequency_Hz = 60;
  double highest_frequency_Hz = 250;
  int frequencies = 20;  ///< at least 2
  DitherShape shape = DitherShape::sine;
  double ripple_limit_share = 0.005;  ///< of full scale, > 0: half of the flow ripple's peak to peak
};

/// What one amplitude and frequency does at one working point.
struct DitherEffect {
  double half_swing_N;          ///< half of peak to peak of the magnetic force
  double band_N;                ///< half the width of what rest leaves open of the flow force
  double band_m3_per_s;         ///< the same in flow
  double motion_m;              ///< half of peak to peak of the spool's motion
  double flow_ripple_m3_per_s;  ///< half of peak to peak of the flow that the motion makes
  bool frees;                   ///< the spool, both ways in each period
};

/// A working point with what matters there; friction in operation, >= 0.
struct DitherPoint {
  uncertainty::WorkingPoint point;
  double current_A = 0;  ///< that holds the spool there
  double flow_m3_per_s = 0;
  double sliding_N = 0;          ///< friction of spool and armature while they slide
  double sticking_N = 0;         ///< the most that they hold after `stated_rest_s`
  double maps_N = 0;             ///< half the 95 % width that magnetic force, springs and flow force leave open
  double stiffness_N_per_m = 0;  ///< of springs and flow force less the solenoid's; may be < 0
  double flow_per_position_m2_per_s = 0;  ///< slope of the flow at a held pressure difference
};

/// The point where the spool rests under a held current; nothing where the model's maps do not hold it.
[[nodiscard]] std::optional<DitherPoint> dither_point(const model::Model& model,
                                                      const uncertainty::WorkingPoint& point);

/// The extremes of the magnetic force come from the model's actuator (force map, hysteresis, eddy currents) driven with
/// some periods of that current about the holding current; band by the sensor's own bounds of friction under dither.
/// The motion is that of the moving mass on springs and contacts, which give way elastically up to friction that falls
/// with speed, and with the drag that the sensor's band counts, under that force. Leaves out the position control,
/// which adds its own current to that of dither where the spool moves, and the change of the magnetic force with the
/// motion beyond its slope at a held current.
[[nodiscard]] DitherEffect dither_effect(const model::Model& model, const DitherPoint& point, double amplitude_A,
                                         double frequency_Hz, DitherShape shape);

/// One setting over all points.
struct DitherSetting {
  double mean_band_m3_per_s;
  double largest_motion_m;
  double largest_ripple_m3_per_s;
  bool within_limit;  ///< of the ripple
};

struct DitherStudy {
  DitherQuestion question;
  std::vector<double> amplitude_A{};   ///< rising from 0
  std::vector<double> frequency_Hz{};  ///< rising
  std::vector<DitherPoint> points{};
  std::vector<std::vector<DitherEffect>> effects{};  ///< of each point, over `place`
  std::vector<DitherSetting> settings{};             ///< over `place`
  std::size_t recommended = 0;                       ///< a place

  [[nodiscard]] std::size_t place(std::size_t amplitude, std::size_t frequency) const {
    return amplitude * frequency_Hz.size() + frequency;
  }
  [[nodiscard]] double amplitude_at_A(std::size_t a_place) const { return amplitude_A[a_place / frequency_Hz.size()]; }
  [[nodiscard]] double frequency_at_Hz(std::size_t a_place) const {
    return frequency_Hz[a_place % frequency_Hz.size()];
  }
};

/// The setting with the smallest mean band among those that keep the ripple's limit at every point, with
/// `amplitude_reserve` as well, which must have been looked at; of those that gain nearly as much the one with the
/// smallest amplitude, and of these the one with the smallest band.
[[nodiscard]] std::size_t recommended_setting(const DitherStudy& study);

/// All amplitudes and frequencies at all points of the question that the maps hold.
/// Throws model::ModelError where the model has no observer, or holds none of the points.
[[nodiscard]] DitherStudy dither_study(const model::Model& model, const DitherQuestion& question, unsigned workers);

}  // namespace spoolflow::analysis
