#include "spoolflow/model/file_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spoolflow::model {
namespace {

/// Keys of older model files, which are read and never written.
struct FormerKey {
  const char* key;       ///< in the older file
  std::string_view now;  ///< what it is called
  bool squared;          ///< the older file holds the square root
};
constexpr std::array former_keys{FormerKey{"least_liveliness", "least_process_noise", true},
                                 FormerKey{"first_liveliness", "first_process_noise", false},
                                 FormerKey{"yielding_s", "constrained_correction_s", false},
                                 FormerKey{"band_unseen_factor", "band_unobserved_factor", false}};

}  // namespace

void FileSection::text(const char* key, std::string& value) {
  if (writes()) {
    (*out_)[key] = value;
  } else {
    value = in_->at(key).text();
  }
}

void FileSection::one_of(const char* key, std::string& value, std::initializer_list<const char*> allowed) {
  text(key, value);
  if (writes() || std::ranges::find(allowed, value) != allowed.end()) return;
  in_->at(key).refuse(fmt::format("is neither \"{}\"", fmt::join(allowed, "\" nor \"")));
}

void FileSection::either(const char* key, bool& value, const char* yes, const char* no) {
  std::string word = value ? yes : no;
  one_of(key, word, {yes, no});
  value = word == yes;
}

void FileSection::mark(const char* key, bool& value, const char* word) {
  std::string found = value ? word : "";
  if (holds(key, found.empty(), Held::where_any)) text(key, found);
  value = found == word;
}

void FileSection::tool(const char* key, std::string& version) {
  const std::string tool = "spoolflow ";
  std::string named = tool + version;
  text(key, named);
  version = named.starts_with(tool) ? named.substr(tool.size()) : named;
}

void FileSection::sha256(const char* key, std::string& digits) {
  text(key, digits);
  if (writes() || (digits.size() == 64 && digits.find_first_not_of("0123456789abcdef") == std::string::npos)) return;
  in_->at(key).refuse("no sha256 of 64 hexadecimal digits");
}

void FileSection::numbers(const char* key, std::vector<double>& values, std::optional<std::size_t> count) {
  if (writes()) {
    (*out_)[key] = values;
    return;
  }
  values = in_->at(key).numbers();
  if (count && values.size() != *count)
    in_->at(key).refuse(fmt::format("has {} entries, {} would fit", values.size(), *count));
}

void FileSection::rising_numbers(const char* key, std::vector<double>& values) {
  if (writes()) return numbers(key, values);
  values = in_->at(key).rising_numbers();
}

void FileSection::range(const char* key, double& lower, double& upper) {
  std::vector<double> ends{lower, upper};
  rising_numbers(key, ends);
  if (ends.size() != 2) in_->at(key).refuse(fmt::format("has {} entries, a range has 2", ends.size()));
  lower = ends[0];
  upper = ends[1];
}

void FileSection::texts(const char* key, std::vector<std::string>& values, Held held) {
  if (!holds(key, values.empty(), held)) return;
  if (writes()) {
    (*out_)[key] = values;
  } else {
    for (const JsonNode& each : in_->at(key).elements()) values.push_back(each.text());
  }
}

void FileSection::require_count(const JsonNode& node, std::size_t found, int wanted) {
  if (found == static_cast<std::size_t>(wanted)) return;
  node.refuse(fmt::format("has {} entries, the sensor's table has {}", found, wanted));
}

double FileSection::even_spacing(const JsonNode& node, const std::vector<double>& values, int points) {
  require_count(node, values.size(), points);
  const double spacing = (values.back() - values.front()) / (points - 1);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double expected = values.front() + static_cast<double>(k) * spacing;
    if (std::abs(values[k] - expected) <= 1e-6 * spacing) continue;
    node.refuse(fmt::format("entry {} is {}, equal steps would give {}; the sensor's axes rise in equal steps", k,
                            values[k], expected));
  }
  return spacing;
}

double FileSection::missing(const Parameter& about) const {
  for (const FormerKey& former : former_keys) {
    if (former.now != about.key || !in_->has(former.key)) continue;
    const double value = in_->at(former.key).number();
    return former.squared ? value * value : value;
  }
  return about.otherwise ? *about.otherwise : in_->at(about.key).number();
}

}  // namespace spoolflow::model
