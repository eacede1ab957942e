#include "addons/live/http/either_stream.hpp"

#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace spoolflow::live {

void EitherStream::read_some(const std::vector<boost::asio::mutable_buffer>& buffers, Transferred&& then) {
  if (tls_) {
    tls_->async_read_some(buffers, std::move(then));
  } else {
    plain_->async_read_some(buffers, std::move(then));
  }
}

void EitherStream::write_some(const std::vector<boost::asio::const_buffer>& buffers, Transferred&& then) {
  if (tls_) {
    tls_->async_write_some(buffers, std::move(then));
  } else {
    plain_->async_write_some(buffers, std::move(then));
  }
}

void teardown(beast::role_type role, EitherStream& stream, beast::error_code& error) {
  using beast::websocket::teardown;
  if (TlsStream* const tls = stream.tls()) {
    teardown(role, *tls, error);
  } else {
    teardown(role, stream.next_layer(), error);
  }
}

void end_below(beast::role_type role, EitherStream& stream, std::function<void(beast::error_code)>&& then) {
  using beast::websocket::async_teardown;
  if (TlsStream* const tls = stream.tls()) {
    async_teardown(role, *tls, std::move(then));
  } else {
    async_teardown(role, stream.next_layer(), std::move(then));
  }
}

}  // namespace spoolflow::live
