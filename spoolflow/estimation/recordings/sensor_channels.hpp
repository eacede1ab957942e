#pragma once
/// What the sensor reads of a recording, and nothing else: time, current, position; voltage and oil temperature where
/// they are. Of a whole valve the currents and voltages of both coils, or those of the active one, and the pressures
/// at its ports.
#include <memory>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::estimation {

[[nodiscard]] recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels);
/// As recording::open_reader, with these channels and perhaps more. Throws RecordingError where no coil current is
/// there.
[[nodiscard]] std::unique_ptr<recording::Reader> open_sensor_channels(const std::filesystem::path& file,
                                                                      const recording::ReadOptions& options);

/// The same of an input that is open.
[[nodiscard]] std::unique_ptr<recording::Reader> open_sensor_channels(std::unique_ptr<recording::InputBytes> input,
                                                                      const recording::ReadOptions& options);

/// The same of a block or a recording in memory, which must outlive what is returned.
[[nodiscard]] Columns sensor_columns(const recording::SampleBlock& block);
[[nodiscard]] Columns sensor_columns(const recording::Recording& recording);

}  // namespace spoolflow::estimation
