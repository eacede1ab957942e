#pragma once
/// One message to one receiver, by libcurl: a POST to a webhook, or mail through a server.
#include <stop_token>
#include <string>

#include "addons/live/notify_settings.hpp"

namespace spoolflow::live {

/// What a webhook gets and what mail says.
struct NotifyMessage {
  std::string subject;  ///< one line
  std::string text;     ///< of mail
  std::string json;     ///< of a webhook
};

/// Takes up to 30 s; ends at once where it is asked to stop. Returns why it did not go out, without any secret; empty:
/// the receiver has it.
[[nodiscard]] std::string deliver(const NotifySettings& to, const NotifyMessage& message, const std::stop_token& stop);

}  // namespace spoolflow::live
