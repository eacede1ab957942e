#pragma once
/// A TDMS file from its first segment to its last: its objects and where their samples stand.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/bytes/file_bytes.hpp"
#include "spoolflow/recording/tdms/tdms_layout.hpp"
#include "spoolflow/recording/tdms/tdms_properties.hpp"

namespace spoolflow::recording {

/// What the wf_ properties of a channel say from one of its samples on.
struct TdmsWave {
  std::uint64_t first = 0;
  std::optional<TdmsTime> start{};
  double offset_s = 0, step_s = 0;

  [[nodiscard]] bool says_the_same(const TdmsWave& other) const {
    return start == other.start && offset_s == other.offset_s && step_s == other.step_s;
  }
};

struct TdmsChannel {
  std::string group, name;
  std::string path;           ///< as the file writes it: /'group'/'name'
  std::uint64_t samples = 0;  ///< in all runs
  std::string said_unit{};    ///< as its properties state it last; empty where they do not
  std::string unit{};         ///< likewise of the samples
  std::string unread{};       ///< why it cannot be read: "text"; empty where it can
  bool of_time = false;       ///< its samples are times
  /// Of even steps, one where the properties change: where the recording was stopped and went on, each segment has a
  /// wf_start_time of its own.
  std::vector<TdmsWave> waves{};
};

struct TdmsContents {
  std::vector<TdmsChannel> channels;                 ///< in the order in which they appear
  std::map<std::string, TdmsProperties> properties;  ///< of each object, by its path; "/" is the file
  std::vector<TdmsRun> runs;                         ///< in the file's order
  std::string lost{};                                ///< what of the last segment is missing; empty where nothing is

  /// Empty where the object says nothing.
  [[nodiscard]] const TdmsProperties& of(const std::string& path) const;
};

/// NI's file format 4712 and 4713 (LabVIEW 8.2 on): segments with appended metadata, interleaved or not, either byte
/// order, DAQmx' raw samples. A segment that the program that wrote it did not finish, or that the file's end cuts off,
/// is read as far as it goes. Throws RecordingError.
[[nodiscard]] TdmsContents read_tdms_contents(const FileBytes& file);

}  // namespace spoolflow::recording
