#include "addons/fleet/transport/reader_watch.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Step = ReaderWatch::Step;

/// When another reader is made, by one that says nothing from then on but answers each time that it is there.
milliseconds renewed_after(ReaderWatch watch, ReaderWatch::Time begin) {
  for (milliseconds silent{0}; silent < seconds(60); silent += milliseconds(100)) {
    const Step step = watch.silent(begin + silent);
    if (step == Step::renew) return silent;
    if (step == Step::ask) watch.answered(begin + silent);
  }
  return milliseconds::max();
}

TEST(ReaderWatch, MakesAnotherOfAReaderThatWasForgottenThoughItAnswersWithinTwoSeconds) {
  const ReaderWatch::Time begin{seconds(1000)};
  ReaderWatch watch(begin);
  EXPECT_LE(renewed_after(watch, begin), seconds(2));
  EXPECT_FALSE(watch.has_spoken());
  watch.heard(begin + seconds(30));
  EXPECT_TRUE(watch.has_spoken());
  EXPECT_LE(renewed_after(watch, begin + seconds(30)), seconds(2));
}

TEST(ReaderWatch, MakesFewerWhereThereIsNothingToSay) {
  const ReaderWatch::Time begin{seconds(1000)};
  EXPECT_GE(renewed_after(ReaderWatch(begin, 100), begin), seconds(4));
}

TEST(ReaderWatch, AsksOneWhoseServerMayBeGoneAfterASecond) {
  const ReaderWatch::Time begin{seconds(1000)};
  ReaderWatch watch(begin);
  EXPECT_EQ(watch.silent(begin + milliseconds(900)), Step::wait);
  EXPECT_EQ(watch.silent(begin + seconds(1)), Step::ask);
  watch.heard(begin + seconds(1));
  EXPECT_EQ(watch.silent(begin + milliseconds(1900)), Step::wait);
}

}  // namespace
}  // namespace spoolflow::fleet
