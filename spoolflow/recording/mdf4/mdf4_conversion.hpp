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
  /// The block CC at that byte: identity, linear, rational, tables of values (with and without interpolation, by
  /// ranges), and tables of texts of which some entries are conversions: texts are missing samples then, as "signal not
  /// available" is. Throws RecordingError where a block is damaged.
  Mdf4Conversion(const FileBytes& file, std::uint64_t at);

  /// Its unit, or that of the first conversion within it that states one.
  [[nodiscard]] const std::string& unit() const { return unit_; }
  /// Why the numbers cannot be used: "texts in the place of numbers", "a formula"; empty where they can.
  [[nodiscard]] const std::string& unread() const { return unread_; }
  /// `whole`: of whole numbers, whose ranges hold their last one, too.
  void apply(double* values, std::size_t count, bool whole) const;

 private:
  enum class Kind : std::uint8_t {
    identity,
    linear,
    rational,
    formula,
    interpolated,
    nearest,
    ranges,
    texts_of_values,
    texts_of_ranges
  };
  Mdf4Conversion(const FileBytes& file, std::uint64_t at, int depth);
  void read_texts(const FileBytes& file, const Mdf4Block& block, std::size_t count, int depth);
  [[nodiscard]] double value_at(double raw, bool whole) const;
  [[nodiscard]] double of_pairs(double raw) const;
  [[nodiscard]] double of_ranges(double raw, bool whole) const;
  [[nodiscard]] double of_texts(double raw, bool whole) const;
  void check(const std::string& what) const;

  Kind kind_ = Kind::identity;
  std::vector<double> numbers_;
  std::vector<Mdf4Conversion> inner_;  ///< of tables of texts
  std::vector<int> answers_;           ///< of each entry and of all other numbers: which of them; below 0: a text
  std::string unit_, unread_;
};

}  // namespace spoolflow::recording
