#pragma once
/// What happened to alarms since a message went out: gathered from the alarm list, bounded, as one message.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "addons/live/valve/alarms.hpp"

namespace spoolflow::live {

/// What became of one alarm since the last message.
struct AlarmNews {
  enum class Kind : std::uint8_t { raised, raised_again, worse, back, gone, raised_and_gone };
  Kind kind;
  Alarm alarm;  ///< as it is now
};
/// "raised", "raised again", "worse", "back from the shelf", "gone", "raised and gone".
[[nodiscard]] std::string_view name(AlarmNews::Kind kind);

/// Of one thread.
class GatheredNews {
 public:
  static constexpr std::size_t most = 200;  ///< further ones push out the oldest

  /// What is known of `alarms` is no news. Alarms of less than `least` are none either.
  GatheredNews(const std::vector<Alarm>& alarms, monitor::Ne107 least);
  /// As it was where written() gave that text; of `alarms` those that it does not know are news with the next look.
  GatheredNews(const std::string& written, const std::vector<Alarm>& alarms, monitor::Ne107 least);
  /// All that it knows and that waits, without what the list of alarms has.
  [[nodiscard]] std::string written() const;
  /// Looks at the list as it is now. Returns how many were pushed out.
  std::size_t look(const std::vector<Alarm>& alarms);
  [[nodiscard]] const std::vector<AlarmNews>& news() const { return news_; }
  /// Those that were pushed out since the last message.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// They went out.
  void clear();

 private:
  struct Known {
    std::int64_t times = 0;
    monitor::Ne107 sign = monitor::Ne107::good;
    bool is_gone = false, is_shelved = false, is_noticed = false;  ///< noticed: its raise was news
  };
  void add(AlarmNews::Kind kind, const Alarm& alarm);

  monitor::Ne107 least_;
  std::map<std::int64_t, Known> known_;
  std::vector<AlarmNews> news_;  ///< one an alarm, in the order in which they came
  std::size_t left_out_ = 0;
};

/// One line: "spoolflow hall_3: 2 alarms raised: friction at press_1 (maintenance required), …".
[[nodiscard]] std::string subject_of(const GatheredNews& gathered, const std::string& site);
/// A paragraph an alarm: what it means, since when, what was seen, what to do.
[[nodiscard]] std::string text_of(const GatheredNews& gathered, const std::string& site);
/// {"program", "site", "time", "text", "alarms": [{"change", …as of /api/v1/alarms}], "left_out"}.
[[nodiscard]] std::string json_of(const GatheredNews& gathered, const std::string& site, std::int64_t now_ms);

}  // namespace spoolflow::live
