#include "spoolflow/analysis/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/rig/bench/settings_file.hpp"

namespace spoolflow::analysis {
namespace {

rig::Settings settings_of(Scenario& scenario) {
  rig::Settings out;
  out.add_value("seed", scenario.seed);
  out.add("points", scenario.points).add("instruments", scenario.instruments);
  out.add("monte_carlo", scenario.monte_carlo).add("map", scenario.map).add("run", scenario.run);
  out.add("study", scenario.study);
  out.add_value("points.pairs", scenario.points.pairs).add_value("points.closing", scenario.points.closing);
  out.add_value("instruments.one_load_cell", scenario.instruments.one_load_cell);
  out.add_value("monte_carlo.adaptive", scenario.monte_carlo.adaptive);
  out.add_value("run.other_bench", scenario.run.other_bench);
  out.add_value("study.skip", scenario.study.skip).add_value("study.given_model", scenario.study.given_model);
  out.add_value("study.valve", scenario.study.valve);
  return out;
}

std::string line_of(std::string_view name, const std::string& value, std::string_view remark, bool given = true) {
  return fmt::format("{:<46}# {}\n", fmt::format("{}{} = {}", given ? "" : "# ", name, value), remark);
}

/// The lines of one table. Keys without a default are written as remarks.
template <class Aggregate>
std::string lines_of(std::string_view table, const Aggregate& aggregate) {
  std::string out = fmt::format("\n[{}]\n", table);
  std::string nested;
  Aggregate::describe(aggregate, [&](const auto& what, const auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(what)>, Parameter>) {
      const std::string remark = fmt::format("{:g} to {:g} {}: {}", what.min, what.max, what.unit, what.why);
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, double>) {
        const bool given = std::isfinite(member);
        out += line_of(what.name, given ? fmt::format("{:g}", member) : fmt::format("{:g}", what.min), remark, given);
      } else {
        const bool given = !member.empty();
        out += line_of(what.name, given ? fmt::format("[{}]", fmt::join(member, ", ")) : "[10, 60]", remark, given);
      }
    } else {
      nested = lines_of(fmt::format("{}.{}", table, what), member);
    }
  });
  return out + nested;
}

void check(const Scenario& scenario, const std::string& name) {
  if (scenario.study.spread.oil_coldest_C >= scenario.study.spread.oil_warmest_C) {
    throw rig::SettingsError(fmt::format("{}: study.spread.oil_coldest_C = {} is not below oil_warmest_C = {}", name,
                                         scenario.study.spread.oil_coldest_C, scenario.study.spread.oil_warmest_C));
  }
  const PointSettings& points = scenario.points;
  if (points.pairs && points.positions_percent.size() != points.pressure_differences_bar.size()) {
    throw rig::SettingsError(
        fmt::format("{}: points.pairs wants as many pressure_differences_bar ({}) as positions_percent ({})", name,
                    points.pressure_differences_bar.size(), points.positions_percent.size()));
  }
}

/// A half width or deviation in SI; "scenario" where it is not the default.
uncertainty::InstrumentFigure figure(double value, double default_value, double per_SI,
                                     const uncertainty::InstrumentFigure& otherwise) {
  return {value / per_SI, value == default_value ? otherwise.source : "scenario"};
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file) {
  const rig::SettingsSource source = rig::read_settings_source(file);
  Scenario scenario;
  rig::apply(source, settings_of(scenario));
  check(scenario, source.name);
  std::string& valve = scenario.study.valve;
  if (valve.ends_with(".toml")) valve = (file.parent_path() / valve).string();
  return scenario;
}

std::string scenario_template() {
  const Scenario scenario;
  std::string out =
      "# Scenario of `spoolflow analyse`. Every key may be left out; these are the defaults.\n"
      "seed = 1\n";
  const auto flag = [](std::string_view name, std::string_view remark) { return line_of(name, "false", remark); };
  out += lines_of("points", scenario.points);
  out += flag("pairs", "true: the first position with the first pressure difference, and so on");
  out += flag("closing", "true: the spool passes the points while it closes");
  out += "\n# Half widths of rectangular distributions; noises are standard deviations.";
  out += lines_of("instruments", scenario.instruments);
  out += flag("one_load_cell", "true: both benches used the same load cell, so its gain error is common");
  out += lines_of("monte_carlo", scenario.monte_carlo);
  out += flag("adaptive", "true: blocks of `trials` until the figures are stable (JCGM 101, 7.9)");
  out += lines_of("map", scenario.map);
  out += "\n# With --recording.";
  out += lines_of("run", scenario.run);
  out += flag("other_bench", "true: not the campaign's oil and flow meter, so that their errors show");
  out += "\n# The global study on the virtual rig; [study.spread] holds standard deviations, cut off at 2.5 of them.";
  std::string study = lines_of("study", scenario.study);
  const std::string own =
      line_of("valve", "\"auto\"", "a preset, a valve file, or auto: the preset of nearest flow") +
      flag("given_model", "true: the sensor runs with MODEL.json; false: with the virtual valve's") +
      flag("skip", "true: no global study");
  study.insert(study.find("\n[study.spread]"), own);
  return out + study;
}

uncertainty::InstrumentFigures instrument_figures(const InstrumentSettings& s) {
  const InstrumentSettings d;
  const uncertainty::InstrumentFigures o;
  uncertainty::InstrumentFigures out;
  if (!std::isnan(s.position_zero_um)) out.position_zero_m = {s.position_zero_um * 1e-6, "scenario"};
  out.position_gain = figure(s.position_gain_percent, d.position_gain_percent, 100, o.position_gain);
  if (!std::isnan(s.position_noise_um)) out.position_noise_m = {s.position_noise_um * 1e-6, "scenario"};
  out.current_gain = figure(s.current_gain_percent, d.current_gain_percent, 100, o.current_gain);
  out.current_offset_A = figure(s.current_offset_mA, d.current_offset_mA, 1000, o.current_offset_A);
  out.current_noise_A = figure(s.current_noise_mA, d.current_noise_mA, 1000, o.current_noise_A);
  out.voltage_offset_V = figure(s.voltage_offset_mV, d.voltage_offset_mV, 1000, o.voltage_offset_V);
  out.thermometer_K = figure(s.thermometer_K, d.thermometer_K, 1, o.thermometer_K);
  if (!std::isnan(s.oil_temperature_away_K)) out.oil_temperature_away_K = {s.oil_temperature_away_K, "scenario"};
  out.load_cell = figure(s.load_cell_percent, d.load_cell_percent, 100, o.load_cell);
  out.flow_meter = figure(s.flow_meter_percent, d.flow_meter_percent, 100, o.flow_meter);
  out.oil_density = figure(s.oil_density_percent, d.oil_density_percent, 100, o.oil_density);
  out.oil_viscosity = figure(s.oil_viscosity_percent, d.oil_viscosity_percent, 100, o.oil_viscosity);
  out.one_load_cell = s.one_load_cell;
  return out;
}

}  // namespace spoolflow::analysis
