#pragma once
/// The page and its interface over HTTP/1.1 and WebSocket, with TLS where a certificate is named.
#include <cstdint>
#include <memory>

#include "spoolflow/live/door/page_content.hpp"
#include "spoolflow/live/page_settings.hpp"

namespace spoolflow::live {

class PageServer {
 public:
  /// Serves from threads of its own until it is destroyed. What the content refers to must outlive it. Throws
  /// SiteError where the address is in use, where certificate or key cannot be used, and where other machines would
  /// reach a page without TLS and accounts.
  PageServer(PageContent content, const PageSettings& settings);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
