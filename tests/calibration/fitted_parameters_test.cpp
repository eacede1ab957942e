/// What the fits say of their own parameters.
#include "spoolflow/calibration/fitted_parameters.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(FittedParameters, UncertaintiesAndCorrelationsAreThoseOfTheCovariance) {
  Eigen::MatrixXd covariance(3, 3);
  covariance << 4, -3, 0, -3, 9, 0, 0, 0, 0;
  const model::Fit fit = known_from("a line", {"offset_N", "slope_N_per_m", "held_N"}, {10, -2, 0}, covariance);
  EXPECT_EQ(fit.parameters[0].uncertainty, 2);
  EXPECT_EQ(fit.parameters[1].uncertainty, 3);
  EXPECT_EQ(fit.parameters[2].uncertainty, 0);
  EXPECT_THAT(fit.correlation, ElementsAre(1, DoubleEq(-0.5), 0, DoubleEq(-0.5), 1, 0, 0, 0, 1));
}

class ExampleFits : public ::testing::Test {
 protected:
  model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
};

TEST_F(ExampleFits, KnowTheCoilResistanceToAPercentAndEveryCorrelationLiesWithinOne) {
  const std::vector<model::Fit>& fits = model.observer->fits;
  ASSERT_EQ(fits.size(), 2U);
  const model::FittedParameter& resistance = fits[0].parameters.front();
  EXPECT_EQ(resistance.name, "coil_resistance_Ohm");
  EXPECT_NEAR(resistance.value, model.observer->parameters.actuator.coil_resistance.resistance_Ohm, 1e-9);
  EXPECT_GT(resistance.uncertainty, 0);
  EXPECT_LT(resistance.uncertainty, 0.01 * resistance.value);
  for (const model::Fit& fit : fits) {
    const std::size_t n = fit.parameters.size();
    ASSERT_EQ(fit.correlation.size(), n * n) << fit.of;
    for (std::size_t r = 0; r < n; ++r) {
      EXPECT_EQ(fit.correlation[r * n + r], 1) << fit.of;
      for (std::size_t c = 0; c < n; ++c) {
        EXPECT_LE(std::abs(fit.correlation[r * n + c]), 1) << fit.of;
        EXPECT_NEAR(fit.correlation[r * n + c], fit.correlation[c * n + r], 1e-9) << fit.of;
      }
    }
  }
}

TEST_F(ExampleFits, ComeBackFromTheModelFileAndAWrongSizeIsRefusedAtItsPlace) {
  std::ostringstream written;
  model::write_model(written, model);
  const model::Model again = model::parse_model(written.str(), "model.json");
  ASSERT_EQ(again.observer->fits.size(), model.observer->fits.size());
  EXPECT_EQ(again.observer->fits[1].correlation, model.observer->fits[1].correlation);
  EXPECT_EQ(again.observer->fits[1].parameters[3].name, model.observer->fits[1].parameters[3].name);

  model.observer->fits[0].correlation.pop_back();
  std::ostringstream damaged;
  model::write_model(damaged, model);
  EXPECT_THAT([&] { (void)model::parse_model(damaged.str(), "model.json"); },
              ::testing::ThrowsMessage<model::ModelError>(
                  HasSubstr("/observer/fits/0/correlation: has 8 entries, 9 would fit")));
}

}  // namespace
}  // namespace spoolflow::calibration
