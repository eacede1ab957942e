#include "addons/playground/requests/playground.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "addons/playground/requests/played_json.hpp"
#include "addons/playground/requests/virtual_valve.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::playground {

Playground::Playground(Outlet outlet) : outlet_(std::move(outlet)) {}
Playground::~Playground() = default;

std::string Playground::answer(std::string_view request) {
  using Json = nlohmann::json;
  const auto done = [&]() -> Json {
    const Json asked = Json::parse(request);
    const std::string work = asked.at("work");
    if (work == "version") return {{"version", SPOOLFLOW_VERSION}};
    if (work == "inspect") return inspect(asked, outlet_);
    if (work == "calibrate") return calibrate(asked, outlet_);
    if (work == "estimate") return estimate(asked, outlet_);
    if (work == "validate") return validate(asked, outlet_);
    if (work == "simulate") return simulate(asked, outlet_);
    if (work == "play_begin") {
      valve_ = std::make_unique<VirtualValve>(model::read_model(asked.at("model").get<std::string>()));
      return Json::object();
    }
    if (work == "play") {
      if (!valve_) throw std::invalid_argument("no valve is at work; ask play_begin first");
      return json_of(valve_->work(settings_of(asked), asked.at("duration_s")));
    }
    throw std::invalid_argument(fmt::format("'{}' is no work of the playground", work));
  };
  Json out;
  try {
    out = done();
  } catch (const std::exception& error) {
    out = {{"error", error.what()}};
  }
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace spoolflow::playground
