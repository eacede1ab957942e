#include "spoolflow/report/figures/reader_axes.hpp"

namespace spoolflow::report {
namespace {

/// Turns the values of one axis; of an axis without a quantity none.
class Axis {
 public:
  Axis(std::optional<units::Kind>& quantity, const ReaderUnits& units) : quantity_(quantity), units_(units) {
    quantity.reset();
  }

  [[nodiscard]] std::string titled(const std::string& title) const {
    return quantity_ ? title + " [" + std::string(units_.unit(*quantity_).shown) + "]" : title;
  }
  void turn(double& value) const {
    if (quantity_) value = units_.value({*quantity_, value});
  }
  void turn(std::optional<double>& value) const {
    if (value) turn(*value);
  }
  void turn(std::vector<double>& values) const {
    for (double& value : values) turn(value);
  }

 private:
  std::optional<units::Kind> quantity_;
  const ReaderUnits& units_;
};

void write_out(Text& text, const ReaderUnits& units) {
  text = text.in(units);
}

void turn_panel(Panel& panel, const Axis& x, const ReaderUnits& units) {
  const Axis y(panel.quantity, units);
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

Figure in_units(Figure figure, const ReaderUnits& units) {
  const Axis x(figure.x_quantity, units);
  figure.x_title = x.titled(figure.x_title.in(units));
  x.turn(figure.x_lowest);
  x.turn(figure.x_highest);
  for (Panel& panel : figure.panels) turn_panel(panel, x, units);
  return figure;
}

BarChart in_units(BarChart chart, const ReaderUnits& units) {
  const Axis axis(chart.quantity, units);
  chart.axis = axis.titled(chart.axis);
  for (Bar& bar : chart.bars) {
    for (Bar::Length* length : {&bar.solid, bar.pale ? &*bar.pale : nullptr}) {
      if (length == nullptr) continue;
      axis.turn(length->value);
      axis.turn(length->lower);
      axis.turn(length->upper);
    }
    write_out(bar.text, units);
  }
  axis.turn(chart.lowest);
  axis.turn(chart.highest);
  return chart;
}

}  // namespace spoolflow::report
