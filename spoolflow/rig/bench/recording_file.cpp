#include "spoolflow/rig/bench/recording_file.hpp"

#include <ostream>
#include <string_view>

#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

/// written = scale * SI + offset
struct Column {
  std::string_view header;
  int decimals;
  double scale;
  double offset;
};

Column column(Channel channel, bool several_rates) {
  constexpr double per_Pa = 1 / units::pascal_per_bar;
  constexpr double per_m3_per_s = units::litre_per_minute_per_m3_per_s;
  switch (channel) {
    case Channel::time:
      return {"time_s", several_rates ? 5 : 4, 1, 0};
    case Channel::current:
      return {"current_A", 5, 1, 0};
    case Channel::current_set:
      return {"current_set_A", 3, 1, 0};
    case Channel::voltage:
      return {"voltage_V", 3, 1, 0};
    case Channel::position:
      return {"position_mm", 5, units::millimetre_per_metre, 0};
    case Channel::position_set:
      return {"position_set_percent", 3, 100, 0};
    case Channel::force:
      return {"force_N", 3, 1, 0};
    case Channel::axial_force:
      return {"axial_force_N", 3, 1, 0};
    case Channel::pressure_upstream:
      return {"pressure_upstream_bar", 3, per_Pa, 0};
    case Channel::pressure_downstream:
      return {"pressure_downstream_bar", 3, per_Pa, 0};
    case Channel::pressure_difference:
      return {"pressure_difference_bar", 3, per_Pa, 0};
    case Channel::pressure_difference_set:
      return {"pressure_difference_set_bar", 1, per_Pa, 0};
    case Channel::oil_temperature:
      return {"oil_temperature_C", 2, 1, -units::kelvin_at_0_degC};
    case Channel::flow:
      return {"flow_L_min", 3, per_m3_per_s, 0};
    case Channel::flow_reference:
      return {"flow_reference_L_min", 3, per_m3_per_s, 0};
    case Channel::test:
      return {"test", 0, 1, 0};
    case Channel::current_a:
      return {"current_a_A", 5, 1, 0};
    case Channel::current_b:
      return {"current_b_A", 5, 1, 0};
    case Channel::voltage_a:
      return {"voltage_a_V", 3, 1, 0};
    case Channel::voltage_b:
      return {"voltage_b_V", 3, 1, 0};
    case Channel::pressure_p:
      return {"pressure_p_bar", 3, per_Pa, 0};
    case Channel::pressure_a:
      return {"pressure_a_bar", 3, per_Pa, 0};
    case Channel::pressure_b:
      return {"pressure_b_bar", 3, per_Pa, 0};
    case Channel::pressure_t:
      return {"pressure_t_bar", 3, per_Pa, 0};
  }
  return {"", 0, 1, 0};
}

}  // namespace

void write_recording(std::ostream& stream, const recording::Recording& recording, const BenchRun& run) {
  const bool several_rates = run.sample_rate_Hz.size() > 1;
  std::vector<Column> columns;
  std::vector<const double*> values;
  for (const Channel channel : run.channels) {
    columns.push_back(column(channel, several_rates));
    values.push_back(recording.columns[static_cast<std::size_t>(channel)].data());
  }
  recording::CsvWriter rows(stream);
  for (const Column& column : columns) {
    rows.text(column.header);
  }
  rows.end_row();
  for (std::size_t row = 0; row < recording.size(); ++row) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      rows.number(columns[k].scale * values[k][row] + columns[k].offset, columns[k].decimals);
    }
    rows.end_row();
  }
  rows.flush();
}

void write_truth(std::ostream& stream, const GroundTruth& truth) {
  recording::CsvWriter rows(stream);
  for (const TruthQuantity& quantity : truth.quantities) {
    rows.text(quantity.header);
  }
  rows.end_row();
  for (std::size_t row = 0; row < truth.size(); ++row) {
    for (std::size_t k = 0; k < truth.columns.size(); ++k) {
      rows.number(truth.columns[k][row], truth.quantities[k].decimals);
    }
    rows.end_row();
  }
  rows.flush();
}

}  // namespace spoolflow::rig
