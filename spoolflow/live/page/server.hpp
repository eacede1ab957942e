#pragma once
/// The page and its interface over HTTP/1.1 and WebSocket, read only.
#include <cstdint>
#include <memory>

#include "spoolflow/live/engine.hpp"

namespace spoolflow::live {

class PageServer {
 public:
  /// Serves from a thread of its own until it is destroyed. The engine must outlive it and have started. Throws
  /// SiteError where the address is in use, or is one that other machines reach: that would need TLS and a token, which
  /// are not there yet.
  PageServer(const Engine& engine, const Address& address);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
