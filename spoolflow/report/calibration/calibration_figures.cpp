#include "spoolflow/report/calibration/calibration_figures.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::report {
namespace {

using units::Kind;

/// Levels in rising order, whatever the order in which they were recorded.
template <class Loop>
std::vector<const Loop*> rising(const std::vector<Loop>& loops, double Loop::*level) {
  std::vector<const Loop*> out;
  for (const Loop& loop : loops) out.push_back(&loop);
  std::ranges::sort(out, {}, [&](const Loop* loop) { return loop->*level; });
  return out;
}

std::vector<const model::AxialForceLoop*> by_pressure(const model::Evidence& evidence) {
  return rising(evidence.axial_force, &model::AxialForceLoop::pressure_difference_set_Pa);
}

std::vector<const model::MagneticForceLoop*> by_current(const model::Evidence& evidence) {
  return rising(evidence.magnetic_force, &model::MagneticForceLoop::current_A);
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

/// The k-th of n lines of a family, pale to deep.
void add(Panel& panel, std::size_t k, std::size_t n, Mark line) {
  line.tone = "";
  line.ramp = ramp(k, n);
  panel.marks.push_back(std::move(line));
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
    add(panel, k, loops.size(), {.name = last ? "spool opens" : "", .x = loops[k]->opening_N, .y = flow});
    add(panel, k, loops.size(),
        {.shape = Shape::dashed,
         .name = last ? "spool closes" : "",
         .width_px = 1.2,
         .x = loops[k]->closing_N,
         .y = flow});
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
                 levels, unit_text(Kind::pressure))};
}

CaptionedFigure magnetic_force_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Magnetic force", .quantity = Kind::force, .height_px = 400};
  const auto loops = by_current(evidence);
  for (std::size_t k = loops.size(); k-- > 0;) {
    const std::vector<double>& position = loops[k]->position_m;
    const bool last = k + 1 == loops.size();
    add(panel, k, loops.size(),
        {.name = last ? "armature opens" : "",
         .end_label = fixed(units::current(loops[k]->current_A), 1),
         .x = position,
         .y = loops[k]->opening_N});
    add(panel, k, loops.size(),
        {.shape = Shape::dashed,
         .name = last ? "armature closes" : "",
         .width_px = 1.2,
         .x = position,
         .y = loops[k]->closing_N});
  }
  return {{.description = "Magnetic force over position at held currents, both directions of motion",
           .x_title = "Position",
           .x_quantity = Kind::length,
           .panels = {std::move(panel)}},
          "Magnetic force over position (the paper's Fig. 8) at held currents. The gap between both directions is "
          "hysteresis and friction of the armature; the sensor's map is their mean."};
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
    add(panel, k, loops.size(),
        {.end_label = three_digits(units::pressure(loops[k]->pressure_difference_set_Pa)),
         .width_px = 1.4,
         .x = loops[k]->position_m,
         .y = std::move(friction)});
  }
  return {
      {.description = "Friction half width over position per pressure difference",
       .x_title = "Position",
       .x_quantity = Kind::length,
       .panels = {std::move(panel)}},
      phrase("Half the width of the axial-force loops: friction that averaging removes from the map and that "
             "stays in the signal. It is {} on average at the lowest pressure difference and {} at the highest.",
             fixed(units::force(loops.empty() ? NAN : least), 1), fixed(units::force(loops.empty() ? NAN : most), 1))};
}

CaptionedFigure hysteresis_figure(const model::Evidence& evidence) {
  Panel panel{.title = "Solenoid hysteresis, half width", .quantity = Kind::force, .height_px = 250, .lowest = 0.0};
  const auto loops = by_current(evidence);
  double widest = 0;
  double widest_at_A = 0;
  for (std::size_t k = loops.size(); k-- > 0;) {
    std::vector<double> width = half_width(loops[k]->opening_N, loops[k]->closing_N);
    const double highest = width.empty() ? 0 : *std::ranges::max_element(width);
    if (highest > widest) widest = highest, widest_at_A = loops[k]->current_A;
    add(panel, k, loops.size(),
        {.end_label = fixed(units::current(loops[k]->current_A), 1),
         .width_px = 1.4,
         .x = loops[k]->position_m,
         .y = std::move(width)});
  }
  return {{.description = "Half width of the magnetic force loops over position per current",
           .x_title = "Position",
           .x_quantity = Kind::length,
           .panels = {std::move(panel)}},
          phrase("Half the width of the magnetic-force loops, at most {} (at {}).", fixed(units::force(widest), 1),
                 fixed(units::current(widest_at_A), 1))};
}

}  // namespace spoolflow::report
