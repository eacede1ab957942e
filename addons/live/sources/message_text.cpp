#include "addons/live/sources/message_text.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/recording/channels/byte_order_mark.hpp"

namespace spoolflow::live {
namespace {

using Json = nlohmann::json;

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// Whether a line names columns: rows begin with a number, a time or nothing.
bool is_header(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t\"#");
  if (begin == std::string_view::npos || !is_letter(line[begin])) return false;
  const std::string_view word = line.substr(begin, 3);
  const bool is_nan = std::ranges::equal(word, std::string_view("nan"), {},
                                         [](char c) { return std::tolower(static_cast<unsigned char>(c)); });
  return !is_nan || (line.size() > begin + 3 && is_letter(line[begin + 3]));
}

MessageText text_of_csv(std::string_view message) {
  MessageText out;
  message = recording::without_byte_order_mark(message);
  const std::string_view first = message.substr(0, message.find('\n'));
  if (is_header(first)) {
    out.header = first;
    if (out.header.ends_with('\r')) out.header.pop_back();
    message.remove_prefix(std::min(message.size(), first.size() + 1));
  }
  if (message.find_first_not_of(" \t\r\n") == std::string_view::npos) return out;
  out.rows = message;
  if (!out.rows.empty() && !out.rows.ends_with('\n')) out.rows += '\n';
  out.samples = static_cast<std::size_t>(std::ranges::count(out.rows, '\n'));
  return out;
}

/// In quotes, which only text has.
std::string quoted(const std::string& text) {
  if (text.find_first_of("\"\n\r") == std::string::npos) return '"' + text + '"';
  throw std::invalid_argument(fmt::format("a text in it holds a quote or a line end: {}", text.substr(0, 40)));
}

std::string cell_of(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  return value.is_string() ? quoted(value.get<std::string>()) : value.dump();
}

bool is_value(const Json& value) {
  return !value.is_object() && !value.is_array();
}

std::string header_of(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ",") + quoted(name);
  return out;
}

MessageText text_of_columns(const Json& object) {
  std::vector<std::string> names;
  std::vector<const Json*> columns;
  for (const auto& [name, values] : object.items()) {
    if (!values.is_array() || !std::ranges::all_of(values, is_value)) continue;
    names.push_back(name);
    columns.push_back(&values);
    if (values.size() != columns.front()->size()) {
      throw std::invalid_argument(fmt::format("its columns {} and {} have {} and {} values; send as many of each",
                                              names.front(), name, columns.front()->size(), values.size()));
    }
  }
  MessageText out{header_of(names)};
  out.samples = columns.empty() ? 0 : columns.front()->size();
  for (std::size_t row = 0; row < out.samples; ++row) {
    for (std::size_t k = 0; k < columns.size(); ++k) out.rows += (k == 0 ? "" : ",") + cell_of((*columns[k])[row]);
    out.rows += '\n';
  }
  return out;
}

/// Columns are those of the first sample; one that lacks a name has it not measured.
template <class Samples>
MessageText text_of_samples(const Samples& samples) {
  std::vector<std::string> names;
  for (const auto& [name, value] : samples.front().items())
    if (is_value(value)) names.push_back(name);
  if (names.empty()) return {};
  MessageText out{header_of(names)};
  for (const Json& sample : samples) {
    if (!sample.is_object()) throw std::invalid_argument("its list holds what is no sample, such as {\"time_s\": 1}");
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto value = sample.find(names[k]);
      out.rows += (k == 0 ? "" : ",") + (value == sample.end() ? "" : cell_of(*value));
    }
    out.rows += '\n';
    ++out.samples;
  }
  return out;
}

MessageText text_of_json(std::string_view message) {
  Json json;
  try {
    json = Json::parse(message);
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(
        fmt::format("it is no JSON at byte {}; what is not measured is null, and there is no NaN", error.byte));
  }
  if (json.is_array()) return json.empty() ? MessageText{} : text_of_samples(json);
  const bool has_columns = std::ranges::any_of(json, [](const Json& value) { return value.is_array(); });
  return has_columns ? text_of_columns(json) : text_of_samples(std::vector<Json>{std::move(json)});
}

}  // namespace

MessageText message_text(std::string_view message) {
  if (message.size() > largest_message)
    throw std::invalid_argument(fmt::format("it has {} bytes; at most {} are read", message.size(), largest_message));
  const std::size_t begin = message.find_first_not_of(" \t\r\n");
  const bool is_json = begin != std::string_view::npos && (message[begin] == '{' || message[begin] == '[');
  MessageText out = is_json ? text_of_json(message) : text_of_csv(message);
  if (out.samples == 0) throw std::invalid_argument("it holds no samples");
  return out;
}

}  // namespace spoolflow::live
