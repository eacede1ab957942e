/// fuzz_seeds CORPUS: the seeds that the project's own writers make, to CORPUS/NAME: frames of a CAN bus, payloads of
/// Sparkplug, Excel workbooks. They are kept beside this; run it after a writer has changed.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "addons/formats/tests/xlsx/xlsx_file.hpp"
#include "addons/live/protocols/can_text.hpp"
#include "addons/live/protocols/sparkplug.hpp"

namespace {

using namespace spoolflow;

std::filesystem::path corpus;

void put(const std::string& target, const std::string& name, const std::string& bytes) {
  std::filesystem::create_directories(corpus / target);
  std::ofstream(corpus / target / name, std::ios::binary) << bytes;
}

void can_seeds() {
  const sensor::CanFrame j1939{
      .id = 0x0CFE1080, .extended = true, .size = 8, .data = {0x7D, 0xFF, 0xF0, 1, 2, 3, 4, 5}};
  const sensor::CanFrame canopen{.id = 0x581, .extended = false, .size = 4, .data = {0x40, 0x00, 0x10, 0}};
  const std::string one = fieldbus::can_datagram(j1939, 1763900000.25), other = fieldbus::can_datagram(canopen, 0);
  put("can_datagram", "j1939", one);
  put("can_datagram", "canopen", other);
  put("can_datagram", "cut", one.substr(0, one.size() / 2));
  put("can_datagram", "long_map", "\xDE" + std::string("\0\x0B", 2) + one.substr(1));
  put("can_datagram", "remote", std::string("\x82\xAF") + "is_remote_frame\xC3\xAE" + "arbitration_id\x05");
}

void sparkplug_seeds() {
  const auto asking = [](bool value) {
    fieldbus::SparkplugPayload payload{.time_ms = 1763900000000, .seq = 7};
    payload.metrics.push_back({.name = "bdSeq", .time_ms = 1, .value = std::uint64_t{3}});
    payload.metrics.push_back({.name = "Node Control/Rebirth", .time_ms = 1, .value = value});
    return fieldbus::sparkplug_bytes(payload);
  };
  put("sparkplug", "rebirth", asking(true));
  put("sparkplug", "no_rebirth", asking(false));
  put("sparkplug", "cut", asking(true).substr(0, 20));
  fieldbus::SparkplugPayload values{.time_ms = -1, .seq = -1};
  for (const fieldbus::SparkplugValue& value :
       {fieldbus::SparkplugValue(std::int64_t{-5}), fieldbus::SparkplugValue(std::uint32_t{5}),
        fieldbus::SparkplugValue(0.5), fieldbus::SparkplugValue(std::string("text"))}) {
    values.metrics.push_back({.name = "value", .time_ms = 1, .value = value, .is_historical = true});
  }
  put("sparkplug", "values", fieldbus::sparkplug_bytes(values));
  put("sparkplug", "name", "\1Node Control/Rebirth");
}

void excel_seeds() {
  using recording::xlsx_row;
  using recording::XlsxFile;
  const std::string names = xlsx_row({"'time_s", "'current_A", "'position_mm"});
  const std::string rows =
      names + xlsx_row({"0", "0.5", "1"}) + xlsx_row({"0.001", "0.6", "<c t=\"e\"><v>#N/A</v></c>"});
  XlsxFile plain, dated, shared, stored;
  plain.sheet("Sheet1", rows);
  put("xlsx", "plain.xlsx", plain.content());
  const std::string clock = xlsx_row({"'clock", "'current_A"}) + xlsx_row({"<c s=\"1\"><v>46349.5</v></c>", "1"}) +
                            xlsx_row({"<c t=\"d\"><v>2026-11-23T12:00:01</v></c>", "2"});
  dated.sheet("Sheet1", clock).formats({"yyyy\\-mm\\-dd", "[h]:mm:ss"}).from_1904();
  put("xlsx", "dated.xlsx", dated.content());
  const std::string by_number = "<row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c><c r=\"B1\" t=\"s\"><v>1</v></c></row>";
  shared.sheet("About", xlsx_row({"'nothing"})).sheet("Run", by_number + xlsx_row({"0", "1"}), " state=\"visible\"");
  shared.texts_part("<si><t>time_s</t></si><si><r><t>curr</t></r><r><t>ent_A</t></r></si>");
  put("xlsx", "shared.xlsx", shared.content());
  stored.sheet("Sheet1", rows).packed({.deflated = false});
  put("xlsx", "stored.xlsx", stored.content());
  // Parts alone, for the target makes an archive of them.
  const std::string formats = "<cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"22\"/></cellXfs>";
  put("xlsx", "parts", rows + '\0' + formats + '\0' + "<si><t>time_s</t></si>");
  put("xlsx", "parts_dated", clock + '\0' + formats);
  put("xlsx", "parts_shared",
      by_number + xlsx_row({"0", "1"}) + '\0' + '\0' + "<si><t>time_s</t></si><si><t>current_A</t></si>");
  put("xlsx", "parts_formula", names + xlsx_row({"0", "<c><f>A1</f></c>", "<c t=\"str\"><f>T(A1)</f><v>1</v></c>"}));
  put("xlsx", "parts_whole", "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY b \"c\">]><worksheet>&b;</worksheet>");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("fuzz_seeds CORPUS\n", stderr);
    return 2;
  }
  corpus = arguments[1];
  can_seeds();
  sparkplug_seeds();
  excel_seeds();
  return 0;
}
