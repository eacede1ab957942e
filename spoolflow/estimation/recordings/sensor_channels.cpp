#include "spoolflow/estimation/recordings/sensor_channels.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::estimation {

using recording::Channel;

namespace {

recording::ReadOptions channels_of(const model::Model& model, recording::ChannelMap channels) {
  if (!model.whole()) {
    // Of a run of the whole valve, in whose signs P to B is > 0, the coil that this model knows.
    std::map<Channel, Channel> stands_in;
    if (model.valve.direction == "b")
      stands_in = {{Channel::current, Channel::current_b}, {Channel::voltage, Channel::voltage_b}};
    return {std::move(channels),
            {Channel::time, Channel::current, Channel::position},
            {Channel::voltage, Channel::oil_temperature},
            model.valve.stroke_m,
            std::move(stands_in)};
  }
  return {std::move(channels),
          {Channel::time, Channel::position},
          {Channel::current, Channel::current_a, Channel::current_b, Channel::voltage, Channel::voltage_a,
           Channel::voltage_b, Channel::oil_temperature, Channel::pressure_p, Channel::pressure_a, Channel::pressure_b,
           Channel::pressure_t},
          model.valve.stroke_m};
}

}  // namespace

recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels) {
  recording::ReadOptions out = channels_of(model, std::move(channels));
  if (model.observer) {
    out.assumed[Channel::oil_temperature] = fmt::format(
        "that of the calibration, {:.0f} degC, is assumed; the band counts another one only where an environment "
        "declares it",
        units::degC_from_K(model.observer->parameters.edge.temperature_K.at(1)));
  }
  return out;
}

std::unique_ptr<recording::Reader> open_sensor_channels(const std::filesystem::path& file,
                                                        const recording::ReadOptions& options) {
  return open_sensor_channels(std::make_unique<recording::InputBytes>(file), options);
}

std::unique_ptr<recording::Reader> open_sensor_channels(std::unique_ptr<recording::InputBytes> input,
                                                        const recording::ReadOptions& options) {
  const std::string file = input->name();
  std::unique_ptr<recording::Reader> reader = recording::open_reader(std::move(input), options);
  const bool both = reader->has(Channel::current_a) && reader->has(Channel::current_b);
  for (const Channel alone : {Channel::current_a, Channel::current_b}) {
    if (both || !reader->has(alone) || !reader->has(Channel::current)) continue;
    throw recording::RecordingError(
        fmt::format("{}: \"{}\" stands beside \"current\", which is the active coil's; give \"current_a\" and "
                    "\"current_b\", or \"current\" alone, in a channel map",
                    file, recording::name(alone)));
  }
  if (!both && !reader->has(Channel::current)) {
    throw recording::RecordingError(fmt::format(
        "{}: the model is of a whole valve and needs the currents of both coils, \"current_a\" and \"current_b\", or "
        "\"current\" of the active one; name their columns in a channel map",
        file));
  }
  return reader;
}

namespace {

template <class Source>
Columns columns_of(const Source& source) {
  const recording::CoilChannels coil = recording::coil_channels(source);
  Columns out{.time_s = source.column(Channel::time),
              .current_A = source.column(coil.current),
              .voltage_V = source.column(coil.voltage),
              .position_m = source.column(Channel::position),
              .oil_temperature_K = source.column(Channel::oil_temperature)};
  if (recording::has_both_coils(source)) {
    out.current_a_A = source.column(Channel::current_a);
    out.voltage_a_V = source.column(Channel::voltage_a);
  }
  out.pressure_p_Pa = source.column(Channel::pressure_p);
  out.pressure_a_Pa = source.column(Channel::pressure_a);
  out.pressure_b_Pa = source.column(Channel::pressure_b);
  out.pressure_t_Pa = source.column(Channel::pressure_t);
  return out;
}

}  // namespace

Columns sensor_columns(const recording::SampleBlock& block) {
  return columns_of(block);
}

Columns sensor_columns(const recording::Recording& recording) {
  return columns_of(recording);
}

}  // namespace spoolflow::estimation
