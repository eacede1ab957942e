#include "spoolflow/validation/sensor_channels.hpp"

namespace spoolflow::validation {

using recording::Channel;

recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels) {
  return {std::move(channels),
          {Channel::time, Channel::current, Channel::position},
          {Channel::voltage, Channel::oil_temperature},
          model.valve.stroke_m};
}

namespace {

template <class Source>
estimation::Columns columns_of(const Source& source) {
  return {.time_s = source.column(Channel::time),
          .current_A = source.column(Channel::current),
          .voltage_V = source.column(Channel::voltage),
          .position_m = source.column(Channel::position),
          .oil_temperature_K = source.column(Channel::oil_temperature)};
}

}  // namespace

estimation::Columns sensor_columns(const recording::SampleBlock& block) {
  return columns_of(block);
}

estimation::Columns sensor_columns(const recording::Recording& recording) {
  return columns_of(recording);
}

}  // namespace spoolflow::validation
