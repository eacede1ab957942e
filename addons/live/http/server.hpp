#pragma once
/// The page and its interface over HTTP/1.1 and WebSocket, with TLS where a certificate is named.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "addons/live/http/page_content.hpp"
#include "addons/live/page_settings.hpp"

namespace spoolflow::live {

/// Where the settings came from. As long as the page is served they are read again whenever this file, the certificate
/// or the key has changed: accounts, names and TLS are then those; settings that cannot be used change nothing.
struct PageOrigin {
  std::filesystem::path file{};                      ///< with a table [page]; empty: certificate and key alone
  std::function<void(const std::string&)> report{};  ///< in the server's thread: what was read again, or why it was not
};

class PageServer {
 public:
  /// Serves from threads of its own until it is destroyed. What the content refers to must outlive it. Throws
  /// SiteError where the address is in use, where certificate or key cannot be used, and where other machines would
  /// reach a page without TLS and accounts.
  PageServer(PageContent content, const PageSettings& settings, PageOrigin origin = {});
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
