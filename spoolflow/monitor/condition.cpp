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

Ne107 sign_of(Fault fault) {
  return fault < Fault::position_sensor ? Ne107::maintenance_required : Ne107::out_of_specification;
}

std::string_view name(IndicatorState state) {
  constexpr std::array<std::string_view, 5> names{"unknown", "learning", "good", "raised", "counts"};
  return names.at(static_cast<std::size_t>(state));
}

}  // namespace spoolflow::monitor
