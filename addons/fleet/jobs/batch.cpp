#include "addons/fleet/jobs/batch.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "addons/fleet/jobs/contents.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds looks_every{200};
constexpr std::chrono::seconds tries_again_every{1};
constexpr std::chrono::seconds wants_every{60};
/// Longer than a worker lets pass between two of its signs.
constexpr double silent_s = 10;

Outcome outcome_of(const FinishedJob& job) {
  if (job.state != JobState::given_up) return read_outcome(job.outcome);
  return {.status = 1,
          .messages = {fmt::format("the piece {:.8} ended its worker {} times and is given up; look at the workers' "
                                   "messages, or do the work here, without --fleet",
                                   job.key, most_attempts)}};
}

}  // namespace

Batch::Batch(std::string connection, std::string program, std::function<void(const std::string&)> report)
    : connection_(std::move(connection)),
      program_(std::move(program)),
      report_(std::move(report)),
      session_(std::make_unique<Session>(connection_, "spoolflow batch")) {
  (void)read_settings(*session_);
}

void Batch::with_session(const std::function<void(Session&)>& work) {
  for (bool reported = false;;) {
    try {
      if (!session_) session_ = std::make_unique<Session>(connection_, "spoolflow batch");
      return work(*session_);
    } catch (const ServerAway& error) {  // all that is asked of it may be asked twice
      session_.reset();
      if (!reported) report_(fmt::format("{}; it is tried again and again", error.what()));
      reported = true;
      std::this_thread::sleep_for(tries_again_every);
    }
  }
}

PieceFile Batch::keep(const std::string& name, const std::string& content) {
  PieceFile out{name, model::sha256_of_text(content), static_cast<std::int64_t>(content.size())};
  if (kept_.contains(out.sha256)) return out;
  with_session([&](Session& session) { out = fleet::keep(session, name, content); });
  kept_.insert(out.sha256);
  return out;
}

std::size_t Batch::ask(const Piece& piece) {
  AskedJob job{key_of(piece, program_), piece.kind, program_, text_of(piece)};
  for (const PieceFile& file : piece.files) job.contents.push_back(file.sha256);
  with_session([&](Session& session) { ask_job(session, job); });
  keys_.push_back(job.key);
  open_[job.key].push_back(keys_.size() - 1);
  return keys_.size() - 1;
}

void Batch::wait(const std::function<void(std::size_t, const Outcome&)>& finished) {
  const Clock::time_point begun = Clock::now();
  Clock::time_point wanted = begun;
  while (!open_.empty()) {
    std::vector<std::string> keys;
    for (const auto& [key, pieces] : open_) keys.push_back(key);
    std::vector<FinishedJob> found;
    with_session([&](Session& session) {
      found = finished_jobs(session, keys);
      if (Clock::now() - wanted > wants_every) {
        want_jobs(session, keys);
        wanted = Clock::now();
      }
      if (found.empty() && Clock::now() - begun > std::chrono::duration<double>(silent_s)) report_silence(session);
    });
    for (const FinishedJob& job : found) {
      const auto pieces = open_.extract(job.key);
      const Outcome outcome = outcome_of(job);
      for (const std::size_t piece : pieces.mapped()) finished(piece, outcome);
    }
    if (found.empty()) std::this_thread::sleep_for(looks_every);
  }
}

void Batch::report_silence(Session& session) {
  const Takers takers = takers_of(session, program_);
  if (takers.silent_s < silent_s) {
    silence_reported_ = false;
    return;
  }
  if (silence_reported_) return;
  silence_reported_ = true;
  report_(
      takers.other_programs.empty()
          ? fmt::format("no worker has asked for work for {:.0f} s; start one: spoolflow worker FLEET.toml", silent_s)
          : fmt::format("no worker of this program ({}) has asked for work for {:.0f} s; those at work are of {}",
                        program_, silent_s, takers.other_programs));
}

std::string Batch::content(const PieceFile& file) {
  std::string out;
  with_session([&](Session& session) { out = content_of(session, file); });
  return out;
}

}  // namespace spoolflow::fleet
