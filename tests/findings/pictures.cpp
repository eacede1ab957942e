#include "tests/findings/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "spoolflow/report/svg_chart.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::findings {
namespace {

using report::Chart;
using report::Series;
using report::Stroke;

/// What the reports' page gives a chart; here it travels inside the picture, on white for every reader.
constexpr std::string_view style =
    R"(<style>text{font-family:system-ui,sans-serif}.grid{stroke:#dde2e8}.zero{stroke:#5b6675}
.tick,.mark{fill:#5b6675;font-size:11.5px}.label{fill:#1c2430;font-size:12.5px}.line{fill:none;stroke:currentColor;stroke-width:1.7;
stroke-linejoin:round}.thin{stroke-width:.9;opacity:.8}.dashed{stroke-dasharray:6 4}.dot{fill:currentColor;opacity:.75}
.c0{color:#0072b2}.c1{color:#d55e00}.c2{color:#009e73}.c3{color:#cc79a7}.c4{color:#56799a}.c5{color:#b58900}.c6{color:#5a4fcf}
.c7{color:#8a8f98}.c8{color:#aab2bd}</style><rect width="100%" height="100%" fill="#fff"/>)";

/// A chart as a file that stands alone, its legend written inside.
void write(const std::filesystem::path& file, const Chart& chart) {
  std::string svg = report::svg_of(chart);
  const std::size_t begin = svg.find("<svg");
  const std::size_t end = svg.find("</svg>");
  svg = svg.substr(begin, end - begin);
  const std::size_t opened = svg.find('>') + 1;
  std::string legend;
  double y = 30;
  for (const Series& series : chart.series) {
    if (series.name.empty()) continue;
    legend +=
        fmt::format(R"(<path class="line c{0}" d="M76 {1:.0f}h24"/><text class="tick" x="106" y="{2:.0f}">{3}</text>)",
                    series.colour, y - 4, y, series.name);
    y += 16;
  }
  svg = svg.substr(0, opened) + std::string(style) + svg.substr(opened) + legend + "</svg>\n";
  // Room on the right for the labels at the lines' ends.
  const std::string box = fmt::format("0 0 {:.0f} ", chart.width);
  if (const std::size_t at = svg.find(box); at != std::string::npos) {
    svg.replace(at, box.size(), fmt::format("0 0 {:.0f} ", chart.width + 40));
  }
  const std::size_t space = svg.find(' ');
  if (svg.find("xmlns=") == std::string::npos) svg.insert(space, R"( xmlns="http://www.w3.org/2000/svg")");
  std::ofstream out(file);
  out << svg;
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

struct Labels {
  const char *x_label, *y_label, *description;
};

Chart labelled(const Labels& labels) {
  Chart chart;
  chart.x_label = labels.x_label;
  chart.y_label = labels.y_label;
  chart.description = labels.description;
  return chart;
}

Series line(std::string name, int colour, Stroke stroke = Stroke::solid) {
  Series series;
  series.name = std::move(name);
  series.colour = colour;
  series.stroke = stroke;
  return series;
}

Chart solenoid_map(const std::vector<SolenoidLoop>& loops) {
  Chart chart = labelled({.x_label = "armature position in mm (air gap falls to the right)",
                          .y_label = "force in N",
                          .description = "Force of the solenoid over position, to and fro, at each held current"});
  chart.height = 440;
  int colour = 0;
  for (const SolenoidLoop& loop : loops) {
    const auto farthest = std::max_element(loop.position_mm.begin(), loop.position_mm.end());
    const auto turn = static_cast<std::size_t>(farthest - loop.position_mm.begin());
    const auto way = [&](std::size_t begin, std::size_t end, std::string label) {
      Series series = line("", colour % 8, Stroke::thin);
      for (std::size_t i = begin; i < end; i += 4) {
        series.x.push_back(loop.position_mm[i]);
        series.y.push_back(loop.force_N[i]);
      }
      series.label_at_end = std::move(label);
      chart.series.push_back(std::move(series));
    };
    way(0, turn, loop.current_A > 0.9 ? fmt::format("{:.1f} A", loop.current_A) : "");
    way(turn, loop.force_N.size(), "");
    ++colour;
  }
  return chart;
}

Chart loop_widths(const Measured& measured) {
  Chart chart = labelled({.x_label = "current in A",
                          .y_label = "loop width at mid stroke in N",
                          .description = "Width of the solenoid's force loop over current, without and with dither"});
  const auto add = [&](const char* name, const std::vector<SolenoidLoop>& loops, int colour) {
    Series series = line(name, colour);
    for (const SolenoidLoop& loop : loops) {
      series.x.push_back(loop.current_A);
      series.y.push_back(loop.mid_width_N);
    }
    chart.series.push_back(std::move(series));
  };
  add("without dither", measured.plain, 0);
  add("with dither", measured.dithered, 1);
  chart.y_lowest = 0;
  return chart;
}

Chart flow_force_map(const std::vector<FlowForceCurve>& curves) {
  Chart chart = labelled({.x_label = "flow force in N",
                          .y_label = "flow in L/min",
                          .description = "Flow over flow force at each position, 5 to 70 bar, 50 C"});
  chart.height = 400;
  int colour = 0;
  for (const FlowForceCurve& curve : curves) {
    Series series = line("", colour++ % 8);
    series.x = curve.force_N;
    series.y = curve.flow_L_min;
    series.label_at_end = fmt::format("{:.1f} mm", curve.position_mm);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

Chart temperature_fall(const std::vector<TemperatureEffect>& effects) {
  Chart chart =
      labelled({.x_label = "oil temperature in C",
                .y_label = "flow force over that at 30 C",
                .description = "Flow force at constant flow over oil temperature, for each position and flow"});
  int colour = 0;
  for (const TemperatureEffect& effect : effects) {
    Series series = line("", colour++ % 8, Stroke::thin);
    series.x = effect.temperature_C;
    for (const double force_N : effect.force_N) series.y.push_back(force_N / effect.force_N.front());
    chart.series.push_back(std::move(series));
  }
  chart.y_highest = 1.0;
  return chart;
}

Chart flow_over_time(const validation::ValidatedRun& run) {
  Chart chart = labelled({.x_label = "time in s",
                          .y_label = "flow in L/min",
                          .description = "Measured flow and that of the condensed sensor over time"});
  const auto add = [&](const char* name, const std::vector<double>& flow, int colour, Stroke stroke) {
    std::vector<double> flow_L_min;
    for (const double value : flow) flow_L_min.push_back(units::L_per_min_from_m3_per_s(value));
    const report::Decimated kept = report::decimate(run.time_s, flow_L_min, 700);
    Series series = line(name, colour, stroke);
    series.x = kept.x;
    series.y = kept.y;
    chart.series.push_back(std::move(series));
  };
  add("condensed sensor", run.results.front().flow_m3_per_s, 1, Stroke::thin);
  add("flow meter", run.reference_m3_per_s, 0, Stroke::solid);
  return chart;
}

Chart force_at_rest(const std::vector<Rest>& rests) {
  Chart chart =
      labelled({.x_label = "time at rest in s",
                .y_label = "magnetic force about its mean in N",
                .description = "Magnetic force while the spool rests, the liveliest rest near each of three flows"});
  const auto add = [&](double flow_L_min, int colour) {
    const Rest& rest = *std::max_element(rests.begin(), rests.end(), [&](const Rest& one, const Rest& two) {
      const auto swing_near_N = [&](const Rest& at) {
        return std::abs(at.flow_L_min - flow_L_min) < 5 ? at.force_swing_N : 0;
      };
      return swing_near_N(one) < swing_near_N(two);
    });
    double mean_N = 0;
    for (const double force_N : rest.force_N) mean_N += force_N / static_cast<double>(rest.force_N.size());
    std::vector<double> about_N;
    for (const double force_N : rest.force_N) about_N.push_back(force_N - mean_N);
    const report::Decimated kept = report::decimate(rest.time_s, about_N, 500);
    Series series = line(fmt::format("{:.0f} L/min", rest.flow_L_min), colour);
    series.x = kept.x;
    series.y = kept.y;
    chart.series.push_back(std::move(series));
  };
  add(10, 2);
  add(36, 0);
  add(66, 1);
  return chart;
}

Chart swing_over_flow(const std::vector<Rest>& rests) {
  Series series = line("", 0, Stroke::dots);
  std::vector<const Rest*> by_flow;
  for (const Rest& rest : rests) by_flow.push_back(&rest);
  std::sort(by_flow.begin(), by_flow.end(),
            [](const Rest* one, const Rest* two) { return one->flow_L_min < two->flow_L_min; });
  for (const Rest* rest : by_flow) {
    series.x.push_back(rest->flow_L_min);
    series.y.push_back(rest->force_swing_N);
  }
  Chart chart = labelled({.x_label = "flow in L/min",
                          .y_label = "swing of the magnetic force in N",
                          .description = "Peak-to-peak magnetic force of each rest over its flow"});
  chart.series = {series};
  chart.y_lowest = 0;
  return chart;
}

}  // namespace

void draw(const Measured& measured, const std::filesystem::path& folder) {
  write(folder / "solenoid_map.svg", solenoid_map(measured.plain));
  write(folder / "solenoid_loop_width.svg", loop_widths(measured));
  write(folder / "flow_force_map.svg", flow_force_map(measured.flow_forces));
  write(folder / "flow_force_temperature.svg", temperature_fall(measured.temperature));
  write(folder / "force_at_rest.svg", force_at_rest(measured.rests));
  write(folder / "force_swing_at_rest.svg", swing_over_flow(measured.rests));
  write(folder / "condensed_60bar.svg", flow_over_time(measured.condensed.ramp.front()));
  write(folder / "condensed_30_to_70bar.svg", flow_over_time(measured.condensed.ramps));
}

}  // namespace spoolflow::findings
