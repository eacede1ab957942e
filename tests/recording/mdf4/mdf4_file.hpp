#pragma once
/// The smallest MDF 4 files, block by block (ASAM MDF 4.1; by columns: 4.2).
#include <string>
#include <vector>
#include <zlib.h>

#include "tests/recording/written_bytes.hpp"

namespace spoolflow::recording {

/// Grows at its end; what is linked to is written before what links to it.
class Mdf4File {
 public:
  /// `mark`: "MDF     4.10    " or another's.
  explicit Mdf4File(const std::string& mark = "MDF     4.10    ") {
    content_ = mark;
    content_.resize(64, '\0');
    (void)block("##HD", {0, 0, 0, 0, 0, 0}, std::string(32, '\0'));
  }

  /// Returns where it stands.
  std::uint64_t block(const std::string& id, const std::vector<std::uint64_t>& links, const std::string& data) {
    content_.resize((content_.size() + 7) / 8 * 8, '\0');
    const std::uint64_t at = content_.size();
    WrittenBytes out;
    out.raw(id).u32(0).u64(24 + 8 * links.size() + data.size()).u64(links.size());
    for (const std::uint64_t link : links) out.u64(link);
    content_ += out.raw(data).content();
    return at;
  }
  std::uint64_t text(const std::string& text) { return block("##TX", {}, text + '\0'); }
  /// `answers`: texts or conversions, of a table of texts.
  std::uint64_t conversion(std::uint8_t kind, const std::vector<double>& numbers,
                           const std::vector<std::uint64_t>& answers = {}, const std::string& unit = "") {
    WrittenBytes data;
    data.u8(kind).u8(0).u16(0).u16(static_cast<std::uint16_t>(answers.size()));
    data.u16(static_cast<std::uint16_t>(numbers.size())).f64(0).f64(0);
    for (const double number : numbers) data.f64(number);
    std::vector<std::uint64_t> links{0, unit.empty() ? 0 : text(unit), 0, 0};
    links.insert(links.end(), answers.begin(), answers.end());
    return block("##CC", links, data.content());
  }

  /// A channel, and how it stands in the record.
  struct Channel {
    std::string name, unit;
    std::uint8_t kind = 0, measure = 0,
                 type = 4;  ///< type 0: unsigned, 2: signed, 4: real; 1, 3, 5: highest byte first
    std::uint32_t byte = 0, bits = 64;
    std::uint8_t bit = 0;
    std::uint64_t conversion = 0;
    int invalid_bit = -1;
  };
  std::uint64_t channels(const std::vector<Channel>& all) {
    std::uint64_t next = 0;
    for (std::size_t k = all.size(); k-- > 0;) {
      const Channel& one = all[k];
      WrittenBytes data;
      data.u8(one.kind).u8(one.measure).u8(one.type).u8(one.bit).u32(one.byte).u32(one.bits);
      data.u32(one.invalid_bit < 0 ? 0 : 2).u32(one.invalid_bit < 0 ? 0 : static_cast<std::uint32_t>(one.invalid_bit));
      data.zeros(52);
      next = block("##CN", {next, 0, text(one.name), 0, one.conversion, 0, one.unit.empty() ? 0 : text(one.unit), 0},
                   data.content());
    }
    return next;
  }
  /// A channel group with records of that many bytes. `master`: the group that holds its time; 0: itself.
  std::uint64_t group(std::uint64_t next, std::uint64_t first_channel, const std::string& name, std::uint64_t number,
                      std::uint64_t count, std::uint32_t bytes, std::uint32_t invalid_bytes = 0,
                      std::uint16_t flags = 0, std::uint64_t master = 0) {
    WrittenBytes data;
    data.u64(number).u64(count).u16(master == 0 ? flags : flags | 8).u16(0).u32(0).u32(bytes).u32(invalid_bytes);
    std::vector<std::uint64_t> links{next, first_channel, text(name), 0, 0, 0};
    if (master != 0) links.push_back(master);
    return block("##CG", links, data.content());
  }
  std::uint64_t data_group(std::uint64_t next, std::uint64_t group, std::uint64_t data, std::uint8_t number_bytes = 0) {
    return block("##DG", {next, group, data, 0}, WrittenBytes().u8(number_bytes).zeros(7).content());
  }
  /// Packed; `row` > 0: transposed before.
  std::uint64_t packed(const std::string& data, std::uint32_t row = 0, const std::string& of = "DT") {
    std::string turned = data;
    const std::size_t rows = row == 0 ? 0 : data.size() / row;
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < row; ++c) turned[c * rows + r] = data[r * row + c];
    }
    std::string out(compressBound(turned.size()), '\0');
    uLongf size = out.size();
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(turned.data()), turned.size());
    out.resize(size);
    WrittenBytes head;
    head.raw(of).u8(row > 0 ? 1 : 0).u8(0).u32(row).u64(data.size()).u64(size);
    return block("##DZ", {}, head.content() + out);
  }
  std::uint64_t list(const std::vector<std::uint64_t>& data) {
    std::vector<std::uint64_t> links{0};
    links.insert(links.end(), data.begin(), data.end());
    return block("##DL", links, WrittenBytes().u32(0).u32(static_cast<std::uint32_t>(data.size())).content());
  }
  /// Blocks of values by columns, and as many of what is invalid, or none.
  std::uint64_t columns(const std::vector<std::uint64_t>& values, const std::vector<std::uint64_t>& invalid = {}) {
    std::vector<std::uint64_t> links{0};
    links.insert(links.end(), values.begin(), values.end());
    links.insert(links.end(), invalid.begin(), invalid.end());
    WrittenBytes data;
    data.u32(invalid.empty() ? 0 : std::uint32_t{1} << 31U).u32(static_cast<std::uint32_t>(values.size()));
    return block("##LD", links, data.zeros(8 * values.size()).content());
  }
  /// The file, whose first data group that is.
  std::string content(std::uint64_t first_data_group) {
    content_.replace(64 + 24, 8, WrittenBytes().u64(first_data_group).content());
    return content_;
  }

 private:
  std::string content_;
};

}  // namespace spoolflow::recording
