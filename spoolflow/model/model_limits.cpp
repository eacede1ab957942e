#include "spoolflow/model/model_limits.hpp"

#include "spoolflow/model/describe_campaign.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/limit_check.hpp"

namespace spoolflow::model {

void require_limits(const Model& model, const std::string& file) {
  const auto require = [&](const std::string& place, const auto& parameters, const auto& describe) {
    if (const auto found = violation(parameters, describe)) {
      throw ModelError(file + ": " + place + found->path + ": " + found->problem +
                       "; make the model again with `spoolflow calibrate`");
    }
  };
  require("/valve", model.valve, [](auto& valve, auto& visitor) { describe_valve(valve, visitor); });
  require("/fluid", model.fluid, [](auto& fluid, auto& visitor) { describe_fluid(fluid, visitor); });
  require("/instruments", model.instruments, [](auto& given, auto& visitor) { describe_instruments(given, visitor); });
  const auto require_sensors = [&](const std::string& place, const Condensed& condensed,
                                   const std::optional<Observer>& observer) {
    require(place + "/condensed", condensed.parameters,
            [](auto& parameters, auto& visitor) { describe_condensed(parameters, visitor); });
    if (!observer) return;
    require(place + "/observer", observer->parameters,
            [](auto& parameters, auto& visitor) { describe_observer(parameters, visitor); });
  };
  require_sensors("", model.condensed, model.observer);
  if (model.p_to_a) require_sensors("/p_to_a", model.p_to_a->condensed, model.p_to_a->observer);
}

}  // namespace spoolflow::model
