/// What HDF5 files of other programs hold beside plain vectors: units as attributes, infinite numbers, foreign filters.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr H5Z_filter_t foreign_filter = 32000;  // that of lzf

/// Hands bytes on as they are, under the name of lzf.
std::size_t hand_on(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) {
  return bytes;
}

class Hdf5Columns : public ::testing::Test {
 protected:
  void SetUp() override { id_ = H5Fcreate(file_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT); }
  void TearDown() override { close(); }
  const std::filesystem::path& close() {
    if (id_ >= 0) H5Fclose(id_);
    id_ = -1;
    return file_.path();
  }
  void add(const std::string& path, const std::vector<double>& values, const char* unit = nullptr,
           bool by_foreign_filter = false) {
    const hsize_t size = values.size();
    const hid_t links = H5Pcreate(H5P_LINK_CREATE), space = H5Screate_simple(1, &size, nullptr);
    const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    if (by_foreign_filter) {
      H5Pset_chunk(plan, 1, &size);
      H5Pset_filter(plan, foreign_filter, H5Z_FLAG_MANDATORY, 0, nullptr);
    }
    const hid_t data = H5Dcreate2(id_, path.c_str(), H5T_NATIVE_DOUBLE, space, links, plan, H5P_DEFAULT);
    H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (unit != nullptr) {
      const hid_t scalar = H5Screate(H5S_SCALAR), text = H5Tcopy(H5T_C_S1);
      H5Tset_size(text, std::char_traits<char>::length(unit) + 1);
      const hid_t made = H5Acreate2(data, "units", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(made, text, unit);
      H5Aclose(made), H5Tclose(text), H5Sclose(scalar);
    }
    H5Dclose(data), H5Pclose(plan), H5Sclose(space), H5Pclose(links);
  }
  [[nodiscard]] Inspection inspected() {
    return inspect(close(), {}, [](std::optional<double>, std::uint64_t) {});
  }
  [[nodiscard]] Recording current_and_position() {
    return read_recording(
        close(), {.channels = {}, .required = {Channel::current, Channel::position}, .optional = {}, .stroke_m = {}});
  }

  const std::vector<double> time_s{0, 0.001, 0.002, 0.003}, current_A{1, 1.1, 1.2, 1.3},
      position_mm{0.5, 0.6, 0.7, 0.8};

 private:
  TemporaryFile file_{"run.h5"};
  hid_t id_ = -1;
};

TEST_F(Hdf5Columns, OfAGroupAreTheirChannelsWhereAnAttributeRepeatsTheUnitOfTheName) {
  add("bench/time_s", time_s, "s");
  add("bench/current_A", current_A, "A");
  add("bench/position_mm", position_mm, "mm");
  const Inspection seen = inspected();
  ASSERT_TRUE(seen.proposal.sources.contains(Channel::current));
  EXPECT_EQ(seen.proposal.sources.at(Channel::current).column, "bench/current_A");
  EXPECT_EQ(seen.proposal.sources.at(Channel::position).column, "bench/position_mm");
  EXPECT_FALSE(seen.proposal.sources.contains(Channel::current_a));
  EXPECT_TRUE(seen.missing.empty());
  EXPECT_EQ(current_and_position().size(), 4U);
}

TEST_F(Hdf5Columns, ThatNobodyAskedForMayHoldInfinity) {
  add("time_s", time_s);
  add("current_A", current_A);
  add("position_mm", position_mm);
  add("ratio", {1, -std::numeric_limits<double>::infinity(), 2, std::numeric_limits<double>::infinity()});
  const Inspection seen = inspected();
  ASSERT_EQ(seen.columns.size(), 4U);
  EXPECT_EQ(seen.columns[3].name, "time_s");
  EXPECT_EQ(seen.columns[2].name, "ratio");
  EXPECT_EQ(seen.columns[2].lowest, 1);
  EXPECT_EQ(seen.columns[2].highest, 2);
  EXPECT_THAT(seen.columns[2].why, HasSubstr("2 infinite, the first in sample 2"));
  EXPECT_EQ(current_and_position().size(), 4U);
}

TEST_F(Hdf5Columns, WithInfinityAreRefusedWhereTheyAreWanted) {
  add("time_s", time_s);
  add("current_A", {1, 1.1, std::numeric_limits<double>::infinity(), 1.3});
  add("position_mm", position_mm);
  EXPECT_THAT(refusal([&] { (void)current_and_position(); }), AllOf(HasSubstr("sample 3"), HasSubstr("not finite")));
}

TEST_F(Hdf5Columns, PackedByAFilterThatIsNotHereAreSoundAndTheFilterIsNamed) {
  const H5Z_class2_t lzf{H5Z_CLASS_T_VERS, foreign_filter, 1, 1, "lzf", nullptr, nullptr, hand_on};
  H5Zregister(&lzf);
  add("time_s", time_s);
  add("current_A", current_A, nullptr, true);
  add("position_mm", position_mm);
  close();
  H5Zunregister(foreign_filter);
  EXPECT_THAT(
      refusal([&] { (void)current_and_position(); }),
      AllOf(HasSubstr("current_A"), HasSubstr("lzf"), HasSubstr("h5repack -f GZIP=4"), Not(HasSubstr("damaged"))));
}

}  // namespace
}  // namespace spoolflow::recording
