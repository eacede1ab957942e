#pragma once
/// What is known of a run after it was judged: figures, and lines short enough to draw.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/validation/error_profile.hpp"
#include "spoolflow/validation/frequency_response.hpp"
#include "spoolflow/validation/known_meter.hpp"
#include "spoolflow/validation/metrics.hpp"
#include "spoolflow/validation/reference_scale.hpp"
#include "spoolflow/validation/run_trace.hpp"
#include "spoolflow/validation/status_timeline.hpp"
#include "spoolflow/validation/step_response.hpp"
#include "spoolflow/validation/trace.hpp"

namespace spoolflow::validation {

/// Smallest and largest recorded value.
struct Extent {
  double lowest, highest;
};

/// The instant of the largest error, and the seconds around it.
struct WorstMoment {
  double time_s;
  double error_m3_per_s;
  double position_m;
  std::optional<double> pressure_difference_Pa;
  bool moving, rest;
  double velocity_m_per_s;  ///< of the spool; 0 unless it moves
  std::vector<std::string> status;
  Line reference_m3_per_s;
  Ribbon band_m3_per_s;
  std::vector<Line> flow_m3_per_s;  ///< of every estimator, in the run's order
};

/// Whether a whole valve's estimated flow has the right sign, where the meter shows more than a fiftieth of full scale.
struct SignFigures {
  std::size_t samples = 0;                   ///< with reference flow
  std::size_t wrong = 0;                     ///< of them: against the measured flow, and the status did not say so
  std::size_t undetermined = 0;              ///< of them: the status says sign_undetermined
  double undetermined_largest_m3_per_s = 0;  ///< largest magnitude of the measured flow among those

  void append(const SignFigures& others) {
    samples += others.samples;
    wrong += others.wrong;
    undetermined += others.undetermined;
    undetermined_largest_m3_per_s = std::max(undetermined_largest_m3_per_s, others.undetermined_largest_m3_per_s);
  }
};

/// One estimator over a run; lines in SI.
struct EstimatorResult {
  estimation::Estimator estimator;
  std::optional<Metrics> metrics;      ///< absent without reference flow
  std::vector<ErrorProfile> profiles;  ///< one for each of `quantities`; empty without reference flow
  std::optional<DirectionProfile> direction;
  std::optional<SignFigures> sign;  ///< of a whole valve with reference flow
  std::optional<FrequencyResponse> frequency_response;
  std::vector<StatusRow> status;
  double fault_share = 0;  ///< of the samples: with any fault
  std::optional<WorstMoment> worst;
  Line flow_m3_per_s, error_m3_per_s, pressure_difference_Pa;
  Ribbon band_m3_per_s;
  Line magnetic_force_N, spring_force_N, flow_force_N, friction_force_N;
};

/// A spool position and pressure difference at which the valve worked, to a hundredth of the stroke and 1 bar.
struct OperatingPoint {
  double position_m, pressure_difference_Pa;
};

/// A spool position and flow rate (measured, else estimated), to a hundredth of the stroke and of full scale.
struct FlowPoint {
  double position_m, flow_m3_per_s;
};

/// A spool position and coil current at which the solenoid worked, to a hundredth of the stroke and 0.02 A.
struct SolenoidPoint {
  double position_m, current_A;
};

struct RunResult {
  KnownMeter reference_meter;
  std::optional<ReferenceScale> reference_scale;  ///< beside the leading estimator; reported, not applied
  std::string name;                               ///< file name without its ending
  std::string file;
  std::string sha256;            ///< empty for standard input
  bool calibrated_with = false;  ///< the model names this very file among its inputs
  std::uint64_t samples = 0, duplicate_times = 0, missing_values = 0;
  std::string resampled;  ///< columns brought onto the time of the current, and how (recording::ReadNotes)
  double duration_s = 0;
  bool has_reference = false;
  std::optional<Extent> current_A, position_m, oil_temperature_K, pressure_difference_Pa, reference_m3_per_s;
  Line reference_line_m3_per_s, position_line_m, pressure_difference_line_Pa;
  RunTrace trace;
  std::vector<OperatingPoint> operating_points;
  std::vector<FlowPoint> flow_points;
  std::vector<SolenoidPoint> solenoid_points;
  std::optional<StepResponse> step_response;
  std::vector<std::string> doubts;       ///< what physics says against the run, a sentence each
  std::vector<EstimatorResult> results;  ///< in the order of the options; the leading estimator last
};

}  // namespace spoolflow::validation
