#include "spoolflow/rig/bench/valve_under_test.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/rig/bench/valve_preset_files.hpp"

namespace spoolflow::rig {
namespace {

std::string preset_name(const EmbeddedFile& file) {
  return std::filesystem::path(file.name).stem().string();
}

/// Everything that a valve file may hold, `preset` included.
void overlay(const SettingsSource& source, const Settings& beside, ValveUnderTest& valve) {
  Settings settings = beside;
  settings.add_choice("preset", valve_presets(), [](std::size_t) {});
  add_valve_settings(settings, valve);
  apply(source, settings);
  check_spread(source.name, valve);
}

}  // namespace

const std::vector<std::string>& valve_presets() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const EmbeddedFile& file : valve_preset_files()) {
      all.push_back(preset_name(file));
    }
    return all;
  }();
  return names;
}

ValveUnderTest valve_preset(std::string_view name, const Settings& beside) {
  for (const EmbeddedFile& file : valve_preset_files()) {
    if (preset_name(file) == name) {
      ValveUnderTest valve;
      overlay({.text = std::string(file.bytes), .name = fmt::format("preset {}", name)}, beside, valve);
      return valve;
    }
  }
  throw SettingsError(
      fmt::format("valve \"{}\" is no preset; choose one of {}, or give the path of a valve file that "
                  "ends in .toml",
                  name, fmt::join(valve_presets(), ", ")));
}

ValveUnderTest read_valve(const std::filesystem::path& file, const Settings& beside) {
  const SettingsSource source = read_settings_source(file);
  std::string preset = "size_6";
  apply_known(source, Settings().add_choice("preset", valve_presets(),
                                            [&](std::size_t index) { preset = valve_presets()[index]; }));
  ValveUnderTest valve = valve_preset(preset, beside);
  overlay(source, beside, valve);
  return valve;
}

void check_spread(const std::string& source, const ValveUnderTest& valve) {
  if (valve.spread_seed == 0 || valve.spread.amount > 0) return;
  throw SettingsError(
      fmt::format("{}: [spread] seed = {} draws nothing, for amount is 0, as it is where none is given; add amount = 1 "
                  "for a usual series, or leave out seed",
                  source, valve.spread_seed));
}

void add_valve_settings(Settings& settings, ValveUnderTest& valve) {
  settings.add_value("name", valve.name).add_value("fluid", valve.fluid).add_value("seed", valve.seed);
  settings.add("rating", valve.rating).add("plant", valve.plant).add("electronics", valve.electronics);
  settings.add("bench_amplifier", valve.bench_amplifier).add("instruments", valve.instruments);
  settings.add("wear", valve.wear).add("spread", valve.spread);
  settings.add_value("spread.seed", valve.spread_seed);
  settings.add_choice("hysteresis", {"jiles_atherton", "preisach"}, [&plant = valve.plant](std::size_t kind) {
    plant.solenoid_a.hysteresis.kind = plant.solenoid_b.hysteresis.kind = static_cast<HysteresisKind>(kind);
  });
  settings.add_value("whole", valve.whole);
  settings.add_choice("plant.load.kind",
                      {"held_difference", "orifice", "cylinder", "motor", "held_path", "held_return"},
                      [&load = valve.plant.load](std::size_t kind) { load.kind = static_cast<LoadKind>(kind); });
  settings.add_value("plant.load.ideal_hold", valve.plant.load.ideal_hold);
  settings.add_value("plant.load.return_to_tank", valve.plant.load.return_to_tank);
  settings.add_choice(
      "electronics.dither.shape", {"sine", "square", "triangle"},
      [&dither = valve.electronics.dither](std::size_t shape) { dither.shape = static_cast<DitherShape>(shape); });
}

ValveUnderTest as_built(ValveUnderTest valve) {
  draw(valve.spread, valve.spread_seed != 0 ? valve.spread_seed : valve.seed, valve.plant, valve.instruments.lvdt);
  valve.plant = worn(valve.plant, valve.wear);
  valve.electronics.sign_chooses = valve.whole;
  if (valve.whole && valve.plant.load.kind == LoadKind::held_difference) valve.plant.load.kind = LoadKind::held_path;
  check_ranges(valve.plant);
  check_ranges(valve.instruments);
  return valve;
}

ValveUnderTest turned_round(ValveUnderTest valve) {
  PlantParameters& plant = valve.plant;
  std::swap(plant.solenoid_a, plant.solenoid_b);
  std::swap(plant.spring_a, plant.spring_b);
  std::swap(plant.edge_PA, plant.edge_PB);
  std::swap(plant.edge_AT, plant.edge_BT);
  std::swap(plant.load.piston_area_A_m2, plant.load.piston_area_B_m2);
  Lvdt& lvdt = valve.instruments.lvdt;
  lvdt.zero_offset_m = -lvdt.zero_offset_m;
  lvdt.zero_drift_per_K = -lvdt.zero_drift_per_K;
  return valve;
}

}  // namespace spoolflow::rig
