#pragma once
/// A recording as the firmware of tests/cortex_m replays it.
#include <cstddef>
#include <filesystem>
#include <string>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::cortex_m {

/// What the boards' 4 MiB of flash hold beside the sensor; of a longer recording the beginning is replayed.
inline constexpr std::size_t most_bytes = 3400000;

/// The bytes of `Run` in firmware/replay.cpp, little-endian: samples in single precision with the flow rate that the
/// host answers to the very same samples in double precision. Behind the recording come two seconds of disturbances:
/// faults of the position sensor, slips, missing inputs, a current beyond its range; and six of dither.
///
/// A whole valve takes a recording of both its coils; one of a single direction is played to both sides in turn, which
/// change each time the spool closes, while the current of the coil that it leaves fades.
[[nodiscard]] std::string packed_run(const model::Model& model, estimation::Estimator estimator,
                                     const std::filesystem::path& recording);

}  // namespace spoolflow::cortex_m
