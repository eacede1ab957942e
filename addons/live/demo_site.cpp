#include <array>

#include "addons/live/demo_model.hpp"
#include "addons/live/site.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::live {
namespace {

/// Healthy work first, so that the monitor learns what is usual; then so much wear as years bring.
constexpr double healthy_s = 60, ageing_s = 180;

struct DemoValve {
  const char* id;
  RigWork work;
  Ageing ageing;
};

Ageing wear(const rig::Wear& until) {
  return {.until = until, .after_s = healthy_s, .over_s = ageing_s};
}

}  // namespace

SiteSettings demo_site() {
  const EmbeddedFile& file = demo_model().front();
  const SharedModel model{
      std::make_shared<const model::Model>(model::parse_model(std::string(file.bytes), std::string(file.name))),
      model::sha256_of_text(file.bytes)};
  const std::array<DemoValve, 8> valves{{{"press_1", RigWork::duty, {}},
                                         {"press_2", RigWork::duty, {}},
                                         {"press_3_friction", RigWork::duty, wear({.friction_factor = 2.5})},
                                         {"clamp_1", RigWork::strokes, {}},
                                         {"clamp_2_edge_wear", RigWork::strokes, wear({.edge_rounding_m = 60e-6})},
                                         {"clamp_3", RigWork::strokes, {}},
                                         {"feed_1_coil", RigWork::strokes, wear({.shorted_turns_fraction = 0.12})},
                                         {"feed_2", RigWork::duty, {}}}};
  SiteSettings site;
  std::uint64_t seed = 101;
  for (const DemoValve& valve : valves) {
    site.valves.push_back(
        {valve.id, model,
         RigSettings{
             .valve = rig::valve_preset("size_6"), .seed = seed++, .ageing = valve.ageing, .work = valve.work}});
  }
  site.alarms.raised_after_s = 5;  // on a busy machine valves of the rig may fall silent for some seconds
  return site;
}

}  // namespace spoolflow::live
