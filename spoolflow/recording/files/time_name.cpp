#include "spoolflow/recording/files/time_name.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::array<std::string_view, 12> time_words{"time",     "t",           "zeit",  "temps",
                                                      "tempo",    "tiempo",      "jikan", "timestamp",
                                                      "timebase", "zeitstempel", "times", "timestamps"};

bool is_time_word(const std::string& word) {
  return std::ranges::find(time_words, word) != time_words.end();
}

bool is_time_unit(const std::string& word) {
  const auto unit = units::unit_named(word);
  return unit && unit->dimension == units::Dimension::time;
}

}  // namespace

bool named_time(const FileColumn& column) {
  if (const auto header = channel_header(column)) return header->channel == Channel::time;
  const std::string unit = stated_unit(column);
  if (!unit.empty() && !is_time_unit(unit)) return false;
  const std::vector<std::string> words = words_of(split_unit(column.leaf).stem);
  return std::ranges::any_of(words, is_time_word);
}

std::string unit_of_time(const FileColumn& column) {
  const auto header = channel_header(column);
  if (header && !header->unit.empty()) return header->unit;
  if (std::string stated = stated_unit(column); !stated.empty()) return stated;
  const std::size_t last = column.leaf.rfind('_');
  const std::string ending = last == std::string::npos ? "" : column.leaf.substr(last + 1);
  return is_time_unit(ending) ? ending : "";
}

bool carries_name(const FileColumn& time, const FileColumn& column) {
  const std::vector<std::string> words = words_of(column.leaf);
  std::size_t own = 0;
  for (const std::string& word : words_of(time.leaf)) {
    if (is_time_word(word) || is_time_unit(word)) continue;
    ++own;
    if (std::ranges::find(words, word) == words.end()) return false;
  }
  return own > 0;
}

}  // namespace spoolflow::recording
