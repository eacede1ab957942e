#pragma once
/// A TCP stream with or without TLS, as one stream of Boost.Beast: what is built on it is compiled once, and the layers
/// below it know its handlers as one type alone.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>

namespace spoolflow::live {

namespace beast = boost::beast;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;

/// Meets the requirements of Beast's AsyncReadStream and AsyncWriteStream for completion handlers.
class EitherStream {
 public:
  using executor_type = beast::tcp_stream::executor_type;

  /// `tls` null: without encryption.
  EitherStream(boost::asio::ip::tcp::socket&& socket, boost::asio::ssl::context* tls) {
    if (tls != nullptr) {
      tls_.emplace(std::move(socket), *tls);
    } else {
      plain_.emplace(std::move(socket));
    }
  }

  /// Null without encryption.
  [[nodiscard]] TlsStream* tls() { return tls_ ? &*tls_ : nullptr; }
  [[nodiscard]] bool is_encrypted() const { return tls_.has_value(); }
  [[nodiscard]] beast::tcp_stream& next_layer() { return tls_ ? tls_->next_layer() : *plain_; }
  [[nodiscard]] const beast::tcp_stream& next_layer() const { return tls_ ? tls_->next_layer() : *plain_; }
  [[nodiscard]] executor_type get_executor() { return next_layer().get_executor(); }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    read_some(list_of<boost::asio::mutable_buffer>(buffers), transferred(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(list_of<boost::asio::const_buffer>(buffers), transferred(std::forward<Handler>(handler)));
  }

 private:
  using Transferred = std::function<void(beast::error_code, std::size_t)>;

  template <class Handler>
  static Transferred transferred(Handler&& handler) {
    auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));  // may not be copied
    return [shared = std::move(shared)](beast::error_code error, std::size_t bytes) { (*shared)(error, bytes); };
  }
  template <class Buffer, class Buffers>
  static std::vector<Buffer> list_of(const Buffers& buffers) {
    return {boost::asio::buffer_sequence_begin(buffers), boost::asio::buffer_sequence_end(buffers)};
  }
  void read_some(const std::vector<boost::asio::mutable_buffer>& buffers, Transferred&& then);
  void write_some(const std::vector<boost::asio::const_buffer>& buffers, Transferred&& then);

  std::optional<beast::tcp_stream> plain_;
  std::optional<TlsStream> tls_;
};

/// How Beast's WebSocket ends the stream below it.
void teardown(beast::role_type role, EitherStream& stream, beast::error_code& error);
void end_below(beast::role_type role, EitherStream& stream, std::function<void(beast::error_code)>&& then);
template <class Handler>
void async_teardown(beast::role_type role, EitherStream& stream, Handler&& handler) {
  auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
  end_below(role, stream, [shared = std::move(shared)](beast::error_code error) { (*shared)(error); });
}

}  // namespace spoolflow::live
