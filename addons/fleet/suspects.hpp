#pragma once
/// Valves whose rows the store refuses, and for which of their blocks: such a valve commits one block at a time until
/// it is beyond those that were refused together, and the one that is refused alone is known then.
#include <map>
#include <optional>
#include <string>

#include "addons/fleet/store/rows.hpp"

namespace spoolflow::fleet {

class Suspects {
 public:
  /// A transaction with so many blocks of the valve, the last of them `last`, was refused. False where nothing was made
  /// of that block: the valve stands then, so that others go on.
  [[nodiscard]] bool refused(const std::string& valve, const BlockPlace& last, std::size_t blocks, std::string why) {
    Suspect& one = valves_[valve];
    if (is_behind(last, one.until)) one.until = last;
    if (blocks > 1) return true;
    one.stands = one.culprit && !is_behind(last, *one.culprit) && !is_behind(*one.culprit, last);
    one.culprit = last;
    one.why = "refused by the store: " + why;
    return !one.stands;
  }
  /// Why nothing is to be made of the block; nothing where it is none of these.
  [[nodiscard]] std::optional<std::string> reason(const std::string& valve, const BlockPlace& block) const {
    const auto found = valves_.find(valve);
    if (found == valves_.end() || !found->second.culprit) return std::nullopt;
    const BlockPlace& culprit = *found->second.culprit;
    if (is_behind(block, culprit) || is_behind(culprit, block)) return std::nullopt;
    return found->second.why;
  }
  [[nodiscard]] bool any() const { return !valves_.empty(); }
  [[nodiscard]] bool has(const std::string& valve) const { return valves_.contains(valve); }
  [[nodiscard]] bool stands(const std::string& valve) const {
    const auto found = valves_.find(valve);
    return found != valves_.end() && found->second.stands;
  }
  /// A commit has the valve's rows up to that block.
  void committed(const std::string& valve, const BlockPlace& last) {
    const auto found = valves_.find(valve);
    if (found != valves_.end() && !is_behind(found->second.until, last)) valves_.erase(found);
  }

 private:
  struct Suspect {
    BlockPlace until{};  ///< the last of those that were refused together
    std::optional<BlockPlace> culprit{};
    std::string why{};
    bool stands = false;
  };
  static bool is_behind(const BlockPlace& a, const BlockPlace& b) {
    return a.session != b.session ? a.session > b.session : a.number > b.number;
  }
  std::map<std::string, Suspect> valves_;
};

}  // namespace spoolflow::fleet
