#include <arpa/inet.h>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "addons/live/demo_model.hpp"
#include "addons/live/engine.hpp"
#include "addons/live/http/server.hpp"
#include "addons/live/page/alarm_text.hpp"
#include "addons/live/page/answer.hpp"
#include "addons/live/page/plot_frame.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PageTest : public ::testing::Test {
 protected:
  static SiteSettings two_valves() {
    const EmbeddedFile& file = demo_model().front();
    const SharedModel model{
        std::make_shared<const model::Model>(model::parse_model(std::string(file.bytes), std::string(file.name))),
        "sha"};
    SiteSettings site;
    site.valves.push_back({"a", model, UdpSettings{}});
    site.valves.push_back({"b", model, UdpSettings{}});
    site.udp = Address{"127.0.0.1", 0};
    return site;
  }
  static PageSettings at(const char* host, std::uint16_t port) { return {.listen = {host, port}}; }
  void SetUp() override { engine.start(); }
  /// What the server answers to these bytes.
  static std::string asked(std::uint16_t port, const std::string& request) {
    const Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket.number(), reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    EXPECT_EQ(::send(socket.number(), request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
    std::string answer(1 << 20, '\0');
    std::size_t got = 0;
    for (ssize_t more = 1; more > 0; got += static_cast<std::size_t>(more)) {
      more = ::recv(socket.number(), answer.data() + got, answer.size() - got, 0);
      if (more < 0) break;
    }
    answer.resize(got);
    return answer;
  }
  static std::string get(std::uint16_t port, const std::string& target, const std::string& host = "127.0.0.1") {
    return asked(port, "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n");
  }
  Engine engine{two_valves(), "test"};
};

TEST_F(PageTest, ValvesAreAsTheInterfaceSays) {
  const PageAnswer answer = answer_to(engine, "GET", "/api/v1/valves");
  const auto valves = nlohmann::json::parse(answer.body)["valves"];
  ASSERT_EQ(valves.size(), 2U);
  for (const char* key : {"id", "time_s", "flow_L_min", "flow_lower_L_min", "flow_upper_L_min", "status", "ne107",
                          "causes", "samples", "indicators"}) {
    EXPECT_TRUE(valves[0].contains(key)) << key;
  }
  EXPECT_EQ(valves[0]["id"], "a");
  EXPECT_TRUE(valves[0]["flow_L_min"].is_null());
  EXPECT_EQ(valves[0]["ne107"], "C");  // no sample has come
  EXPECT_EQ(valves[0]["status"][0], "stalled");
  for (const auto& one : valves[0]["indicators"]) {
    for (const char* key : {"name", "value", "unit", "uncertainty_95", "baseline", "state"})
      EXPECT_TRUE(one.contains(key));
  }
  EXPECT_TRUE(nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/events").body)["events"].is_array());
  EXPECT_EQ(nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/site?x=1").body)["valves"], 2);
  EXPECT_THAT(answer_to(engine, "GET", "/metrics").body, HasSubstr("spoolflow_stalled{valve=\"a\"} 1\n"));
}

TEST_F(PageTest, OneValveIsTheSameAsAmongAll) {
  const auto all = nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/valves").body)["valves"];
  const auto one = nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/valves/b").body);
  EXPECT_EQ(one["id"], "b");
  EXPECT_EQ(one["indicators"], all[1]["indicators"]);
  EXPECT_EQ(answer_to(engine, "GET", "/api/v1/valves/c").status, 404U);
}

TEST_F(PageTest, MetricsStateNoFlowBeforeTheFirstSample) {
  const std::string metrics = answer_to(engine, "GET", "/metrics").body;
  for (const char* name : {"flow_cubic_metres_per_second", "flow_lower_cubic_metres_per_second",
                           "flow_upper_cubic_metres_per_second", "pressure_difference_pascals"})
    EXPECT_THAT(metrics, HasSubstr(fmt::format("spoolflow_{}{{valve=\"a\"}} NaN\n", name)));
}

TEST_F(PageTest, RefusesRequestsWhoseEndAProxyCouldSeeElsewhere) {
  const PageServer server(site_page(engine), at("127.0.0.1", 0));
  const std::string next = "GET /api/v1/valves HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  for (const std::string lines :
       {"Host: localhost\r\nTransfer-Encoding: gzip\r\n", "Host: localhost\r\nTransfer-Encoding: xchunked\r\n",
        "Host: localhost\r\nTransfer-Encoding: gzip\r\nContent-Length: 3\r\n",
        "Host: localhost\r\nContent-Length: 3\r\nTransfer-Encoding: gzip\r\n",
        "Host: localhost\r\nTransfer-Encoding: chunked, gzip\r\n", "Host: localhost\r\nHost: localhost\r\n",
        "Host: localhost\r\nHost: other.example\r\n", ""}) {
    const std::string answer = asked(server.port(), "POST /login HTTP/1.1\r\n" + lines + "\r\nabc" + next);
    EXPECT_THAT(answer, Not(HasSubstr("HTTP/1.1 200"))) << lines;
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 400")) << lines << answer;
  }
  EXPECT_THAT(get(server.port(), "/"), StartsWith("HTTP/1.1 200"));
}

TEST_F(PageTest, NothingButWhatIsKnownIsAnswered) {
  EXPECT_EQ(answer_to(engine, "POST", "/api/v1/valves").status, 405U);
  for (const char* target : {"/../etc/passwd", "/live.html", "//", "/api/v1/valves/../events", "/%2e%2e/x", ""}) {
    EXPECT_EQ(answer_to(engine, "GET", target).status, 404U) << target;
  }
  const PageContent page = site_page(engine);
  EXPECT_TRUE(page.stream("/api/v1/valves/b/stream"));
  EXPECT_FALSE(page.stream("/api/v1/valves/c/stream"));
  EXPECT_FALSE(page.stream("/api/v1/valves/stream"));
}

TEST_F(PageTest, IsServedWithAStrictPolicy) {
  const PageServer server(site_page(engine), at("127.0.0.1", 0));
  const std::string page = get(server.port(), "/");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'"));
  EXPECT_THAT(page, Not(HasSubstr("<script>")));
  EXPECT_THAT(get(server.port(), "/live.js"), HasSubstr("/api/v1/valves"));
  EXPECT_THAT(get(server.port(), "/api/v1/valves"), HasSubstr("\"id\":\"b\""));
  EXPECT_THAT(get(server.port(), "/nothing"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get(server.port(), "/", "evil.example"), StartsWith("HTTP/1.1 421"));
  const std::string head =
      asked(server.port(), "HEAD /live.js HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(head, StartsWith("HTTP/1.1 200"));
  EXPECT_TRUE(head.ends_with("\r\n\r\n"));
}

TEST_F(PageTest, RubbishEndsItsOwnConnectionAlone) {
  const PageServer server(site_page(engine), at("127.0.0.1", 0));
  (void)asked(server.port(), std::string("\x16\x03\x01\0\0\r\n\r\n", 9));
  (void)asked(server.port(), "GET /" + std::string(20000, 'x') + " HTTP/1.1\r\n\r\n");
  EXPECT_THAT(asked(server.port(),
                    "GET /api/v1/valves/b/stream HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n"
                    "Connection: Upgrade, close\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(get(server.port(), "/"), StartsWith("HTTP/1.1 200"));
}

TEST_F(PageTest, OtherMachinesAreNotLetIn) {
  EXPECT_THAT(refusal([&] { const PageServer server(site_page(engine), at("0.0.0.0", 0)); }),
              HasSubstr("needs TLS and a token"));
  const PageServer server(site_page(engine), at("127.0.0.1", 0));
  EXPECT_THAT(refusal([&] { const PageServer second(site_page(engine), at("127.0.0.1", server.port())); }),
              HasSubstr("end the program that listens there or choose another port"));
}

TEST(PlotFrame, HoldsThePointsInTheReadersUnits) {
  ValveAtWork::TracePart part{
      .first = 5, .points = {{.time_s = 2.5, .flow_max_m3_per_s = 1e-3F, .status = 6}}, .arrived_ns = 77};
  const auto frame = plot_frame(part, 99);
  ASSERT_EQ(frame.size(), plot_frame_header_bytes + plot_frame_point_bytes);
  std::uint64_t first = 0;
  double time_s = 0;
  float flow = 0;
  std::uint32_t status = 0;
  std::memcpy(&first, frame.data() + 8, 8);
  std::memcpy(&time_s, frame.data() + 32, 8);
  std::memcpy(&flow, frame.data() + 44, 4);
  std::memcpy(&status, frame.data() + 64, 4);
  EXPECT_EQ(first, 5U);
  EXPECT_EQ(time_s, 2.5);
  EXPECT_NEAR(flow, 60.0F, 1e-4F);
  EXPECT_EQ(status, 6U);
}

TEST(AlarmText, APositionSensorThatFailedIsNotSaidToReadAnotherZero) {
  Alarm alarm{.valve = "a", .cause = "position_sensor", .sign = "S"};
  EXPECT_EQ(json_of(alarm)["indicator"], "position_zero");
  alarm.sign = "F";
  EXPECT_TRUE(json_of(alarm)["indicator"].is_null());
  EXPECT_THAT(json_of(alarm)["meaning"].get<std::string>(), HasSubstr("jumps as no spool can"));
  EXPECT_THAT(json_of(alarm)["remedy"].get<std::string>(), HasSubstr("connector"));
}

}  // namespace
}  // namespace spoolflow::live
