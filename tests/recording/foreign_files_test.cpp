#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/proposal.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/recording/recording_error.hpp"
#include "temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<double> ramp(std::size_t count, double step) {
  std::vector<double> out(count);
  for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<double>(k) * step;
  return out;
}

void write_mat(const std::filesystem::path& file, mat_ft version, std::vector<double> time_s,
               std::vector<double> current_A) {
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
  std::size_t time_dims[2] = {time_s.size(), 1};
  std::size_t current_dims[2] = {1, current_A.size()};
  for (auto* variable :
       {Mat_VarCreate("time_s", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, time_dims, time_s.data(), 0),
        Mat_VarCreate("current_A", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, current_dims, current_A.data(), 0)}) {
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
}

void write_hdf5(const std::filesystem::path& file, const std::vector<double>& time_ms) {
  const hid_t out = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t group = H5Gcreate2(out, "rig", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t size = time_ms.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t data = H5Dcreate2(group, "t", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time_ms.data());
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 3);
  const hid_t scalar = H5Screate(H5S_SCALAR);
  const hid_t unit = H5Acreate2(data, "unit", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(unit, text, "ms\0");
  H5Aclose(unit), H5Sclose(scalar), H5Tclose(text), H5Dclose(data), H5Sclose(space), H5Gclose(group), H5Fclose(out);
}

TEST(Mat, ReadsVersions5And73Alike) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const TemporaryFile file("vectors.mat", "");
    write_mat(file.path(), version, ramp(100, 1e-3), ramp(100, 0.01));
    const Recording recording = read_recording(file.path(), {});
    ASSERT_EQ(recording.size(), 100U);
    EXPECT_DOUBLE_EQ(recording[Channel::time][99], 0.099);
    EXPECT_DOUBLE_EQ(recording[Channel::current][99], 0.99);
  }
}

TEST(Mat, RefusesUnequalLengthsNaNAndTruncation) {
  const TemporaryFile file("bad.mat", "");
  write_mat(file.path(), MAT_FT_MAT5, ramp(100, 1e-3), ramp(99, 0.01));
  EXPECT_THAT([&] { (void)read_recording(file.path(), {}); },
              ThrowsMessage<RecordingError>(AllOf(HasSubstr("99 samples"), HasSubstr("100"))));
  std::vector<double> current = ramp(100, 0.01);
  current[41] = std::nan("");
  write_mat(file.path(), MAT_FT_MAT5, ramp(100, 1e-3), current);
  EXPECT_THAT([&] { (void)read_recording(file.path(), {}); },
              ThrowsMessage<RecordingError>(HasSubstr("sample 42 of \"current_A\"")));
  write_mat(file.path(), MAT_FT_MAT5, ramp(100, 1e-3), ramp(100, 0.01));
  const auto whole = std::filesystem::file_size(file.path());
  ReadOptions options;
  options.required = {Channel::time, Channel::current};
  for (std::uintmax_t size = whole - 1; size > 4; size -= 1 + size / 7) {
    std::filesystem::resize_file(file.path(), size);
    EXPECT_THROW((void)read_recording(file.path(), options), RecordingError) << size << " of " << whole;
  }
}

TEST(Hdf5, ReadsPathsWithUnitAttributes) {
  const TemporaryFile file("rig.h5", "");
  write_hdf5(file.path(), ramp(50, 1.0));
  ReadOptions options;
  options.channels.place = "map";
  options.channels.sources = {{Channel::time, {"/rig/t", "", 1, 0, {}}}};
  EXPECT_DOUBLE_EQ(read_recording(file.path(), options)[Channel::time][49], 0.049);
  const auto whole = std::filesystem::file_size(file.path());
  for (const std::uintmax_t size : {whole / 2, whole / 5, std::uintmax_t{9}}) {
    std::filesystem::resize_file(file.path(), size);
    EXPECT_THROW((void)read_recording(file.path(), options), RecordingError) << size;
  }
}

TEST(ChannelMap, RefusesWhatItDoesNotKnowWithTheLine) {
  const auto read = [](const std::string& text) {
    const TemporaryFile file("map.toml", text);
    return read_channel_map(file.path());
  };
  EXPECT_EQ(read("[channels]\ntime = { column = \"t\", unit = \"ms\" }\n").sources.at(Channel::time).unit, "ms");
  EXPECT_THAT([&] { (void)read("[channels]\ntime = { column = \"t\", unit = \"parsec\" }\n"); },
              ThrowsMessage<RecordingError>(AllOf(HasSubstr("line 2"), HasSubstr("parsec"))));
  EXPECT_THAT([&] { (void)read("[channels]\ntimes = \"t\"\n"); },
              ThrowsMessage<RecordingError>(AllOf(HasSubstr("line 2"), HasSubstr("times"))));
  EXPECT_THAT([&] { (void)read("[channels]\ntime = { colum = \"t\" }\n"); },
              ThrowsMessage<RecordingError>(HasSubstr("did you mean \"column\"")));
  EXPECT_THAT([&] { (void)read("[channels\n"); },
              ThrowsMessage<RecordingError>(AllOf(HasSubstr("line 1"), HasSubstr("TOML"))));
}

TEST(Campaign, NamesTheLineOfARecordingThatIsNotThere) {
  const TemporaryFile file("campaign.toml",
                           "[valve]\nname = \"A\"\nrated_flow_L_min = 80\nstroke_mm = 2.4\n[[recording]]\nprotocol = "
                           "\"spring\"\nfile = \"nowhere.csv\"\n");
  EXPECT_THAT(
      [&] { (void)read_campaign(file.path()); },
      ThrowsMessage<RecordingError>(AllOf(HasSubstr("line 7"), HasSubstr("nowhere.csv"), HasSubstr("not there"))));
}

TEST(Campaign, RefusesAnUnknownProtocolWithTheNearest) {
  const TemporaryFile file("campaign.toml",
                           "[valve]\nname = \"A\"\nrated_flow_L_min = 80\nstroke_mm = 2.4\n[[recording]]\nprotocol = "
                           "\"sprin\"\nfile = \"x\"\n");
  EXPECT_THAT([&] { (void)read_campaign(file.path()); },
              ThrowsMessage<RecordingError>(HasSubstr("did you mean \"spring\"")));
}

TEST(Proposal, KnowsCommonNamesAndLeavesTheRestToThePerson) {
  const ChannelMap map = propose_channels({"CSV", {"t [ms]", "I_sol [mA]", "LVDT", "comment"}, {"", "", "V", ""}});
  EXPECT_EQ(map.sources.at(Channel::time).unit, "ms");
  EXPECT_EQ(map.sources.at(Channel::current).column, "I_sol [mA]");
  EXPECT_THAT(written(map),
              AllOf(HasSubstr("position = { column = \"LVDT\", unit = \"V\", scale"), HasSubstr("to = \"?\"")));
  EXPECT_EQ(map.sources.size(), 3U);
}

}  // namespace
}  // namespace spoolflow::recording
