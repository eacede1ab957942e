#include "spoolflow/report/text/text.hpp"

#include <algorithm>

namespace spoolflow::report {

Text::Text(const QuantityText& quantity) : open_([quantity](const ReaderUnits& units) { return quantity.in(units); }) {}

Text& Text::operator+=(const Text& more) {
  if (!open_ && !more.open_) {
    plain_ += more.plain_;
  } else {
    *this = phrase("{}{}", *this, more);
  }
  return *this;
}

std::string spaced(std::string_view name) {
  std::string out(name);
  std::ranges::replace(out, '_', ' ');
  return out;
}

Text unit_text(units::Kind kind) {
  return Text([kind](const ReaderUnits& units) { return std::string(units.unit(kind).shown); });
}

Text range_text(const QuantityText& lowest, const QuantityText& highest) {
  return Text([=](const ReaderUnits& units) {
    const std::string to = highest.in(units);
    return lowest.in(units) == to ? to : fmt::format("{} to {}", bare(lowest).in(units), to);
  });
}

}  // namespace spoolflow::report
