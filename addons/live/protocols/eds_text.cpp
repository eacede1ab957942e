/// The electronic data sheet of the CANopen device, after CiA 306.
#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "addons/live/protocols/canopen_device.hpp"

namespace spoolflow::fieldbus {
namespace {

constexpr const char* beginning = R"([FileInfo]
FileName=spoolflow.eds
FileVersion=1
FileRevision=0
EDSVersion=4.0
Description=Estimated flow of a spool valve, CiA 408
CreationTime=12:00PM
CreationDate=11-23-2026
CreatedBy=spoolflow
ModificationTime=12:00PM
ModificationDate=11-23-2026
ModifiedBy=spoolflow

[DeviceInfo]
VendorName=spoolflow
VendorNumber=0
ProductName=spoolflow flow sensor
ProductNumber=1
RevisionNumber=0x00010000
OrderCode=spoolflow
BaudRate_10=1
BaudRate_20=1
BaudRate_50=1
BaudRate_125=1
BaudRate_250=1
BaudRate_500=1
BaudRate_800=1
BaudRate_1000=1
SimpleBootUpMaster=0
SimpleBootUpSlave=1
Granularity=0
DynamicChannelsSupported=0
GroupMessaging=0
NrOfRXPDO=0
NrOfTXPDO=1
LSS_Supported=0

[DummyUsage]
Dummy0001=0
Dummy0002=0
Dummy0003=0
Dummy0004=0
Dummy0005=0
Dummy0006=0
Dummy0007=0
)";

/// What an entry holds before anything is known; settings as they are without any; the node's number as CiA 306 writes
/// it.
std::string default_value(const CanopenObject& one) {
  if (one.index == 0x1800 && one.sub == 1) return "$NODEID+0x40000180";
  const bool changes = one.index == 0x1001 || (one.index >= 0x2000 && one.sub != 0) || one.index == 0x2001 ||
                       one.index == 0x2002 || one.index == 0x2003 || one.index == 0x6041;
  return changes ? "" : fmt::format("0x{:X}", one.value);
}

void put_entry(std::string& out, const CanopenObject& one) {
  const bool is_constant = one.index < 0x2000 && one.index != 0x1001;
  out += fmt::format(
      "ParameterName={}\nObjectType=0x7\nDataType=0x{:04X}\nAccessType={}\nDefaultValue={}\nPDOMapping={}\n",
      *one.name == '\0' ? one.object : one.name, static_cast<unsigned>(one.type),
      is_constant || (one.sub == 0 && *one.name != '\0') ? "const" : "ro", default_value(one),
      one.may_be_mapped ? 1 : 0);
}

}  // namespace

std::string eds_text() {
  const std::vector<CanopenObject> all = canopen_objects({}, {});
  std::string out = beginning;
  const auto list = [&](const char* name, auto&& belongs) {
    std::vector<std::uint16_t> indices;
    for (const CanopenObject& one : all) {
      if (belongs(one.index) && (indices.empty() || indices.back() != one.index)) indices.push_back(one.index);
    }
    out += fmt::format("\n[{}]\nSupportedObjects={}\n", name, indices.size());
    for (std::size_t k = 0; k < indices.size(); ++k) out += fmt::format("{}=0x{:04X}\n", k + 1, indices[k]);
  };
  const auto is_mandatory = [](unsigned index) { return index == 0x1000 || index == 0x1001 || index == 0x1018; };
  list("MandatoryObjects", is_mandatory);
  list("OptionalObjects", [&](unsigned index) { return !is_mandatory(index) && (index < 0x2000 || index >= 0x6000); });
  list("ManufacturerObjects", [](unsigned index) { return index >= 0x2000 && index < 0x6000; });
  for (std::size_t k = 0; k < all.size(); ++k) {
    const CanopenObject& one = all[k];
    const bool is_record = *one.name != '\0';
    if (is_record && one.sub == 0) {
      const auto subs = std::count_if(all.begin(), all.end(), [&](const auto& x) { return x.index == one.index; });
      out += fmt::format("\n[{:04X}]\nParameterName={}\nObjectType=0x9\nSubNumber={}\n", one.index, one.object, subs);
    }
    out += is_record ? fmt::format("\n[{:04X}sub{:X}]\n", one.index, one.sub) : fmt::format("\n[{:04X}]\n", one.index);
    put_entry(out, one);
  }
  return out;
}

}  // namespace spoolflow::fieldbus
