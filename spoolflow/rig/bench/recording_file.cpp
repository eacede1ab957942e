#include "spoolflow/rig/bench/recording_file.hpp"

#include <ostream>
#include <string>
#include <utility>

#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/recording/files/csv_writer.hpp"

namespace spoolflow::rig {
namespace {

using recording::Channel;

/// As a recorder writes a channel.
struct Column {
  std::string header;
  int decimals;
  double scale;
  double offset;  ///< written = scale * SI + offset
};

int decimals(Channel channel, bool several_rates) {
  using units::Dimension;
  if (channel == Channel::pressure_difference_set) return 1;
  if (channel == Channel::time) return several_rates ? 5 : 4;
  if (channel == Channel::current_set) return 3;
  if (channel == Channel::test) return 0;
  switch (recording::dimension(channel)) {
    case Dimension::current:
    case Dimension::length:
      return 5;
    case Dimension::temperature:
      return 2;
    default:
      return 3;
  }
}

Column column(Channel channel, bool several_rates) {
  const units::Unit unit = recording::usual_unit(channel);
  std::string header(recording::name(channel));
  if (!unit.header.empty()) header.append("_").append(unit.header);
  return {std::move(header), decimals(channel, several_rates), 1 / unit.factor, -unit.offset / unit.factor};
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
