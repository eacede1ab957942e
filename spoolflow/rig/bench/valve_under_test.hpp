#pragma once
/// A valve as it comes to the rig: plant, electronics and instruments, its place in the series and its wear.
///
///     ValveUnderTest valve = valve_preset("size_6");       // or read_valve("worn.toml")
///     PlantParameters plant = as_built(valve).plant;       // spread and wear applied
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/rig/bench/manufacturing_spread.hpp"
#include "spoolflow/rig/bench/settings_file.hpp"
#include "spoolflow/rig/bench/wear.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/instruments/instruments.hpp"
#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

/// Name-plate figures.
struct Rating {
  double flow_L_per_min = 80.0;
  double current_A = 2.6;
  double pressure_difference_bar = 70.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"flow_L_per_min", "L/min", 1, 2000, "full scale of every % FS figure"}, self.flow_L_per_min);
    visit(Parameter{"current_A", "A", 0.1, 10, "largest current of the solenoid tests"}, self.current_A);
    visit(Parameter{"pressure_difference_bar", "bar", 5, 350, "largest of the campaign, over one edge"},
          self.pressure_difference_bar);
  }
};

struct ValveUnderTest {
  std::string name = "NG6 4/3 proportional, virtual";
  std::string fluid = "HLP46";
  std::uint64_t seed = 1;  ///< of spread, instruments and random courses
  std::uint64_t spread_seed =
      0;               ///< key `spread.seed`: of the spread alone, one valve in runs of many seeds; 0: `seed`
  bool whole = false;  ///< measured and driven in both directions; else it is the valve of one, P to B
  Rating rating;
  PlantParameters plant;
  Electronics electronics;
  CurrentControl bench_amplifier{.proportional_V_per_A = 100,
                                 .integral_V_per_A_s = 3000,
                                 .feed_forward_ohm = 3.0,
                                 .supply_V = 24,
                                 .duty_steps = 100000,
                                 .largest_current_A = 10};
  Instruments instruments;
  Wear wear;
  ManufacturingSpread spread;
};

/// Names of the presets.
[[nodiscard]] const std::vector<std::string>& valve_presets();
/// A preset by its name; `beside` takes keys that are not the valve's. Throws SettingsError with the known names.
[[nodiscard]] ValveUnderTest valve_preset(std::string_view name, const Settings& beside = {});
/// A valve file: `preset` says what it starts from, everything else overrides. Throws SettingsError.
[[nodiscard]] ValveUnderTest read_valve(const std::filesystem::path& file, const Settings& beside = {});

/// Throws SettingsError, which names `source`, where [spread] has a seed and draws nothing by it.
void check_spread(const std::string& source, const ValveUnderTest& valve);

/// Every key of a valve but `preset`; scenario files hold them as well.
void add_valve_settings(Settings& settings, ValveUnderTest& valve);

/// With spread and wear applied to plant and LVDT; inside every range. Electronics of a whole valve choose the solenoid
/// by the sign of their controller's output, and a held difference is one over its whole path.
[[nodiscard]] ValveUnderTest as_built(ValveUnderTest valve);

/// The same valve turned end for end, as it lies on a bench of direction a: solenoids, springs and edges change places,
/// x and the LVDT's signal change sign, so that x > 0 opens P to A of the valve.
[[nodiscard]] ValveUnderTest turned_round(ValveUnderTest valve);

}  // namespace spoolflow::rig
