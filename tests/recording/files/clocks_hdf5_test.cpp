/// HDF5 files whose groups were sampled at rates of their own: all on the time of the current.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/apps/matlab_file.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::HasSubstr;
using Signal = std::function<double(double)>;

/// A file of groups, written dataset by dataset.
class GroupedFile {
 public:
  GroupedFile() : file_("run.h5") { id_ = H5Fcreate(file_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT); }
  ~GroupedFile() { close(); }
  GroupedFile(const GroupedFile&) = delete;
  GroupedFile& operator=(const GroupedFile&) = delete;

  GroupedFile& add(const std::string& path, const std::vector<double>& values, double wave_step_s = 0,
                   double wave_begin_s = 0) {
    const hsize_t size = values.size();
    const hid_t links = H5Pcreate(H5P_LINK_CREATE), space = H5Screate_simple(1, &size, nullptr);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t data = H5Dcreate2(id_, path.c_str(), H5T_NATIVE_DOUBLE, space, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (wave_step_s > 0) {
      attribute(data, "wf_increment", wave_step_s);
      attribute(data, "wf_start_offset", wave_begin_s);
    }
    H5Dclose(data), H5Sclose(space), H5Pclose(links);
    return *this;
  }
  /// An attribute of a dataset that is there.
  GroupedFile& say(const std::string& path, const char* name, const std::string& text) {
    const hid_t data = H5Oopen(id_, path.c_str(), H5P_DEFAULT), space = H5Screate(H5S_SCALAR);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text.size());
    const hid_t made = H5Acreate2(data, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(made, type, text.data());
    H5Aclose(made), H5Tclose(type), H5Sclose(space), H5Oclose(data);
    return *this;
  }
  /// A numeric attribute likewise; of a group, too.
  GroupedFile& say(const std::string& path, const char* name, double value) {
    const hid_t object = H5Oopen(id_, path.c_str(), H5P_DEFAULT);
    attribute(object, name, value);
    H5Oclose(object);
    return *this;
  }
  const std::filesystem::path& close() {
    if (id_ >= 0) H5Fclose(id_);
    id_ = -1;
    return file_.path();
  }

 private:
  static void attribute(hid_t data, const char* name, double value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t made = H5Acreate2(data, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(made, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(made), H5Sclose(space);
  }
  TemporaryFile file_;
  hid_t id_ = -1;
};

std::vector<double> times(double begin_s, double step_s, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(begin_s + k * step_s);
  return out;
}

std::vector<double> of(const std::vector<double>& times_s, const Signal& signal) {
  std::vector<double> out;
  for (const double time_s : times_s) out.push_back(signal(time_s));
  return out;
}

double ramp(double time_s) {
  return 0.5 + 0.2 * time_s;
}
double pressure_bar(double time_s) {
  return 60 + 5 * time_s;
}

/// Ten thousand samples of the current at 1 kHz: several blocks.
void add_current(GroupedFile& file, const std::string& time = "current/time_s") {
  const auto time_s = times(0, 1e-3, 10000);
  file.add(time, time_s).add("current/current_A", of(time_s, ramp)).add("current/position_mm", of(time_s, ramp));
}

ReadOptions with_pressure() {
  return {.channels = {},
          .required = {Channel::current, Channel::position, Channel::pressure_difference},
          .optional = {},
          .stroke_m = {}};
}

Recording read(GroupedFile& file) {
  return read_recording(file.close(), with_pressure());
}

TEST(ClocksOfGroups, SlowerPressureIsInterpolatedAndMissingBeyondItsEnds) {
  GroupedFile file;
  add_current(file);
  const auto slow_s = times(1.0, 0.01, 801);  // 1 to 9 s
  file.add("pressure/time_ms", of(slow_s, [](double time_s) { return 1e3 * time_s; }));
  file.add("pressure/pressure_difference_bar", of(slow_s, pressure_bar));
  const Recording run = read(file);
  ASSERT_EQ(run.size(), 10000U);
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double time_s = 1e-3 * static_cast<double>(k), value = run[Channel::pressure_difference][k];
    if (time_s < 1.0 - 1e-9 || time_s > 9.0 + 1e-9) {
      ASSERT_TRUE(std::isnan(value)) << time_s;
    } else if (std::abs(time_s - 1) > 1e-9 && std::abs(time_s - 9) > 1e-9) {
      ASSERT_NEAR(value, 1e5 * pressure_bar(time_s), 1e-3) << time_s;
    }
  }
  EXPECT_THAT(run.resampled, HasSubstr("'current/current_A' (1000 Hz): 'pressure/pressure_difference_bar' from 100 Hz "
                                       "by linear interpolation, missing before 1 s and after 9 s"));
}

TEST(ClocksOfGroups, TimesOfAGroupCountFromItsStart) {
  GroupedFile file;
  add_current(file);
  const auto slow_s = times(0, 0.01, 801);
  file.add("pressure/time_ms", of(slow_s, [](double time_s) { return 1e3 * time_s; }));
  file.add("pressure/pressure_difference_bar", of(slow_s, pressure_bar));
  file.say("current", "start_time", "2025-01-01T10:00:00.000").say("pressure", "start_time", "2025-01-01T10:00:00.500");
  const Recording run = read(file);
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][499]));
  EXPECT_NEAR(run[Channel::pressure_difference][1505], 1e5 * pressure_bar(1.005), 1e-3);
}

TEST(AttributesOfHdf5, AFillValueIsAMissingSample) {
  GroupedFile file;
  add_current(file);
  std::vector<double> pressure(10000, 60);
  pressure[17] = -999, pressure[18] = -1;
  file.add("current/pressure_difference_bar", pressure);
  file.say("current/pressure_difference_bar", "_FillValue", -999.0);
  file.say("current/pressure_difference_bar", "missing_value", -1.0);
  const Recording run = read(file);
  EXPECT_NEAR(run[Channel::pressure_difference][16], 60e5, 1e-3);
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][17]));
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][18]));
}

TEST(AttributesOfHdf5, AScaleThatIsNotAppliedIsSaid) {
  GroupedFile file;
  add_current(file);
  file.add("current/pressure_difference_bar", std::vector<double>(10000, 60));
  file.say("current/current_A", "gain", 1.25).say("current/position_mm", "gain", 1.0);
  EXPECT_EQ(read(file).resampled,
            "'current/current_A' has the attribute gain = 1.25, which is not applied: if its numbers are still to be "
            "scaled by it, call it scale_factor, or give scale in a channel map");
}

TEST(ClocksOfGroups, FasterPressureIsTheMeanOverTheCurrentsTimeStep) {
  GroupedFile file;
  add_current(file);
  const auto fast_s = times(0, 5e-5, 200000);  // 20 kHz, with a ripple of 1 kHz that a mean over 1 ms does not see
  file.add("pressure/time_s", fast_s);
  file.add("pressure/pressure_difference_bar",
           of(fast_s, [](double time_s) { return pressure_bar(time_s) + 10 * std::sin(2e3 * M_PI * time_s); }));
  const Recording run = read(file);
  for (std::size_t k = 1; k + 1 < run.size(); ++k) {
    ASSERT_NEAR(run[Channel::pressure_difference][k], 1e5 * pressure_bar(1e-3 * static_cast<double>(k)), 2e3) << k;
  }
  EXPECT_THAT(run.resampled, HasSubstr("from 2e+04 Hz by the mean over each time step"));
}

TEST(ClocksOfGroups, GapOfASlowSignalIsNotBridged) {
  GroupedFile file;
  add_current(file);
  auto slow_s = times(0, 0.01, 1001);
  slow_s.erase(slow_s.begin() + 300, slow_s.begin() + 500);  // 2 s without
  file.add("pressure/time_s", slow_s).add("pressure/pressure_difference_bar", of(slow_s, pressure_bar));
  const Recording run = read(file);
  EXPECT_FALSE(std::isnan(run[Channel::pressure_difference][2980]));
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][4000]));
  EXPECT_FALSE(std::isnan(run[Channel::pressure_difference][5010]));
}

TEST(ClocksOfGroups, EqualTimesOfTwoGroupsAreLeftAsTheyAre) {
  GroupedFile file;
  add_current(file);
  const auto time_s = times(0, 1e-3, 10000);
  file.add("pressure/time_s", time_s).add("pressure/pressure_difference_bar", of(time_s, pressure_bar));
  const Recording run = read(file);
  EXPECT_EQ(run.resampled, "");
  EXPECT_DOUBLE_EQ(run[Channel::pressure_difference][7000], 1e5 * pressure_bar(time_s[7000]));
}

TEST(ClocksOfGroups, WaveformAttributesGiveTheTime) {
  GroupedFile file;
  const auto time_s = times(0.5, 1e-3, 4000), slow_s = times(0, 0.1, 60);
  file.add("coil/current_A", of(time_s, ramp), 1e-3, 0.5).add("coil/position_mm", of(time_s, ramp), 1e-3, 0.5);
  file.add("oil/pressure_difference_bar", of(slow_s, pressure_bar), 0.1);
  const Recording run = read(file);
  ASSERT_EQ(run.size(), 4000U);
  EXPECT_NEAR(run[Channel::time][1], 0.501, 1e-12);
  EXPECT_NEAR(run[Channel::pressure_difference][1234], 1e5 * pressure_bar(1.734), 1e-3);
}

TEST(ClocksOfGroups, WaveformsThatBeginAtOtherInstantsAreNotLaidOverEachOther) {
  GroupedFile file;
  const auto time_s = times(0, 1e-3, 4000), slow_s = times(0.5, 0.1, 35);
  file.add("coil/current_A", of(time_s, ramp), 1e-3).add("coil/position_mm", of(time_s, ramp), 1e-3);
  file.add("oil/pressure_difference_bar", of(slow_s, pressure_bar), 0.1);
  for (const char* channel : {"coil/current_A", "coil/position_mm"})
    file.say(channel, "wf_start_time", "2026-11-22T10:00:00.250000");
  file.say("oil/pressure_difference_bar", "wf_start_time", "2026-11-22T10:00:00.750000");
  const Recording run = read(file);
  EXPECT_NEAR(run[Channel::time][1], 0.001, 1e-9);
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][400]));
  EXPECT_NEAR(run[Channel::pressure_difference][1234], 1e5 * pressure_bar(1.234), 1e-3);
}

TEST(ClocksOfGroups, WhatIsAmbiguousIsRefused) {
  GroupedFile no_time;
  add_current(no_time);
  no_time.add("pressure/pressure_difference_bar", times(60, 1, 100));
  EXPECT_THAT(refusal([&] { (void)read(no_time); }), HasSubstr("no time of 100 samples is found for it"));

  GroupedFile two_times;
  add_current(two_times);
  two_times.add("pressure/time_s", times(0, 0.1, 100)).add("pressure/time_ms", times(0, 100, 100));
  two_times.add("pressure/pressure_difference_bar", times(60, 1, 100));
  EXPECT_THAT(refusal([&] { (void)read(two_times); }), HasSubstr("has two times beside it"));

  GroupedFile backwards;
  add_current(backwards);
  auto falling = times(0, 0.1, 100);
  std::swap(falling[40], falling[41]);
  backwards.add("pressure/time_s", falling).add("pressure/pressure_difference_bar", times(60, 1, 100));
  EXPECT_THAT(refusal([&] { (void)read(backwards); }), HasSubstr("time runs backwards, from 4.1 to 4 s"));

  GroupedFile apart;
  add_current(apart);
  apart.add("pressure/time_s", times(1000, 0.1, 100)).add("pressure/pressure_difference_bar", times(60, 1, 100));
  EXPECT_THAT(refusal([&] { (void)read(apart); }), HasSubstr("they have no time in common"));
}

TEST(ClocksOfGroups, VectorOfAnotherLengthIsOfTheTimeThatCarriesItsName) {
  const auto time_s = times(0, 1e-3, 2000), slow_s = times(0, 0.02, 101);
  const TemporaryFile file("run.mat", apps::matlab_v5_file({{"time_s", time_s},
                                                            {"current_A", of(time_s, ramp)},
                                                            {"position_mm", of(time_s, ramp)},
                                                            {"pressure_difference_bar", of(slow_s, pressure_bar)},
                                                            {"pressure_difference_time_s", slow_s}}));
  const Recording run = read_recording(file.path(), with_pressure());
  ASSERT_EQ(run.size(), 2000U);
  EXPECT_NEAR(run[Channel::pressure_difference][1505], 1e5 * pressure_bar(1.505), 1e-3);
}

TEST(ClocksOfGroups, InspectionShowsEachTimeAndWhatBecomesOfIt) {
  GroupedFile file;
  add_current(file);
  const auto slow_s = times(0, 0.01, 1001);
  file.add("a_pressure/time_s", slow_s).add("a_pressure/pressure_difference_bar", of(slow_s, pressure_bar));
  const Inspection found = inspect(file.close(), {}, [](std::optional<double>, std::uint64_t) {});
  ASSERT_EQ(found.clocks.size(), 2U);
  EXPECT_NEAR(found.clocks[0].rate_Hz, 100, 1e-6);
  EXPECT_TRUE(found.clocks[1].leads);
  EXPECT_EQ(found.clocks[1].time, "current/time_s");
  EXPECT_EQ(found.proposal.sources.at(Channel::time).column, "current/time_s");
  EXPECT_EQ(found.samples, 10000U);
  EXPECT_THAT(found.resampled, HasSubstr("by linear interpolation"));
}

}  // namespace
}  // namespace spoolflow::recording
