/// MCAP, record by record after its specification.
#include <map>
#include <zstd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/numerics/crc32.hpp"
#include "tests/recording/written_tables/table_in_memory.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

struct Record {
  int kind;
  std::size_t at;  ///< of its content
  Bytes content;
};

std::vector<Record> records(const Bytes& bytes, std::size_t at, std::size_t end) {
  std::vector<Record> out;
  while (at < end) {
    const auto size = numerics::little_endian<std::uint64_t>(bytes, at + 1);
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at + 9);
    out.push_back({bytes[at], at + 9, Bytes(first, first + static_cast<std::ptrdiff_t>(size))});
    at += 9 + size;
  }
  EXPECT_EQ(at, end);
  return out;
}

std::vector<int> kinds(const std::vector<Record>& of) {
  std::vector<int> out;
  for (const Record& record : of) out.push_back(record.kind);
  return out;
}

TEST(McapWriter, WritesAMessageARowWithItsTimeFromTheFirst) {
  const Bytes bytes = small_table(TableFormat::mcap);
  const std::string magic("\x89MCAP0\r\n");
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 8), magic);
  EXPECT_EQ(std::string(bytes.end() - 8, bytes.end()), magic);
  const auto all = records(bytes, 8, bytes.size() - 8);
  // Header, metadata, chunk, its index, end of data; schema, channel, statistics, metadata index, chunk index, five
  // places of these, footer.
  EXPECT_THAT(kinds(all), ElementsAre(1, 12, 6, 7, 15, 3, 4, 11, 13, 8, 14, 14, 14, 14, 14, 2));

  const Bytes& chunk = all[2].content;
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(chunk, 0), 0U);
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(chunk, 8), 500'000'000U);
  Bytes inside(numerics::little_endian<std::uint64_t>(chunk, 16));
  const std::size_t packed_at = 8 + 8 + 8 + 4 + (4 + 4) + 8;  // times, size, CRC, "zstd", packed size
  ASSERT_EQ(ZSTD_decompress(inside.data(), inside.size(), chunk.data() + packed_at, chunk.size() - packed_at),
            inside.size());
  EXPECT_EQ(numerics::little_endian<std::uint32_t>(chunk, 24), numerics::crc32(inside));
  const auto messages = records(inside, 0, inside.size());
  EXPECT_THAT(kinds(messages), ElementsAre(3, 4, 5, 5, 5));
  std::vector<std::string> texts;
  std::vector<std::uint64_t> times_ns;
  for (std::size_t k = 2; k < messages.size(); ++k) {
    const Bytes& content = messages[k].content;
    EXPECT_EQ(numerics::little_endian<std::uint32_t>(content, 2), k - 2);  // sequence
    times_ns.push_back(numerics::little_endian<std::uint64_t>(content, 6));
    EXPECT_EQ(numerics::little_endian<std::uint64_t>(content, 14), times_ns.back());
    texts.emplace_back(content.begin() + 22, content.end());
    EXPECT_EQ(numerics::little_endian<std::uint64_t>(all[3].content, 6 + 16 * (k - 2)), times_ns.back());
    EXPECT_EQ(numerics::little_endian<std::uint64_t>(all[3].content, 6 + 16 * (k - 2) + 8), messages[k].at - 9);
  }
  EXPECT_THAT(times_ns, ElementsAre(0U, 500'000'000U, 500'000'000U));
  EXPECT_THAT(texts, ElementsAre(R"({"time_s":-0.5,"flow_L_min":0.3333333333333333,"status":""})",
                                 R"({"time_s":0,"status":"closed|held"})", R"({"flow_L_min":2.5,"status":"held"})"));
}

TEST(McapWriter, EndsWithASummaryThatFindsEverything) {
  const Bytes bytes = small_table(TableFormat::mcap);
  const auto all = records(bytes, 8, bytes.size() - 8);
  const Record& footer = all.back();
  const auto summary_at = numerics::little_endian<std::uint64_t>(footer.content, 0);
  EXPECT_EQ(summary_at, all[5].at - 9);
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(footer.content, 8), all[10].at - 9);
  const std::span<const std::uint8_t> covered(bytes.data() + summary_at, footer.at + 16 - summary_at);
  EXPECT_EQ(numerics::little_endian<std::uint32_t>(footer.content, 16), numerics::crc32(covered));
  const Bytes& index = all[9].content;  // of the chunk
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(index, 16), all[2].at - 9);
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(index, 24), all[2].content.size() + 9);
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(index, 32 + 4 + 2), all[3].at - 9);
  EXPECT_EQ(numerics::little_endian<std::uint64_t>(all[7].content, 0), 3U);  // messages
}

}  // namespace
}  // namespace spoolflow::recording
