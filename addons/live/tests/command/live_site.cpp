#include "addons/live/tests/command/live_site.hpp"

#include <arpa/inet.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <netinet/in.h>
#include <sqlite3.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

namespace spoolflow::apps {

std::string live_rows(int count, int from) {
  std::string out;
  for (int k = from; k < from + count; ++k) {
    const double place = std::sin(2e-3 * k);
    out += fmt::format("{:.3f},{:.4f},{:.3f},{:.4f},50\n", 0.001 * k, 1.2 + 0.4 * place, 4.8 + place, 1 + 0.5 * place);
  }
  return out;
}

void LiveSite::SetUp() {
  CommandLine::SetUp();
  std::filesystem::copy_file(SPOOLFLOW_EXAMPLES "/live/size_6.json", folder / "model.json");
}

void LiveSite::write_site(const std::string& source, const std::string& before) const {
  write("site.toml", "[page]\nlisten = \"127.0.0.1:0\"\n" + before +
                         "[[valve]]\nid = \"v\"\nmodel = \"model.json\"\nsource = " + source + "\n");
}

double LiveSite::kept(const char* sql) const {
  sqlite3* store = nullptr;
  sqlite3_open_v2((folder / "s.sqlite").c_str(), &store, SQLITE_OPEN_READONLY, nullptr);
  sqlite3_stmt* statement = nullptr;
  double out = -1;
  if (sqlite3_prepare_v2(store, sql, -1, &statement, nullptr) == SQLITE_OK && sqlite3_step(statement) == SQLITE_ROW) {
    out = sqlite3_column_double(statement, 0);
  }
  sqlite3_finalize(statement);
  sqlite3_close(store);
  return out;
}

double LiveSite::kept_samples(double wanted) const {
  for (int k = 0; k < 3000 && kept("SELECT samples FROM state") < wanted; ++k) ::usleep(10000);
  return kept("SELECT samples FROM state");
}

std::uint16_t LiveSite::port_in(const std::string& line) {
  // "... page at http://127.0.0.1:8080/ ; end with Ctrl-C" has its port behind the last colon, too.
  return static_cast<std::uint16_t>(std::stoi(line.substr(line.rfind(':') + 1)));
}

nlohmann::json LiveSite::valve_at(std::uint16_t page) {
  const LoopbackSender request(page);
  request.send("GET /api/v1/valves HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answer = request.received();
  const std::size_t body = answer.find("\r\n\r\n");
  if (body == std::string::npos) return {};
  return nlohmann::json::parse(answer.substr(body + 4))["valves"][0];
}

void LiveSite::rest() {
  ::usleep(20000);
}

LoopbackSender::LoopbackSender(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
}

LoopbackSender::~LoopbackSender() {
  ::close(socket_);
}

void LoopbackSender::send(const std::string& text) const {
  EXPECT_EQ(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
}

std::string LoopbackSender::received() const {
  std::string out;
  std::array<char, 65536> bytes;
  for (ssize_t got = 1; got > 0;) {
    got = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (got > 0) out.append(bytes.data(), static_cast<std::size_t>(got));
  }
  return out;
}

}  // namespace spoolflow::apps
