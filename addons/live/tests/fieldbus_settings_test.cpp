#include "addons/live/fieldbus_settings.hpp"

#include <gmock/gmock.h>

#include "addons/live/demo_model.hpp"
#include "addons/live/site.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

class FieldbusSettingsTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("m.json", std::string(demo_model().front().bytes));
  }
  void write_site(const std::string& tables) const {
    write("site.toml",
          tables + "[[valve]]\nid = \"press_1\"\nmodel = \"m.json\"\nsource = { kind = \"pipe\", path = \"-\" }\n");
  }
  [[nodiscard]] std::string refused(const std::string& tables) const {
    write_site(tables);
    return refusal([&] { (void)read_site(path("site.toml")); });
  }
};

TEST_F(FieldbusSettingsTest, AreOffWithoutTheirTables) {
  write_site("");
  const SiteSettings site = read_site(path("site.toml"));
  EXPECT_FALSE(site.can || site.modbus || site.mqtt);
}

TEST_F(FieldbusSettingsTest, AreReadFromTheirTables) {
  write_site(R"([can]
interface = "can1"
log = "bus.asc"
source_address = 5
period_ms = 20
auxiliary_valve = { press_1 = 3 }
node = { press_1 = 17 }
[modbus]
listen = "0.0.0.0:1502"
allow = ["192.168.0.7"]
[mqtt]
broker = "ssl://broker.example.org:8883"
group = "plant"
edge_node = "hall 3"
user = "hall"
password_file = "password"
)");
  const SiteSettings site = read_site(path("site.toml"));
  EXPECT_EQ(site.can->interface, "can1");
  EXPECT_EQ(site.can->log, path("bus.asc"));
  EXPECT_EQ(site.can->source_address, 5);
  EXPECT_EQ(site.can->auxiliary_valve.at("press_1"), 3);
  EXPECT_EQ(site.can->node.at("press_1"), 17);
  EXPECT_EQ(site.modbus->listen.port, 1502);
  EXPECT_EQ(site.mqtt->broker.password_file, path("password"));
}

TEST_F(FieldbusSettingsTest, NameWhoMayAskByNumbers) {
  for (const std::string host : {"192.168.0.0/24", "plc.example", "192.168.0", ""}) {
    const std::string allow = "allow = [\"" + host + "\"]\n", words = "'" + host + "' is no machine's address";
    EXPECT_THAT(refused("[modbus]\nlisten = \"127.0.0.1:0\"\n" + allow), HasSubstr(words));
    EXPECT_THAT(refused("[sources]\n" + allow), HasSubstr(words));
  }
}

TEST_F(FieldbusSettingsTest, GiveEachValveTheTopicOfItsSamples) {
  const std::string
      valve = "[[valve]]\nid = \"press_2\"\nmodel = \"m.json\"\nsource = { kind = \"mqtt\" }\n",
      other = "[[valve]]\nid = \"press_3\"\nmodel = \"m.json\"\nsource = { kind = \"mqtt\", topic = \"plc/7\" }\n",
      broker = "[sources.mqtt]\nbroker = \"tcp://127.0.0.1:1883\"\n", topic = "topic = \"hall/+/samples\"\n";
  write_site(broker + topic + valve + other);
  const SiteSettings site = read_site(path("site.toml"));
  EXPECT_EQ(std::get<MqttTopicSettings>(site.valves[0].source).topic, "hall/press_2/samples");
  EXPECT_EQ(std::get<MqttTopicSettings>(site.valves[1].source).topic, "plc/7");
  EXPECT_THAT(refused(valve), HasSubstr("no broker is given; write [sources.mqtt]"));
  EXPECT_THAT(refused(broker + valve), HasSubstr("'press_2' has no topic"));
  EXPECT_THAT(refused(broker + "topic = \"hall/samples\"\n" + valve), HasSubstr("one level of it is '+'"));
  EXPECT_THAT(refused(broker + "topic = \"hall/x+\"\n" + valve), HasSubstr("one level of it is '+'"));
  EXPECT_THAT(refused(broker + "topic = \"plc/+\"\n" + other +
                      "[[valve]]\nid = \"7\"\nmodel = \"m.json\"\nsource = { kind = \"mqtt\" }\n"),
              HasSubstr("'press_3' and '7' have the topic 'plc/7' both"));
}

TEST_F(FieldbusSettingsTest, SayWhatIsWrongAndWhatToDo) {
  EXPECT_THAT(refused("[can]\nnode = { press_1 = 17 }\n"), HasSubstr("names nothing that frames could go to; write "));
  EXPECT_THAT(refused("[can]\nlog = \"bus.log\"\n"), HasSubstr("names no valve; write auxiliary_valve"));
  EXPECT_THAT(refused("[can]\nlog = \"bus.txt\"\nnode = { press_1 = 17 }\n"), HasSubstr(".asc as Vector's tools do"));
  EXPECT_THAT(refused("[can]\nlog = \"bus.log\"\nnode = { press_1 = 128 }\n"), HasSubstr("allowed: 1 to 127"));
  EXPECT_THAT(refused("[can]\nlog = \"bus.log\"\nauxiliary_valve = { press_1 = 16 }\n"), HasSubstr("allowed: 0 to 15"));
  EXPECT_THAT(refused("[can]\nlog = \"bus.log\"\nnode = { pres_1 = 1 }\n"), HasSubstr("press_1"));
  EXPECT_THAT(refused("[can]\nlog = \"bus.log\"\nnode = { press_1 = 1, press_2 = 1 }\n"), HasSubstr("both"));
  EXPECT_THAT(refused("[modbus]\nlisten = \"0.0.0.0:502\"\n"),
              HasSubstr("Modbus knows no passwords; list who may ask"));
  EXPECT_THAT(refused("[mqtt]\nbroker = \"broker:1883\"\ngroup = \"a\"\nedge_node = \"b\"\n"),
              HasSubstr("write tcp://HOST:1883"));
  EXPECT_THAT(refused("[mqtt]\nbroker = \"tcp://b:1883\"\ngroup = \"a/b\"\nedge_node = \"b\"\n"),
              HasSubstr("without '/', '+' and '#'"));
  EXPECT_THAT(refused("[mqtt]\nbroker = \"tcp://10.0.0.1:1883\"\ngroup = \"a\"\nedge_node = \"b\"\nuser = \"u\"\n"
                      "password_file = \"p\"\n"),
              HasSubstr("a password would go to 'tcp://10.0.0.1:1883' unencrypted"));
}

}  // namespace
}  // namespace spoolflow::live
