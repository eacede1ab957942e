#pragma once
/// The side of batch work that asks: pieces go to the fleet, results come back in any order, and what was done before,
/// by whomever and for whomever, is not done again.
///
///     fleet::Batch batch("dbname=fleet", fleet::piece_program("1.2"), say);
///     batch.ask({"estimate", arguments, {batch.keep("@0@/run.csv", content)}});
///     batch.wait([&](std::size_t piece, const fleet::Outcome& outcome) { … });
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "addons/fleet/jobs/piece.hpp"
#include "addons/fleet/store/job_table.hpp"
#include "addons/fleet/store/schema.hpp"

namespace spoolflow::fleet {

class Batch {
 public:
  /// Throws ServerAway, ServerRefuses; later a server that is away is waited for. `report` is called with what is worth
  /// a line.
  Batch(std::string connection, std::string program, std::function<void(const std::string&)> report);

  /// Kept by the fleet from now on.
  [[nodiscard]] PieceFile keep(const std::string& name, const std::string& content);
  /// Its number, which counts from 0.
  std::size_t ask(const Piece& piece);
  /// Until all that were asked for are finished; each is reported once, in the order in which they are found.
  void wait(const std::function<void(std::size_t, const Outcome&)>& finished);
  /// Throws PieceError.
  [[nodiscard]] std::string content(const PieceFile& file);

 private:
  void with_session(const std::function<void(Session&)>& work);
  void report_silence(Session& session);

  std::string connection_, program_;
  std::function<void(const std::string&)> report_;
  std::unique_ptr<Session> session_;
  std::unordered_set<std::string> kept_;  ///< contents
  std::vector<std::string> keys_;         ///< by number
  std::unordered_map<std::string, std::vector<std::size_t>> open_;
  bool silence_reported_ = false;
};

}  // namespace spoolflow::fleet
