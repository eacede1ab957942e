#pragma once
/// What a unit's own recordings say of how it deviates from its type: rows that are zero where the deviations are
/// right.
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/type/spool_track.hpp"
#include "spoolflow/calibration/type/variation.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// What is searched: the deviations, and what is of the recordings and of the type's maps and stays out of the unit's
/// model. The type's ageing is one that serves its pre-sliding, not its break-away alone. What its maps are wrong by is
/// no noise of rows: it is the same in all of them, and would pass for armature friction and the position's gain.
struct UnitUnknowns {
  Deviations deviations{};
  double meter_gain = 0;           ///< what the flow meter reads too much, as a share
  double ageing = 0;               ///< of the force at which the spool breaks away beside the type's, a share of ageing
  double unloaded_friction_N = 0;  ///< by what friction without pressure exceeds that of the maps
  double friction_tilt_N = 0;      ///< by what friction and loop exceed the maps open, and fall short of them closed
  double conductance_tilt = 0;     ///< by what the conductance exceeds the maps' open, and falls short of them closed
};
/// One standard deviation of each of the last five; of the meter where its class is not given.
inline constexpr double meter_gain_uncertainty = 0.005, ageing_uncertainty = 0.35,
                        unloaded_friction_uncertainty_N = 0.3, friction_tilt_uncertainty_N = 0.3,
                        conductance_tilt_uncertainty = 0.01;
inline constexpr std::size_t unit_unknowns = variations + 5;

/// A recording of the unit.
struct UnitRun {
  const recording::Recording* recording;
  recording::Protocol protocol;  ///< unpressurised_strokes or operation
  std::string direction{};       ///< of a whole valve's unit "a", "b", or "both" where it goes through the centre
  double meter_gain_deviation = meter_gain_uncertainty;  ///< of its flow meter, one standard deviation of the reading
};

/// Below this share of the highest pressure difference it counts as none.
inline constexpr double unloaded_share = 0.02;

/// One standard deviation of a mean of the flow meter over a row [share of the rated flow].
inline constexpr double meter_uncertainty_share = 0.002;
/// What the type's maps leave of the forces of another unit in a row, beside what its own bench left [N].
inline constexpr double unit_force_residual_N = 0.25;
/// The reading of the position at the closed end [m], one standard deviation.
inline constexpr double closed_reading_uncertainty_m = 1e-6;

/// A row is a mean over so much travel [m] or time [s], whichever ends first. None lies above the highest pressure
/// difference of the maps.
inline constexpr double row_travel_m = 1e-4, row_time_s = 0.5;
/// A shorter row [s] is none: a spool that slips shows the meter's lag before its speed shows, and one that slips or
/// runs fast less friction than the maps' mean.
inline constexpr double least_row_s = 0.08;
inline constexpr double resistance_uncertainty_share = 0.04;  ///< of copper: 10 K that nobody knows of the winding

/// One standard deviation of a row of force [N] while the spool slides, and of a row of flow [m3/s].
[[nodiscard]] double force_row_uncertainty_N(const model::Model& type);
[[nodiscard]] double flow_row_uncertainty_m3_per_s(const model::Model& type);

/// What a row of evidence is of.
enum class EvidenceOf : unsigned char { force, unpressurised_force, breakaway, flow, closed_reading, resistance };

/// Rows of evidence: means over a tenth of a millimetre of travel, or half a second, whichever ends first, of
/// - force while the spool slides without dither, under pressure by sticking and slipping too: magnetic force less
///   spring, flow force at the measured pressure difference and friction, as the sensor has them. A flow meter alone
///   shows none: its lag would pass for friction;
/// - flow: the meter less conductance times root of the measured pressure difference, seen through the meter's lag;
/// - the position at the closed end, without current;
/// - the coil's resistance, where the voltage is measured.
class UnitEvidence {
 public:
  /// Keeps the type and the recordings by reference.
  UnitEvidence(const model::Model& type, std::vector<UnitRun> runs);

  /// Each row over its standard deviation, at these unknowns.
  [[nodiscard]] Eigen::VectorXd rows(const UnitUnknowns& unknowns) const;
  /// What each of them is of.
  [[nodiscard]] const std::vector<EvidenceOf>& kinds() const { return kinds_; }
  [[nodiscard]] bool any(EvidenceOf kind) const;
  /// The recordings that show forces or flow.
  [[nodiscard]] const std::vector<std::filesystem::path>& shown_by() const { return shown_by_; }
  /// Of UnitUnknowns::meter_gain before it is searched: that of the worst meter.
  [[nodiscard]] double meter_gain_deviation() const { return meter_gain_deviation_; }

 private:
  struct Sample {
    double position_m, current_A, time_step_s, pressure_Pa, flow_m3_per_s, temperature_K;
    int force_row, flow_row;  ///< -1: none
    signed char direction;    ///< 1 opening, -1 closing, 0 does not slide
    double rested_s = 0;      ///< > 0: the spool is about to break away after this rest
  };
  struct Run {
    std::vector<Sample> samples;
    bool pressurised, has_pressure, has_flow;
    numerics::MeterLag meter;
  };
  void prepare(const UnitRun& run);
  [[nodiscard]] numerics::MeterLag meter_of(const recording::Recording& recording) const;
  void add_breakaway(Run& run, std::size_t sample, double rested_s, double travel_m);
  void find_rows(Run& run);
  void add_closed_reading();
  void add_resistance(const UnitRun& run);
  void add_forces(const Run& run, const sensor::ObserverParameters<double>& unit, const UnitUnknowns& unknowns,
                  Eigen::VectorXd& sums) const;
  void add_flows(const Run& run, const sensor::ObserverParameters<double>& unit, const UnitUnknowns& unknowns,
                 Eigen::VectorXd& sums) const;

  const model::Model& type_;
  double meter_gain_deviation_ = 0;
  std::vector<Run> runs_;
  std::vector<EvidenceOf> kinds_;
  std::vector<std::filesystem::path> shown_by_;
  std::vector<double> counts_, deviations_;  ///< of each row: samples, standard deviation
  std::vector<double> closed_readings_m_, resistances_Ohm_;
};

/// Why a run of which forces or flow are expected shows none of the unit's, and what to do next.
[[nodiscard]] std::string why_it_shows_nothing(const UnitRun& run, const model::Model& type);

}  // namespace spoolflow::calibration
