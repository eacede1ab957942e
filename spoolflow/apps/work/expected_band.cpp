#include "spoolflow/apps/work/expected_band.hpp"

#include <cmath>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/uncertainty/operating_point.hpp"

namespace spoolflow::apps {

double expected_half_width(const model::Model& model) {
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa(), rated = model.valve.rated_flow_m3_per_s;
  double sum = 0;
  int points = 0;
  for (const double opening : {0.25, 0.4, 0.55, 0.7, 0.85}) {
    for (const double pressure : {0.25, 0.5, 0.75, 0.95}) {
      for (const bool opens : {true, false}) {
        const auto course = uncertainty::course_to(model, {.position_m = opening * model.valve.stroke_m,
                                                           .pressure_difference_Pa = pressure * highest_Pa,
                                                           .oil_temperature_K = valve.edge.temperature_K.at(1),
                                                           .opening = opens});
        if (!course) continue;
        estimation::RunningSensor sensor(&valve, rated);
        sensor::Estimate<double> answer{};
        for (const estimation::TimedSample& sample : *course) sensor.step(sample, answer);
        sum += 0.5 * (answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s) / rated;
        ++points;
      }
    }
  }
  return points > 0 ? sum / points : std::nan("");
}

}  // namespace spoolflow::apps
