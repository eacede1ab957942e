#include "spoolflow/fleet/transport/reader_watch.hpp"

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

TEST(ReaderWatch, MakesAnotherOfAReaderThatWasForgottenThoughItAnswersWithinThreeSeconds) {
  const ReaderWatch::Time begin{seconds(1000)};
  ReaderWatch watch(begin);
  EXPECT_LE(renewed_after(watch, begin), seconds(3));
  watch.heard(begin + seconds(30));
  EXPECT_LE(renewed_after(watch, begin + seconds(30)), seconds(3));
}

TEST(ReaderWatch, AsksOneWhoseServerMayBeGoneAfterOneAndAHalf) {
  const ReaderWatch::Time begin{seconds(1000)};
  ReaderWatch watch(begin);
  EXPECT_EQ(watch.silent(begin + milliseconds(1400)), Step::wait);
  EXPECT_EQ(watch.silent(begin + milliseconds(1500)), Step::ask);
  watch.heard(begin + seconds(2));
  EXPECT_EQ(watch.silent(begin + milliseconds(3400)), Step::wait);
}

}  // namespace
}  // namespace spoolflow::fleet
