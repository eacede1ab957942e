#pragma once
/// What stands behind the access of a page: a site's, or a fleet's.
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/http/request.hpp"

namespace spoolflow::live {

/// The next message of a WebSocket; of the server's thread, and quick.
using NextFrame = std::function<std::vector<std::uint8_t>()>;

/// What is posted to /api/v1/alarms/ALARM/ACTION by somebody who may.
struct AlarmOrder {
  std::string_view alarm, action;  ///< action: "acknowledge", "shelve", "unshelve" or "comment"
  std::string_view body;           ///< as it came
};

/// Each is called by one thread at a time; `long_answer` by another one than the rest.
struct PageContent {
  std::string name;  ///< of the program, for browsers: "spoolflow live"
  /// The answer to those who may read; `target` as the request has it.
  std::function<PageAnswer(std::string_view method, std::string_view target)> answer;
  /// Whether it is one of the files that the page is made of, which contain nothing of the site.
  std::function<bool(std::string_view path)> is_file;
  /// Does it; nothing where that is no alarm's name.
  std::function<std::optional<PageAnswer>(const AlarmOrder& order, const std::string& by)> act;
  /// Empty where no plot is streamed at that path.
  std::function<NextFrame(std::string_view path)> stream;
  /// Whether an answer reads much, days of a valve for one. Empty: none does.
  std::function<bool(std::string_view path)> is_long{};
  /// As `answer`, of these; gives up where it is asked to stop.
  std::function<PageAnswer(std::string_view method, std::string_view target, const std::stop_token& stop)>
      long_answer{};
};

}  // namespace spoolflow::live
