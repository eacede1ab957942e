#pragma once
/// From the numbers of an MDF 4 record to those that were measured (block CC).
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/bytes/stored_number.hpp"
#include "spoolflow/recording/mdf4/mdf4_block.hpp"

namespace spoolflow::recording {

/// One channel's numbers within the records of an MDF 4 file.
struct Mdf4Sample {
  StoredNumber number{};   ///< its kind and byte order; its width is that of `bits`
  std::uint32_t byte = 0;  ///< within the record, behind its number
  std::uint32_t bit = 0, bits = 0;
  bool by_index = false;                       ///< virtual: the number of the record itself
  std::optional<std::uint32_t> invalid_bit{};  ///< of the record, counted from its first byte

  /// Bytes from `byte` on that hold it.
  [[nodiscard]] std::uint32_t span() const { return (bit + bits + 7) / 8; }
  /// NaN where the record says that it is invalid. `record`: without its number; all its bytes must be there.
  [[nodiscard]] double read(const std::uint8_t* record, std::uint64_t index) const;
};

/// How a channel of that type (cn_data_type) is stored; nothing, and why in `unread`, where it is no number.
[[nodiscard]] std::optional<Mdf4Sample> mdf4_sample(std::uint8_t type, std::uint32_t byte, std::uint8_t bit,
                                                    std::uint32_t bits, std::string& unread);

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
