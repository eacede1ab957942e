#include "spoolflow/recording/text/paired_times.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/time_name.hpp"

namespace spoolflow::recording {
namespace {

/// "time" of Time, "Time 2", time_2, "Time (2)" and Time.1.
std::string less_number(const FileColumn& column) {
  std::string out;
  for (const std::string& word : words_of(split_unit(column.leaf).stem)) {
    const std::size_t end = word.find_last_not_of("0123456789");
    if (end != std::string::npos) out += (out.empty() ? "" : " ") + word.substr(0, end + 1);
  }
  return out;
}

/// t_oil may as well be a temperature.
bool is_letter_without_unit(const FileColumn& column) {
  const std::vector<std::string> words = words_of(split_unit(column.leaf).stem);
  return std::ranges::find(words, "t") != words.end() && unit_of_time(column).empty();
}

}  // namespace

bool pair_times(std::vector<FileColumn>& columns) {
  std::vector<std::size_t> times, again;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (named_time(columns[k])) times.push_back(k);
  }
  if (times.size() < 2) return false;
  const std::size_t first = times.front();
  const auto is_time = [&](std::size_t k) { return std::ranges::find(times, k) != times.end(); };
  std::vector<std::optional<std::size_t>> own(columns.size());
  for (const std::size_t time : times) {
    if (time == first) continue;
    const bool numbered = less_number(columns[time]) == less_number(columns[first]);
    const bool between = !is_time(time - 1) && time + 1 < columns.size() && !is_time(time + 1);
    if (numbered && between) again.push_back(time);
    if (numbered || is_letter_without_unit(columns[time])) continue;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (!is_time(k) && !own[k] && carries_name(columns[time], columns[k])) own[k] = time;
    }
  }
  const bool named = std::ranges::any_of(own, [](const auto& time) { return time.has_value(); });
  if (again.empty() && !named) return false;
  const auto is_own = [&](std::size_t time) {
    return std::ranges::find(again, time) != again.end() || std::ranges::find(own, time) != own.end();
  };
  std::size_t last = first;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (std::ranges::find(again, k) != again.end()) last = k;
    if (k != first && !is_own(k)) columns[k].own_time = own[k].value_or(last);
  }
  return true;
}

}  // namespace spoolflow::recording
