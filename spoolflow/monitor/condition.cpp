#include "spoolflow/monitor/condition.hpp"

namespace spoolflow::monitor {

std::string_view name(Ne107 sign) {
  constexpr std::array<std::string_view, 5> names{"good", "M", "S", "C", "F"};
  return names.at(static_cast<std::size_t>(sign));
}

std::string_view name(Fault fault) {
  constexpr std::array<std::string_view, faults> names{"friction",        "edge_wear",          "spring",     "coil",
                                                       "position_sensor", "temperature_sensor", "wrong_model"};
  return names.at(static_cast<std::size_t>(fault));
}

std::string_view name(IndicatorState state) {
  constexpr std::array<std::string_view, 5> names{"unknown", "learning", "good", "raised", "counts"};
  return names.at(static_cast<std::size_t>(state));
}

}  // namespace spoolflow::monitor
