#include "spoolflow/rig/bench/settings_file.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "spoolflow/recording/channels/nearest_name.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::rig {
namespace {

toml::table parsed(const SettingsSource& source) {
  try {
    return toml::parse(source.text, source.name);
  } catch (const toml::parse_error& error) {
    throw SettingsError(fmt::format("{}, line {}: {}; correct the TOML there", source.name, error.source().begin.line,
                                    error.description()));
  }
}

std::string place(const SettingsSource& source, const toml::node& node) {
  return fmt::format("{}, line {}", source.name, node.source().begin.line);
}

[[noreturn]] void throw_unknown(const SettingsSource& source, const toml::node& node, const std::string& key,
                                const std::vector<Setting>& settings) {
  std::vector<std::string_view> known;
  for (const Setting& setting : settings) {
    known.push_back(setting.key);
  }
  throw SettingsError(fmt::format("{}: {} is no setting here; did you mean {}?", place(source, node), key,
                                  recording::nearest_name(key, known)));
}

double number(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  const std::optional<double> value = node.value<double>();
  if (!value || node.is_boolean()) {
    throw SettingsError(fmt::format("{}: {} must be a number in {}, from {} to {}", place(source, node), setting.key,
                                    setting.about.unit, setting.about.min, setting.about.max));
  }
  try {
    check_range(setting.key, setting.about, *value);
  } catch (const std::invalid_argument& error) {
    throw SettingsError(fmt::format("{}: {}", place(source, node), error.what()));
  }
  return *value;
}

std::vector<double> numbers(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) {
    throw SettingsError(fmt::format("{}: {} must be a list of at least one number in {}, such as [30, 50]",
                                    place(source, node), setting.key, setting.about.unit));
  }
  std::vector<double> values;
  for (const toml::node& element : *array) {
    values.push_back(number(source, element, setting));
  }
  return values;
}

std::string text(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  const std::optional<std::string> value = node.value<std::string>();
  if (!value) {
    throw SettingsError(fmt::format("{}: {} must be text in quotes", place(source, node), setting.key));
  }
  return *value;
}

std::size_t choice(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  const std::string value = text(source, node, setting);
  const auto found = std::find(setting.choices.begin(), setting.choices.end(), value);
  if (found == setting.choices.end()) {
    throw SettingsError(fmt::format("{}: {} = \"{}\" is not known; choose one of {}", place(source, node), setting.key,
                                    value, fmt::join(setting.choices, ", ")));
  }
  return static_cast<std::size_t>(found - setting.choices.begin());
}

bool flag(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  if (!node.is_boolean()) {
    throw SettingsError(fmt::format("{}: {} must be true or false", place(source, node), setting.key));
  }
  return *node.value<bool>();
}

std::uint64_t whole(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  const std::optional<std::int64_t> value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
  if (!value || *value < 0) {
    throw SettingsError(fmt::format("{}: {} must be a whole number from 0", place(source, node), setting.key));
  }
  return static_cast<std::uint64_t>(*value);
}

void assign(const SettingsSource& source, const toml::node& node, const Setting& setting) {
  struct Assign {
    const SettingsSource& source;
    const toml::node& node;
    const Setting& setting;
    void operator()(double* target) const { *target = number(source, node, setting); }
    void operator()(std::vector<double>* target) const { *target = numbers(source, node, setting); }
    void operator()(std::string* target) const { *target = text(source, node, setting); }
    void operator()(bool* target) const { *target = flag(source, node, setting); }
    void operator()(std::uint64_t* target) const { *target = whole(source, node, setting); }
    void operator()(const std::function<void(std::size_t)>& chosen) const { chosen(choice(source, node, setting)); }
  };
  std::visit(Assign{source, node, setting}, setting.target);
}

void apply_table(const SettingsSource& source, const toml::table& table, const std::string& prefix,
                 const std::vector<Setting>& settings) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix.empty() ? std::string(name.str()) : fmt::format("{}.{}", prefix, name.str());
    if (const toml::table* inner = node.as_table()) {
      const bool known = std::any_of(settings.begin(), settings.end(),
                                     [&](const Setting& setting) { return setting.key.starts_with(key + "."); });
      if (!known) {
        throw_unknown(source, node, key, settings);
      }
      apply_table(source, *inner, key, settings);
      continue;
    }
    const auto setting =
        std::find_if(settings.begin(), settings.end(), [&](const Setting& candidate) { return candidate.key == key; });
    if (setting == settings.end()) {
      throw_unknown(source, node, key, settings);
    }
    assign(source, node, *setting);
  }
}

}  // namespace

SettingsSource read_settings_source(const std::filesystem::path& file) {
  try {
    return {.text = recording::read_toml_text(file), .name = file.filename().string()};
  } catch (const recording::RecordingError& error) {
    throw SettingsError(fmt::format("{}; give the path of a TOML file", error.what()));
  }
}

void apply(const SettingsSource& source, const Settings& settings) {
  apply_table(source, parsed(source), "", settings.all());
}

void apply_known(const SettingsSource& source, const Settings& settings) {
  const toml::table table = parsed(source);
  for (const Setting& setting : settings.all()) {
    if (const toml::node* node = table.at_path(setting.key).node()) {
      assign(source, *node, setting);
    }
  }
}

}  // namespace spoolflow::rig
