#include "spoolflow/recording/campaign_valve.hpp"

#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::recording {
namespace {

bool simulated_of(const TomlTable& table) {
  const std::optional<std::string> origin = table.optional_text("origin");
  if (origin && *origin != "simulated" && *origin != "measured") {
    throw RecordingError(
        fmt::format("{}: origin \"{}\" is not known; allowed: \"measured\" (the default), \"simulated\"",
                    table.place("origin"), *origin));
  }
  return origin == "simulated";
}

/// Of a valve whose stroke is known.
std::optional<double> open_stop_of(const TomlTable& table, double stroke_m) {
  constexpr double least_share = 0.5, most_share = 3;
  const double stroke_mm = units::mm_from_m(stroke_m);
  const auto written =
      table.optional_within("open_stop_mm", {least_share * stroke_mm, most_share * stroke_mm,
                                             "give what the position channel shows in mm where the spool meets its "
                                             "open stop"});
  return written ? std::optional(units::m_from_mm(*written)) : std::nullopt;
}

}  // namespace

std::optional<std::string> direction_of(const TomlTable& table) {
  std::optional<std::string> out = table.optional_text("direction");
  if (out && *out != "a" && *out != "b") {
    throw RecordingError(fmt::format("{}: direction \"{}\" is not known; allowed: \"b\" (flow P to B), \"a\" (P to A)",
                                     table.place("direction"), *out));
  }
  return out;
}

CampaignValve valve_of(const TomlTable& table) {
  table.allow_only({"name", "rated_flow_L_min", "stroke_mm", "direction", "origin", "open_stop_mm", "moving_mass_g"});
  constexpr NumberRange flows_L_min{0.05, 10000,
                                    "give it in L/min, where it stands in m3/s times 60000, in gal/min times 3.785"};
  constexpr NumberRange strokes_mm{0.1, 100,
                                   "give it in mm, where it stands in m times 1000, in um divided by 1000; no spool "
                                   "valve has another stroke"};
  CampaignValve valve{table.text("name"), units::m3_per_s_from_L_per_min(table.within("rated_flow_L_min", flows_L_min)),
                      units::m_from_mm(table.within("stroke_mm", strokes_mm)), direction_of(table).value_or("b"),
                      simulated_of(table)};
  valve.open_stop_m = open_stop_of(table, valve.stroke_m);
  constexpr double g_per_kg = 1000;
  const auto mass_g = table.optional_within(
      "moving_mass_g", {2, 5000, "give spool, push rod and armature together in g, where it stands in kg times 1000"});
  if (mass_g) valve.moving_mass_kg = *mass_g / g_per_kg;
  return valve;
}

CampaignValve unit_valve_of(const TomlTable& table, CampaignValve type) {
  table.allow_only({"name", "rated_flow_L_min", "stroke_mm", "direction", "origin", "open_stop_mm"});
  if (const auto name = table.optional_text("name")) type.name = *name;
  type.simulated = simulated_of(table);
  const auto require = [&](std::string_view key, double of_type) {
    const auto written = table.optional_positive(key);
    constexpr double alike = 1e-6;
    if (!written || std::abs(*written - of_type) <= alike * of_type) return;
    throw RecordingError(
        fmt::format("{}: {} = {} is not the type's {}; leave it out, or give the model of its own type",
                    table.place(key), key, *written, of_type));
  };
  require("rated_flow_L_min", units::L_per_min_from_m3_per_s(type.rated_flow_m3_per_s));
  require("stroke_mm", units::mm_from_m(type.stroke_m));
  type.open_stop_m = open_stop_of(table, type.stroke_m);
  return type;
}

CampaignFluid fluid_of(const TomlTable& table) {
  table.allow_only({"name", "density_15C_kg_per_m3", "viscosity_40C_mm2_per_s", "viscosity_100C_mm2_per_s"});
  constexpr NumberRange densities{500, 2000,
                                  "give it in kg/m3 (870 of mineral oil), where it stands in g/cm3 or kg/L times 1000"};
  constexpr NumberRange viscosities{
      0.3, 5000, "give it in mm2/s, which is cSt (46 of ISO VG 46 at 40 degC), where it stands in m2/s times 1e6"};
  const auto viscosity = [&](std::string_view key) -> std::optional<double> {
    const auto written = table.optional_within(key, viscosities);
    return written ? std::optional(units::m2_per_s_from_mm2_per_s(*written)) : std::nullopt;
  };
  CampaignFluid out{table.optional_text("name").value_or(""), table.optional_within("density_15C_kg_per_m3", densities),
                    viscosity("viscosity_40C_mm2_per_s"), viscosity("viscosity_100C_mm2_per_s")};
  if (out.viscosity_40C_m2_per_s && out.viscosity_100C_m2_per_s &&
      !(*out.viscosity_40C_m2_per_s > *out.viscosity_100C_m2_per_s)) {
    throw RecordingError(fmt::format(
        "{}: viscosity_40C_mm2_per_s = {:g} is not above viscosity_100C_mm2_per_s = {:g}, and oil thins as it warms; "
        "exchange them",
        table.place("viscosity_40C_mm2_per_s"), table.number("viscosity_40C_mm2_per_s"),
        table.number("viscosity_100C_mm2_per_s")));
  }
  return out;
}

}  // namespace spoolflow::recording
