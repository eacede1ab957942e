#include "spoolflow/calibration/references/direction_view.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/one_side.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Reference;
using recording::ReferenceKind;

void require_usable(const Reference& reference, const model::Model& model) {
  if (!model.whole()) {
    if (reference.direction.empty() || reference.direction == model.valve.direction) return;
    throw CalibrationError(
        fmt::format("{}: {} is of direction \"{}\", and the model of \"{}\" alone; leave it out, or give the model of "
                    "the whole valve",
                    reference.place, reference.name, reference.direction, model.valve.direction));
  }
  const bool counted = reference.kind == ReferenceKind::stroke || reference.kind == ReferenceKind::pump;
  if (counted && reference.direction.empty()) {
    throw CalibrationError(
        fmt::format("{}: {} does not say which direction of the whole valve passes its oil; write direction = \"b\" "
                    "(P to B) or \"a\" (P to A), a table for each",
                    reference.place, reference.name));
  }
  if (reference.kind == ReferenceKind::stroke && reference.ends == recording::EndsSeen::stalled) {
    throw CalibrationError(
        fmt::format("{}: {}: ends = \"stalled\" serves a model of one direction; see the ends by \"switch\", "
                    "\"pressure\" or \"marks\"",
                    reference.place, reference.name));
  }
}

/// A whole valve's sensor finds its zero at rest, and a meter without direction is of both.
bool is_of(const Reference& reference, const model::Model& model, const std::string& direction) {
  if (!model.whole()) return true;
  if (reference.kind == ReferenceKind::closed) return false;
  return reference.direction.empty() || reference.direction == direction;
}

const sensor::ObserverParameters<double>& observer_of(const model::Model& model, const std::string& direction) {
  return (model.whole() && direction == "a" ? model.p_to_a->observer : model.observer)->parameters;
}

bool opens_beyond(std::span<const double> position_m, double closed_below_m) {
  return std::ranges::any_of(position_m, [&](double position) { return position > closed_below_m; });
}

/// Whether a recording of the reference opens this direction at all.
bool is_seen(const Reference& reference, const DirectionView& view, double closed_below_m) {
  return std::ranges::any_of(view.recordings, [&](const recording::Recording* recording) {
    return (reference.recording.empty() || reference.recording == recording->file.filename().string()) &&
           opens_beyond((*recording)[Channel::position], closed_below_m);
  });
}

void add_side(const recording::Recording& whole, const model::Model& model, const std::string& direction,
              DirectionView& out) {
  OneSide side = one_side(whole, direction, model.valve.stroke_m);
  for (double& position_m : side.run.column(Channel::position)) position_m -= side.closed_m;
  for (double& flow : side.run.column(Channel::flow_reference)) flow = std::abs(flow);  // a meter may know no direction
  const double sign = direction == "a" ? -1 : 1;
  const double other_m = observer_of(model, direction == "a" ? "b" : "a").closed_below_m;
  std::vector<bool> other_opens;
  for (const double position_m : whole[Channel::position])
    other_opens.push_back(side.closed_m - sign * position_m > other_m);
  out.other_opens.push_back(std::move(other_opens));
  out.recordings.push_back(&out.made.emplace_back(std::move(side.run)));
}

}  // namespace

DirectionView view_of_direction(const model::Model& model, const std::string& direction,
                                const std::vector<recording::Recording>& recordings,
                                const std::vector<recording::Reference>& references) {
  DirectionView out{direction, {}, {}, {}, {}};
  for (const Reference& each : references) require_usable(each, model);
  for (const recording::Recording& each : recordings) {
    if (model.whole()) {
      add_side(each, model, direction, out);
    } else {
      out.recordings.push_back(&each);
      out.other_opens.emplace_back();
    }
  }
  const double closed_below_m = observer_of(model, direction).closed_below_m;
  for (const Reference& each : references) {
    const bool of_both = model.whole() && each.direction.empty();
    if (is_of(each, model, direction) && (!of_both || is_seen(each, out, closed_below_m)))
      out.references.push_back(each);
  }
  return out;
}

}  // namespace spoolflow::calibration
