#pragma once
/// Who asks, and what they may do: accounts, sessions of browsers, and the patience with wrong passwords. To be used by
/// one thread.
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "addons/live/http/secret_hash.hpp"
#include "addons/live/page_settings.hpp"

namespace spoolflow::live {

struct Visitor {
  std::string name{};
  Role role = Role::none;
  bool by_cookie = false;  ///< which a browser sends by itself: other pages might have it do so
};

class Access {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// Wrong passwords and tokens a minute, for one account from one address, after which each of these is refused
  /// unseen; and of all, after which each address has one a minute for each account. So nobody is kept out by what
  /// others try from elsewhere, or for another account, or beside a browser that has logged in before.
  static constexpr int trials_of_one = 5, trials_of_all = 60;
  static constexpr std::size_t most_sessions = 1000, most_browsers = 1000, most_tried = 4096;

  /// Throws SiteError where an account's secret is no hash.
  explicit Access(const PageSettings& settings);

  /// Other accounts from now on, of which none may be unusable (check_secrets). Sessions go on, with the
  /// role that they have now, unless their account is gone or its secret another.
  void change(const PageSettings& settings);

  [[nodiscard]] bool has_accounts() const { return !settings_.accounts.empty(); }

  /// `too_many`: nothing was looked at, as too many were wrong before.
  struct Answer {
    Visitor visitor;
    bool too_many = false;
  };
  /// `session`: of the cookie; `bearer`: NAME.SECRET; either may be empty. `peer`: whose trials are counted together.
  [[nodiscard]] Answer who(std::string_view session, std::string_view bearer, const std::string& peer, Time now);

  struct Login {
    std::string session{};  ///< empty: refused
    Visitor visitor{};
    bool too_many = false;
    std::string browser{};  ///< of a cookie that outlives the session: whose trials are counted apart from its address
  };
  /// Who logs in: an address, and the browser's own cookie where it has one.
  struct Trier {
    std::string peer;
    std::string_view browser{};
  };
  [[nodiscard]] Login login(std::string_view name, std::string_view password, const Trier& who, Time now);
  void logout(std::string_view session);

 private:
  struct Session {
    Visitor visitor;
    Time since;
  };
  struct Trials {
    int wrong = 0;
    Time since;
  };
  struct Browser {
    std::string name;  ///< of the account that it logged in with
    Time since;
  };
  /// From where, and for which account: all names that there are not are one.
  using Tried = std::pair<std::string, std::string>;
  [[nodiscard]] const Account* account_of(std::string_view name) const;
  [[nodiscard]] Tried tried(const std::string& from, std::string_view name) const;
  [[nodiscard]] bool may_try(const Tried& what, Time now);
  void count_wrong(const Tried& what, Time now);
  [[nodiscard]] const Account* checked(std::string_view name, std::string_view secret, const Tried& what, Time now);
  [[nodiscard]] std::string knows(std::string_view browser, const std::string& name, Time now);

  PageSettings settings_;
  std::string nobodys_secret_;  ///< so that unknown names take as long as known ones
  std::map<Digest, Session> sessions_;
  std::map<Digest, const Account*> known_bearers_;
  std::map<Digest, Browser> browsers_;
  std::map<Tried, Trials> trials_;
  Trials all_trials_;
};

/// Throws SiteError where an account's secret is no hash.
void check_secrets(const PageSettings& settings);

}  // namespace spoolflow::live
