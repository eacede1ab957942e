#pragma once
/// A recording in memory, as Python holds it.
#include <filesystem>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

#include "addons/python/module/signal_check.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::python {

/// With what was met while reading it.
struct ReadRecording {
  recording::Recording recording;
  recording::ReadNotes notes;
};

/// As arguments and attributes are called: name and SI unit.
[[nodiscard]] std::string column_name(recording::Channel channel);

/// Time, and every other channel that there is.
[[nodiscard]] recording::ReadOptions every_channel(const std::optional<std::filesystem::path>& channels,
                                                   const std::optional<double>& stroke_m);

/// To the last sample; `file` names it.
[[nodiscard]] std::shared_ptr<ReadRecording> read_whole(recording::Reader& reader, const std::filesystem::path& file,
                                                        SignalCheck& check);

/// What the rig has simulated: the recording, and what really happened by the headers of the truth's file, in their
/// units; None where that was not asked for. `file` names it. Needs the interpreter's lock.
[[nodiscard]] pybind11::tuple simulated_objects(const rig::Simulation& simulation, const std::filesystem::path& file);

}  // namespace spoolflow::python
