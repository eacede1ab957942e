#include "spoolflow/rig/bench/scenario.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::rig {
namespace {

/// The file that a scenario names as its valve; empty: a preset.
std::filesystem::path valve_file(const std::string& valve, const std::filesystem::path& scenario_file) {
  return valve.ends_with(".toml") ? scenario_file.parent_path() / valve : std::filesystem::path();
}

std::vector<std::string> protocol_names() {
  std::vector<std::string> names;
  for (const NamedProtocol& protocol : protocols()) {
    names.emplace_back(protocol.name);
  }
  return names;
}

/// What bench tests have beside the protocol's numbers.
struct BenchChoices {
  bool direction_given = false;
  std::optional<std::size_t> edge;  ///< index of `edges`
};
struct NamedEdge {
  const char* name;
  LoadKind load;
  std::optional<bool> direction_a;  ///< what it opens with
};
constexpr std::array<NamedEdge, 5> edges{{{"path", LoadKind::held_path, std::nullopt},
                                          {"PB", LoadKind::held_difference, false},
                                          {"AT", LoadKind::held_return, false},
                                          {"PA", LoadKind::held_difference, true},
                                          {"BT", LoadKind::held_return, true}}};

void add_bench_choices(Settings& settings, Scenario& scenario, BenchChoices& choices) {
  settings.add_choice("direction", {"b", "a"}, [&](std::size_t index) {
    scenario.direction_a = index == 1;
    choices.direction_given = true;
  });
  std::vector<std::string> names;
  for (const NamedEdge& edge : edges) names.emplace_back(edge.name);
  settings.add_choice("edge", names, [&](std::size_t index) { choices.edge = index; });
}

/// Throws SettingsError where the choices do not fit the protocol or each other.
void take(const BenchChoices& choices, const std::string& file, Scenario& scenario) {
  if (choices.direction_given && !is_bench_test(scenario.protocol)) {
    throw SettingsError(
        fmt::format("{}: direction is of bench tests; this protocol drives the valve both ways by the sign of its "
                    "positions, so remove direction",
                    file));
  }
  if (!choices.edge) return;
  std::optional<LoadKind>* fed = nullptr;
  if (auto* axial = std::get_if<AxialForceProtocol>(&scenario.protocol)) fed = &axial->load;
  if (auto* bench = std::get_if<FlowBenchProtocol>(&scenario.protocol)) fed = &bench->load;
  if (fed == nullptr) {
    throw SettingsError(fmt::format(
        "{}: edge is of the protocols axial_force_map, spring, metering and unpressurised_strokes; remove it here",
        file));
  }
  const NamedEdge& edge = edges[*choices.edge];
  if (edge.direction_a && choices.direction_given && *edge.direction_a != scenario.direction_a) {
    throw SettingsError(fmt::format("{}: edge = \"{}\" opens in direction {}; correct direction or remove it", file,
                                    edge.name, *edge.direction_a ? "a" : "b"));
  }
  *fed = edge.load;
  if (edge.direction_a) scenario.direction_a = *edge.direction_a;
}

/// Throws SettingsError where no machine can do so.
void check_machine(const std::string& file, const Scenario& scenario) {
  if (scenario.machine == Machine{}) return;
  if (is_bench_test(scenario.protocol)) {
    throw SettingsError(
        fmt::format("{}: [machine] is of the valve at work; this protocol is a bench test, so remove "
                    "[machine]",
                    file));
  }
  if (scenario.machine.actuator_end.stands_s > 0 && !holds_difference(scenario.valve.plant.load.kind)) {
    throw SettingsError(
        fmt::format("{}: machine.actuator_end is of loads that hold the pressure difference; with this "
                    "load remove it, or choose a cylinder and its cylinder_stroke_m",
                    file));
  }
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
  apply_known(source, Settings().add_value("valve", valve));
  scenario.valve_file = valve_file(valve, file);
  scenario.valve = read_valve_and_campaign(scenario.valve_file.empty() ? valve : scenario.valve_file.string()).valve;

  Settings settings;
  settings.add_value("valve", valve).add_choice("protocol", protocol_names(), [](std::size_t) {});
  add_valve_settings(settings, scenario.valve);
  std::visit(
      [&](auto& its) {
        settings.add("run", its);
        if constexpr (requires { its.conditions; }) {
          settings.add_value("run.conditions.port_pressures", its.conditions.port_pressures);
          settings.add_value("run.conditions.supply_follows_difference", its.conditions.supply_follows_difference);
        }
      },
      scenario.protocol);
  BenchChoices choices;
  add_bench_choices(settings, scenario, choices);
  settings.add("machine", scenario.machine);
  apply(source, settings);
  check_spread(source.name, scenario.valve);
  take(choices, source.name, scenario);
  check_machine(source.name, scenario);
  return scenario;
}

PlannedScenario plan(const Scenario& scenario) {
  ValveUnderTest valve = as_built(scenario.valve);
  if (scenario.direction_a) valve = turned_round(std::move(valve));
  BenchRun run = plan(scenario.protocol, valve, valve.seed);
  run.machine = scenario.machine;
  // The bench's own ripple would go on through a valve whose actuator stands.
  if (run.machine.actuator_end.stands_s > 0) valve.plant.supply.ripple_Pa = 0;
  return {.valve = std::move(valve), .run = std::move(run)};
}

}  // namespace spoolflow::rig
