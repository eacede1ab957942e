#pragma once
/// Logging in and out, as text. Formats: docs/live.md.
#include <optional>
#include <string>

#include "addons/live/http/access.hpp"

namespace spoolflow::live {

/// JSON of /api/v1/session: {"account", "role", "accounts"}.
[[nodiscard]] std::string session_json(const Visitor& visitor, bool has_accounts);
/// What a body of /api/v1/login asks; nothing where it is none.
struct LoginAsked {
  std::string name, password;
};
[[nodiscard]] std::optional<LoginAsked> login_of(const std::string& body);

}  // namespace spoolflow::live
