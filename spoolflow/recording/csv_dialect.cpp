#include "spoolflow/recording/csv_dialect.hpp"

#include <algorithm>

#include "spoolflow/recording/decimal.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

std::string trimmed(std::string text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  std::size_t first = 0;
  while (first < text.size() && blank(text[first])) ++first;
  return text.substr(first);
}

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char delimiter) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"') {
      if (quoted && k + 1 < line.size() && line[k + 1] == '"') {
        fields.back() += c;
        ++k;
      } else {
        quoted = !quoted;
      }
    } else if (c == delimiter && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

char delimiter_of(std::string_view header) {
  for (const char candidate : {';', '\t', ','}) {
    bool quoted = false;
    for (const char c : header) {
      if (c == '"') quoted = !quoted;
      if (c == candidate && !quoted) return candidate;
    }
  }
  return ',';
}

std::string without_brackets(std::string_view text) {
  if (text.size() >= 2 &&
      ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'))) {
    text = text.substr(1, text.size() - 2);
  }
  return trimmed(std::string(text));
}

bool is_units_row(const std::vector<std::string>& fields) {
  bool any = false;
  for (const std::string& field : fields) {
    if (field.empty()) continue;
    const Decimal number = read_decimal(field.data(), field.data() + field.size(), '.');
    if (number.end == field.data() + field.size() && field != "1") return false;
    if (!units::unit_named(without_brackets(field))) return false;
    any = true;
  }
  return any;
}

}  // namespace spoolflow::recording
