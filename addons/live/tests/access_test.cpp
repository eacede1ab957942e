#include "addons/live/http/access.hpp"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/demo_model.hpp"
#include "addons/live/http/http_access.hpp"
#include "addons/live/page/answer.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string& kept_hash() {
  static const std::string hash = secret_hash("correct horse");
  return hash;
}

PageSettings with_accounts() {
  PageSettings page;
  page.accounts = {{"anna", Role::acknowledge, kept_hash()}, {"eve", Role::read, kept_hash()}};
  return page;
}

TEST(SecretHash, HoldsItsOwnSecretAlone) {
  EXPECT_THAT(kept_hash(), testing::StartsWith("$scrypt$ln=15,r=8,p=1$"));
  EXPECT_THAT(kept_hash(), Not(HasSubstr("horse")));
  EXPECT_TRUE(holds(kept_hash(), "correct horse"));
  EXPECT_FALSE(holds(kept_hash(), "correct hors"));
  EXPECT_FALSE(holds(kept_hash(), ""));
  EXPECT_NE(secret_hash("correct horse"), kept_hash());  // another salt
  for (const char* none :
       {"", "$scrypt$", "$scrypt$ln=15,r=8,p=1$$", "$scrypt$ln=60,r=8,p=1$AAAAAAAAAAAAAAAAAAAAAA$x", "plain text"}) {
    EXPECT_FALSE(is_secret_hash(none)) << none;
    EXPECT_FALSE(holds(none, "")) << none;
  }
  EXPECT_EQ(random_token().size(), 43U);
  EXPECT_NE(random_token(), random_token());
}

// The same figures by another program: python3 -c "import hashlib; hashlib.scrypt(b'pleaseletmein',
// salt=b'0123456789abcdef', n=2**14, r=8, p=1, dklen=32, maxmem=2**26)".
TEST(SecretHash, IsScryptAsOtherProgramsComputeIt) {
  EXPECT_TRUE(holds("$scrypt$ln=14,r=8,p=1$MDEyMzQ1Njc4OWFiY2RlZg$wOBlTLx2kTvDnlM7GeRqLPJSaL8dgO6Mbiarn6WFHEI",
                    "pleaseletmein"));
}

class AccessTest : public ::testing::Test {
 protected:
  Access access{with_accounts()};
  Access::Time now = Access::Time(std::chrono::hours(1));
};

TEST_F(AccessTest, OtherAccountsLeaveSessionsToThoseWhoAreStillThere) {
  const auto anna = access.login("anna", "correct horse", {"p"}, now),
             eve = access.login("eve", "correct horse", {"p"}, now);
  EXPECT_EQ(access.who("", "eve.correct horse", "p", now).visitor.role, Role::read);
  PageSettings changed = with_accounts();
  changed.accounts[0].role = Role::read;
  changed.accounts[1].secret = secret_hash("another horse");
  access.change(changed);
  EXPECT_EQ(access.who(anna.session, "", "p", now).visitor.role, Role::read);
  EXPECT_EQ(access.who(eve.session, "", "p", now).visitor.role, Role::none);
  EXPECT_EQ(access.who("", "eve.correct horse", "p", now).visitor.role, Role::none);
  EXPECT_EQ(access.who("", "eve.another horse", "p", now).visitor.role, Role::read);
  changed.accounts.erase(changed.accounts.begin());
  access.change(changed);
  EXPECT_EQ(access.who(anna.session, "", "p", now).visitor.role, Role::none);
}

TEST_F(AccessTest, SessionsBeginWithThePasswordAndEnd) {
  const auto login = access.login("anna", "correct horse", {"p"}, now);
  ASSERT_EQ(login.session.size(), 43U);
  EXPECT_EQ(access.who(login.session, "", "p", now).visitor.role, Role::acknowledge);
  EXPECT_TRUE(access.who(login.session, "", "p", now).visitor.by_cookie);
  EXPECT_EQ(access.who(login.session + "x", "", "p", now).visitor.role, Role::none);
  EXPECT_EQ(access.who(login.session, "", "p", now + std::chrono::hours(13)).visitor.role, Role::none);
  const auto again = access.login("anna", "correct horse", {"p"}, now);
  access.logout(again.session);
  EXPECT_EQ(access.who(again.session, "", "p", now).visitor.role, Role::none);
  EXPECT_TRUE(access.login("anna", "wrong", {"p"}, now).session.empty());
  EXPECT_TRUE(access.login("nobody", "correct horse", {"p"}, now).session.empty());
}

TEST_F(AccessTest, TokensNameTheirAccount) {
  EXPECT_EQ(access.who("", "eve.correct horse", "p", now).visitor.role, Role::read);
  EXPECT_EQ(access.who("", "anna.correct horse", "p", now).visitor.name, "anna");
  EXPECT_FALSE(access.who("", "anna.correct horse", "p", now).visitor.by_cookie);
  for (const char* wrong : {"eve.", "eve", ".", "correct horse", "eve.eve.correct horse"}) {
    EXPECT_EQ(access.who("", wrong, "p", now).visitor.role, Role::none) << wrong;
    now += std::chrono::minutes(2);
  }
}

TEST_F(AccessTest, WrongOnesAreHeldBackByAddressAndAccount) {
  for (int k = 0; k < Access::trials_of_one; ++k) EXPECT_FALSE(access.login("anna", "wrong", {"p"}, now).too_many);
  EXPECT_TRUE(access.login("anna", "correct horse", {"p"}, now).too_many);
  EXPECT_TRUE(access.who("", "anna.correct horse", "p", now).too_many);
  EXPECT_FALSE(access.login("anna", "correct horse", {"q"}, now).session.empty());
  EXPECT_FALSE(access.login("eve", "correct horse", {"p"}, now).session.empty());
  EXPECT_FALSE(access.login("anna", "correct horse", {"p"}, now + std::chrono::seconds(61)).session.empty());
}

TEST_F(AccessTest, NamesThatThereAreNotHaveTheirTrialsTogether) {
  for (int k = 0; k < Access::trials_of_one; ++k) {
    EXPECT_FALSE(access.login("nobody " + std::to_string(k), "wrong", {"p"}, now).too_many);
  }
  EXPECT_TRUE(access.login("another", "wrong", {"p"}, now).too_many);
  EXPECT_FALSE(access.login("anna", "correct horse", {"p"}, now).session.empty());
}

TEST(Access, ManyWrongOnesOfAllKeepNobodyElseOut) {
  PageSettings quick;  // its hash takes no time
  quick.accounts = {
      {"anna", Role::read, "$scrypt$ln=4,r=8,p=1$MDEyMzQ1Njc4OWFiY2RlZg$OAkZqUBelG6VIYdTJfYSENL5OmZRxMa3GwXn5oFliTg"}};
  Access access(quick);
  const Access::Time now(std::chrono::hours(1));
  for (int k = 0; k < Access::trials_of_all; ++k) {
    EXPECT_FALSE(access.login("anna", "wrong", {"p" + std::to_string(k)}, now).too_many);
  }
  EXPECT_TRUE(access.login("anna", "correct horse", {"p1"}, now).too_many);  // its one of this minute was wrong
  EXPECT_FALSE(access.login("anna", "correct horse", {"q"}, now).session.empty());
}

TEST_F(AccessTest, ABrowserThatHasLoggedInIsNotKeptOutByOthersOfItsAddress) {
  const Access::Login before = access.login("anna", "correct horse", {"p"}, now);
  ASSERT_EQ(before.browser.size(), 43U);
  for (int k = 0; k < Access::trials_of_one; ++k) EXPECT_FALSE(access.login("anna", "wrong", {"p"}, now).too_many);
  EXPECT_TRUE(access.login("anna", "correct horse", {"p"}, now).too_many);
  const Access::Login again = access.login("anna", "correct horse", {"p", before.browser}, now);
  EXPECT_FALSE(again.session.empty());
  EXPECT_EQ(again.browser, before.browser);
  for (int k = 0; k < Access::trials_of_one; ++k) {
    EXPECT_FALSE(access.login("anna", "wrong", {"q", before.browser}, now).too_many);
  }
  EXPECT_TRUE(access.login("anna", "correct horse", {"q", before.browser}, now).too_many);  // it has as many itself
  EXPECT_NE(access.login("eve", "correct horse", {"q", before.browser}, now).browser, before.browser);
}

class DoorTest : public ::testing::Test {
 protected:
  static SiteSettings one_valve() {
    const EmbeddedFile& file = demo_model().front();
    SiteSettings site;
    site.valves.push_back(
        {"a",
         {std::make_shared<const model::Model>(model::parse_model(std::string(file.bytes), std::string(file.name))),
          "sha"},
         UdpSettings{}});
    site.udp = Address{"127.0.0.1", 0};
    site.alarms = {.raised_after_s = 0, .gone_after_s = 1000};
    return site;
  }
  static PageRequest get(const std::string& target) {
    return {.method = "GET", .target = target, .host = "127.0.0.1:8080"};
  }
  static PageRequest post(const std::string& target, const std::string& origin) {
    PageRequest out = get(target);
    out.method = "POST";
    out.origin = origin;
    return out;
  }
  Engine engine{one_valve(), "test"};
  Access::Time now = Access::Time(std::chrono::hours(1));
};

TEST_F(DoorTest, WithoutAccountsOnlyTheNamesOfThisMachineComeIn) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost:8080", "[::1]:8080", "[::1]"}) {
    EXPECT_TRUE(is_own_host(host)) << host;
  }
  for (const char* host : {"", "evil.example", "127.evil.example", "127.0.0.1.evil.example:80", "localhost.evil"}) {
    EXPECT_FALSE(is_own_host(host)) << host;
  }
  PageSettings page;
  page.names = {"valves.example"};
  HttpAccess http_access(site_page(engine), page);
  PageRequest request = get("/api/v1/valves");
  EXPECT_EQ(http_access.admit(request, now).answer.status, 200U);
  request.host = "evil.example";
  EXPECT_EQ(http_access.admit(request, now).answer.status, 421U);
  request.host = "valves.example";
  EXPECT_EQ(http_access.admit(request, now).answer.status, 200U);
}

TEST_F(DoorTest, StrangersGetThePageAndNothingElse) {
  HttpAccess http_access(site_page(engine), with_accounts());
  for (const char* open : {"/", "/live.js", "/live.css"})
    EXPECT_EQ(http_access.admit(get(open), now).answer.status, 200U);
  for (const char* closed : {"/api/v1/valves", "/api/v1/alarms", "/api/v1/events", "/api/v1/site", "/metrics",
                             "/api/v1/recordings/1.csv", "/api/v1/openapi.json", "/nothing"}) {
    EXPECT_EQ(http_access.admit(get(closed), now).answer.status, 401U) << closed;
  }
  EXPECT_EQ(http_access.admit(post("/api/v1/alarms/1/acknowledge", ""), now).answer.status, 401U);
  PageRequest stream = get("/api/v1/valves/a/stream");
  stream.upgrade = true;
  EXPECT_FALSE(http_access.admit(stream, now).stream);
  EXPECT_THAT(http_access.admit(get("/api/v1/session"), now).answer.body,
              HasSubstr("\"role\":\"none\",\"accounts\":true"));
  PageRequest token = get("/metrics");
  token.authorization = "Bearer eve.correct horse";
  EXPECT_EQ(http_access.admit(token, now).answer.status, 200U);
}

TEST_F(DoorTest, ASessionIsOnlyWorthOnItsOwnPage) {
  HttpAccess http_access(site_page(engine), with_accounts());
  PageRequest login = post("/api/v1/login", "http://127.0.0.1:8080");
  login.body = R"({"name": "anna", "password": "correct horse"})";
  const PageAnswer in = http_access.admit(login, now).answer;
  ASSERT_EQ(in.status, 200U);
  ASSERT_EQ(in.headers.size(), 2U);
  for (const auto& [header, value] : in.headers) EXPECT_THAT(value, HasSubstr("HttpOnly; SameSite=Strict"));
  EXPECT_THAT(in.headers[0].second, testing::StartsWith("spoolflow-known="));
  login.encrypted = true;
  login.origin = "https://127.0.0.1:8080";
  EXPECT_THAT(http_access.admit(login, now).answer.headers[1].second,
              testing::AllOf(testing::StartsWith("__Host-spoolflow="), HasSubstr("Secure")));
  login.origin = "https://evil.example";
  EXPECT_EQ(http_access.admit(login, now).answer.status, 403U);

  const std::string cookie = "x=1; " + in.headers[1].second.substr(0, in.headers[1].second.find(';'));
  PageRequest read = get("/api/v1/valves");
  read.cookie = cookie;
  EXPECT_EQ(http_access.admit(read, now).answer.status, 200U);
  for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081"}) {
    PageRequest other = post("/api/v1/alarms/1/acknowledge", origin);
    other.cookie = cookie;
    EXPECT_EQ(http_access.admit(other, now).answer.status, 403U) << origin;
    PageRequest stream = get("/api/v1/valves/a/stream");
    stream.upgrade = true;
    stream.cookie = cookie;
    stream.origin = origin;
    EXPECT_FALSE(http_access.admit(stream, now).stream) << origin;
  }
  PageRequest own = post("/api/v1/alarms/1/acknowledge", "http://127.0.0.1:8080");
  own.cookie = cookie;
  EXPECT_EQ(http_access.admit(own, now).answer.status, 404U);  // let in; there is no alarm yet
}

TEST_F(DoorTest, AcknowledgingNeedsItsRole) {
  engine.start();
  for (int k = 0; k < 600 && engine.alarms().empty(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_FALSE(engine.alarms().empty());  // no samples come
  HttpAccess http_access(site_page(engine), with_accounts());
  PageRequest by = post("/api/v1/alarms/1/acknowledge", "");
  by.authorization = "Bearer eve.correct horse";
  EXPECT_EQ(http_access.admit(by, now).answer.status, 403U);
  EXPECT_EQ(engine.alarms()[0].acknowledged_ms, 0);
  by.authorization = "Bearer anna.correct horse";
  const PageAnswer done = http_access.admit(by, now).answer;
  EXPECT_EQ(done.status, 200U);
  EXPECT_THAT(done.body, HasSubstr("\"state\":\"raised_acknowledged\""));
  EXPECT_EQ(engine.alarms()[0].acknowledged_by, "anna");
  EXPECT_THAT(engine.events().back().text, HasSubstr("acknowledged by anna: no_samples"));

  PageSettings readers;
  readers.without_account = Role::read;
  EXPECT_EQ(HttpAccess(site_page(engine), readers).admit(post("/api/v1/alarms/1/acknowledge", ""), now).answer.status,
            403U);
  EXPECT_EQ(HttpAccess(site_page(engine), {}).admit(post("/api/v1/alarms/1/acknowledge", ""), now).answer.status, 200U);
  EXPECT_EQ(HttpAccess(site_page(engine), {})
                .admit(post("/api/v1/alarms/1/acknowledge", "http://evil.example"), now)
                .answer.status,
            403U);
  for (const char* none : {"/api/v1/alarms/x/acknowledge", "/api/v1/alarms//acknowledge", "/api/v1/valves",
                           "/api/v1/alarms/1/acknowledge/"}) {
    EXPECT_EQ(HttpAccess(site_page(engine), {}).admit(post(none, ""), now).answer.status, 405U) << none;
  }
}

}  // namespace
}  // namespace spoolflow::live
