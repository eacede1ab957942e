#pragma once
/// Where a table's bytes go. Whoever opens files implements it; a refused write throws from the call that meets it.
#include <cstdint>
#include <ostream>
#include <span>

namespace spoolflow::recording {

/// A file whose bytes are written and read where one likes.
class PlacedBytes {
 public:
  virtual ~PlacedBytes() = default;
  virtual void write(std::uint64_t at, std::span<const std::uint8_t> bytes) = 0;
  /// What was never written reads as zeros.
  virtual void read(std::uint64_t at, std::span<std::uint8_t> bytes) = 0;
};

/// The file to be, in one of two ways, and room beside it while it comes to be.
class TableOutput {
 public:
  virtual ~TableOutput() = default;
  /// One byte after the other: goes into pipes, too.
  virtual std::ostream& in_sequence() = 0;
  /// Throws where the output is a pipe or a device.
  virtual PlacedBytes& in_places() = 0;
  /// A file that goes when the table is finished.
  virtual PlacedBytes& scratch() = 0;
};

}  // namespace spoolflow::recording
