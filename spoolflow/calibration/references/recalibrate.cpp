#include "spoolflow/calibration/references/recalibrate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/references/contradictions.hpp"
#include "spoolflow/calibration/references/direction_view.hpp"

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

/// Of two references of one kind and recording that are seen in one way.
bool see_the_same(const recording::Reference& one, const recording::Reference& other) {
  const bool one_way = one.direction.empty() || other.direction.empty() || one.direction == other.direction;
  return one.ends == other.ends && one.marks.empty() && other.marks.empty() && one_way;
}

/// Oil that fills one cylinder fills no other, nor comes from another pump: a mark that overlaps another of its kind
/// states the same oil again, which counts once. So does a meter's channel.
void require_counted_once(const std::vector<recording::Reference>& references) {
  for (std::size_t r = 0; r < references.size(); ++r) {
    for (std::size_t s = 0; s < r; ++s) {
      const recording::Reference &one = references[s], &other = references[r];
      const bool elsewhere = !one.recording.empty() && !other.recording.empty() && one.recording != other.recording;
      if (one.kind != other.kind || elsewhere) continue;
      if (see_the_same(one, other)) {
        throw CalibrationError(
            fmt::format("{}: {} sees the same of the recording as {} ({}), which counts once: leave "
                        "one of the two out, or give each its own recording = \"...\"",
                        other.place, other.name, one.name, one.place));
      }
      for (const recording::TimeMark& mark : other.marks) {
        const auto overlaps = [&](const recording::TimeMark& each) {
          return each.begin_s < mark.end_s && mark.begin_s < each.end_s;
        };
        if (std::ranges::none_of(one.marks, overlaps)) continue;
        throw CalibrationError(
            fmt::format("{}: {} marks {} s to {} s, of which {} ({}) has marked a part; the oil of a time counts once: "
                        "correct the marks, or leave one of the two out",
                        other.place, other.name, mark.begin_s, mark.end_s, one.name, one.place));
      }
    }
  }
}

/// Of a whole valve a stroke, or a pump's time, is of one direction; those of the other are none of it.
void keep_own(const recording::Reference& reference, const recording::Recording& recording,
              const std::vector<bool>& other_opens, std::vector<PassedOil>& oil) {
  if (other_opens.empty() || reference.kind == recording::ReferenceKind::meter) return;
  const auto time_s = recording[recording::Channel::time];
  const auto is_of_other = [&](const PassedOil& each) {
    const auto at = [&](double when_s) { return std::ranges::lower_bound(time_s, when_s) - time_s.begin(); };
    return std::any_of(other_opens.begin() + at(each.begin_s), other_opens.begin() + at(each.end_s),
                       [](bool opens) { return opens; });
  };
  const auto foreign = std::ranges::find_if(oil, is_of_other);
  if (foreign == oil.end()) return;
  if (!reference.marks.empty()) {
    throw CalibrationError(fmt::format(
        "{}: {}: between {} s and {} s of {} the spool opens the other direction; correct the mark, or direction = "
        "\"{}\"",
        reference.place, reference.name, foreign->begin_s, foreign->end_s, recording.file.filename().string(),
        reference.direction));
  }
  std::erase_if(oil, is_of_other);
}

MachineEvidence evidence_of(const model::Model& model, const DirectionView& view) {
  MachineEvidence out{model, {}, view.references, {}};
  for (std::size_t n = 0; n < view.recordings.size(); ++n) {
    const recording::Recording& recording = *view.recordings[n];
    WatchedRun run{&recording, {}};
    for (std::size_t r = 0; r < view.references.size(); ++r) {
      const recording::Reference& reference = view.references[r];
      std::vector<PassedOil> oil =
          passed_oil(reference, r, recording, model.observer->parameters, model.valve.rated_flow_m3_per_s);
      keep_own(reference, recording, view.other_opens[n], oil);
      run.oil.insert(run.oil.end(), oil.begin(), oil.end());
      const bool here = reference.recording.empty() || reference.recording == recording.file.filename().string();
      if (reference.kind != recording::ReferenceKind::closed || !here) continue;
      if (const auto reading_m = closed_reading_m(model.observer->parameters, recording)) out.closed_m = reading_m;
    }
    out.runs.push_back(std::move(run));
  }
  const auto closed = std::ranges::find(view.references, recording::ReferenceKind::closed, &recording::Reference::kind);
  if (closed != view.references.end() && !out.closed_m) {
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

/// One direction's update: position zero, friction, edges, one after the other, each from what the ones before left.
class Update {
 public:
  Update(model::Model model, DirectionView view, model::Adaptation how)
      : model_(std::move(model)),
        view_(std::move(view)),
        how_(std::move(how)),
        evidence_(evidence_of(model_, view_)),
        wear_(wear_of(model_)) {}
  Update(const Update&) = delete;
  Update& operator=(const Update&) = delete;

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

  [[nodiscard]] SeenFriction seen() const { return seen_friction(evidence_, seen_with(evidence_, wear_, {})); }

  void take(const Change& friction) {
    const double ratio = std::exp(friction.value);
    const std::string best = fmt::format("{:+.0f} %", percent * (ratio - 1));
    if (!friction.taken) {
      likely_friction_ratio_ = ratio;
      const bool open = friction.evidence > -change_evidence;
      say(stays("friction", friction, best) + (open ? "; more references would tell whether it wore" : ""));
      return;
    }
    wear_.friction_ratio *= ratio;
    wear_.friction_share = friction.deviation;
    correct("friction ratio", "1", ratio, ratio * friction.deviation);
    const std::string why =
        friction.evidence > 0
            ? fmt::format(
                  "with it, and edges as wide as the oil asks for, the references are exp({:.1f}) times as likely",
                  friction.evidence)
            : "expected of a valve that shows other wear; the references tell no more";
    say(fmt::format("friction {} +- {:.0f} %: {}", best, percent * 2 * friction.deviation, why));
  }

  void find_edges() {
    const WearView view = seen_with(evidence_, wear_, {});
    for (std::string& sentence : require_agreement(evidence_, view)) say(std::move(sentence));
    find_edges(view);
  }

  [[nodiscard]] const std::vector<std::string>& doubts() const { return doubts_; }

  /// The model with its entry at the end of the log.
  [[nodiscard]] model::Model moved_on() {
    require_within_limits(model_, wear_);
    model::Model out = moved(model_, wear_);
    how_.wear = wear_;
    out.provenance.adaptations.push_back(std::move(how_));
    return out;
  }

 private:
  void say(std::string sentence) { how_.reasons.push_back(std::move(sentence)); }
  void correct(const char* of, const char* unit, double value, double deviation) {
    how_.corrections.push_back({model_.valve.direction, of, unit, value, 2 * deviation});
  }

  void find_edges(const WearView& from) {
    const OilAgreement agreement = agreement_of(evidence_, from);
    const EdgeChange edge = edge_change(evidence_, from);
    if (agreement.deviation == 0) return;
    if (edge.value < 0) require_no_less(evidence_, likely_friction_ratio_ == 1 ? edge : edge_with_likely_friction());
    require_no_misstated(evidence_, edge);
    // What one reference leaves open of its own figures, it leaves open however often it is asked.
    const double left_open = agreement.references > 1 ? 0 : wear_.flow_share;
    const std::string oil =
        fmt::format("{:+.1f} % of oil beside the sensor's by {}", percent * agreement.log_ratio, names_of(evidence_));
    const double share = std::exp(edge.value) - 1;
    if (!edge.taken) {
      const bool contradicts = edge.value < 0 && edge.evidence > contradiction_evidence;
      say((contradicts ? "edge width stays: wear does not narrow edges, and friction that is not known well may be why"
                       : stays("edge width", edge, fmt::format("{:+.1f} %", percent * share))) +
          "; " + oil);
      if (wear_ != model::WearState{}) wear_.flow_share = std::max(left_open, 0.5 * edge_wear);
      return;
    }
    wear_.edge_width = (1 + wear_.edge_width) * (1 + share) - 1;
    // Flow at a given force goes with the root of the width. Where the oil does not show the wear that friction or
    // position zero do, a reference may hide it: the band keeps all that wear usually changes.
    const double open = edge.evidence > change_evidence ? edge.deviation : std::max(edge_wear, edge.deviation);
    wear_.flow_share = std::max(left_open, 0.5 * open);
    correct("edge width", "1", share, edge.deviation);
    const std::string alike = looks_alike(evidence_, edge);
    say(fmt::format("edge width {:+.1f} +- {:.1f} %: {}{}{}", percent * share, percent * 2 * edge.deviation, oil,
                    alike.empty() ? "" : "; ", alike));
    if (edge.misstated > doubtful_evidence) doubts_.push_back(fmt::format("{}: {}", names_of(evidence_), alike));
  }

  [[nodiscard]] EdgeChange edge_with_likely_friction() const {
    model::WearState likely = wear_;
    likely.friction_ratio *= likely_friction_ratio_;
    return edge_change(evidence_, seen_with(evidence_, likely, {}));
  }

  model::Model model_;
  DirectionView view_;
  model::Adaptation how_;
  MachineEvidence evidence_;  // refers to the two above
  model::WearState wear_;
  std::vector<std::string> doubts_;
  double likely_friction_ratio_ = 1;  // of friction that is not taken: it may be why less oil passes than forces say
};

/// One direction takes its place in the model, the last entry of its log the end of the model's.
void put(RecalibratedValve& out, model::Model of_one) {
  const std::string direction = of_one.valve.direction;
  model::Adaptation log = std::move(of_one.provenance.adaptations.back());
  const bool whole = out.model.whole();
  for (const std::string& reason : log.reasons)
    out.findings.push_back(whole ? fmt::format("{}: {}", model::flow_of(direction), reason) : reason);
  if (whole) log.direction = direction;
  model::put_direction(out.model, direction, std::move(of_one));
  out.model.provenance.adaptations.push_back(std::move(log));
}

/// The last state of a direction among the first `states` of the log.
model::WearState state_of(const model::Model& model, const std::string& direction, std::size_t states) {
  model::WearState out;
  for (const model::Adaptation& each : model.provenance.adaptations) {
    if (!each.wear) continue;
    if (states-- == 0) break;
    if (each.direction.empty() || each.direction == direction) out = *each.wear;
  }
  return out;
}

}  // namespace

void require_movable(const model::Model& model) {
  if (!model.has_observer()) {
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
  require_counted_once(references);
  for (const recording::Recording& recording : recordings) how.files.push_back(recording.file.filename().string());
  RecalibratedValve out{model, {}, {}};
  std::deque<Update> updates;  // of the directions that references are of
  for (const std::string& direction : model::directions(model)) {
    DirectionView view = view_of_direction(model, direction, recordings, references);
    if (!view.references.empty()) {
      updates.emplace_back(model::of_direction(model, direction), std::move(view), how);
    } else {
      out.findings.push_back(fmt::format("{} stays: no reference is of it", model::flow_of(direction)));
    }
  }
  if (updates.empty()) {
    throw CalibrationError(model.valve.name +
                           ": no reference says what oil passed in a direction that the recordings open; give strokes, "
                           "a pump or a meter");
  }
  for (Update& each : updates) each.find_position_zero();
  std::vector<SeenFriction> seen;
  for (const Update& each : updates) seen.push_back(each.seen());
  const Change friction = friction_change(seen);
  for (Update& each : updates) {
    each.take(friction);
    each.find_edges();
    out.doubts.insert(out.doubts.end(), each.doubts().begin(), each.doubts().end());
    put(out, each.moved_on());
  }
  const auto closed = std::ranges::find(references, recording::ReferenceKind::closed, &recording::Reference::kind);
  if (model.whole() && closed != references.end()) {
    out.findings.push_back(closed->name +
                           " says nothing of a whole valve: its sensor finds its zero at rest in the centre");
  }
  return out;
}

RecalibratedValve gone_back(const model::Model& model, std::size_t state, model::Adaptation how) {
  require_movable(model);
  const std::size_t last = wear_states(model).size() - 1;
  if (state > last) {
    throw CalibrationError(fmt::format("{}: the model has no state {}; its states are 0, as calibrated, to {}",
                                       model.valve.name, state, last));
  }
  how.reasons = {fmt::format("went back to state {}", state)};
  RecalibratedValve out{model, {}, corrected_in_all_states(model)};
  for (const std::string& direction : model::directions(model)) {
    const model::Model before = model::of_direction(model, direction);
    how.wear = state_of(model, direction, state);
    model::Model after = moved(before, *how.wear);
    after.provenance.adaptations.push_back(how);
    put(out, std::move(after));
  }
  return out;
}

}  // namespace spoolflow::calibration
