#pragma once
/// From the numbers of an MDF 4 record to those that were measured (block CC).
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/mdf4/mdf4_block.hpp"

namespace spoolflow::recording {

class Mdf4Conversion {
 public:
  /// None: numbers stay as they are.
  Mdf4Conversion() = default;
  /// Identity, linear, rational, and tables of values: with and without interpolation, by ranges. Throws RecordingError
  /// where the block is damaged.
  explicit Mdf4Conversion(const Mdf4Block& block);

  /// Why the numbers cannot be used: "texts in the place of numbers", "a formula"; empty where they can.
  [[nodiscard]] const std::string& unread() const { return unread_; }
  /// `whole`: of whole numbers, whose ranges hold their last one, too.
  void apply(double* values, std::size_t count, bool whole) const;

 private:
  enum class Kind : std::uint8_t { identity, linear, rational, formula, interpolated, nearest, ranges };
  [[nodiscard]] double value_at(double raw, bool whole) const;
  [[nodiscard]] double of_pairs(double raw) const;
  [[nodiscard]] double of_ranges(double raw, bool whole) const;
  void check(const std::string& what) const;

  Kind kind_ = Kind::identity;
  std::vector<double> numbers_;
  std::string unread_;
};

}  // namespace spoolflow::recording
