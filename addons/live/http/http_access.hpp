#pragma once
/// Where a request comes in: by which name it calls the server, who sent it, what they may do; and its answer.
#include <string>
#include <string_view>

#include "addons/live/http/access.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::live {

/// A WebSocket that is to be opened has `stream`; what is to be asked for by long_answer() `is_long`; everything else
/// its answer.
struct Admission {
  PageAnswer answer;
  NextFrame stream{};
  bool is_long = false;
};

/// To be used by one thread; long_answer() by another one.
class HttpAccess {
 public:
  /// Throws SiteError where an account cannot be used.
  HttpAccess(PageContent content, const PageSettings& settings)
      : content_(std::move(content)), settings_(settings), access_(settings) {}

  /// Accounts, names and the like from now on; see Access::change().
  void change(const PageSettings& settings) {
    settings_ = settings;
    access_.change(settings);
  }

  [[nodiscard]] Admission admit(const PageRequest& request, Access::Time now);
  /// To a request that was admitted and is long.
  [[nodiscard]] PageAnswer long_answer(const PageRequest& request, const std::stop_token& stop) const {
    return content_.long_answer(request.method, request.target, stop);
  }

 private:
  [[nodiscard]] bool knows_host(std::string_view host) const;
  [[nodiscard]] bool is_own_page(const PageRequest& request) const;
  [[nodiscard]] PageAnswer login(const PageRequest& request, Access::Time now);
  [[nodiscard]] PageAnswer logout(const PageRequest& request);
  [[nodiscard]] PageAnswer act(const PageRequest& request, const Visitor& visitor, const AlarmOrder& order);
  [[nodiscard]] PageAnswer posted(const PageRequest& request, const Visitor& visitor);

  PageContent content_;
  PageSettings settings_;
  Access access_;
};

/// Whether the name by which a browser called the server is one of this machine alone: a page of another site that
/// pretends to be here by its name's address is refused.
[[nodiscard]] bool is_own_host(std::string_view host);

}  // namespace spoolflow::live
