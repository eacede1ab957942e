#pragma once
/// Reading the rig's TOML files into described aggregates: every key must be known, every number inside its range.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// A scenario or valve file that cannot be used; the message names file, line, value, range and the nearest key.
struct SettingsError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A key that a file may hold and where its value goes.
struct Setting {
  std::string key;  ///< dotted, such as "plant.spool.stroke_m"
  Parameter about;  ///< of a number or of each number of a list
  std::variant<double*, std::vector<double>*, std::string*, bool*, std::uint64_t*, std::function<void(std::size_t)>>
      target;
  std::vector<std::string> choices{};  ///< texts whose index the function gets
};

class Settings {
 public:
  /// Every number of a described aggregate under `prefix`.
  template <class Aggregate>
  Settings& add(std::string_view prefix, Aggregate& aggregate) {
    for_each_parameter(
        aggregate,
        [&](std::string_view path, const Parameter& parameter, auto& value) {
          settings_.push_back({.key = std::string(path), .about = parameter, .target = &value});
        },
        prefix);
    return *this;
  }
  /// A text, a flag or a seed.
  template <class Value>
  Settings& add_value(std::string key, Value& target) {
    settings_.push_back({.key = std::move(key), .about = {}, .target = &target});
    return *this;
  }
  /// One of the texts; `chosen` gets its index.
  Settings& add_choice(std::string key, std::vector<std::string> choices, std::function<void(std::size_t)> chosen) {
    settings_.push_back(
        {.key = std::move(key), .about = {}, .target = std::move(chosen), .choices = std::move(choices)});
    return *this;
  }

  [[nodiscard]] const std::vector<Setting>& all() const { return settings_; }

 private:
  std::vector<Setting> settings_;
};

/// The text of a TOML file with the name that messages use.
struct SettingsSource {
  std::string text;
  std::string name;
};

/// Throws SettingsError when the file cannot be read.
[[nodiscard]] SettingsSource read_settings_source(const std::filesystem::path& file);

/// Writes every value of the source to its setting's target. Throws SettingsError for an unknown key, a wrong type, a
/// value out of range or a text that is no choice.
void apply(const SettingsSource& source, const Settings& settings);
/// The same for the keys of `settings` alone; other keys are passed over.
void apply_known(const SettingsSource& source, const Settings& settings);

}  // namespace spoolflow::rig
