#pragma once
/// What the sensor reads of a recording, and nothing else: time, current, position; voltage and oil temperature where
/// they are.
#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::validation {

[[nodiscard]] recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels);

/// The same of a block or a recording in memory, which must outlive what is returned.
[[nodiscard]] estimation::Columns sensor_columns(const recording::SampleBlock& block);
[[nodiscard]] estimation::Columns sensor_columns(const recording::Recording& recording);

}  // namespace spoolflow::validation
