#pragma once
/// Where a request comes in: by which name it calls the server, who sent it, what they may do; and its answer.
#include <cstddef>
#include <optional>
#include <string>

#include "spoolflow/live/engine.hpp"
#include "spoolflow/live/page/access.hpp"
#include "spoolflow/live/page/request.hpp"

namespace spoolflow::live {

/// A WebSocket that is to be opened has `stream`, the valve's place; everything else its answer.
struct Admission {
  PageAnswer answer;
  std::optional<std::size_t> stream{};
};

/// To be used by one thread.
class Door {
 public:
  /// Throws SiteError where an account cannot be used.
  Door(Engine& engine, const PageSettings& settings) : engine_(engine), settings_(settings), access_(settings) {}

  [[nodiscard]] Admission admit(const PageRequest& request, Access::Time now);

 private:
  [[nodiscard]] bool knows_host(std::string_view host) const;
  [[nodiscard]] bool is_own_page(const PageRequest& request) const;
  [[nodiscard]] PageAnswer login(const PageRequest& request, Access::Time now);
  [[nodiscard]] PageAnswer logout(const PageRequest& request);
  [[nodiscard]] PageAnswer acknowledge(const PageRequest& request, const Visitor& visitor, std::int64_t alarm);
  [[nodiscard]] PageAnswer posted(const PageRequest& request, const Visitor& visitor);

  Engine& engine_;
  PageSettings settings_;
  Access access_;
};

/// Whether the name by which a browser called the server is one of this machine alone: a page of another site that
/// pretends to be here by its name's address is refused.
[[nodiscard]] bool is_own_host(std::string_view host);

}  // namespace spoolflow::live
