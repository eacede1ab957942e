/// Parquet, byte by byte after its description: pages, runs, the footer's compact structures.
#include <bit>
#include <zstd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/formats/parquet/parquet_runs.hpp"
#include "addons/formats/parquet/thrift_compact.hpp"
#include "tests/recording/written_tables/table_in_memory.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

TEST(ThriftCompact, WritesFieldsByTheirStepAndNumbersZigzag) {
  ThriftCompact out;
  out.number(1, -1);                                  // step 1, type 5; zigzag 1
  out.long_number(4, 300);                            // step 3, type 6; zigzag 600 in two bytes
  out.text(5, "ab");                                  // step 1, type 8; length, letters
  out.begin_structure(8);                             // step 3, type 12
  out.number(2, 3);                                   // counted again inside
  out.end();                                          // 0
  out.begin_list(9, 2, ThriftCompact::Kind::number);  // step 1, type 9; two of type 5
  out.bare_number(0);
  out.bare_number(2);
  EXPECT_THAT(out.finished(), ElementsAre(0x15, 0x01, 0x36, 0xD8, 0x04, 0x18, 0x02, 'a', 'b', 0x3C, 0x25, 0x06, 0x00,
                                          0x19, 0x25, 0x00, 0x04, 0x00));
}

TEST(ParquetRuns, HoldTheCountThenTheValue) {
  const std::vector<std::uint32_t> numbers{3, 3, 3, 1, 0, 0};
  Bytes out;
  put_runs(out, numbers.size(), 2, [&](std::size_t k) { return numbers[k]; });
  EXPECT_THAT(out, ElementsAre(6, 3, 2, 1, 4, 0));
  out.clear();
  put_runs(out, 100, 9, [](std::size_t) { return 257U; });  // 200 in two bytes, 257 in two
  EXPECT_THAT(out, ElementsAre(0xC8, 0x01, 0x01, 0x01));
}

/// What the zstd frame that begins after `page` bytes of head holds.
Bytes unpacked(const Bytes& bytes, std::size_t at) {
  const std::size_t packed = ZSTD_findFrameCompressedSize(bytes.data() + at, bytes.size() - at);
  Bytes out(ZSTD_getFrameContentSize(bytes.data() + at, packed));
  EXPECT_EQ(ZSTD_decompress(out.data(), out.size(), bytes.data() + at, packed), out.size());
  return out;
}

std::vector<std::size_t> frames(const Bytes& bytes) {
  const Bytes magic{0x28, 0xB5, 0x2F, 0xFD};
  std::vector<std::size_t> out;
  for (auto at = bytes.begin(); (at = std::search(at, bytes.end(), magic.begin(), magic.end())) != bytes.end(); ++at)
    out.push_back(static_cast<std::size_t>(at - bytes.begin()));
  return out;
}

TEST(ParquetWriter, WritesAPageAColumnWithItsHolesAndNamesOnce) {
  const Bytes bytes = small_table(TableFormat::parquet);
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_EQ(text.substr(0, 4), "PAR1");
  EXPECT_EQ(text.substr(text.size() - 4), "PAR1");
  const std::vector<std::size_t> pages = frames(bytes);
  ASSERT_EQ(pages.size(), 4U);  // two columns, the dictionary, its numbers
  // Four bytes of length, runs of what is there (two, then none), the numbers that are.
  const Bytes time = unpacked(bytes, pages[0]);
  ASSERT_EQ(time.size(), 4 + 4 + 16U);
  EXPECT_THAT(Bytes(time.begin(), time.begin() + 8), ElementsAre(4, 0, 0, 0, 4, 1, 2, 0));
  EXPECT_EQ(std::bit_cast<double>(numerics::little_endian<std::uint64_t>(time, 8)), -0.5);
  EXPECT_EQ(std::bit_cast<double>(numerics::little_endian<std::uint64_t>(time, 16)), 0.0);
  const Bytes flow = unpacked(bytes, pages[1]);
  EXPECT_THAT(Bytes(flow.begin(), flow.begin() + 10), ElementsAre(6, 0, 0, 0, 2, 1, 2, 0, 2, 1));
  EXPECT_EQ(std::bit_cast<double>(numerics::little_endian<std::uint64_t>(flow, 10)), 1.0 / 3.0);
  const Bytes names = unpacked(bytes, pages[2]);
  EXPECT_EQ(std::string(names.begin(), names.end()), std::string("\0\0\0\0\x0B\0\0\0closed|held\4\0\0\0held", 27));
  EXPECT_THAT(unpacked(bytes, pages[3]), ElementsAre(2, 2, 0, 2, 1, 2, 2));  // two bits; one each
}

TEST(ParquetWriter, BeginsAnotherGroupAfter131072Rows) {
  OutputInMemory output;
  const auto writer = table_writer(TableFormat::parquet, small_head(), output);
  const TableRows rows{{std::vector<double>(100'000, 1.0), std::vector<double>(100'000, 2.0)},
                       std::vector<std::uint32_t>(100'000)};
  for (int k = 0; k < 3; ++k) writer->write(rows);
  writer->finish();
  EXPECT_EQ(frames(output.bytes()).size(), 3 * 4U);
}

}  // namespace
}  // namespace spoolflow::recording
