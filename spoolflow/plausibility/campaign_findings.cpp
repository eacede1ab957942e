#include "spoolflow/plausibility/campaign_findings.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/plausibility/bench_relations.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/recording_error.hpp"
#include "spoolflow/plausibility/reference_shift.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"
#include "spoolflow/plausibility/zero_findings.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

enum class Role : std::uint8_t { spring, force_map, dynamic, axial_map, operation };

struct Piece {
  Role role;
  Recording means;
};

/// The campaign as it stands, or with recording errors undone.
class Trial {
 public:
  explicit Trial(const Benches& benches)
      : rated_flow_m3_per_s(benches.rated_flow_m3_per_s),
        stroke_m_(benches.stroke_m),
        density_(benches.density_kg_per_m3) {
    const auto add = [&](Role role, const Recording* recording, std::size_t most) {
      if (recording != nullptr) pieces.push_back({role, block_means(*recording, most)});
    };
    add(Role::spring, benches.spring, 500);
    add(Role::force_map, benches.solenoid_force_map, 1500);
    for (const Recording* recording : benches.solenoid_dynamic) add(Role::dynamic, recording, 1500);
    for (const Recording* recording : benches.axial_force_maps) add(Role::axial_map, recording, 1000);
    for (const Recording* recording : benches.operation) add(Role::operation, recording, 2500);
  }

  /// Fits what `changed` reaches of the curves again; all of them where nothing is named.
  void fit_curves(std::optional<Role> changed) {
    const Recording* map = first(Role::force_map);
    const std::vector<const Recording*> maps = all(Role::axial_map);
    if (!changed || *changed == Role::spring || *changed == Role::axial_map)
      hydraulics_ = fit_hydraulics(first(Role::spring), maps, stroke_m_, density_);
    if (map != nullptr && (!changed || *changed == Role::force_map)) magnetics_ = fit_magnetics(*map, stroke_m_);
  }

  /// All relations, with the curves as they were fitted last.
  [[nodiscard]] std::vector<Deviation> deviations() const {
    const Recording* map = first(Role::force_map);
    const std::vector<const Recording*> maps = all(Role::axial_map);
    std::vector<Deviation> out;
    add_hydraulic_deviations(out, hydraulics_, first(Role::spring), maps);
    add_map_deviations(out, hydraulics_, maps);
    add_rated_flow_deviation(out, hydraulics_, rated_flow_m3_per_s);
    if (map != nullptr) add_magnetic_deviations(out, magnetics_, *map);
    std::vector<const Recording*> coils = all(Role::dynamic);
    if (map != nullptr) coils.push_back(map);
    for (const Recording* run : all(Role::operation)) {
      if (map != nullptr) add_run_deviations(out, hydraulics_, magnetics_, *run);
      coils.push_back(run);
    }
    add_resistance_deviation(out, coils);
    return out;
  }

  /// One direction as its curves were fitted last, with the opening that its axial-force maps have.
  [[nodiscard]] KnownValve known() const {
    return {.hydraulics = hydraulics_,
            .magnetics = magnetics_,
            .coil = {},
            .opening = OpeningCurve(all(Role::axial_map), stroke_m_)};
  }
  [[nodiscard]] double stroke_m() const { return stroke_m_; }
  [[nodiscard]] const HydraulicCurves& hydraulics() const { return hydraulics_; }

  std::vector<Piece> pieces;
  double rated_flow_m3_per_s;

 private:
  [[nodiscard]] const Recording* first(Role role) const {
    const auto found = std::ranges::find(pieces, role, &Piece::role);
    return found == pieces.end() ? nullptr : &found->means;
  }
  [[nodiscard]] std::vector<const Recording*> all(Role role) const {
    std::vector<const Recording*> out;
    for (const Piece& piece : pieces) {
      if (piece.role == role) out.push_back(&piece.means);
    }
    return out;
  }

  double stroke_m_;
  double density_;
  HydraulicCurves hydraulics_;
  MagneticCurves magnetics_;
};

/// Recordings that may share an error, since one instrument took them.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const Trial& trial) {
  std::vector<Group> out;
  Group axial, axial_rig, solenoid, operation;
  for (std::size_t k = 0; k < trial.pieces.size(); ++k) {
    out.push_back({k});
    const Role role = trial.pieces[k].role;
    if (role == Role::axial_map) axial.push_back(k);
    if (role == Role::axial_map || role == Role::spring) axial_rig.push_back(k);
    if (role == Role::force_map || role == Role::dynamic) solenoid.push_back(k);
    if (role == Role::operation) operation.push_back(k);
  }
  for (const Group& group : {axial, axial_rig, solenoid, operation}) {
    if (group.size() > 1) out.push_back(group);
  }
  return out;
}

struct Explanation {
  Group group;  ///< empty: the rated flow
  Channel channel;
  const RecordingError* error;
  double badness;
  std::vector<Deviation> deviations;
  std::vector<const RecordingError*> alike{};  ///< of the same channel and recordings, that leave hardly more
};

void undo(Trial& trial, const Group& group, Channel channel, const RecordingError& error) {
  if (group.empty()) trial.rated_flow_m3_per_s = error.undone(trial.rated_flow_m3_per_s, 0);
  for (const std::size_t k : group) {
    for (double& value : trial.pieces[k].means.column(channel)) value = error.undone(value, trial.stroke_m());
  }
}

bool all_have(const Trial& trial, const Group& group, Channel channel) {
  return std::ranges::all_of(group, [&](std::size_t k) {
    const Piece& piece = trial.pieces[k];
    const bool read =
        piece.role != Role::spring || (channel != Channel::pressure_difference && channel != Channel::flow);
    const bool measured = piece.role != Role::dynamic || channel == Channel::current || channel == Channel::voltage;
    return read && measured && piece.means.has(channel);
  });
}

/// The recording error that leaves least.
std::optional<Explanation> best_explanation(Trial& trial, const std::vector<Deviation>& before) {
  std::optional<Explanation> best;
  std::vector<Explanation> tried;
  const auto judge = [&](const Group& group, Channel channel, const RecordingError& error,
                         std::optional<Role> changed) {
    trial.fit_curves(changed);
    std::vector<Deviation> deviations = trial.deviations();
    if (!judges_as_much(deviations, before)) return;
    const double left = badness(deviations);
    tried.push_back({group, channel, &error, left, {}});
    if (!best || left < best->badness) best = Explanation{group, channel, &error, left, std::move(deviations)};
  };
  for (const RecordingError& error : usual_errors_of_rated_flow()) {
    const double kept = trial.rated_flow_m3_per_s;
    undo(trial, {}, Channel::flow, error);
    judge({}, Channel::flow, error, Role::operation);
    trial.rated_flow_m3_per_s = kept;
  }
  for (const Group& group : groups_of(trial)) {
    for (const Channel channel : recording::all_channels) {
      if (!all_have(trial, group, channel)) continue;
      std::vector<std::vector<double>> kept;
      for (const std::size_t k : group) kept.push_back(trial.pieces[k].means.column(channel));
      const bool both = group.size() > 1 && trial.pieces[group.front()].role != trial.pieces[group.back()].role;
      const std::optional<Role> changed = both ? std::optional<Role>{} : trial.pieces[group.front()].role;
      for (const RecordingError& error : usual_recording_errors(channel)) {
        undo(trial, group, channel, error);
        judge(group, channel, error, changed);
        for (std::size_t k = 0; k < group.size(); ++k) trial.pieces[group[k]].means.column(channel) = kept[k];
      }
      trial.fit_curves(changed);  // as they were
    }
  }
  constexpr double alike = 0.05;
  for (const Explanation& other : tried) {
    if (best && other.error != best->error && other.channel == best->channel && other.group == best->group &&
        other.badness < best->badness + alike)
      best->alike.push_back(other.error);
  }
  return best;
}

std::string files_of(const Trial& trial, const Group& group) {
  std::string out;
  for (const std::size_t k : group) {
    if (!out.empty()) out += k == group.back() ? " and " : ", ";
    out += trial.pieces[k].means.file.filename().string();
  }
  return out;
}

std::string_view name_of(const Trial& trial, const Explanation& found) {
  const bool reference = found.channel == Channel::flow && trial.pieces[found.group.front()].role == Role::operation;
  return recording::name(reference ? Channel::flow_reference : found.channel);
}

std::string explained(const Trial& trial, const Explanation& found, const std::vector<Deviation>& before) {
  const Change change = deciding_change(before, found.deviations);
  const std::string what = found.group.empty()
                               ? "the rated flow"
                               : fmt::format("{}: {}", files_of(trial, found.group), name_of(trial, found));
  std::string looks(found.error->looks);
  for (const RecordingError* other : found.alike) looks += fmt::format(", or {}", other->looks);
  return fmt::format("{} looks {}: with {}, {}", what, looks, found.error->undo, text(change));
}

/// Channels that a protocol moves, and that stand still in its recording.
void add_dead_channels(std::vector<Finding>& to, const Trial& trial) {
  constexpr std::array moved{
      Channel::position, Channel::current, Channel::force, Channel::axial_force, Channel::pressure_difference,
      Channel::flow};
  for (const Piece& piece : trial.pieces) {
    const bool maps = piece.role == Role::axial_map;
    for (const Channel channel : moved) {
      if (piece.role == Role::dynamic && channel == Channel::position) continue;  // held by the protocol
      if (!maps && (channel == Channel::pressure_difference || channel == Channel::flow)) continue;
      const std::optional<double> value = standing_value(piece.means.column(channel));
      if (!value) continue;
      to.push_back({true, fmt::format("{}: {} stands still at {} all along: its wire, its column in the "
                                      "channel map or its unit is wrong",
                                      piece.means.file.filename().string(), recording::name(channel),
                                      shown_value(channel, *value))});
    }
  }
}

/// Runs whose reference has other times; their references are shifted back.
void add_reference_shifts(std::vector<Finding>& to, Trial& trial) {
  for (auto& [role, means] : trial.pieces) {
    if (role != Role::operation || !means.has(Channel::flow)) continue;
    const std::vector<double>& time_s = means.column(Channel::time);
    std::vector<double>& reference = means.column(Channel::flow);
    const auto shift = reference_shift(time_s, expected_flow(trial.hydraulics(), means), reference);
    if (!shift) continue;
    to.push_back({true, fmt::format("{}: {}", file_of(means), shown(*shift))});
    reference = values_later(time_s, reference, shift->late_s);
  }
}

/// Positions that count from another zero; each is taken off, and the curves are fitted without it.
void add_zeros(std::vector<Finding>& to, Trial& trial) {
  const std::size_t before = to.size();
  std::vector<Recording*> maps;
  for (auto& [role, means] : trial.pieces) {
    if (role == Role::axial_map) maps.push_back(&means);
  }
  for (Finding& finding : zero_findings(maps, trial.stroke_m())) to.push_back(std::move(finding));
  if (to.size() > before) trial.fit_curves(std::nullopt);
  const KnownValve known = trial.known();
  for (auto& [role, means] : trial.pieces) {
    if (role == Role::spring) {
      const auto finding = spring_zero_finding(means, {maps.begin(), maps.end()}, trial.stroke_m());
      if (finding) to.push_back(*finding);
    }
    if (role != Role::operation) continue;
    for (const Finding& finding : run_zero_findings(means, {&known, 1}))
      to.push_back({finding.cannot_be, fmt::format("{}: {}", file_of(means), finding.text)});
  }
}

}  // namespace

std::vector<Finding> campaign_findings(const Benches& benches) {
  constexpr int most_errors = 3;
  constexpr double left_share = 0.7;  // of the badness: what a recording error must take away to be named
  std::vector<Finding> out;
  Trial trial(benches);
  add_dead_channels(out, trial);
  if (!out.empty()) return out;
  trial.fit_curves(std::nullopt);
  add_reference_shifts(out, trial);
  add_zeros(out, trial);
  std::vector<Deviation> now = trial.deviations();
  for (int round = 0; round < most_errors; ++round) {
    const auto worst = std::ranges::max_element(now, {}, &Deviation::over_limit);
    if (worst == now.end() || !(worst->over_limit > 1)) break;
    const bool cannot_be = worst->over_limit > surely;
    const std::optional<Explanation> found = best_explanation(trial, now);
    if (!found || !(found->badness < left_share * badness(now))) {
      out.push_back(
          {cannot_be, fmt::format("{}{} is {}, which no usual recording error of one channel explains; look at units, "
                                  "signs and channels of the recordings, and whether all are of one valve",
                                  worst->file.empty() ? "" : worst->file + ": ", worst->of, worst->shown)});
      break;
    }
    out.push_back({cannot_be, explained(trial, *found, now)});
    undo(trial, found->group, found->channel, *found->error);
    trial.fit_curves(std::nullopt);
    now = trial.deviations();
  }
  return out;
}

}  // namespace spoolflow::plausibility
