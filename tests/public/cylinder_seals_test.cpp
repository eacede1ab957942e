/// The calibration of the axial-force map on strokes of pneumatic cylinders at held pressures (E. Zillen, TU Delft):
/// pressure times area is the flow force there, the seal's friction that of the spool.
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

#include "public_data.hpp"
#include "spoolflow/calibration/fits/axial_force.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr double from_m = 5e-3;  // clear of the ends
constexpr double stroke_m = 25e-3;

/// Adds a file: rows of time [ms], three voltages, position [mm], pressure [bar], force [N], without header.
void append(recording::Recording& recording, const std::filesystem::path& file, double pressure_bar) {
  std::ifstream in(file);
  std::string line;
  constexpr int settling_rows = 15;  // as upstream's own evaluation
  const double start_s = recording.size() == 0 ? 0 : recording.column(Channel::time).back() + 1;
  for (int row = 0; std::getline(in, line); ++row) {
    std::istringstream cells(line);
    std::array<double, 7> value{};
    for (double& v : value) cells >> v;
    if (!cells) throw std::invalid_argument(fmt::format("{}, line {}: {}", file.string(), row + 1, line));
    if (row < settling_rows) continue;
    recording.column(Channel::time).push_back(start_s + 1e-3 * value[0]);
    recording.column(Channel::position).push_back(1e-3 * value[4] - from_m);
    recording.column(Channel::pressure_difference).push_back(1e5 * value[5]);
    recording.column(Channel::pressure_difference_set).push_back(1e5 * pressure_bar);
    recording.column(Channel::axial_force).push_back(value[6]);
    recording.column(Channel::flow).push_back(0);
  }
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Seal {
  const char* name;
  double bore_m;
};

class CylinderSeals : public public_data::PublicData, public testing::WithParamInterface<Seal> {
 public:
  CylinderSeals() : PublicData("friction-pneumatic-zillen") {}
};

TEST_P(CylinderSeals, PressureTimesAreaIsLeftAndFrictionRisesWithPressure) {
  const Seal seal = GetParam();
  recording::Recording recording;
  recording.file = seal.name;
  for (const int bar : {1, 3, 5, 7}) append(recording, data / fmt::format("{}_{}bar.csv", seal.name, bar), bar);
  const AxialForceFit fit = fit_axial_force(recording, stroke_m);
  ASSERT_EQ(fit.loops.size(), 4);
  const double area_m2 = 0.25 * std::numbers::pi * seal.bore_m * seal.bore_m;
  double friction_before_N = 0;
  for (const model::AxialForceLoop& loop : fit.loops) {
    const double opening_N = mean(loop.opening_N);
    const double closing_N = mean(loop.closing_N);
    const double expected_N = area_m2 * mean(loop.pressure_difference_Pa);
    const double friction_N = 0.5 * std::abs(opening_N - closing_N);
    const double deviation = 0.5 * (opening_N + closing_N) / expected_N - 1;
    fmt::print(
        "  {:<11} {:.0f} bar: force {:7.2f} N, pressure times area {:7.2f} N ({:+.2f} %; one direction alone {:+.1f}, "
        "{:+.1f} %), friction {:5.2f} N\n",
        seal.name, 1e-5 * loop.pressure_difference_set_Pa, 0.5 * (opening_N + closing_N), expected_N, 100 * deviation,
        100 * (opening_N / expected_N - 1), 100 * (closing_N / expected_N - 1), friction_N);
    EXPECT_LT(std::abs(deviation), 0.03);
    EXPECT_GT(friction_N, friction_before_N);
    friction_before_N = friction_N;
  }
}

INSTANTIATE_TEST_SUITE_P(Seals, CylinderSeals,
                         testing::Values(Seal{"O-ring257", 25.7e-3}, Seal{"X-ring257", 25.7e-3}, Seal{"NAP310", 25e-3},
                                         Seal{"NAPN", 25e-3}),
                         [](const auto& seal) {
                           std::string name = seal.param.name;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace spoolflow::calibration
