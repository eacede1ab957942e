/// What is kept of a valve at work is taken back by the next start, whatever its samples went through.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "addons/live/valve/valve_at_work.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/estimation/sample_faults.hpp"

namespace spoolflow::live {
namespace {

SharedModel example_valve() {
  SharedModel out;
  out.model = std::make_shared<const model::Model>(model::read_model(SPOOLFLOW_EXAMPLE_MODEL));
  out.sha256 = "of the example";
  return out;
}

/// A second at 1 kHz, to and fro.
SampleBlock second_from(int from) {
  SampleBlock out;
  for (int k = from; k < from + 1000; ++k) {
    const double opening = 0.5 + 0.4 * std::sin(1.5e-3 * k);
    out.samples.push_back({1e-3 * k, 0.6 + 1.2 * opening, 3 + 6 * opening, 2e-3 * opening, 318});
  }
  return out;
}

TEST(KeptValve, GoesOnAfterEveryKindOfFault) {
  const SharedModel model = example_valve();
  for (const estimation::SampleFault& fault : estimation::sample_faults) {
    ValveAtWork valve("v", model, "test");
    for (int second = 0; second < 6; ++second) {
      SampleBlock block = second_from(1000 * second);
      if (second == 2) fault.happens(block.samples[500]);
      valve.work(block);
      EXPECT_TRUE(ValveAtWork("v", model, "test").restore(valve.take_commit(false).state))
          << fault.name << ", second " << second;
    }
  }
}

}  // namespace
}  // namespace spoolflow::live
