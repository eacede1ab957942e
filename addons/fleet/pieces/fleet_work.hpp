#pragma once
/// A command's work on a fleet: its pieces with the files that they need, and their results with the files' names as
/// they are here.
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "addons/fleet/jobs/batch.hpp"
#include "addons/fleet/jobs/job_worker.hpp"

namespace spoolflow::apps {

/// One piece on its way. Its files stand in folders "@0@", "@1@", …, which messages have instead of those here.
struct SentPiece {
  fleet::Piece piece;
  std::vector<std::pair<std::string, std::string>> names = {};  ///< in the piece, and here

  /// Text of the piece as it would have been here.
  [[nodiscard]] std::string here(std::string text) const;
};

class FleetWork {
 public:
  /// `version`: of this program. Throws what read_fleet throws, ServerAway, ServerRefuses; a server that goes away
  /// later is waited for. `report` is called with what is worth a line.
  FleetWork(const std::string& fleet_file, std::string_view version,
            const std::function<void(const std::string&)>& report);

  /// The next file of the piece, and its name there. `inside`: its path in a folder that it shares with others; empty:
  /// it stands alone under its own name. Throws std::invalid_argument where it cannot be read or is too large.
  void add(SentPiece& piece, const std::string& file, const std::string& inside = {});
  /// A file that is here as text alone.
  void add_text(SentPiece& piece, const std::string& name, const std::string& content);
  /// A file that another piece has made.
  static void add_kept(SentPiece& piece, const std::string& name, const fleet::PieceFile& file);

  std::size_t ask(SentPiece piece);
  /// Until all that were asked for are finished. `finished` gets each outcome with its messages as they would be here.
  void wait(const std::function<void(std::size_t, const fleet::Outcome&)>& finished);
  [[nodiscard]] const SentPiece& sent(std::size_t number) const { return sent_[number]; }
  [[nodiscard]] std::string content(const fleet::PieceFile& file) { return batch_->content(file); }

 private:
  void place(SentPiece& piece, const std::string& name, const std::string& here, const std::string& content);

  fleet::JobSettings limits_;
  std::unique_ptr<fleet::Batch> batch_;
  std::vector<SentPiece> sent_;
};

/// Where `sent`'s file of that number stands in the piece.
[[nodiscard]] const std::string& path_of(const fleet::Piece& piece, std::size_t number);

/// Throws where the status is not 0, as the work here would have thrown.
void throw_failure(const fleet::Outcome& outcome);

}  // namespace spoolflow::apps
