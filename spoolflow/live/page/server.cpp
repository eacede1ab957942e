/// The only file that sees Boost.Beast, which takes long to compile.
#include "spoolflow/live/page/server.hpp"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "spoolflow/live/page/answer.hpp"
#include "spoolflow/live/page/plot_frame.hpp"

namespace spoolflow::live {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

constexpr std::uint32_t largest_header = 8192;
constexpr std::uint64_t largest_request_body = 1024;
constexpr auto patience = std::chrono::seconds(30);
constexpr auto frame_period = std::chrono::milliseconds(25);
constexpr int most_connections = 256;

/// The page asks nobody but this server for anything, and no page may frame it.
constexpr const char* security_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; base-uri "
    "'none'; "
    "form-action 'none'; frame-ancestors 'none'";

/// One of the connections that there may be.
class Place {
 public:
  explicit Place(std::atomic<int>& count) : count_(&count) { ++*count_; }
  ~Place() {
    if (count_ != nullptr) --*count_;
  }
  Place(Place&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
  Place& operator=(Place&&) = delete;

 private:
  std::atomic<int>* count_;
};

/// Sends one valve's plot, a message each frame period, as long as the browser listens. A slow browser gets fewer
/// messages, each with all that came in between.
class PlotStream : public std::enable_shared_from_this<PlotStream> {
 public:
  PlotStream(beast::tcp_stream&& stream, Place&& place, const ValveAtWork& valve)
      : socket_(std::move(stream)), place_(std::move(place)), timer_(socket_.get_executor()), valve_(valve) {}

  void accept(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own patience
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(largest_request_body);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->listen();
      self->send();
    });
  }

 private:
  /// Nothing is expected; reading notices the end.
  void listen() {
    socket_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->heard_.clear();
      if (error) {
        self->timer_.cancel();
        self->ended_ = true;
        return;
      }
      self->listen();
    });
  }
  void send() {
    if (ended_) return;
    const ValveAtWork::TracePart part = valve_.trace_from(next_);
    next_ = part.first + part.points.size();
    if (next_ > 0) --next_;  // the last point may still grow
    frame_ = plot_frame(part, steady_ns());
    socket_.binary(true);
    socket_.async_write(asio::buffer(frame_), [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->ended_) return;
      self->timer_.expires_after(frame_period);
      self->timer_.async_wait([self](beast::error_code ended) {
        if (!ended) self->send();
      });
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  Place place_;
  asio::steady_timer timer_;
  const ValveAtWork& valve_;
  beast::flat_buffer heard_;
  std::vector<std::uint8_t> frame_;
  std::uint64_t next_ = 0;
  bool ended_ = false;
};

/// Answers the requests of one connection, one after the other.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket&& socket, Place&& place, const Engine& engine)
      : stream_(std::move(socket)), place_(std::move(place)), engine_(engine) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(largest_header);
    parser_->body_limit(largest_request_body);
    stream_.expires_after(patience);
    http::async_read(stream_, heard_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->answer();
    });
  }

 private:
  static std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

  void answer() {
    const auto request = parser_->release();
    const std::string_view host = view(request[http::field::host]);
    if (!is_own_host(host)) {
      reply(request, {421, "text/plain; charset=utf-8", "this server is 127.0.0.1 or localhost\n"});
    } else if (websocket::is_upgrade(request)) {
      const auto valve = streamed_valve(engine_, view(request.target()));
      if (!valve || !is_own_origin(view(request[http::field::origin]), host)) {
        reply(request, {403, "text/plain; charset=utf-8", "no stream is there for this page\n"});
      } else {
        std::make_shared<PlotStream>(std::move(stream_), std::move(place_), engine_.valve(*valve))->accept(request);
      }
    } else {
      reply(request, answer_to(engine_, view(request.method_string()), view(request.target())));
    }
  }

  void reply(const http::request<http::string_body>& request, PageAnswer&& answer) {
    reply_ = {};
    reply_.version(request.version());
    reply_.result(answer.status);
    reply_.keep_alive(request.keep_alive());
    reply_.set(http::field::content_type, beast::string_view(answer.type.data(), answer.type.size()));
    reply_.set("Content-Security-Policy", security_policy);
    reply_.set("X-Content-Type-Options", "nosniff");
    reply_.set("Referrer-Policy", "no-referrer");
    reply_.set("Cross-Origin-Resource-Policy", "same-origin");
    reply_.set(http::field::cache_control, "no-store");
    const std::size_t length = answer.body.size();
    if (request.method() != http::verb::head) reply_.body() = std::move(answer.body);
    reply_.content_length(length);
    stream_.expires_after(patience);
    const auto written = [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      if (self->reply_.need_eof()) {
        beast::error_code ignored;
        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
        return;
      }
      self->read();
    };
    if (request.method() == http::verb::head) {
      head_.emplace(reply_);
      http::async_write_header(stream_, *head_, written);
    } else {
      http::async_write(stream_, reply_, written);
    }
  }

  beast::tcp_stream stream_;
  Place place_;
  const Engine& engine_;
  beast::flat_buffer heard_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> reply_;
  std::optional<http::response_serializer<http::string_body>> head_;
};

}  // namespace

struct PageServer::Parts {
  const Engine& engine;
  std::atomic<int> connections = 0;  ///< before the context, whose last handlers count down
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  std::jthread thread{};

  explicit Parts(const Engine& of) : engine(of) {}

  void accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && connections < most_connections) {
        std::make_shared<Connection>(std::move(socket), Place(connections), engine)->read();
      }
      accept();
    });
  }
};

PageServer::PageServer(const Engine& engine, const Address& address) : parts_(std::make_unique<Parts>(engine)) {
  if (!address.is_loopback()) {
    throw SiteError(
        fmt::format("the page at {} would be reached by other machines; that needs TLS and a token, which this version "
                    "does not have yet: listen at 127.0.0.1 and let a proxy with TLS and passwords (nginx, Caddy) or "
                    "`ssh -L 8080:127.0.0.1:8080` lead there",
                    address.text()));
  }
  BoundSocket bound = bind_socket(address, Transport::tcp);
  const bool is_6 = address.host.find(':') != std::string::npos;
  parts_->acceptor.assign(is_6 ? tcp::v6() : tcp::v4(), bound.descriptor.release());
  parts_->accept();
  parts_->thread = std::jthread([parts = parts_.get()] { parts->context.run(); });
}

PageServer::~PageServer() {
  parts_->context.stop();
}

std::uint16_t PageServer::port() const {
  beast::error_code ignored;
  return parts_->acceptor.local_endpoint(ignored).port();
}

}  // namespace spoolflow::live
