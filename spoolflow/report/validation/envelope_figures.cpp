#include <algorithm>

#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"

namespace spoolflow::report {
namespace {

/// A range on both axes.
struct Box {
  double x_lowest, x_highest, y_lowest, y_highest;

  [[nodiscard]] bool holds(double x, double y) const {
    return x >= x_lowest && x <= x_highest && y >= y_lowest && y <= y_highest;
  }
};

/// Calibrated ranges, from left to right: one, or one each side of a whole valve's centre.
using Boxes = std::vector<Box>;

/// Points that were used.
struct Used {
  std::vector<double> x, y;
};

Mark shade(double x_from, double x_to, double y_from, double y_to, const char* name = "") {
  return {Shape::area, "fault", {}, name, "", 0, {x_from, x_to}, {y_from, y_from}, {y_to, y_to}};
}

Mark dots(Used points, const char* tone, const char* name) {
  return {Shape::dots, tone, {}, name, "", 2.6, std::move(points.x), std::move(points.y), {}};
}

/// Points within and beyond the boxes, and what lies around it as far as the axes reach.
struct Sides {
  Used inside, outside;
  Box axes;
};

Sides sides_of(const Used& used, const Boxes& calibrated) {
  Sides out{{}, {}, calibrated.front()};
  for (const Box& box : calibrated) {
    out.axes.x_highest = std::max(out.axes.x_highest, box.x_highest);
    out.axes.y_lowest = std::min(out.axes.y_lowest, box.y_lowest);
    out.axes.y_highest = std::max(out.axes.y_highest, box.y_highest);
  }
  for (std::size_t k = 0; k < used.x.size(); ++k) {
    const bool held = std::ranges::any_of(calibrated, [&](auto& box) { return box.holds(used.x[k], used.y[k]); });
    Used& side = held ? out.inside : out.outside;
    side.x.push_back(used.x[k]);
    side.y.push_back(used.y[k]);
    out.axes.x_lowest = std::min(out.axes.x_lowest, used.x[k]);
    out.axes.x_highest = std::max(out.axes.x_highest, used.x[k]);
    out.axes.y_lowest = std::min(out.axes.y_lowest, used.y[k]);
    out.axes.y_highest = std::max(out.axes.y_highest, used.y[k]);
  }
  const double x_margin = 0.04 * (out.axes.x_highest - out.axes.x_lowest);
  const double y_margin = 0.06 * (out.axes.y_highest - out.axes.y_lowest);
  out.axes = {out.axes.x_lowest - x_margin, out.axes.x_highest + x_margin, out.axes.y_lowest - y_margin,
              out.axes.y_highest + y_margin};
  return out;
}

/// What an envelope is called.
struct Names {
  std::string description;
  Text caption;
};

CaptionedFigure with_points(const Names& names, Panel panel, Sides sides) {
  panel.lowest = sides.axes.y_lowest;
  panel.highest = sides.axes.y_highest;
  panel.marks.push_back(dots(std::move(sides.inside), "ink", "used by the runs"));
  if (!sides.outside.x.empty()) panel.marks.push_back(dots(std::move(sides.outside), "fault", "used, extrapolated"));
  return {{.description = names.description,
           .x_title = "Position",
           .x_quantity = units::Kind::length,
           .x_lowest = sides.axes.x_lowest,
           .x_highest = sides.axes.x_highest,
           .panels = {std::move(panel)}},
          names.caption};
}

/// `panel`: the axis.
CaptionedFigure box_figure(const Names& names, Panel panel, const Used& used, const Boxes& calibrated) {
  Sides sides = sides_of(used, calibrated);
  const Box& axes = sides.axes;
  panel.marks = {
      shade(axes.x_lowest, calibrated.front().x_lowest, axes.y_lowest, axes.y_highest, "not calibrated"),
      shade(calibrated.back().x_highest, axes.x_highest, axes.y_lowest, axes.y_highest),
  };
  double from = calibrated.front().x_lowest;
  for (const Box& box : calibrated) {
    panel.marks.push_back(shade(from, box.x_highest, axes.y_lowest, box.y_lowest));
    panel.marks.push_back(shade(from, box.x_highest, box.y_highest, axes.y_highest));
    from = box.x_highest;
  }
  return with_points(names, std::move(panel), std::move(sides));
}

/// A column of all runs' points.
template <class Point>
Used used_by(const std::vector<validation::RunResult>& runs, std::vector<Point> validation::RunResult::*points,
             double Point::*other) {
  Used out;
  for (const validation::RunResult& run : runs) {
    for (const Point& point : run.*points) {
      out.x.push_back(point.position_m);
      out.y.push_back(point.*other);
    }
  }
  return out;
}

/// The level with the highest pressure difference; null where none was recorded.
const model::AxialForceLoop* highest_level(const model::Evidence& evidence) {
  const auto& loops = evidence.axial_force;
  const auto highest = std::ranges::max_element(
      loops, [](auto& a, auto& b) { return a.pressure_difference_set_Pa < b.pressure_difference_set_Pa; });
  return highest == loops.end() || highest->position_m.empty() ? nullptr : &*highest;
}

/// Flow over position: calibrated between no flow and the flow at the highest pressure difference of the bench.
CaptionedFigure flow_figure(const model::Model& model, const Used& used) {
  const model::AxialForceLoop& highest = *highest_level(model.evidence);
  const model::AxialForceLoop* const p_to_a = model.whole() ? highest_level(model.p_to_a->evidence) : nullptr;
  Mark above{Shape::area, "fault", {}, "above the highest calibrated pressure difference", "", 0, {}, {}, {}};
  above.x = highest.position_m;
  above.y = highest.flow_m3_per_s;
  Mark below{Shape::area, "fault", {}, "", "", 0, {}, {}, {}};
  Boxes calibrated{{above.x.front(), above.x.back(), 0, *std::ranges::max_element(above.y)}};
  if (p_to_a != nullptr) {
    below.x = scaled(p_to_a->position_m, -1);
    below.y_upper = scaled(p_to_a->flow_m3_per_s, -1);
    calibrated.insert(calibrated.begin(),
                      {below.x.back(), below.x.front(), *std::ranges::min_element(below.y_upper), 0});
  }
  Sides sides = sides_of(used, calibrated);
  sides.inside = used;
  sides.outside = {};
  above.y_upper.assign(above.y.size(), sides.axes.y_highest);
  below.y.assign(below.y_upper.size(), sides.axes.y_lowest);
  Panel panel{.title = "Flow rate", .quantity = units::Kind::flow, .height_px = 220};
  panel.marks.push_back(std::move(above));
  if (p_to_a != nullptr) panel.marks.push_back(std::move(below));
  return with_points({"Flow rate over position: calibrated and used",
                      phrase("Flow rates over position; shaded: above the bench's flow at {}.",
                             fixed(units::pressure(highest.pressure_difference_set_Pa), 0))},
                     std::move(panel), std::move(sides));
}

/// Noise of a spool that stands in the centre of a whole valve is on no side of it.
double centre_margin_m(const model::Condensed& map) {
  constexpr double share = 0.02;
  return share * map.position_m.upper;
}

Boxes calibrated_pressures(const model::Condensed& map, const model::Condensed* p_to_a) {
  const auto box = [](const model::Condensed& of, double from_m, double to_m) {
    return Box{from_m, to_m, of.pressure_difference_Pa.lower, of.pressure_difference_Pa.upper};
  };
  if (p_to_a == nullptr) return {box(map, map.position_m.lower, map.position_m.upper)};
  return {box(*p_to_a, -p_to_a->position_m.upper, 0), box(map, 0, map.position_m.upper)};
}

Boxes calibrated_currents(const model::Condensed& map, const model::Condensed* p_to_a) {
  if (p_to_a == nullptr)
    return {{map.position_m.lower, map.position_m.upper, map.current_A.lower, map.current_A.upper}};
  const double margin_m = centre_margin_m(map);
  return {{-p_to_a->position_m.upper, -margin_m, -p_to_a->current_A.upper, 0},
          {-margin_m, margin_m, -p_to_a->current_A.upper, map.current_A.upper},
          {margin_m, map.position_m.upper, 0, map.current_A.upper}};
}

std::optional<Span> calibrated_temperatures_K(const model::Model& model) {
  if (model.observer) return Span{model.observer->oil_temperature_K.lower, model.observer->oil_temperature_K.upper, 1};
  if (model.condensed.oil_temperature_K) {
    return Span{*model.condensed.oil_temperature_K, *model.condensed.oil_temperature_K, 1};
  }
  return std::nullopt;
}

std::optional<CaptionedFigure> temperature_figure(const model::Model& model,
                                                  const std::vector<validation::RunResult>& runs) {
  constexpr double near_K = 0.5;  // of noise, that no extrapolation is
  Panel panel{.title = "Oil temperatures", .height_px = 0};
  const std::optional<Span> calibrated = calibrated_temperatures_K(model);
  if (calibrated) panel.rows.push_back({"calibrated", "soft", {*calibrated}});
  const std::size_t before = panel.rows.size();
  for (const validation::RunResult& run : runs) {
    if (!run.oil_temperature_K) continue;
    const Span used{run.oil_temperature_K->lowest, run.oil_temperature_K->highest, 1};
    const bool outside = calibrated && (used.from < calibrated->from - near_K || used.to > calibrated->to + near_K);
    panel.rows.push_back({outside ? run.name + ", extrapolated" : run.name, outside ? "fault" : "observer", {used}});
  }
  if (panel.rows.size() == before) return std::nullopt;
  return CaptionedFigure{{.description = "Oil temperatures, calibrated and used",
                          .x_title = "Oil temperature",
                          .x_quantity = units::Kind::temperature,
                          .panels = {std::move(panel)}},
                         "Oil temperatures of the calibration and of the runs."};
}

}  // namespace

std::vector<CaptionedFigure> envelope_figures(const model::Model& model,
                                              const std::vector<validation::RunResult>& runs) {
  using Run = validation::RunResult;
  std::vector<CaptionedFigure> out;
  const model::Condensed& map = model.condensed;
  const model::Condensed* const p_to_a = model.whole() ? &model.p_to_a->condensed : nullptr;
  const Used pressures = used_by(runs, &Run::operating_points, &validation::OperatingPoint::pressure_difference_Pa);
  if (!pressures.x.empty()) {
    out.push_back(box_figure({"Pressure difference over position: calibrated and used",
                              "Working points against the flow-force map's range; shaded: extrapolation."},
                             {.title = "Pressure difference", .quantity = units::Kind::pressure, .height_px = 220},
                             pressures, calibrated_pressures(map, p_to_a)));
  }
  const Used flows = used_by(runs, &Run::flow_points, &validation::FlowPoint::flow_m3_per_s);
  if (!flows.x.empty() && highest_level(model.evidence) != nullptr) {
    out.push_back(flow_figure(model, flows));
  }
  const Used currents = used_by(runs, &Run::solenoid_points, &validation::SolenoidPoint::current_A);
  if (!currents.x.empty()) {
    const Text caption = p_to_a == nullptr
                             ? "Working points against the magnetic-force map's range; shaded: extrapolation."
                             : "Working points against the ranges of both solenoids' magnetic-force maps: current of "
                               "coil b less that of coil a; shaded: extrapolation.";
    out.push_back(box_figure({"Coil current over position: calibrated and used", caption},
                             {.title = p_to_a == nullptr ? "Coil current" : "Coil current, b less a",
                              .quantity = units::Kind::current,
                              .height_px = 220},
                             currents, calibrated_currents(map, p_to_a)));
  }
  if (auto temperatures = temperature_figure(model, runs)) out.push_back(std::move(*temperatures));
  return out;
}

void show_envelope(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs) {
  const std::vector<CaptionedFigure> figures = envelope_figures(model, runs);
  if (figures.empty()) return;
  page.section("Calibrated and used");
  page.pair(figures);
}

}  // namespace spoolflow::report
