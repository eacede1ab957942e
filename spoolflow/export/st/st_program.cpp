#include "spoolflow/export/st/st_program.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/cpp/exported_text.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::exports {
namespace {

/// A literal of type REAL, which needs a decimal point.
std::string real(float value) {
  std::string out = fmt::format("{:.9g}", value);
  if (out.find('.') != std::string::npos) return out;
  const std::size_t exponent = out.find('e');
  return out.insert(exponent == std::string::npos ? out.size() : exponent, ".0");
}

std::string lines_of(const sensor::CondensedTables<float>& tables) {
  constexpr std::size_t most_columns = 110;
  std::string out, line = "    ";
  for (std::size_t k = 0; k < tables.records.size(); ++k) {
    const bool last = k + 1 == tables.records.size();
    const std::string number = real(tables.records[k]) + (last ? "" : ", ");
    if (line.size() + number.size() > most_columns) {
      out += line.substr(0, line.size() - 1) + "\n";
      line = "    ";
    }
    line += number;
  }
  return out + line;
}

}  // namespace

std::string st_program(const model::Model& model) {
  if (model.whole()) {
    throw std::invalid_argument(
        fmt::format("{} is a model of both directions, and a function block serves one: give --direction a or b, and "
                    "export each",
                    model.valve.name));
  }
  using Layout = sensor::CondensedLayout;
  const auto tables = single_tables(model.condensed);
  return exported_text("condensed.st.in", {{"@VALVE@", in_a_block_comment(model.valve.name)},
                                           {"@DIRECTION@", model.valve.direction},
                                           {"@SHA256@", sha256_of_model(model)},
                                           {"@CELLS_PER_M@", real(tables->cells_per_m)},
                                           {"@CELLS_PER_A@", real(tables->cells_per_A)},
                                           {"@CLOSED_BELOW@", real(tables->closed_below_cells)},
                                           {"@FLOW_RESIDUAL@", real(tables->flow_residual_m3_per_s)},
                                           {"@STROKE_S@", real(static_cast<float>(sensor::unobserved_stroke_s))},
                                           {"@NOISE_CELLS@", real(static_cast<float>(sensor::noise_cells))},
                                           {"@OTHER_DIRECTION_M@", real(static_cast<float>(sensor::other_direction_m))},
                                           {"@RECORD@", std::to_string(Layout::record)},
                                           {"@CURRENT_CELLS@", std::to_string(Layout::current_cells)},
                                           {"@LAST_CURRENT_CELL@", std::to_string(Layout::current_cells - 1)},
                                           {"@ROOT_CELLS@", std::to_string(Layout::root_cells)},
                                           {"@LAST_ROOT_CELL@", std::to_string(Layout::root_cells - 1)},
                                           {"@POSITION_CELLS@", std::to_string(Layout::position_cells)},
                                           {"@LAST_POSITION_CELL@", std::to_string(Layout::position_cells - 1)},
                                           {"@SPRING@", std::to_string(Layout::spring)},
                                           {"@FORCE_PER_CELLS2@", std::to_string(Layout::force_per_cells2)},
                                           {"@UNCERTAINTY@", std::to_string(Layout::uncertainty)},
                                           {"@MAGNETIC_FORCE@", std::to_string(Layout::magnetic_force)},
                                           {"@PLANE@", std::to_string(Layout::plane)},
                                           {"@FLOW@", std::to_string(Layout::flow)},
                                           {"@FLOW_CELL@", std::to_string(Layout::flow_cell)},
                                           {"@ROOT_PRESSURE@", std::to_string(Layout::root_pressure)},
                                           {"@LAST@", std::to_string(tables->records.size() - 1)},
                                           {"@RECORDS@", lines_of(*tables)}});
}

}  // namespace spoolflow::exports
