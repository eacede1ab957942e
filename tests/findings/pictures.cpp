#include "tests/findings/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/report/figures/svg_figure.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/trace.hpp"

namespace spoolflow::findings {
namespace {

using report::Figure;
using report::Mark;
using report::Shape;

/// A figure as a file that stands alone: the reports' style sheet and the names of its marks inside.
void write(const std::filesystem::path& file, const Figure& figure) {
  const report::Layout layout{.width_px = 900};
  std::string drawing = report::svg_of(figure, layout, "figure");
  drawing.erase(0, drawing.find('>') + 1);
  drawing.resize(drawing.rfind("</svg>"));
  double height_px = 100;  // titles and axis
  for (const report::Panel& panel : figure.panels) height_px += panel.height_px;
  std::string names;
  double x = 60;
  for (const Mark& mark : figure.panels.front().marks) {
    if (mark.name.empty()) continue;
    names += fmt::format(R"(<path class="line {}" stroke-width="2.2" d="M{:.0f} -8h24"/>)", mark.tone, x);
    names += fmt::format(R"(<text class="label" x="{:.0f}" y="-4">{}</text>)", x + 31, mark.name.str());
    x += 60 + 7 * static_cast<double>(mark.name.str().size());
  }
  std::ofstream out(file);
  out << fmt::format(
             R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -24 950 {:.0f}" font-family="sans-serif" aria-label="{}">)",
             height_px, figure.description)
      << "<style>" << report::page_style()
      << R"svg(</style><rect x="0" y="-24" width="100%" height="100%" fill="var(--paper)"/>)svg" << names << drawing
      << "</svg>\n";
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

struct Labels {
  std::string description, x_title, panel_title;
  double height_px = 240;
};

Figure one_panel(const Labels& labels) {
  Figure figure{.description = labels.description, .x_title = labels.x_title};
  figure.panels.push_back({.title = labels.panel_title, .height_px = labels.height_px});
  return figure;
}

/// Place of the k-th of n lines along a family.
double along(std::size_t k, std::size_t n) {
  return n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0.5;
}

Figure solenoid_map(const std::vector<SolenoidLoop>& loops) {
  Figure figure = one_panel({.description = "Force of the solenoid over position, to and fro, at each held current",
                             .x_title = "Armature position [mm]; the air gap falls to the right",
                             .panel_title = "Force [N]",
                             .height_px = 420});
  for (std::size_t n = 0; n < loops.size(); ++n) {
    const SolenoidLoop& loop = loops[n];
    const auto farthest = std::max_element(loop.position_mm.begin(), loop.position_mm.end());
    const auto turn = static_cast<std::size_t>(farthest - loop.position_mm.begin());
    const auto way = [&](std::size_t begin, std::size_t end, std::string label) {
      Mark mark{.ramp = along(n, loops.size()), .end_label = std::move(label), .width_px = 1};
      for (std::size_t i = begin; i < end; i += 4) {
        mark.x.push_back(loop.position_mm[i]);
        mark.y.push_back(loop.force_N[i]);
      }
      figure.panels.front().marks.push_back(std::move(mark));
    };
    way(0, turn, loop.current_A > 0.9 ? fmt::format("{:.1f} A", loop.current_A) : "");
    way(turn, loop.force_N.size(), "");
  }
  return figure;
}

Figure loop_widths(const Measured& measured) {
  Figure figure = one_panel({.description = "Width of the solenoid's force loop over current, without and with dither",
                             .x_title = "Current [A]",
                             .panel_title = "Width of the force loop at mid stroke [N]"});
  figure.panels.front().lowest = 0;
  const auto add = [&](const char* name, const char* tone, const std::vector<SolenoidLoop>& loops) {
    Mark mark{.tone = tone, .name = name};
    for (const SolenoidLoop& loop : loops) {
      mark.x.push_back(loop.current_A);
      mark.y.push_back(loop.mid_width_N);
    }
    figure.panels.front().marks.push_back(std::move(mark));
  };
  add("without dither", "a", measured.plain);
  add("with dither", "condensed", measured.dithered);
  return figure;
}

Figure flow_force_map(const std::vector<FlowForceCurve>& curves) {
  Figure figure = one_panel({.description = "Flow over flow force at each position, 5 to 70 bar, 50 C",
                             .x_title = "Flow force [N]",
                             .panel_title = "Flow [L/min] at each position, 5 to 70 bar, 50 C",
                             .height_px = 380});
  for (std::size_t n = 0; n < curves.size(); ++n) {
    figure.panels.front().marks.push_back({.ramp = along(n, curves.size()),
                                           .end_label = fmt::format("{:.1f} mm", curves[n].position_mm),
                                           .x = curves[n].force_N,
                                           .y = curves[n].flow_L_min});
  }
  return figure;
}

Figure temperature_fall(const std::vector<TemperatureEffect>& effects) {
  Figure figure = one_panel({.description = "Flow force at constant flow over oil temperature",
                             .x_title = "Oil temperature [C]",
                             .panel_title = "Flow force over that at 30 C; pale 10 L/min, deep 70 L/min",
                             .height_px = 280});
  for (const TemperatureEffect& effect : effects) {
    Mark mark{.ramp = (effect.flow_L_min - 10) / 60, .width_px = 1, .x = effect.temperature_C};
    for (const double force_N : effect.force_N) mark.y.push_back(force_N / effect.force_N.front());
    figure.panels.front().marks.push_back(std::move(mark));
  }
  return figure;
}

Figure flow_over_time(const validation::RunSamples& run) {
  Figure figure = one_panel({.description = "Measured flow and that of the condensed sensor over time",
                             .x_title = "Time [s]",
                             .panel_title = "Flow [L/min]",
                             .height_px = 280});
  const auto add = [&](const char* name, const char* tone, const std::vector<float>& flow) {
    const validation::Line line = validation::thinned(run.time_s, flow, 700);
    Mark mark{.tone = tone, .name = name, .width_px = 1.2, .x = line.time_s};
    for (const float value : line.value) mark.y.push_back(units::L_per_min_from_m3_per_s(value));
    figure.panels.front().marks.push_back(std::move(mark));
  };
  add("condensed sensor", "condensed", run.answers.front().flow_m3_per_s);
  add("flow meter", "ink", run.reference_m3_per_s);
  return figure;
}

Figure force_at_rest(const std::vector<Rest>& rests) {
  Figure figure = one_panel({.description = "Magnetic force while the spool rests, the liveliest rest near three flows",
                             .x_title = "Time at rest [s]",
                             .panel_title = "Magnetic force about its mean [N]"});
  const auto add = [&](double flow_L_min, const char* tone) {
    const auto swing_near_N = [&](const Rest& at) {
      return std::abs(at.flow_L_min - flow_L_min) < 5 ? at.force_swing_N : 0;
    };
    const Rest& rest = *std::max_element(rests.begin(), rests.end(), [&](const Rest& one, const Rest& two) {
      return swing_near_N(one) < swing_near_N(two);
    });
    double mean_N = 0;
    for (const double force_N : rest.force_N) mean_N += force_N / static_cast<double>(rest.force_N.size());
    std::vector<float> about_N;
    for (const double force_N : rest.force_N) about_N.push_back(static_cast<float>(force_N - mean_N));
    const validation::Line line = validation::thinned(rest.time_s, about_N, 400);
    figure.panels.front().marks.push_back({.tone = tone,
                                           .name = fmt::format("{:.0f} L/min", rest.flow_L_min),
                                           .x = line.time_s,
                                           .y = {line.value.begin(), line.value.end()}});
  };
  add(10, "c");
  add(36, "a");
  add(64, "condensed");
  return figure;
}

Figure swing_over_flow(const std::vector<Rest>& rests) {
  Figure figure = one_panel({.description = "Peak-to-peak magnetic force of each rest over its flow",
                             .x_title = "Flow [L/min]",
                             .panel_title = "Swing of the magnetic force in each rest [N]"});
  figure.panels.front().lowest = 0;
  Mark mark{.shape = Shape::dots, .tone = "a", .width_px = 5};
  std::vector<const Rest*> by_flow;
  for (const Rest& rest : rests) by_flow.push_back(&rest);
  std::sort(by_flow.begin(), by_flow.end(),
            [](const Rest* one, const Rest* two) { return one->flow_L_min < two->flow_L_min; });
  for (const Rest* rest : by_flow) {
    mark.x.push_back(rest->flow_L_min);
    mark.y.push_back(rest->force_swing_N);
  }
  figure.panels.front().marks.push_back(std::move(mark));
  return figure;
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
