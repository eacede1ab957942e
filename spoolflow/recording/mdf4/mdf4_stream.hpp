#pragma once
/// The records of an MDF 4 data group as one row of bytes, however many blocks they stand in.
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/mdf4/mdf4_block.hpp"

namespace spoolflow::recording {

/// What of the records a stream holds: all of it, but for what is invalid where a group stored by columns (MDF 4.2)
/// keeps that apart.
enum class Mdf4Part : std::uint8_t { records, invalid_apart };

/// Blocks DT or, by columns, DV, or lists (DL, HL, LD) of them and of DZ: plain, deflated, transposed and deflated.
class Mdf4Stream {
 public:
  /// `at`: the data group's link; 0: nothing. What all blocks hold counts in `declared`. Throws RecordingError.
  Mdf4Stream(const FileBytes& file, std::uint64_t at, DeclaredSize& declared, Mdf4Part part = Mdf4Part::records);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& file() const { return file_.name(); }
  /// Stored by columns: the records hold nothing of what is invalid.
  [[nodiscard]] bool by_columns() const { return by_columns_; }
  /// Fills `out`, which must lie within size(). Throws RecordingError where a block cannot be unpacked.
  void read(std::uint64_t at, std::span<std::uint8_t> out);

 private:
  struct Piece {
    std::uint64_t first;      ///< byte of the stream
    std::uint64_t bytes;      ///< unpacked
    std::uint64_t at;         ///< byte of the file
    std::uint64_t packed;     ///< bytes in the file; 0: not packed
    std::uint32_t row_bytes;  ///< of the matrix that was transposed; 0: none was
  };

  void add(std::uint64_t at, DeclaredSize& declared);
  void add_list(std::uint64_t at, DeclaredSize& declared);
  void add_columns(std::uint64_t at, DeclaredSize& declared, Mdf4Part part);
  [[nodiscard]] Mdf4Block taken(std::uint64_t at, std::string_view id);
  void add_packed(const Mdf4Head& head, DeclaredSize& declared);
  void unpack(const Piece& piece);

  const FileBytes& file_;
  std::vector<Piece> pieces_;
  std::uint64_t size_ = 0;
  bool by_columns_ = false;
  std::set<std::uint64_t> lists_;       ///< that were walked
  std::vector<std::uint8_t> unpacked_;  ///< of the piece that begins at unpacked_first_
  std::uint64_t unpacked_first_ = ~std::uint64_t{0};
};

}  // namespace spoolflow::recording
