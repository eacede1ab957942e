#include "addons/live/fieldbus/fieldbus_outputs.hpp"

#include <fmt/format.h>

namespace spoolflow::live {

void check_built_in(const SiteSettings& site) {
  const auto refuse = [](const char* table, const char* package, const char* option) {
    throw SiteError(
        fmt::format("the site's file has [{}], and this spoolflow was built without it; install {} and build "
                    "with -D{}=ON, or leave [{}] out",
                    table, package, option, table));
  };
  if (site.modbus && !has_modbus()) refuse("modbus", "libmodbus-dev", "SPOOLFLOW_MODBUS");
  if (site.mqtt && !has_mqtt()) refuse("mqtt", "libpaho-mqtt-dev", "SPOOLFLOW_MQTT");
  if (site.mqtt_source && !has_mqtt()) refuse("sources.mqtt", "libpaho-mqtt-dev", "SPOOLFLOW_MQTT");
}

FieldbusOutputs::FieldbusOutputs(Engine& engine) {
  const SiteSettings& site = engine.site();
  if (site.can) {
    can_.emplace(engine, *site.can);
    where_.push_back(
        fmt::format("CAN: {} valves as J1939, {} as CANopen", site.can->auxiliary_valve.size(), site.can->node.size()));
  }
  if (site.modbus) {
    modbus_.emplace(engine, *site.modbus);
    where_.push_back(fmt::format("Modbus TCP at {}", Address{site.modbus->listen.host, modbus_->port()}.text()));
  }
  if (site.mqtt) {
    mqtt_.emplace(engine, *site.mqtt);
    where_.push_back(
        fmt::format("MQTT to {} as {}/{}", site.mqtt->broker.address, site.mqtt->group, site.mqtt->edge_node));
  }
  if (site.mqtt_source) {
    receiver_.emplace(engine, *site.mqtt_source);
    where_.push_back(fmt::format("samples by MQTT from {}", site.mqtt_source->broker.address));
  }
}

}  // namespace spoolflow::live
