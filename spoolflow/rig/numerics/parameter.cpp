#include "spoolflow/rig/numerics/parameter.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::rig {

void check_range(std::string_view path, const Parameter& parameter, double value) {
  if (value >= parameter.min && value <= parameter.max) return;
  throw std::invalid_argument(fmt::format("{} = {} is outside its range of {} to {} [{}]: choose a value inside ({})",
                                          path, value, parameter.min, parameter.max, parameter.unit, parameter.why));
}

}  // namespace spoolflow::rig
