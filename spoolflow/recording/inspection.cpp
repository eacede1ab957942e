#include "spoolflow/recording/inspection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/numerics/held_extremes.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/column_survey.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/time_name.hpp"
#include "spoolflow/recording/proposal.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t gaps_listed = 10;
constexpr double gap_steps = 3;
constexpr std::size_t steps_learned = 2000;  ///< time steps from which the median is taken

/// A channel followed through the stream.
struct Follower {
  numerics::HeldExtremes extremes;
  double sum = 0;
  std::uint64_t missing = 0;

  void take(double value) {
    extremes.take(value);
    if (std::isnan(value)) {
      ++missing;
    } else {
      sum += value;
    }
  }
  [[nodiscard]] ChannelSummary summary(Channel channel) const {
    const auto n = static_cast<double>(std::max<std::uint64_t>(1, extremes.samples));
    const bool any = extremes.samples > 0, moves = extremes.highest > extremes.lowest;
    return {channel,
            any ? extremes.lowest : NAN,
            any ? extremes.highest : NAN,
            any ? sum / n : NAN,
            missing,
            moves ? static_cast<double>(extremes.at_lowest + extremes.at_highest) / n : 0.0};
  }
};

/// Time steps: their median from the first ones, then jitter and gaps.
class Steps {
 public:
  void take(double time_s, Inspection& out) {
    if (std::isnan(last_s_)) out.begin_s = time_s;
    out.end_s = time_s;
    const double step_s = time_s - last_s_;
    if (step_s > 0) {
      if (median_s_ == 0) {
        learned_.push_back({last_s_, step_s});
        if (learned_.size() >= steps_learned) settle(out);
      } else {
        judge(last_s_, step_s, out);
      }
    }
    last_s_ = time_s;
  }
  void settle(Inspection& out) {
    if (learned_.empty() || median_s_ > 0) return;
    std::vector<double> steps;
    for (const auto& [from, step] : learned_) steps.push_back(step);
    median_s_ = numerics::median(std::move(steps));
    out.rate_Hz = 1 / median_s_;
    for (const auto& [from, step] : learned_) judge(from, step, out);
    learned_.clear();
  }

 private:
  void judge(double from_s, double step_s, Inspection& out) const {
    if (step_s <= gap_steps * median_s_) {
      out.jitter = std::max(out.jitter, std::abs(step_s / median_s_ - 1));
      return;
    }
    ++out.gap_count;
    if (out.gaps.size() < gaps_listed) out.gaps.push_back({from_s, from_s + step_s});
  }
  double last_s_ = NAN;
  double median_s_ = 0;
  std::vector<std::pair<double, double>> learned_;
};

/// What the columns' own names say of their channels.
struct OwnNames {
  bool of_a_unit = false, of_time = false;
  bool suffice = true;  ///< each with its unit, and none of two columns
};

OwnNames own_names(const FileContents& contents, const Proposal& proposal, bool several_clocks) {
  OwnNames out;
  std::size_t times = 0, others = 0;
  for (const FileColumn& column : contents.columns) {
    const auto header = channel_header(column);
    if (!header) continue;
    out.of_a_unit = out.of_a_unit || !header->unit.empty();
    ++(header->channel == Channel::time ? times : others);
    if (header->channel == Channel::time && several_clocks) {  // each rate may have one, some without a unit
      out.of_time = true;
      continue;
    }
    out.of_time = out.of_time || header->channel == Channel::time;
    if (header->unit.empty() || proposal.as_well.contains(header->channel)) {
      out.suffice = false;
    }
  }
  if (times > 1 && others == 0) out.suffice = false;
  return out;
}

/// A channel map can be read where it states all units and no raw signal.
ChannelMap known_units(ChannelMap map) {
  std::erase_if(map.sources, [](const auto& entry) {
    const auto unit = units::unit_named(entry.second.unit);
    return !unit || unit->dimension != dimension(entry.first);
  });
  return map;
}

std::string how_known(const FileColumn& column, Channel channel) {
  const auto header = channel_header(column);
  if (header && header->exact && header->channel == channel) return "its own name";
  return column.name.ends_with(column.leaf) ? "by its name" : "by its label '" + column.leaf + "'";
}

/// Says of each channel that several columns could be which ones those are. Times of several rates are no such case.
void say_what_could_be_it(Inspection& out, const Proposal& proposal) {
  for (const auto& [channel, columns] : proposal.as_well) {
    const auto source = out.proposal.sources.find(channel);
    if (source == out.proposal.sources.end() || (channel == Channel::time && !out.clocks.empty())) continue;
    std::vector<std::string> quoted;
    for (const std::string& column : columns) {
      if (column != source->second.column) quoted.push_back("'" + column + "'");
    }
    if (!quoted.empty()) out.remarks.emplace(channel, "a guess, check it: it could be " + listed(quoted) + " as well");
  }
}

/// Of the pressures of all four ports, those that are before and behind the edge of a bench with one direction.
void say_what_a_bench_calls_them(Inspection& out, const Proposal& proposal) {
  if (!proposal.all_ports) return;
  out.remarks.emplace(Channel::pressure_p, "of a bench that opens P to B alone: pressure_upstream");
  out.remarks.emplace(Channel::pressure_b, "of a bench that opens P to B alone: pressure_downstream");
}

/// What every sensor needs.
void find_missing(Inspection& out) {
  const auto lacks = [&](Channel channel) { return !out.proposal.sources.contains(channel); };
  const bool both_coils = !lacks(Channel::current_a) && !lacks(Channel::current_b);
  for (const Channel channel : {Channel::time, Channel::current, Channel::position}) {
    if (lacks(channel) && !(channel == Channel::current && both_coils)) out.missing.push_back(channel);
  }
  const bool both_voltages = !lacks(Channel::voltage_a) && !lacks(Channel::voltage_b);
  if (lacks(Channel::voltage) && !both_voltages) out.helpful.push_back(Channel::voltage);
  if (lacks(Channel::oil_temperature)) out.helpful.push_back(Channel::oil_temperature);
  if (lacks(Channel::flow) && lacks(Channel::flow_reference)) out.helpful.push_back(Channel::flow_reference);
}

std::vector<SurveyedColumn> survey_of(const std::function<std::unique_ptr<SampleTable>()>& open) {
  return survey_columns([&] {
    auto table = open();
    table->let_infinite_pass();
    return table;
  });
}

/// Which columns were looked at in vain.
std::vector<bool> numberless(const std::vector<SurveyedColumn>& columns) {
  std::vector<bool> out;
  for (const SurveyedColumn& column : columns) out.push_back(column.rows > 0 && column.samples == 0);
  return out;
}

/// A time without a unit that counts from 1970, of which its size says the unit.
void guess_unit_of_time(Inspection& out, const std::vector<SurveyedColumn>& columns) {
  const auto time = out.proposal.sources.find(Channel::time);
  if (time == out.proposal.sources.end() || !time->second.unit.empty()) return;
  const auto column = std::ranges::find(columns, time->second.column, &SurveyedColumn::name);
  constexpr std::array<std::pair<const char*, double>, 4> in_2001{
      {{"s", 1e9}, {"ms", 1e12}, {"us", 1e15}, {"ns", 1e18}}};
  for (const auto& [unit, value] : in_2001) {
    if (column == columns.end() || !(column->lowest >= value && column->highest < 4 * value)) continue;
    time->second.unit = unit;
    std::string& remark = out.remarks[Channel::time];
    remark += fmt::format("{} in {} it counts from 1970", remark.empty() ? "a guess, check it:" : ";", unit);
  }
}

/// Guesses by data what names do not state, and says of every column what it is taken for.
void look_at_columns(Inspection& out, const Proposal& proposal, std::vector<SurveyedColumn> columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k].unit = out.contents.columns[k].unit;
    columns[k].said = named_time(out.contents.columns[k]) ? Channel::time : proposal.said[k];
  }
  std::map<Channel, std::size_t> known;
  for (const auto& [channel, source] : out.proposal.sources) {
    const auto found = std::ranges::find(out.contents.columns, source.column, &FileColumn::name);
    known.emplace(channel, static_cast<std::size_t>(found - out.contents.columns.begin()));
  }
  const std::map<Channel, DataGuess> guesses = guess_by_data(columns, known);
  for (const auto& [channel, guess] : guesses) {
    const SurveyedColumn& column = columns[guess.column];
    const auto unit = units::unit_named(column.unit);
    const bool fits = unit && (unit->dimension == dimension(channel) || unit->dimension == units::Dimension::voltage);
    out.proposal.sources.try_emplace(channel, ChannelSource{column.name, fits ? column.unit : ""});
    known.emplace(channel, guess.column);
  }
  std::map<Channel, std::string> reasons;
  for (const auto& [channel, guess] : guesses) reasons.emplace(channel, guess.why);
  for (const auto& [channel, word] : proposal.by_word)
    reasons.emplace(channel, fmt::format("its name holds the word '{}'", word));
  for (const auto& [channel, why] : reasons) out.remarks.emplace(channel, "a guess, check it: " + why);
  guess_unit_of_time(out, columns);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    InspectedColumn& each = out.columns.emplace_back();
    each.name = columns[k].name, each.unit = columns[k].unit;
    each.lowest = columns[k].lowest, each.highest = columns[k].highest;
    if (columns[k].infinite.count > 0) out.infinite.emplace(each.name, columns[k].infinite);
    const auto taken = std::ranges::find_if(known, [&](const auto& entry) { return entry.second == k; });
    each.times_others = std::ranges::count(out.clocks, each.name, &InspectedClock::time) > 0;
    if (taken == known.end() && each.times_others) {
      each.why = "the time of other columns";
      continue;
    }
    if (taken == known.end()) {
      each.why = character_of(columns[k]);
      const FileColumn& named = out.contents.columns[k];
      if (!named.name.ends_with(named.leaf))
        each.why += (each.why.empty() ? "" : "; ") + ("labelled '" + named.leaf + "'");
      continue;
    }
    each.channel = taken->first;
    const auto reason = reasons.find(taken->first);
    each.guessed = reason != reasons.end();
    each.why = each.guessed ? reason->second : how_known(out.contents.columns[k], taken->first);
    if (columns[k].samples == 0 || columns[k].text.count > 0) each.why += "; " + character_of(columns[k]);
  }
}

}  // namespace

Inspection inspect(const std::filesystem::path& file, const ReadOptions& options,
                   const std::function<void(std::optional<double>, std::uint64_t)>& progress) {
  const RepeatedInput input(file);
  Inspection out;
  out.contents = contents_of(input.open());
  const auto open_table = [&input] { return open_sample_table(input.open(), CsvTable::Text::counted).table; };
  std::vector<SurveyedColumn> columns;
  if (options.channels.sources.empty()) columns = survey_of(open_table);
  const Proposal proposal = propose_channels(out.contents, numberless(columns));
  out.proposal = proposal.map;
  bool even = false;  // sampled evenly, as the file says, without a column of time
  bool several_clocks = false;
  {
    const auto table = open_table();
    several_clocks = !table->columns().empty() && table->samples_of(0).has_value();
    even = propose_leading_time(out.proposal, *table, file.string());
  }
  out.clocks =
      inspected_clocks(options.channels.sources.empty() ? out.proposal : options.channels, open_table, file.string());
  if (options.channels.sources.empty()) {
    say_what_could_be_it(out, proposal);
    say_what_a_bench_calls_them(out, proposal);
    look_at_columns(out, proposal, std::move(columns));
    find_missing(out);
    if (even) std::erase(out.missing, Channel::time);
  }
  ReadOptions channels = options;
  channels.infinite_is_missing = true;
  const OwnNames own = own_names(out.contents, proposal, several_clocks);
  const bool maps_itself = own.suffice && own.of_a_unit && (own.of_time || even);
  if (options.channels.sources.empty() && !maps_itself) {  // names alone do not, but with units of their own they may
    channels.channels = known_units(out.proposal);
    const bool timed = even || channels.channels.sources.contains(Channel::time);
    if (!timed || channels.channels.sources.size() < 2) return out;
  }
  const auto reader = open_reader(input.open(), channels);
  std::array<Follower, channel_count> followers;
  Steps steps;
  SampleBlock block;
  while (reader->next(block)) {
    for (const Channel channel : all_channels) {
      for (const double value : block.columns[static_cast<std::size_t>(channel)])
        followers[static_cast<std::size_t>(channel)].take(value);
    }
    for (const double time_s : block.columns[static_cast<std::size_t>(Channel::time)]) steps.take(time_s, out);
    progress(reader->progress(), reader->notes().rows);
  }
  steps.settle(out);
  out.samples = reader->notes().rows;
  out.resampled = reader->notes().resampled;
  out.duplicate_times = reader->notes().duplicate_times;
  for (const auto& [channel, infinite] : reader->notes().infinite) {
    const auto source = options.channels.sources.find(channel);
    if (source != options.channels.sources.end()) out.infinite.emplace(source->second.column, infinite);
  }
  for (const Channel channel : all_channels) {
    if (reader->has(channel)) out.channels.push_back(followers[static_cast<std::size_t>(channel)].summary(channel));
  }
  return out;
}

}  // namespace spoolflow::recording
