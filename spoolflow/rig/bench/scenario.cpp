#include "spoolflow/rig/bench/scenario.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::rig {
namespace {

ValveUnderTest valve_of(const std::string& valve, const std::filesystem::path& scenario_file) {
  const bool is_file = valve.ends_with(".toml");
  return read_valve_and_campaign(is_file ? (scenario_file.parent_path() / valve).string() : valve).valve;
}

std::vector<std::string> protocol_names() {
  std::vector<std::string> names;
  for (const NamedProtocol& protocol : protocols()) {
    names.emplace_back(protocol.name);
  }
  return names;
}

/// The protocol alone, read first: it decides which keys [run] may hold.
Protocol protocol_of(const SettingsSource& source) {
  Protocol protocol;
  bool given = false;
  Settings settings;
  settings.add_choice("protocol", protocol_names(), [&](std::size_t index) {
    protocol = protocols()[index].settings;
    given = true;
  });
  apply_known(source, settings);
  if (!given) {
    throw SettingsError(fmt::format("{}: protocol is missing; add a line such as protocol = \"ramps\"", source.name));
  }
  return protocol;
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file) {
  const SettingsSource source = read_settings_source(file);
  // Before the scenario: where an initializer throws, GCC 12 destroys those before it twice.
  Protocol protocol = protocol_of(source);
  Scenario scenario{.valve = {}, .protocol = std::move(protocol)};
  std::string valve = "size_6";
  apply_known(source, Settings().add_text("valve", valve));
  scenario.valve = valve_of(valve, file);

  Settings settings;
  settings.add_text("valve", valve).add_choice("protocol", protocol_names(), [](std::size_t) {});
  add_valve_settings(settings, scenario.valve);
  std::visit([&](auto& its) { settings.add("run", its); }, scenario.protocol);
  apply(source, settings);
  return scenario;
}

PlannedScenario plan(const Scenario& scenario) {
  ValveUnderTest valve = as_built(scenario.valve);
  BenchRun run = plan(scenario.protocol, valve, valve.seed);
  return {.valve = std::move(valve), .run = std::move(run)};
}

}  // namespace spoolflow::rig
