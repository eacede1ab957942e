#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/recording/written_tables/mcap_records.hpp"
#include "spoolflow/recording/written_tables/packed_bytes.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
constexpr std::uint16_t schema_id = 1, channel_id = 1;
constexpr std::string_view compression = "zstd";

struct ChunkPlace {
  std::uint64_t first_ns, last_ns, at;
  std::uint64_t bytes = 0, index_at = 0, index_bytes = 0, packed_bytes = 0, unpacked_bytes = 0;
};

class McapWriter final : public TableWriter {
 public:
  McapWriter(TableHead head, TableOutput& output) : head_(std::move(head)), out_(output.in_sequence()) {
    out_.write(mcap_magic.data(), mcap_magic.size());
    at_ = mcap_magic.size();
    for (const NumberColumn& column : head_.numbers) keys_.push_back(fmt::format(R"("{}":)", column.name));
    put(McapRecord::header, McapContent().text("").text("spoolflow"));
  }

  void write(const TableRows& rows) override {
    for (std::size_t row = 0; row < rows.count(); ++row) {
      if (messages_ == 0) begin(rows.numbers[0][row]);
      put_message(rows, row);
      if (chunk_.size() >= chunk_bytes) write_chunk();
    }
  }

  void finish() override {
    if (messages_ == 0) begin(0.0);  // the schema is told in any case
    if (!chunk_.empty()) write_chunk();
    put(McapRecord::data_end, McapContent().number(std::uint32_t{0}));  // each chunk has a CRC of its own
    write_summary();
    out_.write(mcap_magic.data(), mcap_magic.size());
  }

 private:
  void put(std::span<const std::uint8_t> bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    at_ += bytes.size();
  }
  void put(McapRecord kind, const McapContent& content) {
    Bytes bytes;
    put_record(bytes, kind, content);
    put(bytes);
  }

  /// What stands before the first message.
  void begin(double time_s) {
    if (time_s < 0) origin_s_ = time_s;
    std::vector<std::pair<std::string, std::string>> notes = head_.notes;
    notes.emplace_back("time_origin_s", fmt::format("{}", origin_s_));
    const std::uint64_t at = at_;
    put(McapRecord::metadata, McapContent().text(head_.name).texts(notes));
    metadata_index_.number(at).number(at_ - at).text(head_.name);
    put_record(chunk_, McapRecord::schema, schema());
    put_record(chunk_, McapRecord::channel, channel());
  }

  [[nodiscard]] McapContent schema() const {
    std::string text = R"({"$schema":"https://json-schema.org/draft/2020-12/schema","type":"object","properties":{)";
    for (const NumberColumn& column : head_.numbers)
      text +=
          fmt::format(R"("{}":{{"type":"number","description":"{} [{}]"}},)", column.name, column.meaning, column.unit);
    text += fmt::format(R"("{}":{{"type":"string","description":"names joined by |, empty when all is well"}}}}}})",
                        head_.flags);
    return McapContent().number(schema_id).text("spoolflow." + head_.name).text("jsonschema").text(text);
  }

  [[nodiscard]] McapContent channel() const {
    std::vector<std::pair<std::string, std::string>> units;
    for (const NumberColumn& column : head_.numbers) units.emplace_back(column.name + ".unit", column.unit);
    return McapContent().number(channel_id).number(schema_id).text("/" + head_.name).text("json").texts(units);
  }

  [[nodiscard]] std::uint64_t nanoseconds(double time_s) const {
    constexpr double longest_s = 9e9;  // of 64 bits
    if (!(time_s - origin_s_ >= 0) || time_s - origin_s_ > longest_s) return last_ns_;
    return static_cast<std::uint64_t>(std::llround((time_s - origin_s_) * 1e9));
  }

  void put_message(const TableRows& rows, std::size_t row) {
    text_.clear();
    text_.push_back('{');
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const double value = rows.numbers[k][row];
      if (!std::isfinite(value)) continue;
      text_.append(keys_[k]);
      fmt::format_to(fmt::appender(text_), FMT_COMPILE("{}"), value);
      text_.push_back(',');
    }
    fmt::format_to(fmt::appender(text_), FMT_COMPILE(R"("{}":"{}"}})"), head_.flags, head_.flag_text(rows.flags[row]));
    last_ns_ = nanoseconds(rows.numbers[0][row]);
    index_.number(last_ns_).number(static_cast<std::uint64_t>(chunk_.size()));
    message_.clear();
    message_.number(channel_id).number(static_cast<std::uint32_t>(messages_++)).number(last_ns_).number(last_ns_);
    message_.bare({reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()});
    put_record(chunk_, McapRecord::message, message_);
    chunk_first_ns_ = std::min(chunk_first_ns_, last_ns_);
    chunk_last_ns_ = std::max(chunk_last_ns_, last_ns_);
  }

  void write_chunk() {
    const bool empty = index_.bytes().empty();
    ChunkPlace place{.first_ns = empty ? 0 : chunk_first_ns_, .last_ns = chunk_last_ns_, .at = at_};
    const Bytes inside = packed(chunk_);
    place.packed_bytes = inside.size();
    place.unpacked_bytes = chunk_.size();
    McapContent chunk;
    chunk.number(place.first_ns).number(place.last_ns).number(place.unpacked_bytes).number(numerics::crc32(chunk_));
    chunk.text(compression).number(place.packed_bytes).bare(inside);
    put(McapRecord::chunk, chunk);
    place.bytes = at_ - place.at;
    place.index_at = at_;
    put(McapRecord::message_index, McapContent()
                                       .number(channel_id)
                                       .number(static_cast<std::uint32_t>(index_.bytes().size()))
                                       .bare(index_.bytes()));
    place.index_bytes = at_ - place.index_at;
    first_ns_ = std::min(first_ns_, place.first_ns);
    longest_ns_ = std::max(longest_ns_, place.last_ns);
    chunks_.push_back(place);
    chunk_.clear();
    index_.clear();
    chunk_first_ns_ = UINT64_MAX;
    chunk_last_ns_ = 0;
  }

  void write_summary() {
    Bytes summary, offsets;
    const std::uint64_t begin = at_;
    const auto group = [&](McapRecord kind, const auto& put_them) {
      const std::uint64_t from = summary.size();
      put_them();
      const McapContent place =
          McapContent().number(static_cast<std::uint8_t>(kind)).number(begin + from).number(summary.size() - from);
      put_record(offsets, McapRecord::summary_offset, place);
    };
    group(McapRecord::schema, [&] { put_record(summary, McapRecord::schema, schema()); });
    group(McapRecord::channel, [&] { put_record(summary, McapRecord::channel, channel()); });
    group(McapRecord::statistics, [&] { put_record(summary, McapRecord::statistics, statistics()); });
    group(McapRecord::metadata_index, [&] { put_record(summary, McapRecord::metadata_index, metadata_index_); });
    group(McapRecord::chunk_index, [&] {
      for (const ChunkPlace& chunk : chunks_) put_record(summary, McapRecord::chunk_index, chunk_index(chunk));
    });
    const std::uint64_t offsets_at = begin + summary.size();
    summary.insert(summary.end(), offsets.begin(), offsets.end());
    // The footer's CRC is of the summary and of the footer itself up to it.
    constexpr std::uint64_t footer_bytes = 20;
    summary.push_back(static_cast<std::uint8_t>(McapRecord::footer));
    numerics::put_little_endian(summary, footer_bytes);
    numerics::put_little_endian(summary, begin);
    numerics::put_little_endian(summary, offsets_at);
    numerics::put_little_endian(summary, numerics::crc32(summary));
    put(summary);
  }

  [[nodiscard]] McapContent statistics() const {
    McapContent out;
    out.number(messages_).number(std::uint16_t{1}).number(std::uint32_t{1});  // schemas, channels
    out.number(std::uint32_t{0}).number(std::uint32_t{1});                    // attachments, metadata
    out.number(static_cast<std::uint32_t>(chunks_.size()));
    out.number(messages_ == 0 ? 0 : first_ns_).number(longest_ns_);
    out.number(std::uint32_t{10}).number(channel_id).number(messages_);  // by channel
    return out;
  }

  [[nodiscard]] static McapContent chunk_index(const ChunkPlace& chunk) {
    McapContent out;
    out.number(chunk.first_ns).number(chunk.last_ns).number(chunk.at).number(chunk.bytes);
    out.number(std::uint32_t{10}).number(channel_id).number(chunk.index_at).number(chunk.index_bytes);
    return out.text(compression).number(chunk.packed_bytes).number(chunk.unpacked_bytes);
  }

  TableHead head_;
  std::ostream& out_;
  std::uint64_t at_ = 0;
  Bytes chunk_;
  McapContent index_;           ///< of the chunk's messages
  McapContent metadata_index_;  ///< of the one metadata record
  std::vector<ChunkPlace> chunks_;
  std::vector<std::string> keys_;  ///< of the numbers, as a message has them: "flow_L_min":
  fmt::memory_buffer text_;        ///< of the message at hand
  McapContent message_;            ///< likewise
  double origin_s_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t last_ns_ = 0;
  std::uint64_t chunk_first_ns_ = UINT64_MAX, chunk_last_ns_ = 0;
  std::uint64_t first_ns_ = UINT64_MAX, longest_ns_ = 0;
};

}  // namespace

std::unique_ptr<TableWriter> mcap_writer(TableHead head, TableOutput& output) {
  return std::make_unique<McapWriter>(std::move(head), output);
}

}  // namespace spoolflow::recording
