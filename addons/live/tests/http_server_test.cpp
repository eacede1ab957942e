/// What one side may ask of the page's server while others ask, too.
#include <arpa/inet.h>
#include <array>
#include <ctime>
#include <latch>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/http/long_queue.hpp"
#include "addons/live/http/peer_address.hpp"
#include "addons/live/http/seats.hpp"
#include "addons/live/http/secret_hash.hpp"
#include "addons/live/http/server.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A page that says where it was asked.
PageContent a_page() {
  return {.name = "test",
          .answer =
              [](std::string_view, std::string_view target) {
                return PageAnswer{200, media::plain, std::string(target)};
              },
          .is_file = [](std::string_view) { return false; },
          .act = [](const AlarmOrder&, const std::string&) { return std::nullopt; },
          .stream = {}};
}

PageSettings somewhere() {
  return {.listen = {"127.0.0.1", 0}};
}

/// A connection from that address of this machine.
Descriptor connection(std::uint16_t port, const char* from = "127.0.0.1") {
  Descriptor out(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in here{}, there{};
  here.sin_family = there.sin_family = AF_INET;
  ::inet_pton(AF_INET, from, &here.sin_addr);
  EXPECT_EQ(::bind(out.number(), reinterpret_cast<const sockaddr*>(&here), sizeof here), 0);
  there.sin_port = htons(port);
  there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(out.number(), reinterpret_cast<const sockaddr*>(&there), sizeof there), 0);
  const timeval patience{10, 0};
  ::setsockopt(out.number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  return out;
}

void send(const Descriptor& to, const std::string& request) {
  EXPECT_EQ(::send(to.number(), request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
}

std::string answer(const Descriptor& from) {
  std::string out;
  std::array<char, 4096> piece{};
  for (ssize_t got = 1; got > 0;) {
    got = ::recv(from.number(), piece.data(), piece.size(), 0);
    if (got > 0) out.append(piece.data(), static_cast<std::size_t>(got));
  }
  return out;
}

std::string get(const std::string& target, const std::string& lines = "") {
  return fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n{}\r\n", target, lines);
}

std::string ask(std::uint16_t port, const std::string& request, const char* from = "127.0.0.1") {
  const Descriptor one = connection(port, from);
  send(one, request);
  return answer(one);
}

TEST(PageServer, AnswersThatTakeLongHoldUpNoOthersAndHaveAQueueWithAnEnd) {
  std::latch released(1);
  PageContent page = a_page();
  page.is_long = [](std::string_view path) { return path == "/long"; };
  page.long_answer = [&](std::string_view, std::string_view, const std::stop_token&) {
    released.wait();
    return PageAnswer{200, media::plain, "long"};
  };
  const PageServer server(std::move(page), somewhere());
  std::vector<Descriptor> waiting;
  for (int k = 0; k < 2 * LongQueue::most_of_one; ++k) {
    waiting.push_back(connection(server.port()));
    send(waiting.back(), get("/long"));
  }
  EXPECT_THAT(ask(server.port(), get("/short")), HasSubstr("/short"));  // behind all of them
  for (int k = 0; k < LongQueue::most_of_one; ++k) {
    const std::string refused = answer(waiting[static_cast<std::size_t>(LongQueue::most_of_one + k)]);
    EXPECT_THAT(refused, StartsWith("HTTP/1.1 503"));
    EXPECT_THAT(refused, HasSubstr("Retry-After: 5"));
  }
  released.count_down();
  for (int k = 0; k < LongQueue::most_of_one; ++k)
    EXPECT_THAT(answer(waiting[static_cast<std::size_t>(k)]), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(ask(server.port(), get("/long")), StartsWith("HTTP/1.1 200"));
}

TEST(PageServer, AServerThatEndsWaitsForNoLongAnswer) {
  PageContent page = a_page();
  page.is_long = [](std::string_view) { return true; };
  page.long_answer = [](std::string_view, std::string_view, const std::stop_token& stop) {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return PageAnswer{503, media::plain, ""};
  };
  auto server = std::make_unique<PageServer>(std::move(page), somewhere());
  const Descriptor one = connection(server->port());
  send(one, get("/long"));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.reset();  // this test ends
}

TEST(PageServer, IdleConnectionsKeepNobodyOut) {
  const PageServer server(a_page(), somewhere());
  std::vector<Descriptor> idle;
  for (std::size_t k = 0; k < Seats::most + 34; ++k) idle.push_back(connection(server.port()));
  EXPECT_THAT(ask(server.port(), get("/one")), HasSubstr("/one"));
  for (const char* from : {"127.0.0.2", "127.0.0.3", "127.0.0.4", "127.0.0.5"}) {
    for (std::size_t k = 0; k < Seats::most_of_one; ++k) idle.push_back(connection(server.port(), from));
  }
  EXPECT_THAT(ask(server.port(), get("/two")), HasSubstr("/two"));
  EXPECT_THAT(ask(server.port(), get("/three"), "127.0.0.6"), HasSubstr("/three"));
}

TEST(PageServer, WaitsForADescriptorWithoutTurningInCircles) {
  const PageServer server(a_page(), somewhere());
  EXPECT_THAT(ask(server.port(), get("/one")), HasSubstr("/one"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // that connection is closed
  const Descriptor waiting(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(::dup(waiting.number()));  // the lowest that is free
  ::close(static_cast<int>(none.rlim_cur));
  ::setrlimit(RLIMIT_NOFILE, &none);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(server.port());
  there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(waiting.number(), reinterpret_cast<const sockaddr*>(&there), sizeof there), 0);
  const std::clock_t begin = std::clock();  // of all threads
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const double worked_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_LT(worked_s, 0.1);
  send(waiting, get("/two"));
  EXPECT_THAT(answer(waiting), HasSubstr("/two"));
}

PageSettings with_anna() {
  static const std::string hash = secret_hash("correct horse");
  PageSettings out = somewhere();
  out.accounts = {{"anna", Role::read, hash}};
  return out;
}

std::string login(std::uint16_t port, const std::string& password, const std::string& forwarded) {
  const std::string body = R"({"name": "anna", "password": ")" + password + "\"}";
  return fmt::format(
      "POST /api/v1/login HTTP/1.1\r\nHost: 127.0.0.1:{0}\r\nOrigin: http://127.0.0.1:{0}\r\nConnection: close\r\n"
      "X-Forwarded-For: {1}\r\nContent-Length: {2}\r\n\r\n{3}",
      port, forwarded, body.size(), body);
}

TEST(PageServer, WrongPasswordsThroughATrustedProxyAreThoseOfWhomItCallsFor) {
  PageSettings behind = with_anna();
  behind.proxies = {"127.0.0.1"};
  const PageServer server(a_page(), behind);
  for (int k = 0; k < 5; ++k)
    EXPECT_THAT(ask(server.port(), login(server.port(), "wrong", "203.0.113.1")), StartsWith("HTTP/1.1 401"));
  // Whatever the other side writes before what the proxy adds.
  EXPECT_THAT(ask(server.port(), login(server.port(), "correct horse", "203.0.113.2, 203.0.113.1")),
              StartsWith("HTTP/1.1 429"));
  EXPECT_THAT(ask(server.port(), login(server.port(), "correct horse", "203.0.113.2")), StartsWith("HTTP/1.1 200"));
}

TEST(PageServer, AnybodysXForwardedForSaysNothing) {
  const PageServer server(a_page(), with_anna());
  for (int k = 0; k < 5; ++k) {
    EXPECT_THAT(ask(server.port(), login(server.port(), "wrong", fmt::format("203.0.113.{}", k))),
                StartsWith("HTTP/1.1 401"));
  }
  EXPECT_THAT(ask(server.port(), login(server.port(), "correct horse", "203.0.113.9")), StartsWith("HTTP/1.1 429"));
}

TEST(PeerAddress, IsTheLastOneThatNoProxyHas) {
  const std::vector<std::string> proxies{"127.0.0.1", "10.0.0.7", "fd00::7"};
  EXPECT_EQ(forwarded_peer("192.168.0.9", "203.0.113.1", proxies), "192.168.0.9");
  EXPECT_EQ(forwarded_peer("127.0.0.1", "", proxies), "127.0.0.1");
  EXPECT_EQ(forwarded_peer("127.0.0.1", "198.51.100.4, 203.0.113.1 ", proxies), "203.0.113.1");
  EXPECT_EQ(forwarded_peer("127.0.0.1", "198.51.100.4, 203.0.113.1,10.0.0.7", proxies), "203.0.113.1");
  EXPECT_EQ(forwarded_peer("fd00::7", ",203.0.113.1:4711", proxies), "203.0.113.1");
  EXPECT_EQ(forwarded_peer("fd00::8", "203.0.113.1", proxies), "fd00::");  // a neighbour of a proxy is none
  EXPECT_EQ(forwarded_peer("127.0.0.1", "[2001:db8:1:2:3:4:5:6]:443", proxies), "2001:db8:1:2::");
  EXPECT_EQ(forwarded_peer("127.0.0.1", "2001:db8:1:2:3:4:5:6", proxies), "2001:db8:1:2::");
  EXPECT_EQ(forwarded_peer("127.0.0.1", "::ffff:203.0.113.1", proxies), "203.0.113.1");
  for (const char* none : {"unknown", "[", "", ",", "1.2.3", "evil\r\n"})
    EXPECT_EQ(forwarded_peer("127.0.0.1", none, proxies), "127.0.0.1") << none;
}

class SeatsTest : public ::testing::Test {
 protected:
  /// Takes one that waits since that second; notes where it is ended.
  bool take(const std::string& peer, int since_s, bool is_proxy = false) {
    auto seat = seats.take(peer, is_proxy, now);
    if (!seat) return false;
    const std::string name = fmt::format("{} {}", peer, since_s);
    seat->waits(Seats::Time(std::chrono::seconds(since_s)), [this, name] { ended.push_back(name); });
    taken.push_back(std::move(*seat));
    return true;
  }
  Seats seats;
  std::vector<std::string> ended;
  std::vector<Seats::Seat> taken;
  Seats::Time now{std::chrono::hours(1)};
};

TEST_F(SeatsTest, AnAddressEndsItsOwnLongestWaitingConnection) {
  taken.reserve(Seats::most);
  for (std::size_t k = 0; k < Seats::most_of_one; ++k) EXPECT_TRUE(take("a", static_cast<int>(100 - k)));
  EXPECT_TRUE(take("b", 1));
  EXPECT_TRUE(ended.empty());
  EXPECT_TRUE(take("a", 200));
  EXPECT_THAT(ended, ::testing::ElementsAre("a 37"));
  for (const Seats::Seat& one : taken) one.works();
  EXPECT_FALSE(take("a", 200));
  EXPECT_TRUE(take("c", 200));
}

TEST_F(SeatsTest, WhereAllAreTakenTheAddressWithMostGivesWay) {
  taken.reserve(2 * Seats::most);
  for (std::size_t k = 0; k < Seats::most_of_a_proxy; ++k) EXPECT_TRUE(take("proxy", 50, true));
  for (std::size_t k = Seats::most_of_a_proxy; k < Seats::most; ++k) EXPECT_TRUE(take("a", 40));
  EXPECT_TRUE(take("new", 60));
  EXPECT_THAT(ended, ::testing::ElementsAre("proxy 50"));
  EXPECT_TRUE(take("proxy", 60, true));  // there is room for it again
  EXPECT_EQ(ended.size(), 2U);
  now = Seats::Time(std::chrono::seconds(30));  // when nobody has waited for long enough
  EXPECT_FALSE(take("another", 60));
}

}  // namespace
}  // namespace spoolflow::live
