#pragma once
/// An MDF 4 file's groups and channels, as its blocks say.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/recording/files/unread_part.hpp"
#include "spoolflow/recording/mdf4/mdf4_conversion.hpp"
#include "spoolflow/recording/mdf4/mdf4_stream.hpp"

namespace spoolflow::recording {

struct Mdf4Channel {
  std::string name, unit;
  bool is_time = false;  ///< the group's master, in seconds
  Mdf4Sample sample;
  Mdf4Conversion conversion;
};

/// The records of a data group: of one kind, or of several, distinguished by the number with which each begins.
struct Mdf4Records {
  Mdf4Stream stream;
  Mdf4Stream invalid;                            ///< what is invalid of each record, where that is kept apart
  std::uint8_t number_bytes = 0;                 ///< before each record
  std::map<std::uint64_t, std::uint64_t> bytes;  ///< of each kind's records, behind that number
  std::map<std::uint64_t, bool> of_any_length;   ///< kinds whose records begin with their length of four bytes
};

/// A channel group.
struct Mdf4Group {
  std::string name;
  std::shared_ptr<Mdf4Records> records;
  std::uint64_t number = 0;        ///< of its records
  std::uint64_t record_bytes = 0;  ///< behind that number, in the stream
  std::uint64_t apart_bytes = 0;   ///< of each record's part in the other stream
  std::uint64_t count = 0;         ///< records
  std::vector<Mdf4Channel> channels;
  std::uint64_t at = 0;      ///< byte of the file
  std::uint64_t master = 0;  ///< byte of the group that holds its time (MDF 4.2); 0: itself

  /// "run.mf4: group 'rig'", for messages.
  [[nodiscard]] std::string what() const { return records->stream.file() + ": group '" + name + "'"; }
};

struct Mdf4Contents {
  std::vector<Mdf4Group> groups;  ///< that hold numbers
  /// Of each group the one that holds its time: itself as a rule.
  std::vector<std::size_t> time_group{};
  std::vector<UnreadPart> unread{};  ///< what cannot be read, with its remedy
};

/// ASAM MDF from 4.00 on. Throws RecordingError: another version, a file that was never finished, damage.
[[nodiscard]] Mdf4Contents read_mdf4_contents(const FileBytes& file);

}  // namespace spoolflow::recording
