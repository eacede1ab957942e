/// `spoolflow estimate` into every format that it writes: the same rows in all.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>
#include <zstd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/recording/files/hdf5_table.hpp"
#include "spoolflow/recording/matlab/mat_table.hpp"
#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array columns{
    "time_s",           "flow_L_min",   "flow_lower_L_min", "flow_upper_L_min", "pressure_difference_bar",
    "magnetic_force_N", "flow_force_N", "friction_force_N"};
constexpr std::array decimals{6, 6, 6, 6, 4, 3, 3, 3};

struct Table {
  std::array<std::vector<double>, columns.size()> numbers;
  std::vector<std::string> status;
};

class EstimateFormats : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::string text = "time_s,current_A,position_mm\n";
    for (int k = 0; k < 1500; ++k) {
      const double swing = std::sin(0.004 * k);
      text += k % 400 == 99 ? fmt::format("{:.3f},,\n", 1e-3 * k)
                            : fmt::format("{:.3f},{:.4f},{:.5f}\n", 1e-3 * k, 1.2 + 0.5 * swing, 1.1 + 0.9 * swing);
    }
    write("run.csv", text);
  }

  [[nodiscard]] Table from_csv(const std::string& file) const {
    Table out;
    std::istringstream lines(content(file));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, fmt::format("{},status", fmt::join(columns, ",")));
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string cell;
      for (std::vector<double>& column : out.numbers) {
        std::getline(cells, cell, ',');
        column.push_back(std::stod(cell));
      }
      cell.clear();
      std::getline(cells, cell);
      out.status.push_back(cell);
    }
    return out;
  }

  [[nodiscard]] static Table from_vectors(recording::VectorTable& table, std::size_t rows) {
    Table out;
    estimation::StatusText text;
    table.look();
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
      std::vector<double> values(rows);
      const std::string& name = table.columns()[k].name;
      table.copy(k, 0, rows, values.data());
      const auto column = std::find(columns.begin(), columns.end(), name);
      if (column != columns.end()) out.numbers[static_cast<std::size_t>(column - columns.begin())] = values;
      if (name != "status") continue;
      for (const double word : values) out.status.emplace_back(text(static_cast<sensor::Status>(word)));
    }
    return out;
  }

  /// What the zstd frames of a file hold, in its order.
  [[nodiscard]] std::vector<std::string> unpacked(const std::string& file) const {
    const std::string bytes = content(file);
    std::vector<std::string> out;
    for (std::size_t at = 0; (at = bytes.find("\x28\xB5\x2F\xFD", at)) != std::string::npos; ++at) {
      const std::size_t packed = ZSTD_findFrameCompressedSize(bytes.data() + at, bytes.size() - at);
      if (ZSTD_isError(packed) != 0) continue;
      out.emplace_back(ZSTD_getFrameContentSize(bytes.data() + at, packed), '\0');
      EXPECT_EQ(ZSTD_decompress(out.back().data(), out.back().size(), bytes.data() + at, packed), out.back().size());
    }
    return out;
  }

  /// Of one row group without holes: its pages end in the rows' numbers.
  [[nodiscard]] Table from_parquet(const std::string& file, std::size_t rows) const {
    Table out;
    const std::vector<std::string> pages = unpacked(file);
    EXPECT_EQ(pages.size(), columns.size() + 2);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      out.numbers[k].resize(rows);
      std::memcpy(out.numbers[k].data(), pages.at(k).data() + pages.at(k).size() - 8 * rows, 8 * rows);
    }
    std::vector<std::string> names;
    for (std::size_t at = 0; at < pages.at(columns.size()).size(); at += 4 + names.back().size())
      names.push_back(pages[columns.size()].substr(at + 4, static_cast<unsigned char>(pages[columns.size()][at])));
    const std::string& runs = pages.at(columns.size() + 1);
    for (std::size_t at = 1; at < runs.size();) {
      std::size_t head = 0;
      for (unsigned shift = 0;; shift += 7) {
        const auto byte = static_cast<unsigned char>(runs[at++]);
        head |= static_cast<std::size_t>(byte & 0x7FU) << shift;
        if (byte < 0x80) break;
      }
      out.status.insert(out.status.end(), head / 2, names.at(static_cast<unsigned char>(runs[at++])));
    }
    return out;
  }

  static void expect_same(const Table& table, const Table& exact, const Table& csv, const std::string& format) {
    EXPECT_EQ(table.numbers, exact.numbers) << format;  // to the last digit
    EXPECT_EQ(table.status, csv.status) << format;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ASSERT_EQ(table.numbers[k].size(), csv.numbers[k].size()) << format;
      for (std::size_t row = 0; row < csv.numbers[k].size(); ++row)
        ASSERT_NEAR(table.numbers[k][row], csv.numbers[k][row], 0.501 * std::pow(10.0, -decimals[k]))
            << format << ' ' << columns[k] << ' ' << row;
    }
  }
  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
};

TEST_F(EstimateFormats, HoldTheSameRows) {
  for (const char* suffix : {"csv", "parquet", "h5", "mat"}) {
    const Answer answer = run(fmt::format("estimate -q {} run.csv -o flow.{}", model, suffix));
    ASSERT_EQ(answer.status, 0) << answer.message;
  }
  const Table csv = from_csv("flow.csv");
  ASSERT_EQ(csv.status.size(), 1500U);
  EXPECT_THAT(csv.status[99], HasSubstr("sample_missing"));
  const Table exact = from_vectors(*recording::open_hdf5_table(folder / "flow.h5"), csv.status.size());
  expect_same(exact, exact, csv, "HDF5");
  expect_same(from_vectors(*recording::open_mat_table(folder / "flow.mat"), csv.status.size()), exact, csv, "MATLAB");
  expect_same(from_parquet("flow.parquet", csv.status.size()), exact, csv, "Parquet");
  for (const std::string name : {"flow.h5", "flow.mat"}) {
    const Answer read = run("inspect " + name);
    EXPECT_EQ(read.status, 0) << read.message;
    EXPECT_THAT(read.output, HasSubstr("1500 samples from 0 to 1.499 s")) << name;
  }
}

TEST_F(EstimateFormats, AreOneForAFolderOfSeveral) {
  write("other.csv", content("run.csv"));
  ASSERT_EQ(run("estimate -q " + model + " run.csv other.csv --format mat -o out").status, 0);
  ASSERT_EQ(run("estimate -q " + model + " run.csv -o flow.mat").status, 0);
  EXPECT_EQ(content("out/run.mat"), content("flow.mat"));
  EXPECT_EQ(content("out/other.mat"), content("flow.mat"));
}

TEST_F(EstimateFormats, LeaveNothingBehindWhereTheDiskIsFullOrTheOutputAPipe) {
  for (const std::string suffix : {"parquet", "h5", "mat"}) {
    write("flow." + suffix, "of an earlier run");
    const Answer answer = run(fmt::format("--version; ulimit -f 16; '{}' estimate -q {} run.csv -o flow.{}",
                                          SPOOLFLOW_COMMAND, model, suffix));
    EXPECT_EQ(answer.status, 2) << suffix;
    EXPECT_THAT(answer.message, HasSubstr("size limit")) << suffix;
    EXPECT_EQ(content("flow." + suffix), "of an earlier run");
  }
  EXPECT_THAT(files(), ElementsAre("flow.h5", "flow.mat", "flow.parquet", "run.csv"));
  EXPECT_THAT(run("estimate -q " + model + " run.csv --format h5 -o - | cat").output, "");
  EXPECT_THAT(run("estimate -q " + model + " run.csv --format mat -o -").message, HasSubstr("needs a file"));
  EXPECT_THAT(run("estimate -q " + model + " run.csv -o flow.xlsx").message, HasSubstr(".xlsx is no format"));
}

}  // namespace
}  // namespace spoolflow::apps
