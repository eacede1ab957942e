#include "spoolflow/recording/resampled_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/clock_follower.hpp"
#include "spoolflow/recording/column_clock.hpp"
#include "spoolflow/recording/files/time_name.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr double much_faster = 0.9;  // of the current's step: below it, means are taken

/// Columns of one clock that is not the current's.
struct Group {
  ColumnClock clock;
  std::vector<std::size_t> columns;
  TimeScale scale{};
  ClockSpan span{};
};

/// Time stamps without a unit are in that of the recording's time.
TimeScale scale_of(const SampleTable& table, const ColumnClock& clock, const BoundColumn& time,
                   const std::string& file) {
  if (!clock.time || *clock.time == time.column) return {time.gain, time.offset};
  const FileColumn& column = table.columns()[*clock.time];
  const std::string written = unit_of_time(column);
  if (written.empty()) return {time.gain, time.offset};
  const auto unit = units::unit_named(written);
  if (!unit || unit->dimension != units::Dimension::time) {
    throw RecordingError(
        fmt::format("{}: '{}' is the time of other columns, but '{}' is no unit of time; write s, ms or us", file,
                    column.name, written));
  }
  return {unit->factor, unit->offset};
}

/// Whether two columns of times, equally long, say the same.
bool same_times(SampleTable& table, std::size_t one, TimeScale of_one, std::size_t other, TimeScale of_other) {
  constexpr std::size_t rows_at_once = 4096;
  std::array<std::vector<double>, 2> block{std::vector<double>(rows_at_once), std::vector<double>(rows_at_once)};
  const std::array<double*, 2> into{block[0].data(), block[1].data()};
  table.select({one, other});
  double last_s = NAN;
  for (std::size_t rows = table.read(into, rows_at_once); rows > 0; rows = table.read(into, rows_at_once)) {
    for (std::size_t row = 0; row < rows; ++row) {
      const double a = of_one.gain * block[0][row] + of_one.offset, b = of_other.gain * block[1][row] + of_other.offset;
      const double step_s = std::isnan(last_s) ? 0 : std::abs(a - last_s);
      constexpr double share = 1e-3;  // of a step
      if (!(std::abs(a - b) <= std::max(share * step_s, 1e-12 * std::abs(a)))) return false;
      last_s = a;
    }
  }
  return true;
}

/// The current's columns from the table itself, those of other clocks by followers.
class ResampledTable final : public SampleTable {
 public:
  struct Followed {
    std::vector<std::size_t> columns;
    std::unique_ptr<ClockFollower> follower;
  };
  ResampledTable(std::unique_ptr<SampleTable> own, const ColumnClock& clock, TimeScale scale, std::size_t time,
                 std::vector<Followed> followed)
      : own_(std::move(own)), clock_(clock), scale_(scale), time_(time), followed_(std::move(followed)) {}

  [[nodiscard]] const std::vector<FileColumn>& columns() const override { return own_->columns(); }
  [[nodiscard]] std::optional<std::uint64_t> samples_of(std::size_t column) const override {
    return own_->samples_of(column);
  }
  [[nodiscard]] std::vector<UnreadPart> unread() const override { return own_->unread(); }
  [[nodiscard]] std::string lost() const override { return own_->lost(); }
  [[nodiscard]] std::string place(std::size_t row) const override { return own_->place(row); }
  [[nodiscard]] std::optional<double> progress() const override { return own_->progress(); }

  void select(const std::vector<std::size_t>& columns) override {
    slot_of_.clear();
    own_slots_.clear();
    std::vector<std::size_t> own;
    for (std::size_t slot = 0; slot < columns.size(); ++slot) {
      slot_of_[columns[slot]] = slot;
      const bool elsewhere = std::ranges::any_of(followed_, [&](const Followed& each) {
        return std::ranges::find(each.columns, columns[slot]) != each.columns.end();
      });
      if (elsewhere || (!clock_.time && columns[slot] == time_)) continue;
      own.push_back(columns[slot]);
      own_slots_.push_back(slot);
    }
    own_->select(own);
  }

  std::size_t read(std::span<double* const> out, std::size_t rows) override {
    std::vector<double*> own;
    for (const std::size_t slot : own_slots_) own.push_back(out[slot]);
    const std::size_t count = own_->read(own, rows);
    double* const time = out[slot_of_.at(time_)];
    if (!clock_.time) {
      for (std::size_t row = 0; row < count; ++row) {
        time[row] = clock_.wave.at(read_ + row);
      }
    }
    read_ += count;
    for (const Followed& each : followed_) {
      std::vector<double> values(each.columns.size());
      double last_s = -INFINITY;
      for (std::size_t row = 0; row < count; ++row) {
        const double time_s = scale_.gain * time[row] + scale_.offset;
        if (time_s >= last_s) each.follower->values(time_s, values);  // else the recording is refused for it
        last_s = time_s;
        for (std::size_t k = 0; k < values.size(); ++k) out[slot_of_.at(each.columns[k])][row] = values[k];
      }
    }
    return count;
  }

 private:
  std::unique_ptr<SampleTable> own_;
  ColumnClock clock_;
  TimeScale scale_;
  std::size_t time_;  ///< column of the recording's time; beyond the last where there is none
  std::vector<Followed> followed_;
  std::map<std::size_t, std::size_t> slot_of_;
  std::vector<std::size_t> own_slots_;
  std::uint64_t read_ = 0;
};

/// Which of the bound columns are of which clock.
class Clocks {
 public:
  Clocks(const SampleTable& table, const std::vector<BoundColumn>& bound, const OpenAgain& open,
         const std::string& file)
      : table_(table), time_(bound.front()), open_(open), file_(file) {
    for (const BoundColumn& column : bound) {
      if (column.channel != Channel::time) others_.push_back(column.column);
    }
    const std::size_t lead = leading_channel(bound)->column;
    const bool by_column = time_.column < table.columns().size();
    const FileColumn& leading = table.columns()[lead];
    own_ = by_column ? ColumnClock{time_.column, {}, *table.samples_of(time_.column)}
                     : ColumnClock{std::nullopt, leading.wave, *table.samples_of(lead)};
    if (*table.samples_of(lead) != own_.samples) {
      throw RecordingError(
          fmt::format("{}: '{}' holds {} samples but its time '{}' holds {}; name the time of '{}' in a channel map, "
                      "with as many samples",
                      file, leading.name, *table.samples_of(lead), time_.name, own_.samples, leading.name));
    }
    for (const BoundColumn& column : bound) {
      if (column.channel != Channel::time && column.column != lead) sort_in(column.column, leading.name);
    }
  }

  [[nodiscard]] const ColumnClock& own() const { return own_; }
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

 private:
  void sort_in(std::size_t column, const std::string& leading) {
    const auto usual = own_.time;
    const auto clock = clock_of(table_, column, usual, others_, file_);
    if (!clock && table_.samples_of(column) == own_.samples) return;
    if (!clock) {
      const std::string& name = table_.columns()[column].name;
      throw RecordingError(fmt::format(
          "{}: '{}' holds {} samples but '{}' holds {}, and no time of {} samples is found for it; write its "
          "time beside it (time_s in its group, or as {}_time_s), or resample it",
          file_, name, *table_.samples_of(column), leading, own_.samples, *table_.samples_of(column),
          table_.columns()[column].leaf));
    }
    if (*clock == own_ || is_own(*clock)) return;
    const auto same = std::ranges::find(groups_, *clock, &Group::clock);
    if (same != groups_.end()) {
      same->columns.push_back(column);
      return;
    }
    groups_.push_back({*clock, {column}, scale_of(table_, *clock, time_, file_)});
  }

  /// Another column of the same times.
  bool is_own(const ColumnClock& clock) {
    if (!clock.time || !own_.time || clock.samples != own_.samples) return false;
    if (std::ranges::find(own_too_, *clock.time) != own_too_.end()) return true;
    if (std::ranges::any_of(groups_, [&](const Group& group) { return group.clock == clock; })) return false;
    const std::unique_ptr<SampleTable> again = open_();
    const TimeScale scale{time_.gain, time_.offset};
    if (!same_times(*again, *own_.time, scale, *clock.time, scale_of(table_, clock, time_, file_))) return false;
    own_too_.push_back(*clock.time);
    return true;
  }

  const SampleTable& table_;
  const BoundColumn& time_;
  const OpenAgain& open_;
  const std::string& file_;
  std::vector<std::size_t> others_;
  ColumnClock own_;
  std::vector<std::size_t> own_too_;
  std::vector<Group> groups_;
};

[[noreturn]] void refuse_apart(const std::string& file, const std::string& column, const ClockSpan& its,
                               const std::string& leading, const ClockSpan& own) {
  throw RecordingError(
      fmt::format("{}: '{}' was sampled from {:.6g} to {:.6g} s and '{}' from {:.6g} to {:.6g} s: they have no time in "
                  "common; let both count from the same instant",
                  file, column, its.begin_s, its.end_s, leading, own.begin_s, own.end_s));
}

}  // namespace

std::string sentence(const std::vector<Resampling>& resampled, const std::string& current) {
  if (resampled.empty()) return {};
  std::string out = fmt::format("resampled onto the time of '{}' ({:.4g} Hz):", current, resampled.front().to_Hz);
  for (const Resampling& each : resampled) {
    out += &each == resampled.data() ? "" : ";";
    for (const std::string& column : each.columns)
      out += fmt::format("{} '{}'", &column == each.columns.data() ? "" : ",", column);
    out += fmt::format(" from {:.4g} Hz by {}", each.from_Hz,
                       each.mean ? "the mean over each time step" : "linear interpolation");
    if (each.late) out += fmt::format(", missing before {:.6g} s", each.begin_s);
    if (each.early) out += fmt::format("{} after {:.6g} s", each.late ? " and" : ", missing", each.end_s);
  }
  return out;
}

OneClock on_one_clock(std::unique_ptr<SampleTable> table, const std::vector<BoundColumn>& bound, const OpenAgain& open,
                      const std::string& file) {
  const BoundColumn* const leading = leading_channel(bound);
  if (table->columns().empty() || !table->samples_of(0) || leading == nullptr) return {std::move(table)};
  const Clocks clocks(*table, bound, open, file);
  if (clocks.groups().empty() && clocks.own().time) return {std::move(table)};
  const TimeScale scale{bound.front().gain, bound.front().offset};
  const ClockSpan own = span_of(*open(), clocks.own(), scale, file);
  std::vector<ResampledTable::Followed> followed;
  std::vector<Resampling> resampled;
  for (Group group : clocks.groups()) {
    group.span = span_of(*open(), group.clock, group.scale, file);
    std::vector<std::string> names;
    for (const std::size_t column : group.columns) names.push_back(table->columns()[column].name);
    if (group.span.end_s < own.begin_s || group.span.begin_s > own.end_s)
      refuse_apart(file, names.front(), group.span, leading->name, own);
    const bool mean = group.span.step_s < much_faster * own.step_s;
    const bool late = group.span.begin_s > own.begin_s + own.step_s / 2;
    const bool early = group.span.end_s < own.end_s - own.step_s / 2;
    const auto rate = [](const ClockSpan& span) { return span.step_s > 0 ? 1 / span.step_s : 0.0; };
    resampled.push_back({names, rate(group.span), rate(own), mean, group.span.begin_s, group.span.end_s, late, early});
    auto follower = std::make_unique<ClockFollower>(open(), group.columns, group.clock, group.scale, group.span,
                                                    mean ? own.step_s : 0.0);
    followed.push_back({group.columns, std::move(follower)});
  }
  auto out = std::make_unique<ResampledTable>(std::move(table), clocks.own(), scale, bound.front().column,
                                              std::move(followed));
  return {std::move(out), sentence(resampled, leading->name)};
}

}  // namespace spoolflow::recording
