#include "addons/fleet/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/fleet/server_configuration.hpp"
#include "addons/live/site.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::fleet {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FleetFile : public live::InFolder {
 protected:
  std::string said(const std::string& text) {
    write("fleet.toml", text);
    return live::refusal([&] { (void)read_fleet(folder / "fleet.toml"); });
  }
  const std::string nats = "[nats]\nservers = \"nats://127.0.0.1:4222\"\n";
  const std::string database = "[postgresql]\nconnection = \"dbname=fleet\"\n";
};

TEST_F(FleetFile, NamesServersAndHowWorkersWork) {
  write("fleet.toml", "sites = [\"hall_3\"]\n[nats]\nservers = \"tls://a:4222,b\"\nreplicas = 3\n" + database +
                          "[worker]\nname = \"w1\"\nlease_s = 3\n[alarms]\nraised_after_s = 0\n");
  const FleetSettings fleet = read_fleet(folder / "fleet.toml");
  EXPECT_THAT(fleet.servers, ElementsAre("tls://a:4222", "tls://b"));
  EXPECT_EQ(fleet.stream.replicas, 3);
  EXPECT_EQ(fleet.worker.name, "w1");
  EXPECT_EQ(fleet.worker.lease_s, 3);
  EXPECT_EQ(fleet.raised_after_s, 0);
  EXPECT_THAT(fleet.sites, ElementsAre("hall_3"));
}

TEST_F(FleetFile, IsRefusedWithPlaceValueAndRemedy) {
  EXPECT_THAT(said(nats), HasSubstr("has no [postgresql]"));
  EXPECT_THAT(said(nats + "port = 1\n" + database), AllOf(HasSubstr("line 3"), HasSubstr("port")));
  EXPECT_THAT(said("[nats]\nservers = \"http://a\"\n" + database), HasSubstr("names no NATS servers"));
  EXPECT_THAT(said(nats + "user = \"w\"\n" + database), HasSubstr("go together"));
  EXPECT_THAT(said(nats + database + "[worker]\nlease_s = 1\n"), AllOf(HasSubstr("is 1"), HasSubstr("2 to 60")));
  EXPECT_THAT(said("sites = [\"a b\"]\n" + nats + database), HasSubstr("'a b'"));
}

TEST_F(FleetFile, ASiteMayDoNothingButSendItsOwnAndHearOfIt) {
  FleetSettings fleet;
  fleet.sites = {"hall_3"};
  const std::string text = nats_configuration(fleet);
  EXPECT_THAT(text, HasSubstr("publish: [\"spoolflow.block.*.hall_3\", \"spoolflow.model.hall_3\"], "
                              "subscribe: [\"spoolflow.coverage.hall_3\", \"spoolflow.ask.hall_3\"]"));
  // CVE-2023-47090: users stand in accounts alone, and one account more than the system's is there.
  EXPECT_THAT(text, AllOf(Not(HasSubstr("authorization")), HasSubstr("SPOOLFLOW {"), HasSubstr("SYS {")));
}

using SiteFile = FleetFile;

TEST_F(SiteFile, NamesTheSiteToTheFleet) {
  const auto said_of = [&](const std::string& fleet) {
    write("site.toml", fleet + "[[valve]]\nid = \"v\"\nmodel = \"" SPOOLFLOW_EXAMPLES
                               "/live/size_6.json\"\nsource = { kind = \"rig\" }\n");
    return live::refusal([&] { (void)live::read_site(folder / "site.toml"); });
  };
  EXPECT_EQ(said_of("[fleet]\nsite = \"hall_3\"\nservers = \"nats://a\"\nblock_s = 0.5\n"), "");
  EXPECT_THAT(said_of("[fleet]\nsite = \"hall 3\"\n"), HasSubstr("'hall 3'"));
  EXPECT_THAT(said_of("[fleet]\nsite = \"hall_3\"\nblock_s = 2\n"), HasSubstr("0.1 to 1 s"));
  EXPECT_THAT(said_of("[fleet]\nservers = \"nats://a\"\n"), HasSubstr("site"));
}

}  // namespace
}  // namespace spoolflow::fleet
