#include "spoolflow/recording/channels/channel_unit.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

std::vector<std::string> unit_names(Channel channel) {
  std::vector<std::string> out;
  const auto add = [&out](units::Dimension wanted) {
    for (const units::Unit& unit : units::all_units()) {
      if (unit.dimension == wanted) out.emplace_back(unit.name);
    }
  };
  if (channel == Channel::test) return {"1"};
  add(dimension(channel));
  if (channel == Channel::position) out.emplace_back("percent");
  if (channel == Channel::position_set) add(units::Dimension::length);
  return out;
}

units::Unit usual_unit(Channel channel) {
  if (channel == Channel::test) return {"", "", units::Dimension::ratio, 1};
  return *units::unit_named(channel == Channel::position_set ? "percent" : unit_names(channel).front());
}

units::Unit channel_unit(Channel channel, std::string_view written, std::optional<double> stroke_m,
                         const std::string& place) {
  const std::vector<std::string> allowed = unit_names(channel);
  const std::optional<units::Unit> found = units::unit_named(written);
  if (!found) {
    throw RecordingError(fmt::format("{}: unit '{}' of channel {} is not known{}; allowed: {}", place, written,
                                     name(channel), did_you_mean(written, allowed), listed(allowed)));
  }
  units::Unit unit = *found;
  if (unit.dimension == dimension(channel) && !(channel == Channel::test && unit.name != "1")) return unit;

  const bool position_as_share = channel == Channel::position && unit.dimension == units::Dimension::ratio;
  const bool share_as_length = channel == Channel::position_set && unit.dimension == units::Dimension::length;
  if (!position_as_share && !share_as_length) {
    throw RecordingError(fmt::format(
        "{}: channel {} cannot be in '{}', which is a unit of {}; allowed: {}. Where a sensor's signal stands for "
        "another quantity, give scale, offset and to",
        place, name(channel), written, units::name(unit.dimension), listed(allowed)));
  }
  if (!stroke_m || !(*stroke_m > 0.0)) {
    throw RecordingError(
        fmt::format("{}: channel {} in {} needs the valve's stroke, which is not known here; give it in {} instead "
                    "(a channel map with scale and to does it)",
                    place, name(channel), written, position_as_share ? "mm" : "percent"));
  }
  unit.factor = position_as_share ? unit.factor * *stroke_m : unit.factor / *stroke_m;
  return unit;
}

}  // namespace spoolflow::recording
