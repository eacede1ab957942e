/// In place of modbus_server.cpp where libmodbus was not there.
#include "addons/live/fieldbus/modbus_server.hpp"

namespace spoolflow::live {

struct ModbusServer::Parts {};

bool has_modbus() {
  return false;
}

ModbusServer::ModbusServer(Engine&, const ModbusSettings&) {
  throw SiteError("[modbus]: this spoolflow was built without Modbus");
}
ModbusServer::~ModbusServer() = default;
std::uint16_t ModbusServer::port() const {
  return 0;
}

}  // namespace spoolflow::live
