#pragma once
/// A recording in memory, as Python holds it.
#include <memory>
#include <pybind11/pybind11.h>
#include <utility>

#include "spoolflow/recording/reader.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::python {

/// With what was met while reading it.
struct ReadRecording {
  recording::Recording recording;
  recording::ReadNotes notes;
};

/// What the rig has simulated: the recording, and what really happened by the headers of the truth's file, in their
/// units; None where that was not asked for. `file` names it. Needs the interpreter's lock.
[[nodiscard]] pybind11::tuple simulated_objects(const rig::Simulation& simulation, const std::filesystem::path& file);

}  // namespace spoolflow::python
