#include "spoolflow/apps/work/notes.hpp"

#include <string_view>

#include <fmt/format.h>

namespace spoolflow::apps {

std::string type_note(const model::Model& model, const std::string& file) {
  if (!model.type || model.type->unit) return {};
  return fmt::format(
      "{}: the model of the type {}: its band and what counts as healthy hold any unit; for those of this unit: "
      "spoolflow calibrate UNIT.toml --type {} -o UNIT.json",
      file, model.type->name, file);
}

std::string bench_note(const model::Model& model) {
  if (!model.observer || !sensor::is_bench(model.observer->parameters.environment)) return {};
  return "the band is that of bench conditions: what a machine leaves open (oil, position's zero, friction, vibration, "
         "ripple) is not in it; for a machine's recording add --environment machine";
}

namespace {

using recording::Channel;

struct Without {
  std::string_view what_then;
  std::vector<Channel> channels;
};

/// What the sensor does where a value of these channels is missing.
const std::vector<Without>& without() {
  static const std::vector<Without> out{
      {"the estimate is held there, with status sample_missing",
       {Channel::current, Channel::current_a, Channel::current_b, Channel::position}},
      {"the last one stands in there, before the first one that of the calibration", {Channel::oil_temperature}},
      {"the coil's diagnosis goes on without them", {Channel::voltage, Channel::voltage_a, Channel::voltage_b}},
      {"forces alone show the pressure there",
       {Channel::pressure_p, Channel::pressure_a, Channel::pressure_b, Channel::pressure_t}}};
  return out;
}

}  // namespace

std::string repeated_times_text(std::uint64_t repeated, std::uint64_t samples) {
  std::string out = fmt::format("{} samples repeat the time stamp before them", repeated);
  if (2 * repeated >= samples && repeated < samples)
    out += fmt::format(" ({:.3g} have the same time on average: write the times with more digits)",
                       static_cast<double>(samples) / static_cast<double>(samples - repeated));
  return out;
}

std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file) {
  std::vector<std::string> out;
  if (notes.duplicate_times > 0) {
    out.push_back(fmt::format("{}: {}; each is estimated, with status time_fault", file,
                              repeated_times_text(notes.duplicate_times, notes.rows)));
  }
  for (const auto& [what_then, channels] : without()) {
    for (const Channel channel : channels) {
      const std::uint64_t missing = notes.missing[static_cast<std::size_t>(channel)];
      if (missing > 0)
        out.push_back(fmt::format("{}: {} values of {} are missing; {}", file, missing, name(channel), what_then));
    }
  }
  if (notes.missing_times + notes.backward_times > 0) {
    out.push_back(fmt::format(
        "{}: {} samples have no time stamp, of {} it runs back; the estimate is held there, with status time_fault",
        file, notes.missing_times, notes.backward_times));
  }
  if (!notes.resampled.empty()) out.push_back(fmt::format("{}: {}", file, notes.resampled));
  if (notes.left_out > 0)
    out.push_back(fmt::format("{}: {} lines are no samples and have no row", file, notes.left_out));
  return out;
}

}  // namespace spoolflow::apps
