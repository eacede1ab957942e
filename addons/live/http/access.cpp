#include "addons/live/http/access.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace spoolflow::live {
namespace {

constexpr auto patience = std::chrono::minutes(1);
constexpr std::size_t longest_secret = 256;

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
  known_bearers_.clear();  // they refer to the accounts before
  settings_ = settings;
  if (has_accounts() && nobodys_secret_.empty()) nobodys_secret_ = secret_hash(random_token());
}

bool Access::may_try(const std::string& peer, Time now) {
  const auto over = [&](const Trials& trials) { return now - trials.since > patience; };
  std::erase_if(trials_, [&](const auto& entry) { return over(entry.second); });
  if (over(all_trials_)) all_trials_ = {0, now};
  if (all_trials_.wrong >= trials_of_all) return false;
  const auto found = trials_.find(peer);
  if (found != trials_.end()) return found->second.wrong < trials_of_one;
  return trials_.size() < most_peers;
}

void Access::count_wrong(const std::string& peer, Time now) {
  ++trials_.try_emplace(peer, Trials{0, now}).first->second.wrong;
  ++all_trials_.wrong;
}

const Account* Access::checked(std::string_view name, std::string_view secret, const std::string& peer, Time now) {
  const auto account = std::find_if(settings_.accounts.begin(), settings_.accounts.end(),
                                    [&](const Account& one) { return one.name == name; });
  const bool known = account != settings_.accounts.end();
  const bool right = secret.size() <= longest_secret && holds(known ? account->secret : nobodys_secret_, secret);
  if (known && right) return &*account;
  count_wrong(peer, now);
  return nullptr;
}

Access::Answer Access::who(std::string_view session, std::string_view bearer, const std::string& peer, Time now) {
  if (!has_accounts()) return {{"local", settings_.without_account}};
  if (!bearer.empty()) {
    const Digest digest = digest_of(bearer);
    if (const auto known = known_bearers_.find(digest); known != known_bearers_.end()) {
      return {{known->second->name, known->second->role}};
    }
    if (!may_try(peer, now)) return {.visitor = {}, .too_many = true};
    const std::size_t point = std::min(bearer.find('.'), bearer.size());
    const std::string_view secret = bearer.substr(std::min(point + 1, bearer.size()));
    const Account* account = checked(bearer.substr(0, point), secret, peer, now);
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

Access::Login Access::login(std::string_view name, std::string_view password, const std::string& peer, Time now) {
  if (!has_accounts()) return {};
  if (!may_try(peer, now)) return {.session = {}, .visitor = {}, .too_many = true};
  const Account* account = checked(name, password, peer, now);
  if (account == nullptr) return {};
  if (sessions_.size() >= most_sessions) {
    sessions_.erase(std::min_element(sessions_.begin(), sessions_.end(),
                                     [](const auto& a, const auto& b) { return a.second.since < b.second.since; }));
  }
  Login out{random_token(), {account->name, account->role, true}, false};
  sessions_.emplace(digest_of(out.session), Session{out.visitor, now});
  return out;
}

void Access::logout(std::string_view session) {
  sessions_.erase(digest_of(session));
}

}  // namespace spoolflow::live
