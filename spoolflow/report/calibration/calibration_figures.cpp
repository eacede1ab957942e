#include "spoolflow/report/calibration/calibration_figures.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::report {
namespace {

using units::Kind;

/// Levels in rising order, whatever the order in which they were recorded.
std::vector<const model::AxialForceLoop*> by_pressure(const model::Evidence& evidence) {
  std::vector<const model::AxialForceLoop*> out;
  for (const model::AxialForceLoop& loop : evidence.axial_force) out.push_back(&loop);
  std::sort(out.begin(), out.end(),
            [](auto* a, auto* b) { return a->pressure_difference_set_Pa < b->pressure_difference_set_Pa; });
  return out;
}

std::vector<const model::MagneticForceLoop*> by_current(const model::Evidence& evidence) {
  std::vector<const model::MagneticForceLoop*> out;
  for (const model::MagneticForceLoop& loop : evidence.magnetic_force) out.push_back(&loop);
  std::sort(out.begin(), out.end(), [](auto* a, auto* b) { return a->current_A < b->current_A; });
  return out;
}

std::vector<double> half_width(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out;
  for (std::size_t k = 0; k < a.size(); ++k) out.push_back(0.5 * std::abs(a[k] - b[k]));
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// A line through the mean of both directions at one position, over all levels.
Mark position_line(const std::vector<const model::AxialForceLoop*>& loops, std::size_t at) {
  Mark line{
      .shape = Shape::line,
      .tone = "muted",
      .end_label = fixed(units::length(loops.front()->position_m[at]), 1),
      .width_px = 0.9,
  };
  for (const model::AxialForceLoop* loop : loops) {
    line.x.push_back(0.5 * (loop->opening_N[at] + loop->closing_N[at]));
    line.y.push_back(loop->flow_m3_per_s[at]);
  }
  return line;
}

}  // namespace

CaptionedFigure flow_force_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Flow rate", .quantity = Kind::flow, .height_px = 400, .lowest = 0.0};
  const auto loops = by_pressure(evidence);
  if (!loops.empty()) {
    const std::size_t points = loops.front()->position_m.size();
    for (const double share : {0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0}) {
      panel.marks.push_back(position_line(loops, static_cast<std::size_t>(share * static_cast<double>(points - 1))));
    }
    panel.marks.front().name = "one position, both directions averaged";
  }
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const std::vector<double>& flow = loops[k]->flow_m3_per_s;
    const bool last = k + 1 == loops.size();
    panel.marks.push_back(
        {Shape::line, "", ramp(k, loops.size()), last ? "spool opens" : "", "", 1.6, loops[k]->opening_N, flow, {}});
    panel.marks.push_back(
        {Shape::dashed, "", ramp(k, loops.size()), last ? "spool closes" : "", "", 1.2, loops[k]->closing_N, flow, {}});
  }
  Text levels;
  for (const model::AxialForceLoop* loop : loops) {
    if (!levels.empty()) levels += ", ";
    levels += bare(three_digits(units::pressure(loop->pressure_difference_set_Pa)));
  }
  return {{.description = "Flow rate over axial force at held pressure differences, both directions of motion",
           .x_title = "Axial force",
           .x_quantity = Kind::force,
           .panels = {std::move(panel)}},
          phrase("Flow rate over axial force (the paper's Fig. 5) at held pressure differences of {} {}, pale to "
                 "deep. Between an opening and its closing line lies twice the friction. Along a line of position "
                 "the flow is read off the force: the steeper the line, the more flow a newton of error costs.",
                 levels, unit_text(Kind::pressure)),
          {}};
}

CaptionedFigure magnetic_force_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Magnetic force", .quantity = Kind::force, .height_px = 400};
  const auto loops = by_current(evidence);
  for (std::size_t k = loops.size(); k-- > 0;) {
    const std::vector<double>& position = loops[k]->position_m;
    const bool last = k + 1 == loops.size();
    panel.marks.push_back({Shape::line,
                           "",
                           ramp(k, loops.size()),
                           last ? "armature opens" : "",
                           fixed(units::current(loops[k]->current_A), 1),
                           1.6,
                           position,
                           loops[k]->opening_N,
                           {}});
    panel.marks.push_back({Shape::dashed,
                           "",
                           ramp(k, loops.size()),
                           last ? "armature closes" : "",
                           "",
                           1.2,
                           position,
                           loops[k]->closing_N,
                           {}});
  }
  return {{.description = "Magnetic force over position at held currents, both directions of motion",
           .x_title = "Position",
           .x_quantity = Kind::length,
           .panels = {std::move(panel)}},
          "Magnetic force over position (the paper's Fig. 8) at held currents. The gap between both directions is "
          "hysteresis and friction of the armature; the sensor's map is their mean.",
          {}};
}

CaptionedFigure friction_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Spool friction, half width", .quantity = Kind::force, .height_px = 250, .lowest = 0.0};
  const auto loops = by_pressure(evidence);
  double least = INFINITY;
  double most = 0;
  for (std::size_t k = loops.size(); k-- > 0;) {
    std::vector<double> friction = half_width(loops[k]->opening_N, loops[k]->closing_N);
    least = std::min(least, mean(friction));
    most = std::max(most, mean(friction));
    panel.marks.push_back({Shape::line,
                           "",
                           ramp(k, loops.size()),
                           "",
                           three_digits(units::pressure(loops[k]->pressure_difference_set_Pa)),
                           1.4,
                           loops[k]->position_m,
                           std::move(friction),
                           {}});
  }
  return {
      {.description = "Friction half width over position per pressure difference",
       .x_title = "Position",
       .x_quantity = Kind::length,
       .panels = {std::move(panel)}},
      phrase("Half the width of the axial-force loops: friction that averaging removes from the map and that "
             "stays in the signal. It is {} on average at the lowest pressure difference and {} at the highest.",
             fixed(units::force(loops.empty() ? NAN : least), 1), fixed(units::force(loops.empty() ? NAN : most), 1)),
      {}};
}

CaptionedFigure hysteresis_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Solenoid hysteresis, half width", .quantity = Kind::force, .height_px = 250, .lowest = 0.0};
  const auto loops = by_current(evidence);
  double widest = 0;
  double widest_at_A = 0;
  for (std::size_t k = loops.size(); k-- > 0;) {
    std::vector<double> width = half_width(loops[k]->opening_N, loops[k]->closing_N);
    const double highest = width.empty() ? 0 : *std::max_element(width.begin(), width.end());
    if (highest > widest) widest = highest, widest_at_A = loops[k]->current_A;
    panel.marks.push_back({Shape::line,
                           "",
                           ramp(k, loops.size()),
                           "",
                           fixed(units::current(loops[k]->current_A), 1),
                           1.4,
                           loops[k]->position_m,
                           std::move(width),
                           {}});
  }
  return {{.description = "Half width of the magnetic force loops over position per current",
           .x_title = "Position",
           .x_quantity = Kind::length,
           .panels = {std::move(panel)}},
          phrase("Half the width of the magnetic-force loops, at most {} (at {}).", fixed(units::force(widest), 1),
                 fixed(units::current(widest_at_A), 1)),
          {}};
}

}  // namespace spoolflow::report
