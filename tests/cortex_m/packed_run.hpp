#pragma once
/// A recording as the firmware of tests/cortex_m replays it.
#include <cstddef>
#include <filesystem>
#include <string>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::cortex_m {

/// What the boards' 4 MiB of flash hold beside the sensor; of a longer recording the beginning is replayed.
inline constexpr std::size_t most_samples = 160000;

/// The bytes of `Run` in firmware/replay.cpp, little-endian: samples in single precision with the flow rate that the
/// host answers to the very same samples in double precision. Behind the recording come two seconds of disturbances:
/// faults of the position sensor, slips, missing inputs, a current beyond its range.
[[nodiscard]] std::string packed_run(const model::Model& model, estimation::Estimator estimator,
                                     const std::filesystem::path& recording);

}  // namespace spoolflow::cortex_m
