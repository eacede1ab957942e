#include "addons/live/http/server.hpp"

#include <algorithm>
#include <filesystem>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>
#include <openssl/err.h>

#include "addons/live/http/connection.hpp"
#include "addons/live/http/peer_address.hpp"
#include "addons/live/http/settings_watch.hpp"

namespace spoolflow::live {
namespace {

std::string reason(const boost::system::system_error& error) {
  return error.code().message();
}

/// Throws SiteError. TLS 1.2 at least.
std::shared_ptr<asio::ssl::context> tls_context(const PageSettings& settings) {
  if (!settings.has_tls()) return nullptr;
  auto context = std::make_shared<asio::ssl::context>(asio::ssl::context::tls_server);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  // A key with a password would ask for it at the terminal.
  context->set_password_callback([](std::size_t, asio::ssl::context::password_purpose) { return std::string(); });
  const std::string certificate = settings.certificate.string(), key = settings.key.string();
  try {
    context->use_certificate_chain_file(certificate);
  } catch (const boost::system::system_error& error) {
    throw SiteError(
        fmt::format("{}: no certificate can be read from it ({}); it must be a PEM file with the server's "
                    "certificate first",
                    certificate, reason(error)));
  }
  std::error_code ignored;
  const auto rights = std::filesystem::status(settings.key, ignored).permissions();
  const bool is_there = rights != std::filesystem::perms::unknown;
  if (is_there && (rights & std::filesystem::perms::others_read) != std::filesystem::perms::none) {
    throw SiteError(fmt::format("{0}: everybody on this machine may read the key; `chmod 600 {0}`", key));
  }
  try {
    context->use_private_key_file(key, asio::ssl::context::pem);
  } catch (const boost::system::system_error& error) {
    throw SiteError(fmt::format("{}: is no key of the certificate {} ({}); it must be a PEM file without password", key,
                                certificate, reason(error)));
  }
  return context;
}

SettingsWatch::Files watched_files(const PageOrigin& origin, const PageSettings& settings) {
  SettingsWatch::Files out;
  for (const std::filesystem::path& file : {origin.file, settings.certificate, settings.key}) {
    if (!file.empty()) out.push_back(file);
  }
  return out;
}

constexpr auto look_period = std::chrono::seconds(1);
/// Behind a connection that could not be taken, as without a descriptor none can.
constexpr auto accept_pause = std::chrono::milliseconds(100);

}  // namespace

struct PageServer::Parts {
  Seats seats;                              ///< before the context, whose last handlers leave them
  std::shared_ptr<asio::ssl::context> tls;  ///< of connections from now on; each keeps what it began with
  PageSettings settings;
  PageOrigin origin;
  SettingsWatch watch;
  asio::io_context context{1};
  Desk desk;
  tcp::acceptor acceptor{context};
  asio::steady_timer next_look{context}, next_accept{context};
  std::jthread thread{};

  Parts(PageContent&& content, const PageSettings& page, PageOrigin&& from)
      : tls(tls_context(page)),
        settings(page),
        origin(std::move(from)),
        watch(watched_files(origin, page)),
        desk(std::move(content), page) {}

  void look_again() {
    next_look.expires_after(look_period);
    next_look.async_wait([this](boost::system::error_code ended) {
      if (ended) return;
      if (watch.changed()) read_again();
      look_again();
    });
  }
  /// All of it or nothing.
  void read_again() {
    std::string message;
    try {
      PageSettings now = origin.file.empty() ? settings : read_page_of(origin.file);
      now.listen = settings.listen;  // another address needs a new start
      check_reach(now);
      check_secrets(now);
      if (now.has_tls() != settings.has_tls()) {
        throw SiteError(fmt::format("{}: a page with TLS instead of one without, or the other way, needs a new start",
                                    origin.file.string()));
      }
      tls = tls_context(now);
      settings = now;
      watch.follow(watched_files(origin, now));
      asio::post(desk.thread, [this, now] { desk.http_access.change(now); });
      message = fmt::format("accounts and certificate were read again: {} accounts", now.accounts.size());
    } catch (const std::exception& error) {
      message = fmt::format("{}; the accounts and the certificate of before stay in force", error.what());
    }
    if (origin.report) origin.report(message);
  }

  /// A waiting connection is accepted; without a descriptor an idle one is closed, and the listener rests.
  void accept() {
    acceptor.async_wait(tcp::acceptor::wait_read, [this](boost::system::error_code error) {
      if (error == asio::error::operation_aborted) return;
      tcp::socket socket(context);
      if (!error) acceptor.accept(socket, error);
      if (!error) take(std::move(socket));
      if (!error || error == asio::error::would_block) {
        accept();
        return;
      }
      seats.end_longest_waiting(std::chrono::steady_clock::now());
      next_accept.expires_after(accept_pause);
      next_accept.async_wait([this](boost::system::error_code ended) {
        if (!ended) accept();
      });
    });
  }
  void take(tcp::socket&& socket) {
    boost::system::error_code error;
    const auto other = socket.remote_endpoint(error);
    if (error) return;
    const std::string host = host_of(other.address().to_string()).value_or("");
    const bool is_proxy = std::find(settings.proxies.begin(), settings.proxies.end(), host) != settings.proxies.end();
    auto seat = seats.take(peer_of_host(host), is_proxy, std::chrono::steady_clock::now());
    if (!seat) return;
    serve(std::move(socket), tls.get(), std::move(*seat), host, {desk, settings});
  }
};

PageServer::PageServer(PageContent content, const PageSettings& settings, PageOrigin origin) {
  check_reach(settings);
  parts_ = std::make_unique<Parts>(std::move(content), settings, std::move(origin));
  BoundSocket bound = bind_socket(settings.listen, Transport::tcp);
  const bool is_6 = settings.listen.host.find(':') != std::string::npos;
  parts_->acceptor.assign(is_6 ? tcp::v6() : tcp::v4(), bound.descriptor.release());
  parts_->acceptor.non_blocking(true);
  parts_->accept();
  parts_->look_again();
  parts_->thread = std::jthread([parts = parts_.get()] { parts->context.run(); });
}

PageServer::~PageServer() {
  parts_->context.stop();
  parts_->thread = {};
  // What is still asked at the desk goes with the context.
  parts_->desk.end();
}

std::uint16_t PageServer::port() const {
  boost::system::error_code ignored;
  return parts_->acceptor.local_endpoint(ignored).port();
}

}  // namespace spoolflow::live
