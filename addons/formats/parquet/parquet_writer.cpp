/// Apache Parquet after its format description (parquet.thrift, Encodings.md): version 1 data pages, one a column and
/// row group.
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "addons/formats/parquet/packed_bytes.hpp"
#include "addons/formats/parquet/parquet_runs.hpp"
#include "addons/formats/parquet/thrift_compact.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/numerics/little_endian.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;
using numerics::put_little_endian;
using Kind = ThriftCompact::Kind;

constexpr std::size_t rows_of_a_group = 131072;
constexpr std::string_view mark = "PAR1";

// The numbers of parquet.thrift.
constexpr std::int32_t type_double = 5, type_byte_array = 6;
constexpr std::int32_t required = 0, optional = 1;
constexpr std::int32_t plain = 0, runs = 3, by_dictionary = 8;
constexpr std::int32_t data_page = 0, dictionary_page = 2;
constexpr std::int32_t zstd = 6;

/// Where a column's part of a row group lies, and what the footer states of it.
struct ColumnPart {
  std::int64_t dictionary_at = -1;
  std::int64_t data_at = 0;
  std::int64_t unpacked_bytes = 0;
  std::int64_t packed_bytes = 0;
  std::int64_t nulls = 0;
  std::optional<double> smallest{}, largest{};
};

struct Group {
  std::int64_t rows;
  std::vector<ColumnPart> parts;
};

class ParquetWriter final : public TableWriter {
 public:
  ParquetWriter(TableHead head, TableOutput& output) : head_(std::move(head)), out_(output.in_sequence()) {
    gathered_.numbers.resize(head_.numbers.size());
    put({reinterpret_cast<const std::uint8_t*>(mark.data()), mark.size()});
  }

  void write(const TableRows& rows) override {
    for (std::size_t from = 0; from < rows.count();) {
      const std::size_t count = std::min(rows.count() - from, rows_of_a_group - gathered_.count());
      const auto append = [&](auto& to, const auto& column) {
        const auto first = column.begin() + static_cast<std::ptrdiff_t>(from);
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
      };
      for (std::size_t k = 0; k < head_.numbers.size(); ++k) append(gathered_.numbers[k], rows.numbers[k]);
      append(gathered_.flags, rows.flags);
      from += count;
      if (gathered_.count() == rows_of_a_group) write_group();
    }
  }

  void finish() override {
    if (gathered_.count() > 0) write_group();
    Bytes footer = this->footer();
    put_little_endian(footer, static_cast<std::uint32_t>(footer.size()));
    footer.insert(footer.end(), mark.begin(), mark.end());
    put(footer);
  }

 private:
  void put(std::span<const std::uint8_t> bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    at_ += static_cast<std::int64_t>(bytes.size());
  }

  /// Head and packed content. `values`: of a dictionary its entries, else the rows, nulls included.
  void put_page(ColumnPart& part, std::int32_t kind, std::size_t values, std::int32_t encoding, const Bytes& content) {
    const Bytes inside = packed(content);
    ThriftCompact head;
    head.number(1, kind);
    head.number(2, static_cast<std::int32_t>(content.size()));
    head.number(3, static_cast<std::int32_t>(inside.size()));
    head.number(4, static_cast<std::int32_t>(numerics::crc32(inside)));
    head.begin_structure(kind == data_page ? 5 : 7);
    head.number(1, static_cast<std::int32_t>(values));
    head.number(2, encoding);
    if (kind == data_page) head.number(3, runs), head.number(4, runs);
    head.end();
    const Bytes head_bytes = head.finished();
    part.unpacked_bytes += static_cast<std::int64_t>(head_bytes.size() + content.size());
    part.packed_bytes += static_cast<std::int64_t>(head_bytes.size() + inside.size());
    put(head_bytes);
    put(inside);
  }

  ColumnPart write_numbers(const std::vector<double>& values) {
    ColumnPart part{.data_at = at_};
    Bytes present;
    put_runs(present, values.size(), 1, [&](std::size_t k) { return std::isnan(values[k]) ? 0U : 1U; });
    Bytes content;
    content.reserve(4 + present.size() + 8 * values.size());
    put_little_endian(content, static_cast<std::uint32_t>(present.size()));
    content.insert(content.end(), present.begin(), present.end());
    for (const double value : values) {
      if (std::isnan(value)) {
        ++part.nulls;
        continue;
      }
      put_little_endian(content, std::bit_cast<std::uint64_t>(value));
      part.smallest = std::min(part.smallest.value_or(value), value);
      part.largest = std::max(part.largest.value_or(value), value);
    }
    // Zeros compare alike and differ to readers: the range is to hold both.
    if (part.smallest == 0.0) part.smallest = -0.0;
    if (part.largest == 0.0) part.largest = 0.0;
    put_page(part, data_page, values.size(), plain, content);
    return part;
  }

  ColumnPart write_flags(const std::vector<std::uint32_t>& flags) {
    std::map<std::uint32_t, std::uint32_t> number_of;
    Bytes dictionary;
    for (const std::uint32_t word : flags) {
      if (!number_of.emplace(word, static_cast<std::uint32_t>(number_of.size())).second) continue;
      const std::string_view text = head_.flag_text(word);
      put_little_endian(dictionary, static_cast<std::uint32_t>(text.size()));
      dictionary.insert(dictionary.end(), text.begin(), text.end());
    }
    ColumnPart part{.dictionary_at = at_};
    put_page(part, dictionary_page, number_of.size(), plain, dictionary);
    part.data_at = at_;
    const auto bits = static_cast<unsigned>(std::max<std::size_t>(1, std::bit_width(number_of.size() - 1)));
    Bytes content{static_cast<std::uint8_t>(bits)};
    put_runs(content, flags.size(), bits, [&](std::size_t k) { return number_of.at(flags[k]); });
    put_page(part, data_page, flags.size(), by_dictionary, content);
    return part;
  }

  void write_group() {
    Group group{static_cast<std::int64_t>(gathered_.count()), {}};
    for (std::vector<double>& column : gathered_.numbers) {
      group.parts.push_back(write_numbers(column));
      column.clear();
    }
    group.parts.push_back(write_flags(gathered_.flags));
    gathered_.flags.clear();
    rows_ += group.rows;
    groups_.push_back(std::move(group));
  }

  [[nodiscard]] Bytes footer() const {
    ThriftCompact footer;
    footer.number(1, 2);
    put_schema(footer);
    footer.long_number(3, rows_);
    footer.begin_list(4, groups_.size(), Kind::structure);
    for (const Group& group : groups_) put_group(footer, group);
    footer.begin_list(5, head_.numbers.size() + head_.notes.size(), Kind::structure);
    const auto key_value = [&](std::string_view key, std::string_view value) {
      footer.begin_element();
      footer.text(1, key);
      footer.text(2, value);
      footer.end();
    };
    for (const NumberColumn& column : head_.numbers) key_value(column.name + ".unit", column.unit);
    for (const auto& [key, value] : head_.notes) key_value(key, value);
    footer.text(6, "spoolflow");
    footer.begin_list(7, head_.numbers.size() + 1, Kind::structure);  // smallest and largest by the type's own order
    for (std::size_t k = 0; k <= head_.numbers.size(); ++k) {
      footer.begin_element();
      footer.begin_structure(1);
      footer.end();
      footer.end();
    }
    return footer.finished();
  }

  void put_schema(ThriftCompact& footer) const {
    footer.begin_list(2, head_.numbers.size() + 2, Kind::structure);
    footer.begin_element();
    footer.text(4, head_.name);
    footer.number(5, static_cast<std::int32_t>(head_.numbers.size() + 1));
    footer.end();
    for (const NumberColumn& column : head_.numbers) {
      footer.begin_element();
      footer.number(1, type_double);
      footer.number(3, optional);
      footer.text(4, column.name);
      footer.end();
    }
    footer.begin_element();
    footer.number(1, type_byte_array);
    footer.number(3, required);
    footer.text(4, head_.flags);
    footer.number(6, 0);  // UTF8, for readers before
    footer.begin_structure(10);
    footer.begin_structure(1);  // text
    footer.end();
    footer.end();
    footer.end();
  }

  void put_group(ThriftCompact& footer, const Group& group) const {
    std::int64_t unpacked_bytes = 0, packed_bytes = 0;
    footer.begin_element();
    footer.begin_list(1, group.parts.size(), Kind::structure);
    for (std::size_t k = 0; k < group.parts.size(); ++k) {
      const ColumnPart& part = group.parts[k];
      unpacked_bytes += part.unpacked_bytes;
      packed_bytes += part.packed_bytes;
      footer.begin_element();
      footer.long_number(2, 0);  // no metadata beside the column's own
      footer.begin_structure(3);
      put_part(footer, part, group.rows, k < head_.numbers.size() ? &head_.numbers[k] : nullptr);
      footer.end();
      footer.end();
    }
    footer.long_number(2, unpacked_bytes);
    footer.long_number(3, group.rows);
    footer.long_number(6, packed_bytes);
    footer.end();
  }

  /// `column` null: the flags.
  void put_part(ThriftCompact& footer, const ColumnPart& part, std::int64_t rows, const NumberColumn* column) const {
    footer.number(1, column != nullptr ? type_double : type_byte_array);
    footer.begin_list(2, column != nullptr ? 2 : 3, Kind::number);
    footer.bare_number(plain);
    footer.bare_number(runs);
    if (column == nullptr) footer.bare_number(by_dictionary);
    footer.begin_list(3, 1, Kind::text);
    footer.bare_text(column != nullptr ? column->name : head_.flags);
    footer.number(4, zstd);
    footer.long_number(5, rows);
    footer.long_number(6, part.unpacked_bytes);
    footer.long_number(7, part.packed_bytes);
    footer.long_number(9, part.data_at);
    if (part.dictionary_at >= 0) footer.long_number(11, part.dictionary_at);
    if (column == nullptr) return;
    footer.begin_structure(12);
    footer.long_number(3, part.nulls);
    const auto limit = [&](int id, double value) {
      Bytes bytes;
      put_little_endian(bytes, std::bit_cast<std::uint64_t>(value));
      footer.text(id, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    };
    if (part.largest) limit(5, *part.largest);
    if (part.smallest) limit(6, *part.smallest);
    footer.end();
  }

  TableHead head_;
  std::ostream& out_;
  TableRows gathered_;
  std::vector<Group> groups_;
  std::int64_t at_ = 0;
  std::int64_t rows_ = 0;
};

}  // namespace

std::unique_ptr<TableWriter> parquet_writer(TableHead head, TableOutput& output) {
  return std::make_unique<ParquetWriter>(std::move(head), output);
}

}  // namespace spoolflow::recording
