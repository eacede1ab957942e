#include "spoolflow/calibration/references/recalibrate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/references/contradictions.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double um_per_m = 1e6;

void require_their_recordings(const std::vector<recording::Recording>& recordings,
                              const std::vector<recording::Reference>& references) {
  std::vector<std::string> files;
  for (const recording::Recording& recording : recordings) files.push_back(recording.file.filename().string());
  for (const recording::Reference& reference : references) {
    if (reference.recording.empty() || std::ranges::find(files, reference.recording) != files.end()) continue;
    throw CalibrationError(
        fmt::format("{}: {} is of the recording {}, and given are {}; give it too, correct "
                    "recording = \"...\", or leave the reference out",
                    reference.place, reference.name, reference.recording, fmt::join(files, ", ")));
  }
}

MachineEvidence evidence_of(const model::Model& model, const std::vector<recording::Recording>& recordings,
                            const std::vector<recording::Reference>& references) {
  MachineEvidence out{model, {}, references, {}};
  for (const recording::Recording& recording : recordings) {
    WatchedRun run{&recording, {}};
    for (std::size_t r = 0; r < references.size(); ++r) {
      const std::vector<PassedOil> oil =
          passed_oil(references[r], r, recording, model.observer->parameters, model.valve.rated_flow_m3_per_s);
      run.oil.insert(run.oil.end(), oil.begin(), oil.end());
      const bool here =
          references[r].recording.empty() || references[r].recording == recording.file.filename().string();
      if (references[r].kind != recording::ReferenceKind::closed || !here) continue;
      if (const auto reading_m = closed_reading_m(model.observer->parameters, recording)) out.closed_m = reading_m;
    }
    out.runs.push_back(std::move(run));
  }
  const auto closed = std::ranges::find(references, recording::ReferenceKind::closed, &recording::Reference::kind);
  if (closed != references.end() && !out.closed_m) {
    throw CalibrationError(
        fmt::format("{}: {}: the spool never stands closed without current for 0.3 s; record the valve before it is "
                    "switched on, or leave the reference out",
                    closed->place, closed->name));
  }
  return out;
}

void require_within_limits(const model::Model& model, const model::WearState& wear) {
  const auto refuse = [&](const std::string& what) {
    throw CalibrationError(fmt::format(
        "{}: {} lies beyond what references move (edges {:.0f} %, friction {:g} times, "
        "position zero {:g} um); repair the valve, or calibrate it again",
        model.valve.name, what, percent * most_edge_width, most_friction_ratio, um_per_m * most_position_zero_m));
  };
  if (std::abs(wear.edge_width) > most_edge_width)
    refuse(fmt::format("edge width {:+.0f} %", percent * wear.edge_width));
  if (wear.friction_ratio > most_friction_ratio || wear.friction_ratio < 1 / most_friction_ratio)
    refuse(fmt::format("friction of {:.2f} times the calibrated one", wear.friction_ratio));
  if (std::abs(wear.position_zero_m) > most_position_zero_m)
    refuse(fmt::format("a position zero of {:+.0f} um", um_per_m * wear.position_zero_m));
}

std::string stays(const std::string& what, const Change& change, const std::string& best) {
  return fmt::format("{} stays: {} would be exp({:.1f}) times as likely", what, best, change.evidence);
}

/// Position zero, friction, edges, one after the other: each from what the ones before left.
class Update {
 public:
  Update(const MachineEvidence& evidence, RecalibratedValve& out, model::Adaptation& how)
      : evidence_(evidence), out_(out), how_(how), wear_(out.before) {}

  void run() {
    find_position_zero();
    const WearView as_it_was = seen_with(evidence_, wear_, {});
    find_friction(as_it_was);
    const WearView view = seen_with(evidence_, wear_, {});
    for (std::string& sentence : require_agreement(evidence_, view)) say(std::move(sentence));
    find_edges(view);
    out_.after = wear_;
  }

 private:
  void say(std::string sentence) { out_.findings.push_back(std::move(sentence)); }
  void correct(const char* of, const char* unit, double value, double deviation) {
    how_.corrections.push_back({evidence_.model.valve.direction, of, unit, value, 2 * deviation});
  }

  void find_position_zero() {
    const Change zero = position_zero_change(evidence_);
    if (zero.deviation == 0) return;
    const std::string best = fmt::format("{:+.1f} um", um_per_m * zero.value);
    if (!zero.taken) {
      say(stays("position zero", zero, best));
      return;
    }
    wear_.position_zero_m += zero.value;
    correct("position zero", "m", zero.value, zero.deviation);
    say(fmt::format("position zero {} +- {:.1f} um, from where the closed spool stands", best,
                    um_per_m * 2 * zero.deviation));
  }

  void find_friction(const WearView& from) {
    const Change friction = friction_change(evidence_, from, edge_change(evidence_, from));
    const double ratio = std::exp(friction.value);
    const std::string best = fmt::format("{:+.0f} %", percent * (ratio - 1));
    if (!friction.taken) {
      say(stays("friction", friction, best));
      return;
    }
    wear_.friction_ratio *= ratio;
    wear_.friction_share = friction.deviation;
    correct("friction ratio", "1", ratio, ratio * friction.deviation);
    say(fmt::format(
        "friction {} +- {:.0f} %: with it the sensor's forces and the references' volumes agree exp({:.1f}) "
        "times as likely",
        best, percent * 2 * friction.deviation, friction.evidence));
  }

  void find_edges(const WearView& from) {
    const OilAgreement agreement = agreement_of(evidence_, from);
    const Change edge = edge_change(evidence_, from);
    if (agreement.deviation == 0) return;
    require_no_less(evidence_, edge);
    const std::string oil =
        fmt::format("{:+.1f} % of oil beside the sensor's by {}", percent * agreement.log_ratio, names_of(evidence_));
    const double share = std::exp(edge.value) - 1;
    if (!edge.taken) {
      say(stays("edge width", edge, fmt::format("{:+.1f} %", percent * share)) + "; " + oil);
      if (wear_ != model::WearState{}) wear_.flow_share = 0.5 * edge_wear;
      return;
    }
    wear_.edge_width = (1 + wear_.edge_width) * (1 + share) - 1;
    // Flow at a given force goes with the root of the width. Where the oil does not show the wear that friction or
    // position zero do, a reference may hide it: the band keeps all that wear usually changes.
    wear_.flow_share = 0.5 * (edge.evidence > change_evidence ? edge.deviation : edge_wear);
    correct("edge width", "1", share, edge.deviation);
    say(fmt::format("edge width {:+.1f} +- {:.1f} %: {}", percent * share, percent * 2 * edge.deviation, oil));
  }

  const MachineEvidence& evidence_;
  RecalibratedValve& out_;
  model::Adaptation& how_;
  model::WearState wear_;
};

void put_log(model::Adaptation how, RecalibratedValve& out) {
  how.reasons = out.findings;
  how.wear = out.after;
  out.model.provenance.adaptations.push_back(std::move(how));
}

}  // namespace

void require_movable(const model::Model& model) {
  if (model.whole()) {
    throw CalibrationError(model.valve.name +
                           ": the model is of both directions of flow, and references move one of one direction; make "
                           "a model of each direction's benches");
  }
  if (!model.observer) {
    throw CalibrationError(model.valve.name +
                           ": the model has the condensed sensor alone; calibrate the valve with solenoid_dynamic, and "
                           "axial_force_map at two or more oil temperatures");
  }
  if (model.type && !model.type->unit) {
    throw CalibrationError(model.valve.name +
                           ": the model is of a type, and references are of one unit; make the unit's with `spoolflow "
                           "calibrate UNIT.toml --type TYPE.json`");
  }
}

RecalibratedValve recalibrate(const model::Model& model, const std::vector<recording::Recording>& recordings,
                              const std::vector<recording::Reference>& references, model::Adaptation how) {
  require_movable(model);
  require_their_recordings(recordings, references);
  RecalibratedValve out{model, wear_of(model), wear_of(model), {}};
  const MachineEvidence evidence = evidence_of(model, recordings, references);
  for (const recording::Recording& recording : recordings) how.files.push_back(recording.file.filename().string());
  Update(evidence, out, how).run();
  require_within_limits(model, out.after);
  out.model = moved(model, out.after);
  put_log(std::move(how), out);
  return out;
}

RecalibratedValve gone_back(const model::Model& model, std::size_t state, model::Adaptation how) {
  require_movable(model);
  const std::vector<model::WearState> states = wear_states(model);
  if (state >= states.size()) {
    throw CalibrationError(fmt::format("{}: the model has no state {}; its states are 0, as calibrated, to {}",
                                       model.valve.name, state, states.size() - 1));
  }
  RecalibratedValve out{moved(model, states[state]), states.back(), states[state], {}};
  out.findings.push_back(fmt::format("went back to state {}", state));
  put_log(std::move(how), out);
  return out;
}

}  // namespace spoolflow::calibration
