/// Channels that are not in every segment of a TDMS file, or change their unit from one to the next.
#include "spoolflow/recording/tdms/tdms_pauses.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/tdms/tdms_file.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Meta = TdmsMetadata;

/// A segment of 10 samples of each channel named, 0.1 s apart; `offset_s`: of the last one.
std::string seconds_of(const std::vector<std::string>& channels, double offset_s = 0) {
  Meta metadata;
  std::string numbers;
  for (const std::string& channel : channels) {
    metadata.channel("/'g'/'" + channel + "'", Meta::f64, 10).property("wf_increment", 0.1);
    numbers += tdms_samples<double>(std::vector<double>(10, 1));
  }
  if (offset_s > 0) metadata.property("wf_start_offset", offset_s);
  return tdms_segment(metadata.content(), numbers);
}

std::vector<std::string> unread_of(const std::string& bytes) {
  const TemporaryFile file("run.tdms", bytes);
  std::vector<std::string> out;
  for (const UnreadPart& part : open_sample_table(file.path()).table->unread()) out.push_back(part.what);
  return out;
}

TEST(TdmsPauses, AChannelAbsentFromASegmentInWhichOthersGoOnHasNoTimesBehindIt) {
  const std::vector<std::string> both{"current_A", "position_mm"};
  const std::string sound = seconds_of(both) + seconds_of(both);
  EXPECT_THAT(unread_of(sound), IsEmpty());
  const auto why = HasSubstr(
      "channel 'g/position_mm' is not read: it has no samples for 1 s in which others have, and neither wf_start_time "
      "nor "
      "wf_start_offset of the segment at byte");
  EXPECT_THAT(unread_of(seconds_of(both) + seconds_of({"current_A"}) + seconds_of(both)), ElementsAre(why));
  EXPECT_THAT(unread_of(seconds_of({"current_A"}) + seconds_of(both)), ElementsAre(why));
  EXPECT_THAT(unread_of(seconds_of(both) + seconds_of({"current_A"}) + seconds_of(both, 2)), IsEmpty());
}

TEST(TdmsPauses, ChannelsWrittenInTurnHaveNone) {
  std::string in_turn, slowly;
  for (int k = 0; k < 5; ++k) in_turn += seconds_of({"current_A"}) + seconds_of({"position_mm"});
  EXPECT_THAT(unread_of(in_turn), IsEmpty());
  for (int k = 0; k < 20; ++k) {
    Meta metadata;
    metadata.channel("/'g'/'current_A'", Meta::f64, 10).property("wf_increment", 0.1);
    std::string numbers = tdms_samples<double>(std::vector<double>(10, 1));
    if (k % 5 == 4) {
      metadata.channel("/'g'/'oil_temperature_C'", Meta::f64, 1).property("wf_increment", 5.0);
      numbers += tdms_samples<double>({50});
    }
    slowly += tdms_segment(metadata.content(), numbers);
  }
  EXPECT_THAT(unread_of(slowly), IsEmpty());
}

TEST(TdmsPauses, AUnitThatChangesFromOneSegmentToTheNextIsNotRead) {
  const auto in_unit = [](const std::string& unit) {
    return tdms_segment(Meta().channel("/'g'/'current'", Meta::f64, 2).property("unit_string", unit).content(),
                        tdms_samples<double>({1, 1}));
  };
  EXPECT_THAT(unread_of(in_unit("A") + in_unit("A")), IsEmpty());
  EXPECT_THAT(unread_of(in_unit("A") + in_unit("mA")),
              ElementsAre(HasSubstr("channel 'g/current' holds samples in A, and in mA from the segment at byte")));
}

}  // namespace
}  // namespace spoolflow::recording
