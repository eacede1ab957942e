#pragma once
/// One valve of the fleet: its blocks in their order through sensor, monitor and alarms. Without any clock but those of
/// the blocks and without input or output: the same blocks make the same rows on every machine, in however many turns.
#include <memory>
#include <optional>
#include <string>

#include "addons/fleet/store/rows.hpp"
#include "addons/live/blocks/block.hpp"
#include "addons/live/valve/alarms.hpp"
#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::fleet {

class ValveLine {
 public:
  /// `program`: name and version, of whose kept states none other is taken.
  ValveLine(std::string valve, std::string program, const live::AlarmDelays& delays);

  /// Goes on from what was kept. `model`: that of its position.
  void restore(const KeptValve& kept, live::SharedModel model);

  /// What to do with a block.
  enum class Turn : std::uint8_t {
    next,       ///< its turn has come
    early,      ///< there are others before it
    duplicate,  ///< it, or what stands for it, was worked on before; or it is of a session that is over
  };
  [[nodiscard]] Turn turn(const Block& block) const;
  /// The number that is missing, in the newest session that was met.
  [[nodiscard]] const BlockPlace& last() const { return position_.block; }
  [[nodiscard]] const std::string& model_sha256() const { return position_.model_sha256; }

  /// Works on the block whose turn has come, with the model that it names.
  void work(const Block& block, const live::SharedModel& model);
  /// The same in two parts, between which the valve that is returned works on `samples`, together with others perhaps;
  /// null: it has none, and the block is done.
  [[nodiscard]] live::ValveAtWork* begin_work(const Block& block, const live::SharedModel& model);
  void end_work(const Block& block);
  /// The block's, as a valve works on them.
  [[nodiscard]] static live::SampleBlock samples(const Block& block);
  /// Behind the last block, whose place it returns. An alarm that is not there, or was acknowledged, stays as it is.
  BlockPlace acknowledge(const Acknowledgement& seen);
  /// What is to be kept since the last time; nothing where nothing came.
  [[nodiscard]] std::optional<ValveRows> take_rows();

 private:
  void begin(const live::SharedModel& model);
  void add_event(std::string text, const Block& block);
  void look(const Block& block);
  void take_report(const SiteReport& report);

  std::string valve_, program_;
  live::AlarmDelays delays_;
  std::unique_ptr<live::ValveAtWork> work_;
  live::Alarms alarms_;
  ValvePosition position_;
  monitor::Ne107 reported_condition_ = monitor::Ne107::good;
  ValveRows rows_;  ///< since they were taken
  bool changed_ = false;
};

}  // namespace spoolflow::fleet
