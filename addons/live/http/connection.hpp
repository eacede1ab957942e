#pragma once
/// What answers requests, and one connection of HTTP/1.1, with or without TLS, with the WebSocket that it may become.
#include <exception>
#include <stop_token>
#include <string>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/thread_pool.hpp>

#include "addons/live/http/http_access.hpp"
#include "addons/live/http/long_queue.hpp"
#include "addons/live/http/seats.hpp"

namespace spoolflow::live {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Requests are answered one by one in a thread beside the one that sends plots: neither the store's answers nor the
/// hash of a password hold those up. Those that read much have a thread of their own, so that they hold up each other
/// alone, and a queue with an end.
struct Desk {
  HttpAccess http_access;
  LongQueue queue{};
  std::stop_source ends{};  ///< for what reads much
  asio::thread_pool thread{1}, long_thread{1};

  Desk(PageContent&& content, const PageSettings& settings) : http_access(std::move(content), settings) {}
  ~Desk() { end(); }
  void end() {
    ends.request_stop();
    for (asio::thread_pool* one : {&thread, &long_thread}) {
      one->stop();
      one->join();
    }
  }
  /// `then` has the admission with its answer, in one of these threads.
  template <class Then>
  void ask(PageRequest&& request, Then&& then) {
    asio::post(thread, [this, request = std::move(request), then = std::forward<Then>(then)]() mutable {
      Admission admission = guarded([&] { return http_access.admit(request, std::chrono::steady_clock::now()); });
      if (!admission.is_long) return then(std::move(admission));
      if (!queue.enter(request.peer)) return then({busy()});
      asio::post(long_thread, [this, request = std::move(request), then = std::move(then)]() mutable {
        Admission answered = guarded([&] { return Admission{http_access.long_answer(request, ends.get_token())}; });
        queue.leave(request.peer);
        then(std::move(answered));
      });
    });
  }

 private:
  template <class Work>
  static Admission guarded(Work&& work) {
    try {
      return work();
    } catch (const std::exception& error) {
      return {{500, media::plain, std::string(error.what()) + "\n"}};
    }
  }
  static PageAnswer busy() {
    PageAnswer out{503, media::plain, "others read hours and days now; ask again in some seconds\n"};
    out.headers.emplace_back("Retry-After", "5");
    return out;
  }
};

/// What connections share with the server. Proxies are read in the thread of the connections alone.
struct Hall {
  Desk& desk;
  const PageSettings& settings;
};

/// Answers the requests of one connection, one after the other, until it ends. `tls` null: without encryption; `host`:
/// of the other side.
void serve(tcp::socket&& socket, asio::ssl::context* tls, Seats::Seat&& seat, const std::string& host,
           const Hall& hall);

}  // namespace spoolflow::live
