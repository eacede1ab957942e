#include "addons/live/http/access.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace spoolflow::live {
namespace {

constexpr auto trial_patience = std::chrono::minutes(1);
constexpr std::size_t longest_secret = 256;

template <class Entries>
auto oldest(Entries& entries) {
  return std::min_element(entries.begin(), entries.end(),
                          [](const auto& a, const auto& b) { return a.second.since < b.second.since; });
}

}  // namespace

void check_secrets(const PageSettings& settings) {
  for (const Account& account : settings.accounts) {
    if (is_secret_hash(account.secret)) continue;
    throw SiteError(
        fmt::format("the secret of the account '{0}' is no hash that this program knows; make one with "
                    "`spoolflow account {0}`",
                    account.name));
  }
}

Access::Access(const PageSettings& settings) {
  check_secrets(settings);
  change(settings);
}

void Access::change(const PageSettings& settings) {
  const auto account_in = [](const PageSettings& of, const std::string& name) {
    const auto found =
        std::find_if(of.accounts.begin(), of.accounts.end(), [&](const Account& one) { return one.name == name; });
    return found == of.accounts.end() ? nullptr : &*found;
  };
  for (auto entry = sessions_.begin(); entry != sessions_.end();) {
    Visitor& visitor = entry->second.visitor;
    const Account *before = account_in(settings_, visitor.name), *now = account_in(settings, visitor.name);
    const bool stays = now != nullptr && before != nullptr && now->secret == before->secret;
    if (stays) visitor.role = now->role;
    entry = stays ? std::next(entry) : sessions_.erase(entry);
  }
  std::erase_if(browsers_, [&](const auto& entry) { return account_in(settings, entry.second.name) == nullptr; });
  known_bearers_.clear();  // they refer to the accounts before
  settings_ = settings;
  if (has_accounts() && nobodys_secret_.empty()) nobodys_secret_ = secret_hash(random_token());
}

const Account* Access::account_of(std::string_view name) const {
  const auto account = std::find_if(settings_.accounts.begin(), settings_.accounts.end(),
                                    [&](const Account& one) { return one.name == name; });
  return account == settings_.accounts.end() ? nullptr : &*account;
}

Access::Tried Access::tried(const std::string& from, std::string_view name) const {
  return {from, account_of(name) == nullptr ? std::string() : std::string(name)};
}

bool Access::may_try(const Tried& what, Time now) {
  const auto over = [&](const Trials& trials) { return now - trials.since > trial_patience; };
  std::erase_if(trials_, [&](const auto& entry) { return over(entry.second); });
  if (over(all_trials_)) all_trials_ = {0, now};
  const auto found = trials_.find(what);
  return found == trials_.end() || found->second.wrong < (all_trials_.wrong < trials_of_all ? trials_of_one : 1);
}

void Access::count_wrong(const Tried& what, Time now) {
  if (trials_.size() >= most_tried && !trials_.contains(what)) trials_.erase(oldest(trials_));
  ++trials_.try_emplace(what, Trials{0, now}).first->second.wrong;
  ++all_trials_.wrong;
}

const Account* Access::checked(std::string_view name, std::string_view secret, const Tried& what, Time now) {
  const Account* const account = account_of(name);
  const bool right =
      secret.size() <= longest_secret && holds(account != nullptr ? account->secret : nobodys_secret_, secret);
  if (account != nullptr && right) return account;
  count_wrong(what, now);
  return nullptr;
}

/// The browser's cookie from now on, the same where it has one of that account.
std::string Access::knows(std::string_view browser, const std::string& name, Time now) {
  if (const auto found = browsers_.find(digest_of(browser)); found != browsers_.end() && found->second.name == name) {
    found->second.since = now;
    return std::string(browser);
  }
  if (browsers_.size() >= most_browsers) browsers_.erase(oldest(browsers_));
  std::string cookie = random_token();
  browsers_.emplace(digest_of(cookie), Browser{name, now});
  return cookie;
}

Access::Answer Access::who(std::string_view session, std::string_view bearer, const std::string& peer, Time now) {
  if (!has_accounts()) return {{"local", settings_.without_account}};
  if (!bearer.empty()) {
    const Digest digest = digest_of(bearer);
    if (const auto known = known_bearers_.find(digest); known != known_bearers_.end()) {
      return {{known->second->name, known->second->role}};
    }
    const std::size_t point = std::min(bearer.find('.'), bearer.size());
    const std::string_view name = bearer.substr(0, point), secret = bearer.substr(std::min(point + 1, bearer.size()));
    const Tried what = tried(peer, name);
    if (!may_try(what, now)) return {.visitor = {}, .too_many = true};
    const Account* account = checked(name, secret, what, now);
    if (account == nullptr) return {};
    known_bearers_.emplace(digest, account);  // as many as there are accounts
    return {{account->name, account->role}};
  }
  if (session.empty()) return {};
  const auto found = sessions_.find(digest_of(session));
  if (found == sessions_.end()) return {};
  if (now - found->second.since > std::chrono::duration<double, std::ratio<3600>>(settings_.session_hours)) {
    sessions_.erase(found);
    return {};
  }
  return {found->second.visitor};
}

Access::Login Access::login(std::string_view name, std::string_view password, const Trier& who, Time now) {
  if (!has_accounts()) return {};
  const Digest browser = digest_of(who.browser);
  const auto known = browsers_.find(browser);
  const bool is_known = known != browsers_.end() && known->second.name == name;
  const Tried what = tried(is_known ? "browser " + std::string(browser.begin(), browser.end()) : who.peer, name);
  if (!may_try(what, now)) return {.session = {}, .visitor = {}, .too_many = true};
  const Account* account = checked(name, password, what, now);
  if (account == nullptr) return {};
  if (sessions_.size() >= most_sessions) sessions_.erase(oldest(sessions_));
  Login out{random_token(), {account->name, account->role, true}, false, knows(who.browser, account->name, now)};
  sessions_.emplace(digest_of(out.session), Session{out.visitor, now});
  return out;
}

void Access::logout(std::string_view session) {
  sessions_.erase(digest_of(session));
}

}  // namespace spoolflow::live
