#include "addons/live/http/connection.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "addons/live/http/either_stream.hpp"
#include "addons/live/http/peer_address.hpp"

namespace spoolflow::live {
namespace {

namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::uint32_t largest_header = 8192;
constexpr std::uint64_t largest_request_body = 1024;
constexpr auto connection_patience = std::chrono::seconds(30), handshake_patience = std::chrono::seconds(10);
/// Of an answer that its reader does not take, before the connection may be ended for another one.
constexpr auto reader_patience = std::chrono::seconds(3);
constexpr auto frame_period = std::chrono::milliseconds(25);

/// The page asks nobody but this server for anything, and no page may frame it.
constexpr const char* security_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; base-uri "
    "'none'; form-action 'none'; frame-ancestors 'none'";

/// Sends one valve's plot, a message each frame period, as long as the browser listens. A slow browser gets fewer
/// messages, each with all that came in between.
class PlotStream : public std::enable_shared_from_this<PlotStream> {
 public:
  PlotStream(EitherStream&& stream, Seats::Seat&& seat, NextFrame&& next)
      : socket_(std::move(stream)), seat_(std::move(seat)), timer_(socket_.get_executor()), next_(std::move(next)) {}

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
    frame_ = next_();
    socket_.binary(true);
    socket_.async_write(asio::buffer(frame_), [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->ended_) return;
      self->timer_.expires_after(frame_period);
      self->timer_.async_wait([self](beast::error_code ended) {
        if (!ended) self->send();
      });
    });
  }

  websocket::stream<EitherStream, false> socket_;  // frames are not compressed
  Seats::Seat seat_;
  asio::steady_timer timer_;
  NextFrame next_;
  beast::flat_buffer heard_;
  std::vector<std::uint8_t> frame_;
  bool ended_ = false;
};

/// Answers the requests of one connection, one after the other.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(EitherStream&& stream, Seats::Seat&& seat, std::string host, const Hall& hall)
      : stream_(std::move(stream)), seat_(std::move(seat)), host_(std::move(host)), hall_(hall) {}

  void begin() {
    TlsStream* const tls = stream_.tls();
    if (tls == nullptr) return read();
    may_end(std::chrono::seconds(0));
    beast::get_lowest_layer(stream_).expires_after(handshake_patience);
    tls->async_handshake(asio::ssl::stream_base::server, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->read();
    });
  }

 private:
  using Request = http::request<http::string_body>;

  /// Where others want its place, behind that time.
  void may_end(std::chrono::seconds patience) {
    seat_.waits(std::chrono::steady_clock::now() + patience, [weak = weak_from_this()] {
      if (const auto self = weak.lock()) beast::get_lowest_layer(self->stream_).close();
    });
  }

  void read() {
    may_end(std::chrono::seconds(0));
    parser_.emplace();
    parser_->header_limit(largest_header);
    parser_->body_limit(largest_request_body);
    beast::get_lowest_layer(stream_).expires_after(connection_patience);
    http::async_read(stream_, heard_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) {
        self->ask();
      } else if (error == http::error::header_limit) {
        self->refuse(431, "the request's head is longer than 8 KiB");
      } else if (error == http::error::body_limit) {
        self->refuse(413, "the request's body is longer than 1 KiB");
      } else if (error.category() == http::make_error_code(http::error::bad_method).category() &&
                 error != http::error::end_of_stream) {
        self->refuse(400, "this is no request of HTTP/1.1");
      }
    });
  }

  /// Whether everybody on the way sees the request end where this server does, and for the same host (RFC 9112 sections
  /// 3.2 and 6.3).
  [[nodiscard]] static bool is_unambiguous(const Request& request) {
    if (request.version() >= 11 && request.count(http::field::host) != 1) return false;
    if (request.count(http::field::host) > 1 || request.count(http::field::content_length) > 1) return false;
    const std::size_t codings = request.count(http::field::transfer_encoding);
    if (codings == 0) return true;
    return codings == 1 && beast::iequals(request[http::field::transfer_encoding], "chunked") &&
           request.count(http::field::content_length) == 0;
  }

  /// Says why, and ends the connection: what follows may be no request.
  void refuse(unsigned status, const char* why) {
    Request none;
    none.version(11);
    none.keep_alive(false);
    reply(none, {status, media::plain, std::string(why) + "\n"});
  }

  [[nodiscard]] PageRequest asked(const Request& request) const {
    const auto field = [&](http::field name) { return std::string(request[name]); };
    std::string forwarded;
    const auto [begin, end] = request.equal_range("X-Forwarded-For");
    for (auto one = begin; one != end; ++one) forwarded += "," + std::string(one->value());
    return {.method = std::string(request.method_string()),
            .target = std::string(request.target()),
            .host = field(http::field::host),
            .origin = field(http::field::origin),
            .cookie = field(http::field::cookie),
            .authorization = field(http::field::authorization),
            .body = request.body(),
            .peer = forwarded_peer(host_, forwarded, hall_.settings.proxies),
            .upgrade = websocket::is_upgrade(request),
            .encrypted = stream_.is_encrypted()};
  }

  /// At the desk, and back in this thread with its answer.
  void ask() {
    if (!is_unambiguous(parser_->get())) {
      refuse(400, "the request's end or its host is ambiguous: one Host, and of Transfer-Encoding chunked alone");
      return;
    }
    seat_.works();
    auto request = std::make_shared<Request>(parser_->release());
    hall_.desk.ask(asked(*request), [self = shared_from_this(), request](Admission&& admission) mutable {
      const auto executor = self->stream_.get_executor();
      asio::post(executor, [self = std::move(self), request, admission = std::move(admission)]() mutable {
        self->admitted(*request, std::move(admission));
      });
    });
  }

  void admitted(const Request& request, Admission&& admission) {
    if (!admission.stream) {
      reply(request, std::move(admission.answer));
      return;
    }
    std::make_shared<PlotStream>(std::move(stream_), std::move(seat_), std::move(admission.stream))->accept(request);
  }

  void reply(const Request& request, PageAnswer&& answer) {
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
    if (stream_.is_encrypted()) reply_.set(http::field::strict_transport_security, "max-age=31536000");
    for (const auto& [header, value] : answer.headers) reply_.insert(header, value);
    const std::size_t length = answer.body.size();
    if (request.method() != http::verb::head) reply_.body() = std::move(answer.body);
    reply_.content_length(length);
    beast::get_lowest_layer(stream_).expires_after(connection_patience);
    may_end(reader_patience);
    const auto next = [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      if (self->reply_.need_eof()) {
        self->end();
      } else {
        self->read();
      }
    };
    if (request.method() == http::verb::head) {
      head_.emplace(reply_);
      http::async_write_header(stream_, *head_, next);
    } else {
      http::async_write(stream_, reply_, next);
    }
  }

  void end() {
    if (TlsStream* const tls = stream_.tls()) {
      tls->async_shutdown([self = shared_from_this()](beast::error_code) {});
    } else {
      beast::error_code ignored;
      stream_.next_layer().socket().shutdown(tcp::socket::shutdown_send, ignored);
    }
  }

  EitherStream stream_;
  Seats::Seat seat_;
  std::string host_;
  Hall hall_;
  beast::flat_buffer heard_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> reply_;
  std::optional<http::response_serializer<http::string_body>> head_;
};

}  // namespace

void serve(tcp::socket&& socket, asio::ssl::context* tls, Seats::Seat&& seat, const std::string& host,
           const Hall& hall) {
  std::make_shared<Connection>(EitherStream(std::move(socket), tls), std::move(seat), host, hall)->begin();
}

}  // namespace spoolflow::live
