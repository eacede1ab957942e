#include "addons/live/site.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/demo_model.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

class SiteTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("m.json", std::string(demo_model().front().bytes));
  }
  /// Of a site with these lines behind its valve's id and model.
  [[nodiscard]] std::string refused(const std::string& lines, const std::string& before = {}) const {
    write("site.toml", before + "[[valve]]\nid = \"press_1\"\nmodel = \"m.json\"\n" + lines);
    return refusal([&] { (void)read_site(path("site.toml")); });
  }
};

TEST_F(SiteTest, MayNameItsStoreOnTheCommandLineAlone) {
  write("site.toml",
        "[store]\nkeep_days = 7\n[[valve]]\nid = \"a\"\nmodel = \"m.json\"\nsource = { kind = \"udp\" }\n"
        "[sources]\nudp = \"127.0.0.1:0\"\n");
  const SiteSettings site = read_site(path("site.toml"));
  EXPECT_EQ(site.store, "");
  EXPECT_EQ(site.retention.days, 7);
}

TEST_F(SiteTest, ReadsEveryKindOfSource) {
  write("site.toml", R"(
[page]
listen = "127.0.0.1:9000"
[store]
file = "kept.sqlite"
keep_days = 7
[sources]
udp = "127.0.0.1:7700"
stalled_after_s = 2.5
[[valve]]
id = "a"
model = "m.json"
source = { kind = "udp" }
[[valve]]
id = "b"
model = "m.json"
source = { kind = "tcp", listen = "[::1]:0" }
[valve.channels]
current = { column = "I", unit = "mA" }
[[valve]]
id = "c"
model = "m.json"
source = { kind = "pipe", path = "fifo" }
[[valve]]
id = "d"
model = "m.json"
source = { kind = "replay", recording = "run.csv", speed = 10, repeats = true }
[[valve]]
id = "e"
model = "m.json"
source = { kind = "rig", valve = "size_6", seed = 4, ageing = { friction_factor = 2, over_s = 60 } }
)");
  const SiteSettings site = read_site(path("site.toml"));
  ASSERT_EQ(site.valves.size(), 5U);
  EXPECT_EQ(site.page.listen.port, 9000);
  EXPECT_EQ(site.store, path("kept.sqlite"));
  EXPECT_EQ(site.retention.days, 7);
  EXPECT_EQ(site.stalled_after_s, 2.5);
  EXPECT_EQ(kind(site.valves[0].source), "udp");
  EXPECT_EQ(std::get<TcpSettings>(site.valves[1].source).listen.host, "::1");
  EXPECT_EQ(site.valves[1].channels.sources.size(), 1U);
  EXPECT_EQ(std::get<PipeSettings>(site.valves[2].source).path, path("fifo"));
  EXPECT_TRUE(std::get<ReplaySettings>(site.valves[3].source).repeats);
  EXPECT_EQ(std::get<RigSettings>(site.valves[4].source).ageing.until.friction_factor, 2);
  EXPECT_EQ(site.valves[0].model.model, site.valves[4].model.model);  // one file, one model
}

TEST_F(SiteTest, APipeReachesOneValveAlone) {
  const std::string other = "[[valve]]\nid = \"press_2\"\nmodel = \"m.json\"\n";
  const std::string pipe = "source = { kind = \"pipe\", path = \"samples.fifo\" }\n";
  EXPECT_THAT(refused(pipe + other + "source = { kind = \"pipe\", path = \"./samples.fifo\" }\n"),
              HasSubstr("line 8: 'press_1' and 'press_2' read the same pipe"));
  EXPECT_EQ(refused(pipe + other + "source = { kind = \"pipe\", path = \"others.fifo\" }\n"), "");
}

TEST_F(SiteTest, AChannelMapOfDatagramsHasNoUse) {
  const std::string channels = "[valve.channels]\ncurrent = { column = \"I\", unit = \"mA\" }\n";
  EXPECT_THAT(refused("source = { kind = \"udp\" }\n" + channels, "[sources]\nudp = \"127.0.0.1:7700\"\n"),
              HasSubstr("'press_1' has channels, and its source is udp"));
  EXPECT_EQ(refused("source = { kind = \"tcp\", listen = \"127.0.0.1:0\" }\n" + channels), "");
}

TEST_F(SiteTest, SaysWhatIsWrongAndWhatToDo) {
  EXPECT_THAT(refused(""), HasSubstr("valve 'press_1' needs a source"));
  EXPECT_THAT(refused("source = { kind = \"upd\" }"),
              HasSubstr("line 4: unknown kind of source 'upd'; did you mean 'udp'?"));
  EXPECT_THAT(refused("source = { kind = \"udp\" }"), HasSubstr("write udp = \"127.0.0.1:7700\" in [sources]"));
  EXPECT_THAT(refused("source = { kind = \"tcp\", listen = \"everywhere\" }"), HasSubstr("is no address with a port"));
  EXPECT_THAT(refused("source = { kind = \"tcp\", listen = \"0.0.0.0:7001\" }"),
              HasSubstr("which other machines reach, and nothing says who may send"));
  EXPECT_THAT(refused("source = { kind = \"replay\", recording = \"r.csv\", speed = -1 }"),
              HasSubstr("must not be negative"));
  EXPECT_THAT(refused("source = { kind = \"rig\", ageing = { friction_factor = 50 } }"),
              HasSubstr("lies outside 0.2 to 5"));
  EXPECT_THAT(refused("source = { kind = \"rig\" }\nname = \"x\""), HasSubstr("unknown key 'name'"));
  write("site.toml", "[[valve]]\nid = \"../x\"\nmodel = \"m.json\"\nsource = { kind = \"rig\" }");
  EXPECT_THAT(refusal([&] { (void)read_site(path("site.toml")); }), HasSubstr("must be up to 32 letters, digits"));
  write("site.toml", "[[valve]]\nid = \"..\"\nmodel = \"m.json\"\nsource = { kind = \"rig\" }");
  EXPECT_THAT(refusal([&] { (void)read_site(path("site.toml")); }), HasSubstr("line 2: the id '..' must be"));
  write("site.toml", "[page]\n");
  EXPECT_THAT(refusal([&] { (void)read_site(path("site.toml")); }), HasSubstr("holds no valve"));
  const std::string rig = "source = { kind = \"rig\" }\n";
  for (const char* span : {"-1", "1e9"})
    EXPECT_THAT(refused(rig, std::string("[store]\nfile = \"x.sqlite\"\nraw_before_s = ") + span + "\n"),
                HasSubstr("give the raw samples about an alarm in s, 0 to 3600"));
  EXPECT_THAT(refused(rig, "[[valve]]\nid = \"press_1\"\nmodel = \"m.json\"\n" + rig),
              HasSubstr("two valves have the id"));
}

TEST_F(SiteTest, ReadsWhoMayComeIn) {
  const std::string rig = "[[valve]]\nid = \"a\"\nmodel = \"m.json\"\nsource = { kind = \"rig\" }\n";
  const std::string account = "[[page.account]]\nname = \"anna\"\nrole = \"acknowledge\"\nsecret = \"$scrypt$x\"\n";
  const auto of = [&](const std::string& page) {
    write("site.toml", page + rig);
    return read_site(path("site.toml"));
  };
  const auto wrong = [&](const std::string& page) { return refusal([&] { (void)of(page); }); };
  const SiteSettings site =
      of("[page]\nlisten = \"0.0.0.0:8443\"\ncertificate = \"c.pem\"\nkey = \"k.pem\"\nnames = [\"valves.org\"]\n" +
         account + "[alarms]\nraised_after_s = 0.5\n[plotjuggler]\nsend_to = \"127.0.0.1:9870\"\n");
  EXPECT_EQ(site.page.certificate, path("c.pem"));
  ASSERT_EQ(site.page.accounts.size(), 1U);
  EXPECT_EQ(site.page.accounts[0].role, Role::acknowledge);
  EXPECT_EQ(site.alarms.raised_after_s, 0.5);
  EXPECT_EQ(site.plotjuggler->port, 9870);
  EXPECT_NO_THROW(check_reach(site.page));
  EXPECT_EQ(of("[page]\nproxies = [\"127.0.0.1\", \"fd00:0::7\"]\n").page.proxies,
            (std::vector<std::string>{"127.0.0.1", "fd00::7"}));
  EXPECT_THAT(wrong("[page]\nproxies = [\"proxy.local\"]\n"), HasSubstr("proxy.local"));
  EXPECT_THAT(wrong("[page]\nproxies = \"127.0.0.1\"\n"), HasSubstr("proxies must be a list of texts, such as"));
  EXPECT_THAT(wrong("[page]\ncertificate = \"c.pem\"\n"), HasSubstr("name the other PEM file, too"));
  EXPECT_THAT(wrong(account + account), HasSubstr("two accounts have the name 'anna'"));
  EXPECT_THAT(wrong("[[page.account]]\nname = \"a\"\nrole = \"admin\"\nsecret = \"\"\n"),
              HasSubstr("role is \"read\" or \"acknowledge\""));
  EXPECT_THAT(wrong("[[page.account]]\nname = \"a\"\nrole = \"read\"\nsecret = \"hunter2\"\n"),
              HasSubstr("is no hash of a password or token; make one with `spoolflow account a`"));
  EXPECT_THAT(refusal([&] { check_reach(of("[page]\nlisten = \"0.0.0.0:1\"\n" + account).page); }),
              HasSubstr("and a certificate is missing"));
  EXPECT_THAT(refusal([&] { check_reach(of("[page]\nlisten = \"[::]:1\"\n").page); }),
              HasSubstr("a certificate and an account is missing"));
}

TEST(DemoSite, HasEightValvesOfWhichThreeAge) {
  const SiteSettings site = demo_site();
  ASSERT_EQ(site.valves.size(), 8U);
  int ageing = 0;
  for (const ValveSettings& valve : site.valves) {
    const rig::Wear& wear = std::get<RigSettings>(valve.source).ageing.until;
    ageing += wear.friction_factor > 1 || wear.edge_rounding_m > 0 || wear.shorted_turns_fraction > 0 ? 1 : 0;
    EXPECT_TRUE(valve.model.model->has_observer());
  }
  EXPECT_EQ(ageing, 3);
}

TEST(Ageing, GrowsInProportionToTime) {
  const rig::PlantParameters plant = rig::as_built(rig::valve_preset("size_6")).plant;
  const Ageing ageing{.until = {.friction_factor = 3}, .after_s = 100, .over_s = 200};
  EXPECT_EQ(aged(plant, ageing, 100).spool_friction.wear_factor, plant.spool_friction.wear_factor);
  EXPECT_DOUBLE_EQ(aged(plant, ageing, 200).spool_friction.wear_factor, 2 * plant.spool_friction.wear_factor);
  EXPECT_DOUBLE_EQ(aged(plant, ageing, 1e9).spool_friction.wear_factor, 3 * plant.spool_friction.wear_factor);
}

}  // namespace
}  // namespace spoolflow::live
