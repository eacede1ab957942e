#include "spoolflow/recording/column_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_columns = 1024, columns_at_once = 64, most_lengths = 16, kept_samples = 20'000,
                      block_samples = 4096;
constexpr std::size_t least_samples = 50;
constexpr int most_lag = 100;           // samples
constexpr double along = 0.5;           // correlation from which two columns go together
constexpr double closely_along = 0.8;   // of voltage and current
constexpr double slow_share = 0.002;    // of a column's range, the largest mean step of what drifts
constexpr double noise_over_range = 3;  // a range that is hardly more than the noise is no signal

/// Those of each length, the most frequent first.
std::vector<std::vector<std::size_t>> equally_long(const SampleTable& table) {
  std::map<std::uint64_t, std::vector<std::size_t>> by_length;
  for (std::size_t k = 0; k < table.columns().size(); ++k) by_length[table.samples_of(k).value_or(0)].push_back(k);
  std::vector<std::vector<std::size_t>> out;
  for (auto& [length, columns] : by_length) out.push_back(std::move(columns));
  std::ranges::stable_sort(out, std::ranges::greater{}, [](const auto& columns) { return columns.size(); });
  if (out.size() > most_lengths) out.resize(most_lengths);
  for (std::vector<std::size_t>& columns : out) columns.resize(std::min(columns.size(), most_columns));
  return out;
}

void take(SurveyedColumn& column, const std::vector<double>& values, std::size_t rows, double& last, bool kept) {
  const std::uint64_t before = column.rows;
  column.rows += rows;
  for (std::size_t k = 0; k < rows; ++k) {
    const bool infinite = std::isinf(values[k]);
    if (infinite) column.infinite.take(values[k], before + k + 1);
    const double value = infinite ? std::numeric_limits<double>::quiet_NaN() : values[k];
    if (kept && column.beginning.size() < kept_samples) column.beginning.push_back(value);
    if (std::isnan(value)) {
      column.rises = false;
      continue;
    }
    if (column.samples == 0) {
      column.lowest = column.highest = value;
    } else {
      column.rises = column.rises && value > last;
    }
    column.lowest = std::min(column.lowest, value);
    column.highest = std::max(column.highest, value);
    ++column.samples;
    last = value;
  }
}

bool stated_as(const SurveyedColumn& column, units::Dimension dimension) {
  const auto unit = units::unit_named(column.unit);
  return column.unit.empty() || (unit && unit->dimension == dimension);
}

double range_of(const SurveyedColumn& column) {
  return column.highest - column.lowest;
}

double mean_step(const SurveyedColumn& column) {
  double sum = 0, count = 0;
  for (std::size_t k = 1; k < column.beginning.size(); ++k) {
    const double step = std::abs(column.beginning[k] - column.beginning[k - 1]);
    if (!std::isnan(step)) sum += step, ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// More than noise about a value.
bool moves(const SurveyedColumn& column) {
  return column.samples >= least_samples && range_of(column) > noise_over_range * mean_step(column);
}

/// Largest correlation of two columns over the lags up to a hundred samples, and the lag by which `second` comes later.
struct Alongside {
  double correlation = 0;
  int lag = 0;
};

Alongside compare(const SurveyedColumn& one, const SurveyedColumn& other) {
  Alongside out;
  if (one.rows != other.rows) return out;
  const std::vector<double>&first = one.beginning, &second = other.beginning;
  const int n = static_cast<int>(std::min(first.size(), second.size()));
  const int most = std::min(most_lag, n / 10);
  for (int lag = -most; lag <= most; ++lag) {
    double count = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (int k = std::max(0, -lag); k < std::min(n, n - lag); ++k) {
      const double a = first[static_cast<std::size_t>(k)], b = second[static_cast<std::size_t>(k + lag)];
      if (std::isnan(a) || std::isnan(b)) continue;
      ++count, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
    }
    const double spread = (count * xx - x * x) * (count * yy - y * y);
    if (!(spread > 0)) continue;
    const double correlation = (count * xy - x * y) / std::sqrt(spread);
    const bool better = std::abs(correlation) > std::abs(out.correlation) + 1e-6;
    const bool nearer = std::abs(correlation) > std::abs(out.correlation) - 1e-6 && std::abs(lag) < std::abs(out.lag);
    if (better || nearer) out = {correlation, lag};
  }
  return out;
}

bool drifts(const SurveyedColumn& column) {
  const bool warm = (column.lowest >= 5 && column.highest <= 120) || (column.lowest >= 278 && column.highest <= 393);
  if (!warm || column.samples < least_samples) return false;
  // Over half of the samples it hardly goes anywhere, and single steps are small beside a degree.
  const double whole = range_of(column);
  return whole > 0 && whole < 30 && mean_step(column) < std::max(0.05, slow_share * whole);
}

class Guesser {
 public:
  Guesser(const std::vector<SurveyedColumn>& columns, std::map<Channel, std::size_t> known)
      : columns_(columns), known_(std::move(known)), used_(columns.size(), false) {
    for (const auto& [channel, column] : known_) used_.at(column) = true;
  }

  std::map<Channel, DataGuess> guesses() {
    time();
    current_and_position();
    voltage();
    oil_temperature();
    return std::move(out_);
  }

 private:
  /// A position may be in volts: the raw signal of its sensor.
  [[nodiscard]] bool free(std::size_t column, units::Dimension dimension) const {
    const std::optional<Channel> said = columns_[column].said;
    return !used_[column] && (!said || recording::dimension(*said) == dimension) &&
           (stated_as(columns_[column], dimension) ||
            (dimension == units::Dimension::length && stated_as(columns_[column], units::Dimension::voltage)));
  }
  [[nodiscard]] std::optional<std::size_t> column_of(Channel channel) const {
    const auto found = known_.find(channel);
    return found == known_.end() ? std::nullopt : std::optional(found->second);
  }
  void choose(Channel channel, std::size_t column, std::string why) {
    used_[column] = true;
    known_.emplace(channel, column);
    out_.emplace(channel, DataGuess{column, std::move(why)});
  }
  [[nodiscard]] const std::string& name(std::size_t column) const { return columns_[column].name; }

  /// The column of which that holds; nothing where it holds of several, of which the first is none the better.
  template <class Holds>
  [[nodiscard]] std::optional<std::size_t> only_one(Holds&& holds) const {
    std::optional<std::size_t> out;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!holds(k)) continue;
      if (out) return std::nullopt;
      out = k;
    }
    return out;
  }

  /// The only column that states a unit of that quantity.
  void take_only(Channel wanted, const char* why) {
    if (column_of(wanted)) return;
    const auto only = only_one([&](std::size_t k) {
      const SurveyedColumn& column = columns_[k];
      return !used_[k] && column.samples > 0 && !column.unit.empty() && stated_as(column, dimension(wanted));
    });
    if (only) choose(wanted, *only, why);
  }

  void time() {
    if (column_of(Channel::time)) return;
    const auto rises = [this](std::size_t k) {
      return free(k, units::Dimension::time) && columns_[k].rises && columns_[k].samples >= 2;
    };
    if (const auto only = only_one(rises)) choose(Channel::time, *only, "it rises with every sample");
  }

  /// `anchor` is known; the wanted one comes later (position after current) or earlier.
  void beside(std::size_t anchor, Channel wanted, units::Dimension dimension, int side) {
    Alongside best;
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!free(k, dimension) || !moves(columns_[k])) continue;
      const Alongside each = compare(columns_[anchor], columns_[k]);
      if (side * each.lag <= 0 || std::abs(each.correlation) <= std::max(along, std::abs(best.correlation))) continue;
      best = each, found = k;
    }
    if (!found) return;
    choose(wanted, *found,
           fmt::format("{} {} samples {} '{}' does", side > 0 ? "it moves" : "it rises", std::abs(best.lag),
                       side > 0 ? "after" : "before", name(anchor)));
  }

  void current_and_position() {
    if (column_of(Channel::current_a) || column_of(Channel::current_b)) return;
    take_only(Channel::current, "no other column is a current");
    const auto current = column_of(Channel::current), position = column_of(Channel::position);
    if (current && !position) beside(*current, Channel::position, units::Dimension::length, 1);
    if (position && !current) beside(*position, Channel::current, units::Dimension::current, -1);
    if (!current && !position) pair();
    take_only(Channel::position, "no other column is a length");
  }

  /// Two columns that go along, one after the other: what comes first is the current, and of several that come first
  /// the latest, as the voltage comes before it.
  void pair() {
    std::optional<std::size_t> first, second;
    double best = along;
    int best_lag = 0;
    for (std::size_t a = 0; a < columns_.size(); ++a) {
      if (!free(a, units::Dimension::current) || !moves(columns_[a])) continue;
      for (std::size_t b = 0; b < columns_.size(); ++b) {
        if (a == b || !free(b, units::Dimension::length) || !moves(columns_[b])) continue;
        const Alongside each = compare(columns_[a], columns_[b]);
        if (each.lag <= 0 || std::abs(each.correlation) < best) continue;
        best = std::abs(each.correlation), best_lag = each.lag, first = a, second = b;
      }
    }
    if (!first) return;
    choose(Channel::current, *first, fmt::format("it rises {} samples before '{}' moves", best_lag, name(*second)));
    choose(Channel::position, *second, fmt::format("it moves {} samples after '{}' rises", best_lag, name(*first)));
  }

  void voltage() {
    const auto current = column_of(Channel::current);
    if (!current || column_of(Channel::voltage)) return;
    double best = closely_along;
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!free(k, units::Dimension::voltage) || !moves(columns_[k])) continue;
      const Alongside each = compare(columns_[*current], columns_[k]);
      if (each.lag > 0 || each.correlation <= best) continue;
      best = each.correlation, found = k;
    }
    if (found) choose(Channel::voltage, *found, fmt::format("it goes along with '{}', not after it", name(*current)));
  }

  void oil_temperature() {
    if (column_of(Channel::oil_temperature)) return;
    const auto warms = [this](std::size_t k) {
      return free(k, units::Dimension::temperature) && drifts(columns_[k]) && !columns_[k].rises;
    };
    const auto only = only_one(warms);
    if (!only) return;
    choose(Channel::oil_temperature, *only,
           fmt::format("it drifts slowly between {:.3g} and {:.3g}", columns_[*only].lowest, columns_[*only].highest));
  }

  const std::vector<SurveyedColumn>& columns_;
  std::map<Channel, std::size_t> known_;
  std::vector<bool> used_;
  std::map<Channel, DataGuess> out_;
};

void survey(SampleTable& table, const std::vector<std::size_t>& chosen, std::vector<SurveyedColumn>& out, bool kept) {
  table.select(chosen);
  std::vector<std::vector<double>> block(chosen.size(), std::vector<double>(block_samples));
  std::vector<double*> places;
  for (std::vector<double>& values : block) places.push_back(values.data());
  std::vector<double> last(chosen.size(), 0.0);
  for (const std::size_t k : chosen) out[k].rises = true;
  for (std::size_t rows = table.read(places, block_samples); rows > 0; rows = table.read(places, block_samples)) {
    for (std::size_t k = 0; k < chosen.size(); ++k) take(out[chosen[k]], block[k], rows, last[k], kept);
  }
  const std::span<const TextCells> text = table.text_cells();
  for (std::size_t k = 0; k < text.size(); ++k) out[chosen[k]].text = text[k];
}

}  // namespace

std::vector<SurveyedColumn> survey_columns(const std::function<std::unique_ptr<SampleTable>()>& open) {
  std::vector<SurveyedColumn> out;
  std::unique_ptr<SampleTable> table = open();
  for (const FileColumn& column : table->columns()) {
    SurveyedColumn& each = out.emplace_back();
    each.name = column.name;
    each.unit = column.unit;
    each.lowest = each.highest = std::numeric_limits<double>::quiet_NaN();
  }
  for (const std::vector<std::size_t>& chosen : equally_long(*table)) {
    for (std::size_t first = 0; first < chosen.size(); first += columns_at_once) {
      const auto begin = chosen.begin() + static_cast<std::ptrdiff_t>(first);
      const auto count = static_cast<std::ptrdiff_t>(std::min(columns_at_once, chosen.size() - first));
      if (!table) table = open();
      survey(*table, {begin, begin + count}, out, first == 0);
      table.reset();
    }
  }
  return out;
}

std::map<Channel, DataGuess> guess_by_data(const std::vector<SurveyedColumn>& columns,
                                           std::map<Channel, std::size_t> known) {
  return Guesser(columns, std::move(known)).guesses();
}

namespace {

std::string no_numbers(const SurveyedColumn& column) {
  if (column.rows == 0) return "no samples of it were looked at, or it has none";
  const std::uint64_t missing = column.rows - column.text.count - column.infinite.count;
  const auto all_of = [&column](std::uint64_t count) { return count == column.rows; };
  if (all_of(column.text.count))
    return fmt::format("no numbers: text in all {} cells, such as {}", column.rows, column.text.first);
  if (all_of(missing)) return fmt::format("no numbers: all {} samples are missing", column.rows);
  if (all_of(column.infinite.count)) return fmt::format("no numbers: all {} are infinite", column.rows);
  return fmt::format("no numbers: of {} samples {} are missing, {} text, {} infinite", column.rows, missing,
                     column.text.count, column.infinite.count);
}

}  // namespace

std::string character_of(const SurveyedColumn& column) {
  if (column.samples == 0) return no_numbers(column);
  if (column.text.count > 0)
    return fmt::format("text in {} of {} cells, such as {}", column.text.count, column.rows, column.text.first);
  if (column.lowest == column.highest) return "stands still";
  if (column.rises) return "rises with every sample";
  if (!column.unit.empty()) return {};
  constexpr double least_Pa = 5e4, most_Pa = 1e8;
  if (column.lowest > -least_Pa && column.highest > least_Pa && column.highest < most_Pa) {
    return "could be a pressure in Pa";
  }
  return {};
}

}  // namespace spoolflow::recording
