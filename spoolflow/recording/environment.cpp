#include "spoolflow/recording/environment.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::recording {
namespace {

constexpr double standard_gravity_m_per_s2 = 9.80665;

/// One key: what it sets, SI per unit of it, and the least value above zero and the largest that make sense.
struct Key {
  const char* name;
  double Environment::*member;
  double per_unit;
  double least;
  double largest;
};

constexpr std::array keys{Key{"position_zero_um", &Environment::position_zero_m, 1e-6, 0.5, 1000},
                          Key{"position_gain_percent", &Environment::position_gain, 0.01, 0.05, 20},
                          Key{"viscosity_percent", &Environment::viscosity, 0.01, 1, 200},
                          Key{"temperature_K", &Environment::temperature_K, 1, 0.1, 60},
                          Key{"density_percent", &Environment::density, 0.01, 0.1, 30},
                          Key{"current_gain_percent", &Environment::current_gain, 0.01, 0.02, 20},
                          Key{"pwm_ripple_percent", &Environment::pwm_ripple, 0.01, 0.5, 100},
                          Key{"leakage_L_min", &Environment::leakage_m3_per_s, 1 / 60000.0, 1e-3, 100},
                          Key{"friction_percent", &Environment::friction, 0.01, 2, 200},
                          Key{"dithered_loop_percent", &Environment::dithered_loop, 0.01, 2, 200},
                          Key{"vibration_g", &Environment::vibration_m_per_s2, standard_gravity_m_per_s2, 0.01, 50},
                          Key{"ripple_bar", &Environment::ripple_Pa, 1e5, 0.01, 200}};

/// As the key ends: "percent" of position_gain_percent.
std::string unit_of(const std::string& key) {
  std::string written = key.substr(key.rfind('_') + 1);
  return written == "min" ? "L/min" : written;
}

Environment of_kind(const std::string& kind, const std::string& place) {
  if (kind == "bench") return {};
  if (kind == "machine") return machine_environment();
  throw RecordingError(
      fmt::format("{}: environment \"{}\" is not known; allowed: \"bench\" (nothing is left open), "
                  "\"machine\" (usual unknowns of a valve in the field)",
                  place, kind));
}

void require_known_keys(const TomlTable& table) {
  std::vector<std::string> allowed{"kind"};
  for (const Key& key : keys) allowed.emplace_back(key.name);
  allowed.emplace_back("highest_pressure_bar");
  table.allow_only(allowed);
}

Environment from_table(const TomlTable& table, const std::string& usual_kind) {
  require_known_keys(table);
  Environment out = of_kind(table.optional_text("kind").value_or(usual_kind), table.place("kind"));
  for (const Key& key : keys) {
    const std::optional<double> written = table.optional_number(key.name);
    if (!written) continue;
    if (!(*written >= 0 && *written <= key.largest)) {
      throw RecordingError(fmt::format("{}: {} = {} is out of range; give the half width at 95 %, 0 to {}",
                                       table.place(key.name), key.name, *written, key.largest));
    }
    if (*written > 0 && *written < key.least) {
      throw RecordingError(
          fmt::format("{}: {} = {} is nearer than anybody knows it; give the half width at 95 % in {}, {} to {}, or 0 "
                      "where nothing is left open",
                      table.place(key.name), key.name, *written, unit_of(key.name), key.least, key.largest));
    }
    out.*key.member = *written * key.per_unit;
  }
  constexpr NumberRange pressures_bar{
      1, 1000, "give the highest pressure difference in bar, where it stands in MPa times 10, in Pa divided by 1e5"};
  if (const auto written = table.optional_within("highest_pressure_bar", pressures_bar))
    out.highest_Pa = units::Pa_from_bar(*written);
  return out;
}

}  // namespace

Environment machine_environment() {
  Environment out;
  out.kind = "machine";
  out.position_zero_m = 20e-6;
  out.position_gain = 0.01;
  out.viscosity = 0.2;
  out.temperature_K = 5;
  out.density = 0.01;
  out.current_gain = 0.005;
  out.leakage_m3_per_s = 0.2 / 60000;
  out.friction = 0.2;
  out.dithered_loop = 1;
  out.vibration_m_per_s2 = 0.3 * standard_gravity_m_per_s2;
  out.ripple_Pa = 0.3e5;
  return out;
}

Environment environment_of(const TomlTable& document, const std::string& usual_kind) {
  const toml::node* node = document.table.get("environment");
  if (node == nullptr) return of_kind(usual_kind, document.file.string());
  if (const auto text = node->value<std::string>()) return of_kind(*text, place_of(*node, document.file));
  const toml::table* table = node->as_table();
  if (table == nullptr) {
    throw RecordingError(fmt::format("{}: environment is a table [environment], \"bench\" or \"machine\"",
                                     place_of(*node, document.file)));
  }
  return from_table({*table, document.file, "[environment]"}, usual_kind);
}

Environment read_environment(const std::string& name_or_file) {
  if (name_or_file == "bench" || name_or_file == "machine") return of_kind(name_or_file, name_or_file);
  const std::filesystem::path file(name_or_file);
  if (!std::filesystem::exists(file)) {
    throw RecordingError(
        fmt::format("{}: there is no such file{}; an environment is \"bench\", \"machine\" or a TOML file with a table "
                    "[environment]",
                    name_or_file, did_you_mean(name_or_file, {"bench", "machine"})));
  }
  const toml::table document = read_toml(file);
  if (!document.contains("environment")) {
    throw RecordingError(fmt::format(
        "{}: has no table [environment]; write one, or give \"bench\" or \"machine\" instead of a file", name_or_file));
  }
  const TomlTable whole{document, file, "an environment file"};
  whole.allow_only({"environment"});
  return environment_of(whole, "machine");
}

}  // namespace spoolflow::recording
