#include "spoolflow/recording/inspected_clock.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/clock_follower.hpp"
#include "spoolflow/recording/column_clock.hpp"
#include "spoolflow/recording/files/time_name.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_clocks = 32;

std::optional<std::size_t> column_of(const SampleTable& table, const ChannelMap& map, Channel channel) {
  const auto source = map.sources.find(channel);
  if (source == map.sources.end()) return std::nullopt;
  const auto found = std::ranges::find(table.columns(), source->second.column, &FileColumn::name);
  if (found == table.columns().end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.columns().begin());
}

std::optional<std::size_t> leading_column(const SampleTable& table, const ChannelMap& map) {
  for (const Channel channel : {Channel::current, Channel::current_a, Channel::current_b, Channel::position}) {
    if (const auto column = column_of(table, map, channel)) return column;
  }
  return std::nullopt;
}

/// Columns that are taken for something else than a time.
std::vector<std::size_t> other_columns(const SampleTable& table, const ChannelMap& map) {
  std::vector<std::size_t> out;
  for (const auto& entry : map.sources) {
    const auto column = column_of(table, map, entry.first);
    if (entry.first != Channel::time && column) out.push_back(*column);
  }
  return out;
}

void look_at(InspectedClock& out, SampleTable& table, const ColumnClock& clock, const std::string& usual_unit,
             const std::string& file) {
  try {
    std::string written = clock.time ? unit_of_time(table.columns()[*clock.time]) : "s";
    const auto unit = units::unit_named(written.empty() ? usual_unit : written);
    const ClockSpan span = span_of(table, clock, {unit ? unit->factor : 1.0, 0}, file);
    out.rate_Hz = span.step_s > 0 ? 1 / span.step_s : 0;
    out.begin_s = span.begin_s, out.end_s = span.end_s;
  } catch (const RecordingError& error) {
    out.fault = error.what();
  }
}

}  // namespace

bool propose_leading_time(ChannelMap& proposal, const SampleTable& table, const std::string& file) {
  const auto leading = leading_column(table, proposal);
  if (!leading) {
    return !proposal.sources.contains(Channel::time) &&
           std::ranges::any_of(table.columns(), [](const FileColumn& column) { return !column.wave.empty(); });
  }
  if (!table.samples_of(*leading)) return false;
  const auto named = column_of(table, proposal, Channel::time);
  std::optional<ColumnClock> clock;
  try {
    clock = clock_of(table, *leading, named, other_columns(table, proposal), file);
  } catch (const RecordingError&) {
    return false;  // reading reports it
  }
  if (!clock) return false;
  if (!clock->time) {
    proposal.sources.erase(Channel::time);
    return true;
  }
  if (clock->time == named) return false;
  proposal.sources.erase(Channel::time);
  const FileColumn& column = table.columns()[*clock->time];
  proposal.sources.emplace(Channel::time, ChannelSource{column.name, unit_of_time(column)});
  return false;
}

std::vector<InspectedClock> inspected_clocks(const ChannelMap& proposal,
                                             const std::function<std::unique_ptr<SampleTable>()>& open,
                                             const std::string& file) {
  const std::unique_ptr<SampleTable> table = open();
  if (table->columns().empty() || !table->samples_of(0)) return {};
  const auto usual = column_of(*table, proposal, Channel::time);
  const auto leading = leading_column(*table, proposal);
  const std::vector<std::size_t> others = other_columns(*table, proposal);
  std::vector<std::pair<std::optional<ColumnClock>, InspectedClock>> found;
  for (std::size_t k = 0; k < table->columns().size(); ++k) {
    const FileColumn& column = table->columns()[k];
    if (named_time(column) && std::ranges::find(others, k) == others.end()) continue;
    std::optional<ColumnClock> clock;
    std::string fault;
    try {
      clock = clock_of(*table, k, usual, others, file);
      if (!clock) fault = "no time of as many samples is found for it";
    } catch (const RecordingError& error) {
      fault = error.what();
    }
    const std::uint64_t samples = *table->samples_of(k);
    auto same = std::ranges::find_if(found, [&](const auto& entry) {
      return entry.first == clock && entry.second.samples == samples && entry.second.fault == fault;
    });
    if (same == found.end()) {
      if (found.size() == most_clocks) break;
      InspectedClock fresh;
      fresh.samples = samples, fresh.fault = fault;
      if (clock && clock->time) fresh.time = table->columns()[*clock->time].name;
      found.emplace_back(clock, std::move(fresh));
      same = std::prev(found.end());
    }
    same->second.columns.push_back(column.name);
    same->second.leads = same->second.leads || k == leading;
  }
  if (found.size() < 2) return {};
  const auto unit = usual ? unit_of_time(table->columns()[*usual]) : std::string("s");
  std::vector<InspectedClock> out;
  for (auto& [clock, each] : found) {
    if (clock) look_at(each, *open(), *clock, unit, file);
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace spoolflow::recording
