#include "addons/live/notify/alarm_news.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "addons/live/page/alarm_text.hpp"
#include "addons/live/page/alarm_words.hpp"

namespace spoolflow::live {
namespace {

using Kind = AlarmNews::Kind;
using monitor::Ne107;

std::string_view words(Ne107 sign) {
  switch (sign) {
    case Ne107::good:
      return "good";
    case Ne107::maintenance_required:
      return "maintenance required";
    case Ne107::out_of_specification:
      return "out of specification";
    case Ne107::function_check:
      return "function check";
    case Ne107::failure:
      return "failure";
  }
  return "failure";
}

/// "no_samples" as "no samples".
std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// "friction at press_1 (maintenance required)"
std::string phrase(const Alarm& alarm) {
  const std::string cause = spaced(alarm.cause);
  const std::string_view sign = words(sign_named(alarm.sign));
  return cause == sign ? fmt::format("{} at {}", cause, alarm.valve)
                       : fmt::format("{} at {} ({})", cause, alarm.valve, sign);
}

struct ById {
  bool operator()(const Alarm& alarm, std::int64_t id) const { return alarm.id < id; }
  bool operator()(std::int64_t id, const Alarm& alarm) const { return id < alarm.id; }
};

bool ends(Kind kind) {
  return kind == Kind::gone || kind == Kind::raised_and_gone;
}

/// What both together are.
Kind merged(Kind before, Kind now) {
  const bool began = before == Kind::raised || before == Kind::raised_again || before == Kind::raised_and_gone;
  if (now == Kind::gone) return began ? Kind::raised_and_gone : Kind::gone;
  return now == Kind::worse && began ? before : now;
}

}  // namespace

std::string_view name(Kind kind) {
  switch (kind) {
    case Kind::raised:
      return "raised";
    case Kind::raised_again:
      return "raised again";
    case Kind::worse:
      return "worse";
    case Kind::back:
      return "back from the shelf";
    case Kind::gone:
      return "gone";
    case Kind::raised_and_gone:
      return "raised and gone";
  }
  return "raised";
}

GatheredNews::GatheredNews(const std::vector<Alarm>& alarms, Ne107 least) : least_(least) {
  for (const Alarm& alarm : alarms) {
    const Ne107 sign = sign_named(alarm.sign);
    known_[alarm.id] = {alarm.times, sign, alarm.gone_ms != 0, alarm.shelved_until_ms != 0, sign >= least_};
  }
}

/// Lines "known ID TIMES SIGN GONE SHELVED NOTICED", "news ID KIND" and "left_out COUNT".
GatheredNews::GatheredNews(const std::string& written, const std::vector<Alarm>& alarms, Ne107 least) : least_(least) {
  std::istringstream lines(written);
  std::string what;
  std::int64_t id = 0;
  while (lines >> what >> id) {
    if (what == "known") {
      Known one;
      int sign = 0;
      lines >> one.times >> sign >> one.is_gone >> one.is_shelved >> one.is_noticed;
      one.sign = static_cast<Ne107>(std::clamp(sign, 0, static_cast<int>(Ne107::failure)));
      known_[id] = one;
    } else if (what == "news") {
      int kind = 0;
      lines >> kind;
      const auto alarm = std::ranges::lower_bound(alarms, id, {}, &Alarm::id);
      if (alarm == alarms.end() || alarm->id != id) continue;
      add(static_cast<Kind>(std::clamp(kind, 0, static_cast<int>(Kind::raised_and_gone))), *alarm);
    } else {
      left_out_ = static_cast<std::size_t>(std::max<std::int64_t>(id, 0));
    }
  }
}

std::string GatheredNews::written() const {
  std::string out = fmt::format("left_out {}\n", left_out_);
  for (const auto& [id, one] : known_) {
    out += fmt::format("known {} {} {} {:d} {:d} {:d}\n", id, one.times, static_cast<int>(one.sign), one.is_gone,
                       one.is_shelved, one.is_noticed);
  }
  for (const AlarmNews& one : news_) out += fmt::format("news {} {}\n", one.alarm.id, static_cast<int>(one.kind));
  return out;
}

void GatheredNews::add(Kind kind, const Alarm& alarm) {
  const auto same =
      std::find_if(news_.begin(), news_.end(), [&](const AlarmNews& one) { return one.alarm.id == alarm.id; });
  if (same == news_.end()) {
    news_.push_back({kind, alarm});
  } else {
    *same = {merged(same->kind, kind), alarm};
  }
}

std::size_t GatheredNews::look(const std::vector<Alarm>& alarms) {
  for (const Alarm& alarm : alarms) {
    Known& known = known_[alarm.id];
    const Known before = known;
    const Ne107 sign = sign_named(alarm.sign);
    const bool is_gone = alarm.gone_ms != 0, is_shelved = alarm.shelved_until_ms != 0;
    known = {alarm.times, sign, is_gone, is_shelved, before.is_noticed};
    if (is_shelved) {
      // Who shelves it knows of it: what waits is not sent, and nothing is until it comes back.
      std::erase_if(news_, [&](const AlarmNews& one) { return one.alarm.id == alarm.id; });
      continue;
    }
    if (sign < least_) continue;
    if (before.is_shelved) {
      if (!is_gone) add(Kind::back, alarm);
    } else if (alarm.times > before.times) {
      add(before.times == 0 ? Kind::raised : Kind::raised_again, alarm);
    } else if (sign > before.sign) {
      add(before.is_noticed ? Kind::worse : Kind::raised, alarm);
    }
    const bool goes = is_gone && (!before.is_gone || alarm.times > before.times);
    known.is_noticed = before.is_noticed || !is_gone || alarm.times > before.times;
    if (goes && known.is_noticed && !before.is_shelved) add(Kind::gone, alarm);
  }
  std::erase_if(known_,
                [&](const auto& one) { return !std::binary_search(alarms.begin(), alarms.end(), one.first, ById()); });
  const std::size_t pushed_out = news_.size() > most ? news_.size() - most : 0;
  news_.erase(news_.begin(), news_.begin() + static_cast<std::ptrdiff_t>(pushed_out));
  left_out_ += pushed_out;
  return pushed_out;
}

void GatheredNews::clear() {
  news_.clear();
  left_out_ = 0;
}

std::string subject_of(const GatheredNews& gathered, const std::string& site) {
  constexpr std::size_t most_named = 3;
  const std::vector<AlarmNews>& news = gathered.news();
  const auto raised = static_cast<std::size_t>(
      std::count_if(news.begin(), news.end(), [](const auto& one) { return !ends(one.kind); }));
  std::vector<std::string> named;
  for (const bool over : {false, true}) {
    for (const AlarmNews& one : news) {
      if (ends(one.kind) == over && named.size() < most_named) named.push_back(phrase(one.alarm));
    }
  }
  const auto alarms = [](std::size_t count) { return fmt::format("{} alarm{}", count, count == 1 ? "" : "s"); };
  const std::size_t gone = news.size() - raised;
  return fmt::format("spoolflow {}: {}: {}{}", site,
                     raised == 0 ? alarms(gone) + " gone"
                     : gone == 0 ? alarms(raised) + " raised"
                                 : fmt::format("{} raised, {} gone", alarms(raised), gone),
                     fmt::join(named, ", "), news.size() > named.size() ? ", …" : "");
}

std::string text_of(const GatheredNews& gathered, const std::string& site) {
  std::string out = subject_of(gathered, site) + "\n";
  for (const AlarmNews& one : gathered.news()) {
    const Alarm& alarm = one.alarm;
    out += fmt::format("\n{}: {}, since {}{}\n", name(one.kind), phrase(alarm), utc(alarm.raised_ms),
                       alarm.gone_ms == 0 ? "" : ", gone " + utc(alarm.gone_ms));
    const AlarmWords* const known = words_for(alarm.cause, alarm.sign);
    if (known != nullptr) out += fmt::format("{}\n{}\n", known->meaning, known->remedy);
    out += fmt::format("Seen: {}\n", alarm.text);
  }
  if (gathered.left_out() > 0) out += fmt::format("\n{} earlier ones are left out here.\n", gathered.left_out());
  return out;
}

std::string json_of(const GatheredNews& gathered, const std::string& site, std::int64_t now_ms) {
  Json alarms = Json::array();
  for (const AlarmNews& one : gathered.news()) {
    Json alarm = json_of(one.alarm);
    Json change{{"change", name(one.kind)}};
    change.update(alarm);
    alarms.push_back(std::move(change));
  }
  return written(Json{{"program", "spoolflow live"},
                      {"site", site},
                      {"time", utc(now_ms)},
                      {"text", subject_of(gathered, site)},
                      {"alarms", std::move(alarms)},
                      {"left_out", gathered.left_out()}});
}

}  // namespace spoolflow::live
