#pragma once
/// Corrects the model by what the indicators have identified: on request only, within limits, and recorded in the
/// model's provenance. The model that it was corrected from stays as it is: going back is to use that.
///
/// Beside it how fast references move a model: the rate of wear with its band, and no remaining useful life.
///
///     model::Model corrected = monitor::adapted(model, watch.findings(), {.tool_version = …, .created = …, …});
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/correction.hpp"
#include "spoolflow/monitor/isolation.hpp"

namespace spoolflow::monitor {

/// What one side's raised charts are best explained by.
struct DirectionFindings {
  bool raised = false;                            ///< a chart is
  std::array<bool, isolated_faults> likeliest{};  ///< the set of faults that explains best, in the order of Fault
  Magnitudes value{};                             ///< in usual_fault, against the model
  Magnitudes deviation{};                         ///< one standard deviation of each
};
struct Findings {
  std::array<DirectionFindings, 2> side{};  ///< of solenoids b and a; a valve of one direction has the first
};

/// No more is corrected: beyond, the valve is to be repaired or calibrated again.
inline constexpr double most_friction_ratio = 3;
inline constexpr double most_preload_loss = 0.3;
inline constexpr double most_rate_loss = 0.3;
inline constexpr double most_shorted_turns = 0.15;
inline constexpr double most_position_zero_m = 60e-6;

/// Friction as identified lies about the valve's own with this standard deviation, as a share of it: on rig valves 0.93
/// to 1.01 of what it is. The band takes it on where friction is corrected.
inline constexpr double identified_friction_share = 0.08;

/// The model with friction, spring, force factor and position zero of the faults found put right, and `how`, with the
/// corrections filled in, at the end of its provenance. Edge wear is not corrected: it changes the flow that a force
/// means. Nor is the zero of a whole valve, which its sensor finds at rest by itself. Throws ModelError where nothing
/// was raised, where what was raised is none of what can be corrected, or where a correction passes its limit; the
/// model's own name, the figure, the limit and the remedy are named.
[[nodiscard]] model::Model adapted(const model::Model& model, const Findings& findings, model::Adaptation how);

/// By the month of 30 days, each with its half width at 95 %.
struct WearRate {
  double value, uncertainty_95;
};

struct WearDrift {
  WearRate edge_width;       ///< conductance and flow force, as a share of the calibrated
  WearRate friction;         ///< as a share of the calibrated
  WearRate position_zero_m;  ///< of the sensor's reading
  std::size_t looks;         ///< of references, at which the model moved or stayed
  double days;               ///< from calibration to the last of them
};

/// A line through the model as calibrated and each state since, weighted by how well each is known; `direction` of a
/// whole valve. Nothing where references never looked at it, or all within a day.
[[nodiscard]] std::optional<WearDrift> wear_drift(const model::Provenance& provenance,
                                                  const std::string& direction = {});

/// "in 30 days: edge width +0.4 +- 0.9 %, …"
[[nodiscard]] std::string text_of(const WearDrift& drift);
/// The same of each direction that has a drift; of a whole valve "P to B in 30 days: …".
[[nodiscard]] std::vector<std::string> drift_texts(const model::Model& model);

}  // namespace spoolflow::monitor
