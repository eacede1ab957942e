#include "spoolflow/recording/column_clock.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/time_name.hpp"

namespace spoolflow::recording {
namespace {

/// The group or struct that holds it: "rig/pressure" of "rig/pressure/p", empty at the top.
std::string_view group_of(std::string_view name) {
  const std::size_t last = name.substr(0, name.find(':')).find_last_of("./");
  return last == std::string_view::npos ? std::string_view() : name.substr(0, last);
}

class Search {
 public:
  Search(const SampleTable& table, std::size_t column, std::span<const std::size_t> others, const std::string& file)
      : table_(table), column_(column), samples_(table.samples_of(column).value_or(0)), file_(file) {
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
      const bool other = std::ranges::find(others, k) != others.end();
      if (k != column && !other && table.samples_of(k) == samples_ && named_time(at(k))) times_.push_back(k);
    }
  }

  [[nodiscard]] std::optional<ColumnClock> clock(std::optional<std::size_t> usual) const {
    if (at(column_).own_time) return by(*at(column_).own_time);
    for (std::string_view group = group_of(at(column_).name);; group = group_of(group)) {
      std::vector<std::size_t> beside;
      std::ranges::copy_if(times_, std::back_inserter(beside),
                           [&](std::size_t k) { return group_of(at(k).name) == group; });
      if (const auto found = chosen(beside, usual)) return by(*found);
      if (group.empty()) break;
    }
    if (!at(column_).wave.empty()) return ColumnClock{std::nullopt, at(column_).wave, samples_};
    if (usual && table_.samples_of(*usual) == samples_) return by(*usual);
    if (times_.size() == 1) return by(times_.front());
    return std::nullopt;
  }

 private:
  [[nodiscard]] const FileColumn& at(std::size_t column) const { return table_.columns()[column]; }
  [[nodiscard]] ColumnClock by(std::size_t time) const { return {time, {}, samples_}; }

  /// Of times of one group.
  [[nodiscard]] std::optional<std::size_t> chosen(std::vector<std::size_t> times,
                                                  std::optional<std::size_t> usual) const {
    if (times.empty()) return std::nullopt;
    std::vector<std::size_t> named = times;
    std::erase_if(named, [&](std::size_t k) { return !carries_name(at(k), at(column_)); });
    if (named.size() == 1) return named.front();
    if (usual && std::ranges::find(times, *usual) != times.end()) return usual;
    std::vector<std::size_t> plain = times;  // called nothing but a time
    std::erase_if(plain, [&](std::size_t k) { return !channel_header(at(k)); });
    if (plain.size() == 1) return plain.front();
    if (times.size() == 1) return times.front();
    throw RecordingError(
        fmt::format("{}: '{}' has two times beside it, '{}' and '{}', both of {} samples; take one of them out of its "
                    "group, or name the time {}_time_s",
                    file_, at(column_).name, at(times[0]).name, at(times[1]).name, samples_, at(column_).leaf));
  }

  const SampleTable& table_;
  std::size_t column_;
  std::uint64_t samples_;
  const std::string& file_;
  std::vector<std::size_t> times_;
};

}  // namespace

std::optional<ColumnClock> clock_of(const SampleTable& table, std::size_t column, std::optional<std::size_t> usual,
                                    std::span<const std::size_t> others, const std::string& file) {
  return Search(table, column, others, file).clock(usual);
}

}  // namespace spoolflow::recording
