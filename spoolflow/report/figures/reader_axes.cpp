#include "spoolflow/report/figures/reader_axes.hpp"

namespace spoolflow::report {
namespace {

void write_out(Text& text, const ReaderUnits& units) {
  text = text.in(units);
}

void turn_panel(Panel& panel, const ReaderAxis& x, const ReaderUnits& units) {
  const ReaderAxis y(panel.quantity, units);
  panel.title = y.titled(panel.title.in(units)) + panel.title_end;
  panel.title_end.clear();
  y.turn(panel.lowest);
  y.turn(panel.highest);
  for (Cell& cell : panel.cells) {
    for (double* each : {&cell.x_from, &cell.x_to}) x.turn(*each);
    for (double* each : {&cell.y_from, &cell.y_to}) y.turn(*each);
  }
  for (Row& row : panel.rows) {
    for (Span& span : row.spans) {
      x.turn(span.from);
      x.turn(span.to);
    }
  }
  for (Mark& mark : panel.marks) {
    write_out(mark.name, units);
    write_out(mark.end_label, units);
    x.turn(mark.x);
    y.turn(mark.y);
    y.turn(mark.y_upper);
  }
}

}  // namespace

ReaderAxis::ReaderAxis(std::optional<units::Kind>& quantity, const ReaderUnits& units)
    : quantity_(quantity), units_(units) {
  quantity.reset();
}

std::string ReaderAxis::titled(const std::string& title) const {
  return quantity_ ? title + " [" + std::string(units_.unit(*quantity_).shown) + "]" : title;
}

void ReaderAxis::turn(double& value) const {
  if (quantity_) value = units_.value({*quantity_, value});
}

void ReaderAxis::turn(std::optional<double>& value) const {
  if (value) turn(*value);
}

void ReaderAxis::turn(std::vector<double>& values) const {
  for (double& value : values) turn(value);
}

Figure in_units(Figure figure, const ReaderUnits& units) {
  const ReaderAxis x(figure.x_quantity, units);
  figure.x_title = x.titled(figure.x_title.in(units));
  x.turn(figure.x_lowest);
  x.turn(figure.x_highest);
  for (Panel& panel : figure.panels) turn_panel(panel, x, units);
  return figure;
}

}  // namespace spoolflow::report
